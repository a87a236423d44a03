// model   Blinn
// paper   J. F. Blinn, "Models of light reflection for computer synthesized pictures",
//         SIGGRAPH 1977, p. 192-198; normalised form: F. Giesen, "Phong and Blinn-Phong
//         normalization factors", 2009
// claims  positive, reciprocal (form = normalised)
// note    I = k_a I_a + k_d I_d cos(theta) + k_s I_s cos(phi)^alpha', phi between N and H; a highlight
//         as wide as Phong's takes alpha' of about 4 alpha
#include "lib/constants.glsl"
#include "lib/lobe.glsl"
#include "lib/lobe_sampling.glsl"

uniform vec3 ka = vec3(0.1);      // color: k_a, reflected share of the ambient light (unitless)
uniform vec3 kd = vec3(0.5);      // color: k_d, diffuse share (unitless)
uniform vec3 ks = vec3(0.4);      // color: k_s, specular share (unitless)
uniform float shininess = 160.0;  // [1, 4000 ..] log: alpha', exponent of the lobe (unitless)
uniform int form = 0;             // {slide, normalised}: as published, or each lobe of albedo k
uniform bool ambient = true;      // toggle: the ambient term
uniform bool diffuse = true;      // toggle: the diffuse term
uniform bool specular = true;     // toggle: the specular term

float power_lobe(vec3 H) {
    vec2 squares = vec2(H.z * H.z, dot(H.xy, H.xy)) / dot(H, H);  // of cos(phi) and sin(phi): no root
    // none where H vanishes: L = -V, the eye below the surface
    return H.z > 0.0 ? cos_power(squares.x, squares.y, 0.5 * shininess) : 0.0;
}

vec3 scatter(vec3 L, vec3 V) {
    if (L.z <= 0.0) return vec3(0.0);
    vec3 value = vec3(0.0);
    if (diffuse) value += kd * L.z;
    if (specular) {
        float lobe = power_lobe(L + V);
        float scale = (shininess + 2.0) * (shininess + 4.0) / (8.0 * (exp2(-0.5 * shininess) + shininess));
        value += form == FORM_SLIDE ? ks * lobe : ks * (scale * lobe * L.z);
    }
    return value * INV_PI;
}

float share() {
    float reflected = form == FORM_SLIDE ? 8.0 / (shininess + 4.0) : 1.0;
    return lobe_share(float(diffuse) * kd, float(specular) * reflected * ks);
}

float scatter_pdf(vec3 L, vec3 V) {
    vec3 H = L + V;
    float density = power_density(power_lobe(H), shininess) / max(2.0 * length(H), 1e-6);  // 1e-6: L = -V
    return mix(cosine_density(L), density, share());
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    if (drawn(share(), u)) {
        vec3 H = power_direction(shininess, u);
        L = 2.0 * dot(V, H) * H - V;
    } else L = cosine_direction(u);
    return weighed(scatter(L, V), scatter_pdf(L, V));
}

vec3 surround(vec3 V) {
    return ambient ? ka * ambience(vec3(0.0, 0.0, 1.0)) : vec3(0.0);
}
