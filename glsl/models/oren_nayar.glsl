// model   Oren-Nayar
// paper   M. Oren and S. K. Nayar, "Generalization of Lambert's reflectance model", SIGGRAPH 1994;
//         energy_preserving: J. Portsmouth, P. Kutz and S. Hill, "EON: a practical energy-preserving
//         rough diffuse BRDF", Journal of Computer Graphics Techniques 14(1), 2025
// claims  positive, reciprocal, conserving (form = energy_preserving)
// note    qualitative is the lecture's, without interreflection; full adds it and can gain energy
#include "lib/constants.glsl"
#include "lib/diffuse.glsl"
#include "lib/sampling.glsl"

uniform vec3 albedo = vec3(0.8);            // color: rho, of a facet (unitless)
uniform float sigma = radians(30.0);        // [0, 90] degrees: standard deviation of the facets' slope angle
uniform float roughness = 0.5;              // [0, 1]: r of energy_preserving, which has no sigma (unitless)
uniform int form = 0;                       // {qualitative, full, energy_preserving}: which of the three

vec3 scatter(vec3 L, vec3 V) {
    if (L.z <= 0.0 || V.z <= 0.0) return vec3(0.0);
    float s = dot(L.xy, V.xy);              // sin(theta_i) sin(theta_r) cos(phi_i - phi_r)
    float steepest = L.z / max(L.z, V.z);   // cos(theta_i) / cos(beta): bounded, unlike tan(beta)
    if (form == FORM_ENERGY_PRESERVING) {
        float A = 1.0 / (1.0 + LOST * roughness);
        vec2 apart = L.xy + V.xy;           // 1 + s, which is small behind the light
        float up = 0.5 * (dot(apart, apart) + L.z * L.z + V.z * V.z);
        float single = s > 0.0 ? L.z + roughness * s * steepest : L.z * (1.0 - roughness + roughness * up);
        float lost = A * roughness, mean = lost * LOST_MEAN;
        vec3 again = albedo * albedo * (1.0 - mean) / (1.0 - albedo * mean);
        again *= lost / LOST_MEAN * lost_share(L) * lost_share(V) * L.z;
        return INV_PI * (albedo * A * single + again);
    }
    float variance = sigma * sigma;
    float one = 1.0 - 0.5 * variance / (variance + 0.33), two = 0.45 * variance / (variance + 0.09);
    if (form == FORM_QUALITATIVE) return albedo * (INV_PI * (one * L.z + two * max(s, 0.0) * steepest));
    float sin_L = length(L.xy), sin_V = length(V.xy);
    float turn = s / max(sin_L * sin_V, 1e-30);  // cos(phi_i - phi_r); 1e-30: any, where it does not count
    // alpha is the larger angle, beta the smaller
    float sin_alpha = L.z > V.z ? sin_V : sin_L, sin_beta = L.z > V.z ? sin_L : sin_V;
    float cos_alpha = min(L.z, V.z), rise = 2.0 / PI * angle_of(max(L.z, V.z), sin_beta);
    float b = 1.0 - rise, ab = 2.0 / PI * b * angle_of(sin_alpha, cos_alpha);
    // sin(alpha) - b^3, both nearly 1 at grazing: the differences from 1
    float gap = rise * (3.0 - rise * (3.0 - rise)) - cos_alpha * cos_alpha / (1.0 + sin_alpha);
    float second = steepest * (s < 0.0 ? turn * sin_beta * gap : s);
    float half_tangent = (sin_L + sin_V) * L.z / (L.z + V.z);  // tan((alpha + beta) / 2) cos(theta_i)
    float third = 0.125 * variance / (variance + 0.09) * ab * ab * (1.0 - abs(turn)) * half_tangent;
    float again = 0.17 * variance / (variance + 0.13) * (1.0 - turn * b * b) * L.z;
    return INV_PI * albedo * max(one * L.z + two * second + third + again * albedo, 0.0);  // or -1e-4
}

float scatter_pdf(vec3 L, vec3 V) {
    return cosine_density(L);
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    L = cosine_direction(u);
    return weighed(scatter(L, V), cosine_density(L));
}

vec3 surround(vec3 V) {
    return albedo * ambience(vec3(0.0, 0.0, 1.0));
}
