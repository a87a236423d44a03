// model   Conductor
// paper   A. Fresnel, 1823; M. Born and E. Wolf, "Principles of optics", ch. 14; f82: N. Hoffman, 2019
// claims  positive, reciprocal, conserving, constant
// note    a smooth metal: point lights have no highlight, only the surroundings are mirrored
#include "lib/fresnel.glsl"

uniform vec3 eta = vec3(0.14, 0.503, 1.428);   // [0.01, 10]: index of refraction, here gold's (unitless)
uniform vec3 k = vec3(3.702, 2.312, 1.937);    // [0, 12]: extinction coefficient (unitless)
uniform vec3 f0 = vec3(1.0, 0.71, 0.29);       // color: reflectance at normal incidence, for schlick and f82
uniform vec3 f82 = vec3(0.966, 0.858, 0.661);  // color: reflectance at 82 degrees, for f82
uniform int form = 0;                          // {exact, schlick, f82}: the Fresnel reflectance

vec3 F_facet(float c) {
    vec3 dip = form == FORM_F82 ? F82_dip(f0, f82) : vec3(0.0);
    return form == FORM_EXACT ? 1.0 - A_conductor(c, eta, k) : F_f82(f0, dip, c);
}

vec3 scatter(vec3 L, vec3 V) {
    return vec3(0.0);
}

vec3 surround(vec3 V) {
    if (V.z <= 0.0) return vec3(0.0);
    return F_facet(min(V.z, 1.0)) * environment(vec3(-V.xy, V.z));
}
