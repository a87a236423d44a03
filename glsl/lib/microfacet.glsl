#include "lib/constants.glsl"

// The terms of f = D F G / (4 N.L N.V), K. Torrance and E. Sparrow, 1967; B. Walter et al., EGSR 2007.
// H = L + V is not normalised: H.xy / H.z is the slope of the facet, without a 1 - cos to cancel.
//
// P. Beckmann and A. Spizzichino, 1963. H: H.z > 0; alpha: rms slope times sqrt 2 along T and B, > 1e-4
float D_beckmann(vec3 H, vec2 alpha) {
    vec2 slope = H.xy / (alpha * H.z);
    float e = dot(slope, slope), k = dot(H, H) / (H.z * H.z);
    return e > 87.0 ? 0.0 : exp(-e) * k * k / (PI * alpha.x * alpha.y);  // e^-87 is the least float
}

// T. Trowbridge and K. Reitz, 1975; "GGX" in Walter 2007. H: H.z > 0; alpha: along T and B, > 1e-4
float D_ggx(vec3 H, vec2 alpha) {
    vec2 slope = H.xy / (alpha * H.z);
    float k = dot(H, H) / (H.z * H.z * (1.0 + dot(slope, slope)));
    return k * k / (PI * alpha.x * alpha.y);
}

// w.z Lambda(w), Smith's masking, B. Smith, 1967; E. Heitz, JCGT 3(2), 2014, eq. 72. Finite at grazing.
// w: w.z >= 0
float M_ggx(vec3 w, vec2 alpha) {
    vec2 a = alpha * w.xy;
    float s = dot(a, a);
    return 0.5 * s / (sqrt(w.z * w.z + s) + w.z + 1e-30);  // 1e-30: w = 0
}

// w.z Lambda(w) for Beckmann's slopes, Heitz 2014, eq. 68; erfc by M. Abramowitz and I. Stegun, 7.1.26,
// to 2.5e-7, where many programs use a rational form that is 0.3 % off.
// w: w.z >= 0
float M_beckmann(vec3 w, vec2 alpha) {
    float s = length(alpha * w.xy), x = w.z / max(s, 1e-30);
    if (x > 5.0) return 0.0;  // less than 1e-12
    float t = 1.0 / (1.0 + 0.3275911 * x), e = exp(-x * x);
    float series = 1.421413741 + t * (-1.453152027 + t * 1.061405429);
    float erfc = e * t * (0.254829592 + t * (-0.284496736 + t * series));
    return 0.5 * max(s * e * 0.564189584 - w.z * erfc, 0.0);  // 1 / sqrt(pi)
}

// G / (4 N.L N.V) N.L of height-correlated Smith masking, from M of both directions, Heitz 2014, eq. 99.
float G_correlated(float NdotL, float NdotV, float M_L, float M_V) {
    return 0.25 * NdotL / max(NdotL * NdotV + NdotV * M_L + NdotL * M_V, 1e-30);  // 1e-30: grazing
}

// The same with independent heights, G = G1(L) G1(V), Walter 2007, eq. 23.
float G_separable(float NdotL, float NdotV, float M_L, float M_V) {
    return 0.25 * NdotL / max((NdotL + M_L) * (NdotV + M_V), 1e-30);
}

// Either of them for either distribution.
float G_smith(bool ggx, bool correlated, vec3 L, vec3 V, vec2 alpha) {
    float M_L = ggx ? M_ggx(L, alpha) : M_beckmann(L, alpha), M_V = ggx ? M_ggx(V, alpha) : M_beckmann(V, alpha);
    return correlated ? G_correlated(L.z, V.z, M_L, M_V) : G_separable(L.z, V.z, M_L, M_V);
}

// The same for V-shaped grooves, Torrance and Sparrow 1967, J. Blinn 1977. H: L + V
float G_groove(float NdotL, float NdotV, vec3 H) {
    float one = 0.25 / max(NdotV, 1e-30);
    return min(one, H.z * NdotL / (dot(H, H) * max(NdotL, NdotV)));
}
