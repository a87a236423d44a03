// From linear radiance to a picture: mean of the samples, exposure, tone curve, sRGB.
#include "lib/color.glsl"

uniform sampler2D rig_radiance;
uniform int rig_rows;         // rows of this picture: the first of a file is the top one
uniform float rig_exposure;   // factor on the radiance, 2^EV

uniform int side = 1;         // [1, 8]: samples along each side of a pixel
uniform int target = 0;       // {display, linear}: sRGB for eyes, or radiance for arithmetic
uniform int tone = 0;         // {none, reinhard, aces}: tone curve

layout(location = 0) out vec4 rig_out;
layout(location = 1) out float rig_flag;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.x, rig_rows - 1 - int(gl_FragCoord.y)) * side;
    vec3 L = vec3(0.0);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) L += texelFetch(rig_radiance, pixel + ivec2(x, y), 0).rgb;
    L /= float(side * side);
    // By its bits: some drivers compile isnan(x) to false, and clamping would hide it first.
    uvec3 bits = floatBitsToUint(L) & 0x7f800000u;
    bool finite = bits.r != 0x7f800000u && bits.g != 0x7f800000u && bits.b != 0x7f800000u;
    rig_flag = finite ? 0.0 : 1.0;
    if (target == TARGET_LINEAR) {
        rig_out = vec4(L, 1.0);
        return;
    }
    L *= rig_exposure;
    if (tone == TONE_REINHARD) L = tone_reinhard(L);
    if (tone == TONE_ACES) L = tone_aces(L);
    rig_out = vec4(finite ? srgb_encode(clamp(L, 0.0, 1.0)) : vec3(1.0, 0.0, 1.0), 1.0);
}
