// The radiance that leaves a surface point toward the eye: the sum over the lights of the scene.
// compose.py puts files in the places named LIGHTS, MODEL and FRAME, repeats a line marked "each
// light" for every light, and keeps a line marked "where ..." only where that holds.
#include "LIGHTS"
#include "rigs/environment.glsl"
#include "MODEL"
#include "FRAME"

uniform vec3 rig_eye;

vec3 rig_reflected(Incident incident, Frame frame, vec3 V) {
    return incident.irradiance * scatter(to_local(incident.direction, frame), V);
}

// Mesa's software renderer leaves all loops of a shader after 65 535 steps together, without a word.
// One more loop, of two or three steps and none a compiler could unroll, tells whether it did.
bool rig_cut_short(float x) {
    int steps = 0, wanted = 2 + int(floatBitsToUint(x) >> 31);
    while (steps < wanted) ++steps;
    return steps < wanted;
}

vec3 rig_radiance(vec3 position, Frame frame) {
    vec3 V = to_local(normalize(rig_eye - position), frame);
    vec3 radiance = vec3(0.0);
    radiance += rig_reflected(light(position, vec2(0.5)), frame, V);  // each light
    radiance += surround(V);  // where surround
    if (rig_cut_short(V.x)) radiance = vec3(uintBitsToFloat(0x7fc00000u));  // where looping
    return radiance;
}
