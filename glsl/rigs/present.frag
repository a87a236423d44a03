// From linear radiance to a picture: mean of the samples, exposure, tone curve, sRGB.
#include "lib/color.glsl"

uniform sampler2D rig_radiance;
uniform float rig_exposure;   // factor on the radiance, 2^EV

uniform int side = 1;         // [1, 8]: samples along each side of a pixel
uniform int target = 0;       // {display, linear}: sRGB for eyes, or radiance for arithmetic
uniform int tone = 0;         // {none, reinhard, aces}: tone curve
uniform bool exposed = true;  // toggle: exposed at all

out vec4 rig_out;  // alpha 0 marks a pixel whose radiance is NaN or infinite

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) * side;
    vec3 L = vec3(0.0);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) L += texelFetch(rig_radiance, pixel + ivec2(x, y), 0).rgb;
    L /= float(side * side);
    // By the bits of the sum, which NaN and infinity pass on: some drivers compile isnan(x) to false,
    // and clamping would hide it first.
    bool finite = (floatBitsToUint(L.r + L.g + L.b) & 0x7f800000u) != 0x7f800000u;
    if (target == TARGET_LINEAR) {
        rig_out = vec4(L, finite ? 1.0 : 0.0);
        return;
    }
    if (exposed) L *= rig_exposure;
    if (tone == TONE_REINHARD) L = tone_reinhard(L);
    if (tone == TONE_ACES) L = tone_aces(L);
    rig_out = finite ? vec4(srgb_encode(clamp(L, 0.0, 1.0)), 1.0) : vec4(1.0, 0.0, 1.0, 0.0);
}
