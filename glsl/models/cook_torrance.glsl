// model   Cook-Torrance
// paper   R. Cook and K. Torrance, "A reflectance model for computer graphics", ACM Transactions on
//         Graphics 1(1), 1982; ggx: B. Walter et al., EGSR 2007; compensated: C. Kulla and A. Conty, 2017
// claims  positive, reciprocal
// needs   tangent
// note    the published norm of 1982 is four times the lecture's; fresnel slide is the lecture's misprint
#include "lib/energy.glsl"
#include "lib/fresnel.glsl"
#include "lib/facet_sampling.glsl"

uniform vec3 kd = vec3(0.3, 0.08, 0.05);     // color: diffuse share (unitless)
uniform vec3 f0 = vec3(0.04);                // color: reflectance at normal incidence, for schlick and constant
uniform float eta = 1.5;                     // [1.1, 4]: index of refraction, for exact and slide (unitless)
uniform float alpha = 0.2;                   // [0.001, 1] log: m, roughness along the tangent (unitless)
uniform float alpha_y = 0.5;                 // [0.001, 1] log: roughness across it, if anisotropic (unitless)
uniform int distribution = 0;                // {beckmann, ggx}: D, the facets' slopes
uniform int shadowing = 2;                   // {none, implicit, v_groove, smith, separable}: G
uniform int fresnel = 0;                     // {exact, schlick, constant, slide}: F
uniform int norm = 0;                        // {slide, published}: f = DFG / 4 .., or that of 1982
uniform bool anisotropic = false;            // toggle: another roughness across the tangent
uniform bool compensated = false;            // toggle: what one bounce loses comes back, if isotropic

vec3 F_facet(float c) {
    if (fresnel == FRESNEL_EXACT) return vec3(F_dielectric(c, eta).x);
    if (fresnel == FRESNEL_SLIDE) return vec3(F_slide(c, eta));
    return fresnel == FRESNEL_SCHLICK ? F_schlick(f0, c) : f0;
}

vec3 scatter(vec3 L, vec3 V) {
    vec3 H = L + V;
    float square = dot(H, H), c = min(0.5 * sqrt(square), 1.0);  // c: L.H of unit directions
    if (L.z <= 0.0 || V.z <= 0.0 || square < 1e-12) return vec3(0.0);  // 1e-12: L = -V, no half vector
    vec2 a = vec2(alpha, anisotropic ? alpha_y : alpha);
    bool beckmann = distribution == DISTRIBUTION_BECKMANN;
    float D = beckmann ? D_beckmann(H, a) : D_ggx(H, a), G = shadowing == SHADOWING_NONE ? 0.25 / V.z : 0.25 * L.z;
    if (shadowing == SHADOWING_V_GROOVE) G = G_groove(L.z, V.z, H);
    if (shadowing >= SHADOWING_SMITH) G = G_smith(!beckmann, shadowing == SHADOWING_SMITH, L, V, a);
    vec3 value = F_facet(c) * (D * G * (norm == NORM_PUBLISHED ? 4.0 : 1.0));
    if (compensated && !anisotropic) {  // its loss has no known fit there
        vec3 mean = fresnel == FRESNEL_SCHLICK ? F_average(f0, vec3(0.0)) : f0;
        if (fresnel == FRESNEL_EXACT || fresnel == FRESNEL_SLIDE) mean = vec3(F_average_dielectric(eta));
        value += bounced(!beckmann, L.z, V.z, alpha, mean);
    }
    return value + kd * (INV_PI * L.z);
}

float scatter_pdf(vec3 L, vec3 V) {
    vec2 a = vec2(alpha, anisotropic ? alpha_y : alpha);
    return glossy_density(distribution == DISTRIBUTION_GGX, lobe_share(kd, F_schlick(f0, max(V.z, 0.0))), L, V, a);
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    vec2 a = vec2(alpha, anisotropic ? alpha_y : alpha);
    L = glossy_direction(distribution == DISTRIBUTION_GGX, lobe_share(kd, F_schlick(f0, max(V.z, 0.0))), V, a, u);
    return weighed(scatter(L, V), scatter_pdf(L, V));
}

vec3 surround(vec3 V) {
    return kd * ambience(vec3(0.0, 0.0, 1.0));
}
