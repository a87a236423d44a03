// The model is evaluated at every vertex; the radiance is interpolated.
#include "rigs/shade.glsl"
#include "rigs/place.glsl"

in vec3 rig_vertex;
in vec3 rig_vertex_normal;
in vec4 rig_vertex_tangent;  // where tangent

out vec3 rig_front;
out vec3 rig_back;  // where two_sided

void main() {
    gl_Position = rig_projected(rig_vertex);
    vec3 position = rig_placed(rig_vertex);
    vec3 N = rig_turned(rig_vertex_normal);
    vec4 tangent = rig_along(rig_vertex_tangent);  // where tangent
    rig_seed = rig_hash(uint(gl_VertexID));  // where sampled
    rig_ground = rig_upright = N;  // where shadowed
    rig_front = rig_radiance(position, Frame(N));  // where not tangent
    rig_front = rig_radiance(position, tangent_frame(N, tangent));  // where tangent
    rig_back = rig_radiance(position, Frame(-N));  // where two_sided and not tangent
    rig_back = rig_radiance(position, tangent_frame(-N, tangent));  // where two_sided and tangent
}
