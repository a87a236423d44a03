// The model is evaluated once per face, in the geometry stage; here a vertex passes through.
in vec3 rig_vertex;
in vec4 rig_vertex_tangent;  // where tangent

out vec3 rig_corner;
out vec4 rig_corner_tangent;  // where tangent

void main() {
    rig_corner = rig_vertex;
    rig_corner_tangent = rig_vertex_tangent;  // where tangent
}
