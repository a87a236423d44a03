// light   Sun: its disk alone, seen through the air; the rest of the sky is a light of its own
// paper   L. Hosek and A. Wilkie, "Adding a solar radiance function to the Hosek-Wilkie skylight model",
//         IEEE Computer Graphics and Applications 33(3), 2013
// sampled  by solid angle, 6.797e-5 sr: shadows have a soft edge
// note    darker toward the limb; its radiance is taken as the mean over the disk
#include "lib/constants.glsl"
#include "lib/light.glsl"

uniform float turbidity = 3.0;          // [1, 10]: how hazy: 2 very clear, 3 clear, 6 hazy, 10 murky (unitless)
uniform float height = radians(40.0);   // [0, 90] degrees: of the sun above the horizon
uniform float azimuth = radians(30.0);  // [-360, 360] degrees: of the sun about y, from +z toward +x
uniform float strength = 1.0;           // [0, 4 ..]: factor on the published radiance (unitless)
uniform vec3 toward;                    // given: direction to the middle of the disk
uniform vec3 limb[6];                   // given: radiance as a polynomial in mu, 1 in the middle, 0 on the rim
uniform vec2 bearing;                    // given: sine and cosine of its azimuth

const float SIN2 = 5.40864388e-6;  // sin^2 of half the disk's radius of 0.2665 degrees
const float DENSITY = 1.0 / (4.0 * PI * SIN2);

// share: of the disk's solid angle that is nearer to its middle, [0, 1]
vec3 disk(float share) {
    float mu = sqrt(max(1.0 - share, 0.0));
    vec3 sum = limb[5];
    for (int i = 4; i >= 0; --i) sum = sum * mu + limb[i];
    return strength * sum;
}

Incident light(vec3 place, vec2 u) {
    vec3 across = vec3(bearing.y, 0.0, -bearing.x);
    float s = SIN2 * u.x, off = 2.0 * sqrt(s * (1.0 - s)), phi = 2.0 * PI * u.y;
    vec3 beside = across * cos(phi) + cross(toward, across) * sin(phi);
    return Incident(off * beside + (1.0 - 2.0 * s) * toward, disk(u.x) / DENSITY);
}

// How far from the middle, as for `disk`; beyond 1 outside.
float share(vec3 direction) {
    vec3 off = direction - toward;
    return dot(off, off) / (4.0 * SIN2);
}

float density(vec3 place, vec3 direction) {
    return share(direction) <= 1.0 ? DENSITY : 0.0;
}

vec3 arriving(vec3 place, vec3 direction) {
    return share(direction) <= 1.0 ? disk(share(direction)) : vec3(0.0);
}
