// The whole picture, and where in it: from -1 to 1 across and down.
out vec2 rig_at;

void main() {
    rig_at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(rig_at, 0.0, 1.0);
}
