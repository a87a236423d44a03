// model   Black body
// paper   M. Planck, "Ueber das Gesetz der Energieverteilung im Normalspectrum", Annalen der Physik 309(3), 1901
// claims  positive, reciprocal, conserving, constant
// note    what it does not emit at a temperature it reflects, as Lambert (G. Kirchhoff, 1860), so 1 is black;
//         below 1900 K its colour is outside sRGB: a component stays negative until the display cuts it to 0
#include "lib/spectrum.glsl"
#include "lib/sampling.glsl"

uniform float temperature = 1200.0;  // [500, 20000 ..] log: T (K)
uniform float emissivity = 1.0;      // [0, 1]: share of a black body's radiance that it emits (unitless)
uniform int wavelengths = 95;        // [4, 95]: how many are added up (unitless)
uniform int observer = 0;            // {table, fit}: the CIE's table of 1931, or Wyman's lobes of 2013
uniform int shown = 0;               // {radiance, color}: all of it, or its colour at a luminance of 1

vec3 scatter(vec3 L, vec3 V) {
    return vec3((1.0 - emissivity) * INV_PI * max(L.z, 0.0));
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    L = cosine_direction(u);
    return vec3(1.0 - emissivity);
}

float scatter_pdf(vec3 L, vec3 V) {
    return max(L.z, 0.0) * INV_PI;
}

vec3 surround(vec3 V) {
    return (1.0 - emissivity) * ambience(vec3(0.0, 0.0, 1.0));
}

vec3 emitted(vec3 V) {
    vec3 radiance = black_body(temperature, wavelengths, observer == OBSERVER_FIT);
    float whole = dot(radiance, LUMINANCE);
    return emissivity * (shown == SHOWN_COLOR ? radiance / whole : radiance);
}
