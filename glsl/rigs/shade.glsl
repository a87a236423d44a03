// The radiance that leaves a surface point toward the eye: the sum over the lights of the scene.
// compose.py puts files in the places named LIGHTS, MODEL and FRAME, repeats a line marked "each
// light" for every light, and keeps a line marked "where ..." only where that holds.
#include "LIGHTS"
#include "FRAME"
#include "rigs/environment.glsl"
#include "rigs/loops.glsl"
#include "MODEL"

uniform vec3 rig_eye;

vec3 rig_reflected(Incident incident, Frame frame, vec3 V) {
    return incident.irradiance * scatter(to_local(incident.direction, frame), V);
}

// An interpolated normal may lean away from the eye where a coarse mesh turns away: an opaque surface
// is then seen at the horizon, not from behind, where models are black.
vec3 rig_radiance(vec3 position, Frame frame) {
    rig_here = frame;  // where surround
    vec3 V = to_local(normalize(rig_eye - position), frame);
    V.z = max(V.z, 1e-3);  // where opaque
    vec3 radiance = vec3(0.0);
    radiance += rig_reflected(light(position, vec2(0.5)), frame, V);  // each light
    radiance += surround(V);  // where surround
    if (rig_cut_short(V.x)) radiance = vec3(uintBitsToFloat(0x7fc00000u));  // where looping
    return radiance;
}
