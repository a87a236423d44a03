// model   Lambert
// paper   J. H. Lambert, "Photometria, sive de mensura et gradibus luminis, colorum et umbrae", 1760
// claims  positive, reciprocal, conserving (form = normalised), constant
// note    the slide calls the BRDF a constant; read as k_d, without the 1/pi, it returns pi times the light
#include "lib/sampling.glsl"

uniform vec3 albedo = vec3(0.8);  // color: rho, the share of the light that is reflected (unitless)
uniform int form = 0;             // {normalised, slide}: f = rho / pi, or f = k_d as on the slide

vec3 scatter(vec3 L, vec3 V) {
    float f = form == FORM_SLIDE ? 1.0 : INV_PI;
    return albedo * f * max(L.z, 0.0);
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    L = cosine_direction(u);
    return albedo * (form == FORM_SLIDE ? PI : 1.0);
}

float scatter_pdf(vec3 L, vec3 V) {
    return max(L.z, 0.0) * INV_PI;
}

vec3 surround(vec3 V) {
    float share = form == FORM_SLIDE ? PI : 1.0;
    return albedo * share * ambience(vec3(0.0, 0.0, 1.0));
}
