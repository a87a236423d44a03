// model   A black body's colour at 1e6 / mix(50, 1000, N.L) kelvin, exact and by shorter ways
// paper   M. Planck, 1901; M. Krystek, "An algorithm to calculate correlated colour temperature", Color
//         Research and Application 10(1), 1985; C. Wyman et al., JCGT 2(2), 2013
// claims  positive
// note    what `lumiar bench spectrum` compares; only colours count here, not how bright they are
#include "lib/spectrum.glsl"

uniform int wavelengths = 95;                // [1, 95]: how many are added up (unitless)
uniform vec3 white = vec3(1.0);              // [.. 0, 10 ..]: over Planck's radiance at three, for rgb
uniform int form = 0;                        // {sum, rgb, krystek}: integral, three wavelengths, a fit of the result
uniform int observer = 0;                    // {table, fit}: the CIE's table of 1931, or Wyman's lobes of 2013

// u, v of 1960 as ratios of parabolas, within 9e-5 from 1000 to 15000 K.
vec3 krystek(float T) {
    float u = (0.860117757 + T * (1.54118254e-4 + T * 1.28641212e-7)) / (1.0 + T * (8.42420235e-4 + T * 7.08145163e-7));
    float v = (0.317398726 + T * (4.22806245e-5 + T * 4.20481691e-8)) / (1.0 + T * (T * 1.61456053e-7 - 2.89741816e-5));
    return srgb_from_xyz(vec3(1.5 * u, v, 2.0 - 0.5 * u - 5.0 * v) / v);
}

vec3 scatter(vec3 L, vec3 V) {
    float T = 1e6 / mix(50.0, 1000.0, clamp(L.z, 0.0, 1.0));
    if (form == FORM_KRYSTEK) return krystek(T);
    if (form == FORM_RGB) return white * vec3(planck(0.66, T), planck(0.538, T), planck(0.437, T));
    return black_body(T, wavelengths, observer == OBSERVER_FIT);
}
