#include "lib/microfacet.glsl"
#include "lib/sampling.glsl"

// Facets by chance, and where they reflect to: B. Walter et al., EGSR 2007. GGX's are drawn as they are
// seen from V; Beckmann's, which are Ward's too (G. Ward, SIGGRAPH 1992), whether seen or not.
//
// V: V.z > 0; alpha: along T and B
vec3 facet(bool ggx, vec3 V, vec2 alpha, vec2 u) {
    return ggx ? visible_ggx(V, alpha, u) : facet_beckmann(alpha, u);
}

// Density of those facets over solid angle [1/sr]. H: of any length, H.z > 0
float facet_density(bool ggx, vec3 H, vec3 V, vec2 alpha) {
    float unit = inversesqrt(dot(H, H));
    return ggx ? D_ggx(H, alpha) * max(dot(V, H) * unit, 0.0) / (V.z + M_ggx(V, alpha))
        : D_beckmann(H, alpha) * (H.z * unit);
}

// The direction that such a facet mirrors V to.
vec3 facet_mirrored(bool ggx, vec3 V, vec2 alpha, vec2 u) {
    vec3 H = facet(ggx, V, alpha, u);
    return 2.0 * dot(V, H) * H - V;
}

// The density of those directions [1/sr].
float facet_mirrored_density(bool ggx, vec3 L, vec3 V, vec2 alpha) {
    vec3 H = L + V;
    if (L.z <= 0.0 || V.z <= 0.0 || dot(H, H) < 1e-12) return 0.0;  // 1e-12: L = -V, no half vector
    return facet_density(ggx, H, V, alpha) / (2.0 * length(H));     // dH / dL = 1 / (4 V.H)
}

// Both for what is glossy over a diffuse base: a share is drawn from facets, the rest from the cosine.
vec3 glossy_direction(bool ggx, float share, vec3 V, vec2 alpha, vec2 u) {
    return drawn(share, u) ? facet_mirrored(ggx, V, alpha, u) : cosine_direction(u);
}

float glossy_density(bool ggx, float share, vec3 L, vec3 V, vec2 alpha) {
    return mix(cosine_density(L), facet_mirrored_density(ggx, L, V, alpha), share);
}

// The direction that such a facet refracts V to, below the surface; above where it refracts nothing.
// n: index of refraction below over above
vec3 facet_refracted(bool ggx, vec3 V, vec2 alpha, float n, vec2 u) {
    vec3 H = facet(ggx, V, alpha, u);
    float c = dot(V, H), square = 1.0 - (1.0 - c * c) / (n * n);
    return square > 0.0 ? (c / n - sqrt(square)) * H - V / n : vec3(0.0, 0.0, 1.0);
}

// The density of those directions [1/sr], Walter 2007, eq. 17.
float facet_refracted_density(bool ggx, vec3 L, vec3 V, vec2 alpha, float n) {
    vec3 H = V + n * L;
    H = H.z < 0.0 ? -H : H;
    float square = dot(H, H), LdotH = dot(L, H);
    if (square < 1e-12 || H.z <= 0.0 || dot(V, H) <= 0.0 || LdotH >= 0.0) return 0.0;  // 1e-12: n = 1
    return facet_density(ggx, H, V, alpha) * n * n * -LdotH / (square * sqrt(square));
}
