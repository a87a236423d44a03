// model   Rough dielectric
// paper   B. Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007
// claims  positive, reciprocal, conserving
// sides   both
// note    both BRDFs and both BTDFs of a boundary; radiance grows by eta^2 where it enters (eq. 21)
#include "lib/fresnel.glsl"
#include "lib/facet_sampling.glsl"

uniform float eta = 1.5;       // [0.25, 4]: index of refraction below the surface over that above (unitless)
uniform float alpha = 0.2;     // [0.001, 1] log: roughness (unitless)
uniform int distribution = 0;  // {ggx, beckmann}: D, the facets' slopes
uniform int shadowing = 0;     // {smith, separable}: G of reflection, height-correlated or not

vec3 F_facet(float c) { return F_dielectric(c, eta).xxx; }

vec3 scatter(vec3 L, vec3 V) {
    if (L.z == 0.0 || V.z == 0.0) return vec3(0.0);
    float side = V.z < 0.0 ? -1.0 : 1.0, n = V.z < 0.0 ? 1.0 / eta : eta;
    L.z *= side;  // V is above now, and n is the index below over that above
    V.z *= side;
    bool ggx = distribution == DISTRIBUTION_GGX, reflects = L.z > 0.0;
    vec3 H = reflects ? L + V : V + n * L;  // Walter eq. 13 and 16
    H = H.z < 0.0 ? -H : H;
    float square = dot(H, H), LdotH = dot(L, H), VdotH = dot(V, H);
    if (square < 1e-12 || VdotH <= 0.0 || (LdotH > 0.0) != reflects) return vec3(0.0);
    vec2 a = vec2(alpha);
    float unit = inversesqrt(square), c = min(VdotH * unit, 1.0);
    vec3 below = vec3(L.xy, abs(L.z));
    float D = ggx ? D_ggx(H, a) : D_beckmann(H, a);
    float M_L = ggx ? M_ggx(below, a) : M_beckmann(below, a), M_V = ggx ? M_ggx(V, a) : M_beckmann(V, a);
    float G = reflects && shadowing == SHADOWING_SMITH
        ? G_correlated(below.z, V.z, M_L, M_V) : G_separable(below.z, V.z, M_L, M_V);
    if (reflects) return vec3(F_dielectric(c, n).x * D * G);
    float T = T_dielectric(c, min(-LdotH * unit, 1.0) * n, n);
    return vec3(T * D * G * 4.0 * -LdotH * VdotH / (square * square));
}

// The share of the directions that are mirrored. V: above; n: the index below over that above
float share(vec3 V, float n) {
    return clamp(F_dielectric(clamp(V.z, 0.0, 1.0), n).x, 0.1, 0.9);
}

float scatter_pdf(vec3 L, vec3 V) {
    float side = V.z < 0.0 ? -1.0 : 1.0, n = V.z < 0.0 ? 1.0 / eta : eta;
    L.z *= side;
    V.z *= side;
    bool ggx = distribution == DISTRIBUTION_GGX;
    if (L.z > 0.0) return share(V, n) * facet_mirrored_density(ggx, L, V, vec2(alpha));
    return (1.0 - share(V, n)) * facet_refracted_density(ggx, L, V, vec2(alpha), n);
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    float side = V.z < 0.0 ? -1.0 : 1.0, n = V.z < 0.0 ? 1.0 / eta : eta;
    vec3 up = vec3(V.xy, side * V.z);
    bool ggx = distribution == DISTRIBUTION_GGX, mirrors = drawn(share(up, n), u);
    L = mirrors ? facet_mirrored(ggx, up, vec2(alpha), u) : facet_refracted(ggx, up, vec2(alpha), n, u);
    bool passes = mirrors == (L.z > 0.0);
    L.z *= side;
    return passes ? weighed(scatter(L, V), scatter_pdf(L, V)) : vec3(0.0);
}
