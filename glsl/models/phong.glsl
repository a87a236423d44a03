// model   Phong
// paper   B. T. Phong, "Illumination for computer generated pictures",
//         Communications of the ACM 18(6), 1975, p. 311-317; normalised form: E. P. Lafortune and
//         Y. D. Willems, "Using the modified Phong reflectance model", Leuven CW 197, 1994
// claims  positive, reciprocal (form = normalised)
// note    I = k_a I_a + k_d I_d cos(theta) + k_s I_s cos(beta)^alpha, divided by pi once
#include "lib/constants.glsl"
#include "lib/lobe.glsl"
#include "lib/lobe_sampling.glsl"

uniform vec3 ka = vec3(0.1);     // color: k_a, reflected share of the ambient light (unitless)
uniform vec3 kd = vec3(0.5);     // color: k_d, diffuse share (unitless)
uniform vec3 ks = vec3(0.4);     // color: k_s, specular share (unitless)
uniform float shininess = 40.0;  // [1, 1000 ..] log: alpha, exponent of the lobe (unitless)
uniform int form = 0;            // {slide, normalised}: as published, or each lobe of albedo k
uniform bool ambient = true;     // toggle: the ambient term
uniform bool diffuse = true;     // toggle: the diffuse term
uniform bool specular = true;    // toggle: the specular term

float power_lobe(vec3 L, vec3 V) {
    vec3 d = vec3(-L.xy, L.z) - V;  // R - V, so that 1 - cos(beta) = d.d / 2
    float gap = 0.5 * dot(d, d);
    return cos_power(1.0 - gap, gap, shininess);
}

vec3 scatter(vec3 L, vec3 V) {
    if (L.z <= 0.0) return vec3(0.0);
    vec3 value = vec3(0.0);
    if (diffuse) value += kd * L.z;
    if (specular) {
        float lobe = power_lobe(L, V);
        value += form == FORM_SLIDE ? ks * lobe : ks * (0.5 * (shininess + 2.0) * lobe * L.z);
    }
    return value * INV_PI;
}

float share() {
    float reflected = form == FORM_SLIDE ? 2.0 / (shininess + 1.0) : 1.0;
    return lobe_share(float(diffuse) * kd, float(specular) * reflected * ks);
}

float scatter_pdf(vec3 L, vec3 V) {
    return mix(cosine_density(L), power_density(power_lobe(L, V), shininess), share());
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    vec3 R = vec3(-V.xy, V.z);
    L = drawn(share(), u) ? about(R, power_direction(shininess, u)) : cosine_direction(u);
    return weighed(scatter(L, V), scatter_pdf(L, V));
}

vec3 surround(vec3 V) {
    return ambient ? ka * ambience(vec3(0.0, 0.0, 1.0)) : vec3(0.0);
}
