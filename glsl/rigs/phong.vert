// The normal is interpolated; the model is evaluated at every pixel, in the fragment stage.
#include "rigs/place.glsl"

in vec3 rig_vertex;
in vec3 rig_vertex_normal;
in vec4 rig_vertex_tangent;  // where tangent

out vec3 rig_position;
out vec3 rig_normal;
out vec4 rig_tangent;  // where tangent
out vec3 rig_square, rig_mixed, rig_rise;  // where shadowed

void main() {
    gl_Position = rig_projected(rig_vertex);
    rig_position = rig_placed(rig_vertex);
    rig_normal = rig_turned(rig_vertex_normal);
    rig_square = rig_normal * rig_normal;  // where shadowed
    rig_mixed = rig_normal.yzx * rig_normal.zxy;  // where shadowed
    rig_rise = rig_normal * dot(rig_normal, rig_position);  // where shadowed
    rig_tangent = rig_along(rig_vertex_tangent);  // where tangent
}
