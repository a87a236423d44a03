// The normal is interpolated; the model is evaluated at every pixel.
#include "rigs/shade.glsl"

in vec3 rig_position;
in vec3 rig_normal;
in vec4 rig_tangent;  // where tangent
in vec3 rig_square, rig_mixed, rig_rise;  // where shadowed

out vec4 rig_out;

void main() {
    vec3 N = normalize(rig_normal);
    N = gl_FrontFacing ? N : -N;  // where two_sided
    Frame frame = Frame(N);  // where not tangent
    Frame frame = tangent_frame(N, rig_tangent);  // where tangent
    ivec2 pixel = ivec2(gl_FragCoord.xy) + rig_shift;  // where sampled
    rig_seed = rig_hash(uint(pixel.x) + 65536u * uint(pixel.y));  // where sampled
    rig_ground = normalize(cross(normalize(dFdx(rig_position)), normalize(dFdy(rig_position))));  // where shadowed
    rig_ground = dot(rig_ground, N) < 0.0 ? -rig_ground : rig_ground;  // where shadowed
    rig_upright = N;  // where shadowed
    rig_raise = rig_bulge(rig_position, rig_square, rig_mixed, rig_rise, rig_ground);  // where shadowed
    rig_out = vec4(rig_radiance(rig_position, frame), 1.0);
}
