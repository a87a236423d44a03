// model   Fresnel's reflectance, its forms and its approximations, at N.L
// paper   A. Fresnel, 1823; C. Schlick, Eurographics 1994; N. Hoffman, MAM 2019; R. Cook and
//         K. Torrance, TOG 1(1), 1982, eq. 6; M. Born and E. Wolf, "Principles of optics", ch. 14
// claims  positive
// note    what `lumiar bench fresnel` compares; only the forms whose names Lumiar uses are to be used
#include "lib/fresnel.glsl"

uniform float eta = 1.5;                       // [0.25, 4]: index behind the interface over the one before it
uniform float grey = 0.04;                     // [0, 1]: its reflectance at normal incidence
uniform float grey82 = 0.4;                    // [0, 1]: the same at cos = 1/7
uniform vec3 f0 = vec3(1.0, 0.71, 0.29);       // color: reflectance of a metal at normal incidence
uniform vec3 f82 = vec3(0.966, 0.858, 0.661);  // color: the same at cos = 1/7
uniform vec3 index = vec3(0.14, 0.503, 1.428); // [0, 10]: index of refraction of a metal (unitless)
uniform vec3 k = vec3(3.702, 2.312, 1.937);    // [0, 12]: its extinction coefficient (unitless)
uniform bool metal = false;                    // toggle: a metal, in three colours
uniform int form = 0;  // {exact, g_form, textbook, schlick, schlick_pow, schlick_t, f82, constant, slide}

// The form of most books: both angles, Snell's law by 1 - (1 - c^2) / n^2.
float F_textbook(float c, float n) {
    float t2 = 1.0 - (1.0 - c * c) / (n * n);
    if (t2 <= 0.0) return 1.0;
    float t = sqrt(t2), s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return 0.5 * (s * s + p * p);
}

// The slide's, with g^2 = n^2 + c^2 - 1 as it should read.
float F_g_form(float c, float n) {
    float g2 = n * n + c * c - 1.0;
    if (g2 <= 0.0) return 1.0;
    float g = sqrt(g2), a = (g - c) / (g + c), b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Schlick's with the larger of both angles, which has the total reflection from inside.
vec3 F_schlick_t(vec3 f0, float c, float n) {
    float t2 = 1.0 - (1.0 - c * c) / (n * n);
    return t2 <= 0.0 ? vec3(1.0) : F_schlick(f0, n < 1.0 ? sqrt(t2) : c);
}

// Born and Wolf's a and b straight away; 1 - F is not computed.
vec3 F_metal(float c, vec3 n, vec3 k) {
    float c2 = c * c, s2 = 1.0 - c2;
    vec3 t = n * n - k * k - s2, m = sqrt(t * t + 4.0 * n * n * k * k);
    vec3 a = sqrt(max(0.5 * (m + t), 0.0)), s = (m + c2 - 2.0 * a * c) / (m + c2 + 2.0 * a * c);
    return 0.5 * s * (1.0 + (c2 * m + s2 * s2 - 2.0 * a * c * s2) / (c2 * m + s2 * s2 + 2.0 * a * c * s2));
}

vec3 scatter(vec3 L, vec3 V) {
    float c = min(L.z, 1.0);
    vec3 r0 = metal ? f0 : vec3(grey), r82 = metal ? f82 : vec3(grey82);
    if (form == FORM_EXACT) return metal ? 1.0 - A_conductor(c, index, k) : vec3(F_dielectric(c, eta).x);
    if (form == FORM_TEXTBOOK) return metal ? F_metal(c, index, k) : vec3(F_textbook(c, eta));
    if (form == FORM_G_FORM) return vec3(F_g_form(c, eta));
    if (form == FORM_SCHLICK) return F_schlick(r0, c);
    if (form == FORM_SCHLICK_POW) return r0 + (1.0 - r0) * pow(1.0 - c, 5.0);
    if (form == FORM_SCHLICK_T) return F_schlick_t(r0, c, eta);
    if (form == FORM_F82) return F_f82(r0, F82_dip(r0, r82), c);
    if (form == FORM_SLIDE) return vec3(F_slide(c, eta));
    return r0;
}
