// model   Rough conductor
// paper   B. Walter et al., EGSR 2007; f82: N. Hoffman, 2019; compensated: C. Kulla and A. Conty, 2017
// claims  positive, reciprocal, conserving
// needs   tangent
// note    a metal of complex index eta + i k at three wavelengths; assets/materials has measured ones
#include "lib/energy.glsl"
#include "lib/fresnel.glsl"
#include "lib/facet_sampling.glsl"

uniform vec3 eta = vec3(0.14, 0.503, 1.428);   // [0.01, 10]: index of refraction, here gold's (unitless)
uniform vec3 k = vec3(3.702, 2.312, 1.937);    // [0, 12]: extinction coefficient (unitless)
uniform vec3 f0 = vec3(1.0, 0.71, 0.29);       // color: reflectance at normal incidence, for schlick and f82
uniform vec3 f82 = vec3(0.966, 0.858, 0.661);  // color: reflectance at 82 degrees, for f82
uniform float alpha = 0.2;                     // [0.001, 1] log: roughness along the tangent (unitless)
uniform float alpha_y = 0.5;                   // [0.001, 1] log: roughness across it, if anisotropic (unitless)
uniform int form = 0;                          // {exact, schlick, f82}: the Fresnel reflectance
uniform int distribution = 0;                  // {ggx, beckmann}: D, the facets' slopes
uniform int shadowing = 0;                     // {smith, separable}: G, height-correlated or not
uniform bool anisotropic = false;              // toggle: another roughness across the tangent
uniform bool compensated = false;              // toggle: what one bounce loses comes back, if isotropic

vec3 F_facet(float c) {
    vec3 dip = form == FORM_F82 ? F82_dip(f0, f82) : vec3(0.0);
    return form == FORM_EXACT ? 1.0 - A_conductor(c, eta, k) : F_f82(f0, dip, c);
}

vec3 scatter(vec3 L, vec3 V) {
    vec3 H = L + V;
    if (L.z <= 0.0 || V.z <= 0.0 || dot(H, H) < 1e-12) return vec3(0.0);  // 1e-12: L = -V, no half vector
    vec2 a = vec2(alpha, anisotropic ? alpha_y : alpha);
    bool ggx = distribution == DISTRIBUTION_GGX;
    float D = ggx ? D_ggx(H, a) : D_beckmann(H, a);
    float G = G_smith(ggx, shadowing == SHADOWING_SMITH, L, V, a);
    vec3 value = F_facet(min(0.5 * length(H), 1.0)) * (D * G);  // L.H of unit directions
    if (compensated && !anisotropic) {  // its loss has no known fit there
        vec3 front = F_facet(1.0), dip = form == FORM_F82 ? F82_dip(f0, f82) : vec3(0.0);
        if (form == FORM_EXACT) dip = F82_dip(front, F_facet(1.0 / 7.0));
        vec3 mean = clamp(F_average(front, dip), 0.0, 1.0);
        value += bounced(ggx, L.z, V.z, alpha, mean);
    }
    return value;
}

float share() {
    return compensated && !anisotropic ? 1.0 - deficit_average(distribution == DISTRIBUTION_GGX, alpha) : 1.0;
}

float scatter_pdf(vec3 L, vec3 V) {
    vec2 a = vec2(alpha, anisotropic ? alpha_y : alpha);
    return glossy_density(distribution == DISTRIBUTION_GGX, share(), L, V, a);
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    vec2 a = vec2(alpha, anisotropic ? alpha_y : alpha);
    L = glossy_direction(distribution == DISTRIBUTION_GGX, share(), V, a, u);
    return weighed(scatter(L, V), scatter_pdf(L, V));
}
