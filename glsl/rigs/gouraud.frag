// The radiance at the vertices, interpolated.
in vec3 rig_front;
in vec3 rig_back;  // where two_sided

out vec4 rig_out;

void main() {
    rig_out = vec4(rig_front, 1.0);  // where not two_sided
    rig_out = vec4(gl_FrontFacing ? rig_front : rig_back, 1.0);  // where two_sided
}
