// The radiance that leaves a surface point toward the eye: the sum over the lights of the scene.
// compose.py puts files in the places named LIGHTS, MODEL and FRAME, repeats a line marked "each
// light" for every light, and keeps a line marked "where ..." only where that holds. A light with an
// extent, or one that casts shadows, brings its own copy of lit.glsl, in the place LIT.
#include "LIGHTS"
#include "FRAME"
#include "rigs/environment.glsl"
#include "rigs/loops.glsl"
#include "rigs/spread.glsl"
#include "rigs/occlusion.glsl"
#include "MODEL"

uniform vec3 rig_eye;
uniform float rig_number;  // of the object

vec3 rig_reflected(Incident incident, Frame frame, vec3 V) {
    return incident.irradiance * scatter(to_local(incident.direction, frame), V);
}

vec3 rig_ground;             // normal of the face itself, on the side of
vec3 rig_upright;            // the normal that is shaded with
vec3 rig_raise = vec3(0.0);  // from the face to the surface that such normals speak of

bool rig_blocked(vec3 position, vec3 direction, float far) {
    bool above = dot(rig_upright, direction) > 0.0;
    vec3 ground = above || dot(rig_ground, direction) > 0.0 ? rig_ground : -rig_ground;
    vec3 start = above ? position + rig_raise : position;
    return rig_hidden(rig_lifted(start, ground, direction), direction, far);
}

// The balance heuristic of E. Veach and L. Guibas, SIGGRAPH 1995: how much a direction drawn with one
// density counts where as many are drawn with another.
float rig_balance(float own, float other) {
    return own / max(own + other, 1e-30);
}

#include "LIT"

uniform int rig_aims;  // how many lights without an extent cast shadows

// One after the other in one loop: the rays' own loops, copied for each of them, take compilers minutes.
vec3 rig_shadowed(vec3 position, Frame frame, vec3 V) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < rig_aims; ++i) {
        int next = 0;
        float far = 0.0;
        Incident incident = Incident(vec3(0.0), vec3(0.0));
        if (i == next++) incident = rig_aimed(position, far);  // each rig_aimed
        if (!rig_blocked(position, incident.direction, far)) sum += rig_reflected(incident, frame, V);
    }
    return sum;
}

// An interpolated normal may lean away from the eye where a coarse mesh turns away: an opaque surface
// is then seen at the horizon, not from behind, where models are black.
vec3 rig_radiance(vec3 position, Frame frame) {
    return from_local(vec3(0.0, 0.0, 1.0), frame);  // where normal
    return position;  // where position
    return vec3(rig_number);  // where object
    rig_here = frame;  // where surround
    rig_place = position;  // where surround and arriving
    vec3 V = to_local(normalize(rig_eye - position), frame);
    V.z = max(V.z, 1e-3);  // where opaque
    return V;  // where eye
    return to_local(toward(position, vec2(0.5)).direction, frame);  // each toward
    vec3 radiance = vec3(0.0);
    radiance += rig_reflected(light(position, vec2(0.5)), frame, V);  // each light
    radiance += rig_shadowed(position, frame, V);  // where aimed
    radiance += rig_lit(position, frame, V);  // each rig_lit
    radiance += surround(V);  // where surround
    radiance += emitted(V);  // where emitted
    if (rig_cut_short(V.x)) radiance = vec3(uintBitsToFloat(0x7fc00000u));  // where looping
    return radiance;
}
