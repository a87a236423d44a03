// model   Rough dielectric
// paper   B. Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007
// claims  positive, reciprocal, conserving
// sides   both
// note    both BRDFs and both BTDFs of a boundary; radiance grows by eta^2 where it enters (eq. 21)
#include "lib/fresnel.glsl"
#include "lib/microfacet.glsl"

uniform float eta = 1.5;       // [0.25, 4]: index of refraction below the surface over that above (unitless)
uniform float alpha = 0.2;     // [0.001, 1] log: roughness (unitless)
uniform int distribution = 0;  // {ggx, beckmann}: D, the facets' slopes
uniform int shadowing = 0;     // {smith, separable}: G of reflection, height-correlated or not

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
