// The radiance of the face.
flat in vec3 rig_face;

out vec4 rig_out;

void main() {
    rig_out = vec4(rig_face, 1.0);
}
