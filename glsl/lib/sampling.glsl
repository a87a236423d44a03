#include "lib/constants.glsl"

// Directions by chance, from u spread evenly over [0, 1)^2, and their densities over solid angle [1/sr].
//
// Density cos(theta) / pi. Concentric rings would waste fewer samples; one ring is simpler.
vec3 cosine_direction(vec2 u) {
    float r = sqrt(u.x), phi = 2.0 * PI * u.y;
    return vec3(r * cos(phi), r * sin(phi), sqrt(1.0 - u.x));
}

float cosine_density(vec3 L) {
    return max(L.z, 0.0) * INV_PI;
}

// All around, density 1 / (4 pi).
vec3 even_direction(vec2 u) {
    float z = 1.0 - 2.0 * u.x, s = 2.0 * sqrt(u.x * (1.0 - u.x)), phi = 2.0 * PI * u.y;
    return vec3(s * cos(phi), s * sin(phi), z);
}

// A direction about (0, 0, 1) turned to be one about an axis. T. Duff et al., "Building an orthonormal
// basis, revisited", Journal of Computer Graphics Techniques 6(1), 2017.
vec3 about(vec3 axis, vec3 w) {
    float side = axis.z < 0.0 ? -1.0 : 1.0, k = -1.0 / (side + axis.z), b = axis.x * axis.y * k;
    vec3 T = vec3(1.0 + side * axis.x * axis.x * k, side * b, -side * axis.x);
    vec3 B = vec3(b, side + axis.y * axis.y * k, -axis.y);
    return T * w.x + B * w.y + axis * w.z;
}

// What a direction counts: scatter over its density; 0 where no light can leave.
vec3 weighed(vec3 scatter, float density) {
    return density > 0.0 ? scatter / density : vec3(0.0);
}

// The share of the directions that a lobe takes beside a diffuse term, by what both reflect. Neither
// gets less than a quarter: the one that is weaker in red may be the stronger one in blue.
float lobe_share(vec3 diffuse, vec3 lobe) {
    float a = max(diffuse.r, max(diffuse.g, diffuse.b)), b = max(lobe.r, max(lobe.g, lobe.b));
    float share = b / max(a + b, 1e-30);  // 1e-30: black
    return a > 0.0 && b > 0.0 ? clamp(share, 0.25, 0.75) : share;
}

// Whether the lobe with that share is drawn, by u.x, which is spread anew over [0, 1).
bool drawn(float share, inout vec2 u) {
    bool yes = u.x < share;
    u.x = min((yes ? u.x : u.x - share) / (yes ? share : 1.0 - share), 0.99999994);  // below 1
    return yes;
}

// A facet of GGX as seen from V: the spherical cap that V reflects from, in stretched space, where
// the facets are a sphere. J. Dupuy and A. Benyoub, "Sampling visible GGX normals with spherical caps",
// HPG 2023. V: V.z > 0; alpha: along T and B
vec3 visible_ggx(vec3 V, vec2 alpha, vec2 u) {
    vec3 w = normalize(vec3(alpha * V.xy, V.z));
    float phi = 2.0 * PI * u.x, z = 1.0 - u.y * (1.0 + w.z);  // from 1 down to -w.z
    float s = sqrt(max((1.0 - z) * (1.0 + z), 0.0));          // 0: rounding at the pole
    vec3 H = vec3(s * cos(phi), s * sin(phi), z) + w;
    return normalize(vec3(alpha * H.xy, max(H.z, 1e-9)));     // 1e-9: a facet on edge
}

// A facet of Beckmann's, whether seen or not, density D cos: its slopes are Gaussian.
vec3 facet_beckmann(vec2 alpha, vec2 u) {
    float r = sqrt(-log(1.0 - u.x)), phi = 2.0 * PI * u.y;
    return normalize(vec3(-alpha * r * vec2(cos(phi), sin(phi)), 1.0));
}
