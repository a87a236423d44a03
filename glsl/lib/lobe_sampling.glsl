#include "lib/exponential.glsl"
#include "lib/sampling.glsl"

// Directions of cosine lobes, E. Lafortune and Y. Willems, "Using the modified Phong reflectance model",
// Leuven CW 197, 1994: density (n + 1) / (2 pi) cos^n(theta) about an axis.
//
// A direction about (0, 0, 1). 1 - cos(theta) keeps its digits where the lobe is narrow.
// exponent: n, [0, 1e6]
vec3 power_direction(float exponent, vec2 u) {
    float gap = -exponential_minus_one(log(1.0 - u.x) / (exponent + 1.0));
    float s = sqrt(gap * (2.0 - gap)), phi = 2.0 * PI * u.y;
    return vec3(s * cos(phi), s * sin(phi), 1.0 - gap);
}

// lobe: cos^n(theta), as by `cos_power`
float power_density(float lobe, float exponent) {
    return lobe * (exponent + 1.0) * 0.5 * INV_PI;
}
