// The model is evaluated once per face, at its centroid, with the face's own normal.
#include "rigs/shade.glsl"
#include "rigs/place.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in vec3 rig_corner[];
in vec4 rig_corner_tangent[];  // where tangent

flat out vec3 rig_face;

void main() {
    // Differences of stored vertices are exact to an ulp of the edge, not of the position; unit edges
    // keep the product within the range of a float whatever the size of the mesh.
    vec3 along = normalize(rig_corner[1] - rig_corner[0]);
    vec3 N = rig_turned(cross(along, normalize(rig_corner[2] - rig_corner[0])));
    vec3 position = rig_placed((rig_corner[0] + rig_corner[1] + rig_corner[2]) / 3.0);
    float facing = dot(N, rig_eye - position);
    if (facing <= 0.0) return;  // where not two_sided
    N = normalize(facing < 0.0 ? -N : N);
    rig_seed = rig_hash(uint(gl_PrimitiveIDIn));  // where sampled
    rig_ground = rig_upright = N;  // where shadowed
    vec3 radiance = rig_radiance(position, Frame(N));  // where not tangent
    vec4 tangent = rig_along(rig_corner_tangent[0]);  // where tangent
    vec3 radiance = rig_radiance(position, tangent_frame(N, tangent));  // where tangent
    for (int i = 0; i < 3; ++i) {
        rig_face = radiance;  // EmitVertex leaves every output undefined
        gl_Position = rig_projected(rig_corner[i]);
        EmitVertex();
    }
}
