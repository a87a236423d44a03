// model   A mirror of metal under a light, wavelength by wavelength, at N.L
// paper   M. Born and E. Wolf, "Principles of optics", ch. 14
// claims  positive
// note    what `lumiar bench spectrum` compares; it writes the tables anew for more wavelengths
#include "lib/fresnel.glsl"

const int TRIPLES = 1;                                             // of wavelengths
const vec3 ETA[TRIPLES] = vec3[TRIPLES](vec3(0.14, 0.503, 1.428)); // index of refraction, here gold's
const vec3 K[TRIPLES] = vec3[TRIPLES](vec3(3.702, 2.312, 1.937));  // extinction coefficient
const mat3 RGB[TRIPLES] = mat3[TRIPLES](mat3(1.0));                // each column what a wavelength adds if all is reflected

vec3 scatter(vec3 L, vec3 V) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < TRIPLES; ++i) sum += RGB[i] * (1.0 - A_conductor(clamp(L.z, 0.0, 1.0), ETA[i], K[i]));
    return sum;
}
