// The model at one pair of directions per pixel: the text that draws is the text that is measured.
#include "rigs/furnace.glsl"
#include "rigs/loops.glsl"
#include "rigs/strict.glsl"
#include "MODEL"

uniform sampler2D rig_L;  // to the light, local frame
uniform sampler2D rig_V;  // to the eye
uniform int rig_repeats;  // where timed
uniform float rig_tiny;  // where timed: read each time, as parameters are, which takes longest the first time

out vec4 rig_out;

void main() {
    ivec2 pair = ivec2(gl_FragCoord.xy);
    vec3 L = texelFetch(rig_L, pair, 0).xyz, V = texelFetch(rig_V, pair, 0).xyz;
    vec3 sum = vec3(0.0);  // where timed
    for (int i = 0; i < rig_repeats; ++i) {  // where timed
        // other directions each time, for less than a texture costs: turned, and kept above
        L.xz = vec2(0.8 * L.x - 0.6 * L.z, abs(0.6 * L.x + 0.8 * L.z));  // where timed
        V.yz = vec2(0.8 * V.y - 0.6 * V.z, abs(0.6 * V.y + 0.8 * V.z));  // where timed
        sum += scatter(L, V) + rig_tiny * (L + V);  // where timed
    }  // where timed
    rig_out = vec4(sum, 1.0);  // where timed
    rig_out = vec4(scatter(L, V), 1.0);  // where scatter
    rig_out = vec4(surround(V), 1.0);  // where surround
    rig_out = vec4(vec3(scatter_pdf(L, V)), 1.0);  // where density
    rig_out = vec4(F_facet(V.z), 1.0);  // where facet
    vec3 way, weight = sample_scatter(V, L.xy, way);  // where sampled
    rig_out = vec4(way, 1.0);  // where sampled and not weighed
    rig_out = vec4(weight, 1.0);  // where weighed
    if (rig_cut_short(V.x)) rig_out = vec4(uintBitsToFloat(0x7fc00000u));  // where looping
}
