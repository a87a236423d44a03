// model   Dielectric
// paper   A. Fresnel, 1823; W. Snell, 1621
// claims  positive, reciprocal, conserving, constant
// sides   both
// note    one smooth boundary, such as water: mirrors and refracts the surroundings, from either side
#include "lib/fresnel.glsl"
#include "lib/refract.glsl"

uniform float eta = 1.5;  // [0.25, 4]: index of refraction below the surface over that above (unitless)

vec3 F_facet(float c) {
    return F_dielectric(c, eta).xxx;
}

vec3 scatter(vec3 L, vec3 V) {
    return vec3(0.0);
}

vec3 surround(vec3 V) {
    float side = V.z < 0.0 ? -1.0 : 1.0, n = V.z < 0.0 ? 1.0 / eta : eta;
    vec2 F = F_dielectric(min(side * V.z, 1.0), n);
    vec4 through = refracted(vec3(V.xy, side * V.z), 1.0 / n);
    vec3 radiance = F.x * environment(vec3(-V.xy, V.z));
    if (through.w > 0.0) radiance += F.y * environment(vec3(through.xy, side * through.z));
    return radiance;
}
