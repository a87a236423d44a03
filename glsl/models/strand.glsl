// model   Strand
// paper   J. Kajiya and T. Kay, "Rendering fur with three dimensional textures", SIGGRAPH 1989;
//         D. Banks, "Illumination in diverse codimensions", SIGGRAPH 1994
// claims  positive, reciprocal (form = surface)
// needs   tangent
// note    the lecture's other anisotropic model; strand lights threads from all sides, surface cloth of them
#include "lib/constants.glsl"
#include "lib/lobe.glsl"
#include "lib/sampling.glsl"

uniform vec3 kd = vec3(0.2);     // color: k_d, diffuse share (unitless)
uniform vec3 ks = vec3(0.5);     // color: m_spec, specular share (unitless)
uniform float shininess = 40.0;  // [1, 1000 ..] log: m_shi, exponent of the lobe (unitless)
uniform int form = 0;            // {surface, strand}: times N.L, or as the thread alone

vec3 scatter(vec3 L, vec3 V) {
    if (form == FORM_SURFACE && (L.z <= 0.0 || V.z <= 0.0)) return vec3(0.0);
    float sin_L = length(L.yz), sin_V = length(V.yz);  // to the tangent, (1, 0, 0)
    // 1 + cos(theta_L + theta_V): how far the light is from leaving on its cone
    float over = sin_L - sin_V, along = L.x + V.x;
    float gap = 0.5 * (over * over + along * along);
    float lobe = cos_power(1.0 - gap, gap, shininess);
    if (form == FORM_SURFACE) return INV_PI * L.z * (kd + ks * lobe);
    return INV_PI * (kd * sin_L + ks * lobe);
}

float scatter_pdf(vec3 L, vec3 V) {
    return form == FORM_SURFACE ? cosine_density(L) : 0.25 * INV_PI;
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    L = form == FORM_SURFACE ? cosine_direction(u) : even_direction(u);
    return weighed(scatter(L, V), scatter_pdf(L, V));
}

vec3 surround(vec3 V) {
    return kd * ambience(vec3(0.0, 0.0, 1.0));
}
