// model   Plastic
// paper   B. Walter et al., EGSR 2007, for the coat; below it a Lambertian base whose light is reflected
//         back by the coat any number of times: J. Saunderson, Journal of the Optical Society of America
//         32, 1942
// claims  positive, reciprocal, conserving
// note    a composite: pigment under a rough dielectric coat
#include "lib/fresnel.glsl"
#include "lib/facet_sampling.glsl"

uniform vec3 kd = vec3(0.6, 0.1, 0.08);  // color: albedo of the base (unitless)
uniform float eta = 1.5;                 // [1.1, 3]: index of refraction of the coat (unitless)
uniform float alpha = 0.1;               // [0.001, 1] log: roughness of the coat (unitless)
uniform int distribution = 0;            // {ggx, beckmann}: D, the facets' slopes
uniform int shadowing = 0;               // {smith, separable}: G, height-correlated or not

// What the base sends out per irradiance that reaches it, past a coat of mean reflectance F inside.
// Less what a rough coat reflects more than the smooth one of T below, at most: no light is made.
vec3 base() {
    float inside = 1.0 - (1.0 - F_average_dielectric(eta)) / (eta * eta);
    return kd * (1.0 - min(0.44 * alpha * alpha, 0.0032)) / (eta * eta * (1.0 - kd * inside));
}

vec3 F_facet(float c) {
    return F_dielectric(c, eta).xxx;
}

vec3 scatter(vec3 L, vec3 V) {
    vec3 H = L + V;
    float square = dot(H, H);
    if (L.z <= 0.0 || V.z <= 0.0 || square < 1e-12) return vec3(0.0);  // 1e-12: L = -V, no half vector
    vec2 a = vec2(alpha);
    bool ggx = distribution == DISTRIBUTION_GGX;
    float D = ggx ? D_ggx(H, a) : D_beckmann(H, a);
    float G = G_smith(ggx, shadowing == SHADOWING_SMITH, L, V, a);
    float T = F_dielectric(min(L.z, 1.0), eta).y * F_dielectric(min(V.z, 1.0), eta).y;
    return F_facet(min(0.5 * sqrt(square), 1.0)) * (D * G) + base() * (T * INV_PI * L.z);
}

float share(vec3 V) {
    return lobe_share(kd, F_dielectric(clamp(V.z, 0.0, 1.0), eta).xxx);
}

float scatter_pdf(vec3 L, vec3 V) {
    return glossy_density(distribution == DISTRIBUTION_GGX, share(V), L, V, vec2(alpha));
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    L = glossy_direction(distribution == DISTRIBUTION_GGX, share(V), V, vec2(alpha), u);
    return weighed(scatter(L, V), scatter_pdf(L, V));
}

vec3 surround(vec3 V) {
    if (V.z <= 0.0) return vec3(0.0);
    float T = F_dielectric(min(V.z, 1.0), eta).y * (1.0 - F_average_dielectric(eta));
    return base() * T * ambience(vec3(0.0, 0.0, 1.0));
}
