// light   Furnace: the same radiance from everywhere, as in a closed oven that glows
// sampled  evenly over the sphere
// note    what reflects all light becomes invisible in it: the white furnace test
#include "lib/constants.glsl"
#include "lib/light.glsl"
#include "lib/sampling.glsl"

uniform vec3 radiance = vec3(1.0);  // [0, 5 ..] tinted: L, the same in every direction (W m^-2 sr^-1)

vec3 environment(vec3 direction) {
    return radiance;
}

Incident light(vec3 place, vec2 u) {
    return Incident(even_direction(u), 4.0 * PI * radiance);
}

float density(vec3 place, vec3 direction) {
    return 0.25 * INV_PI;
}

vec3 arriving(vec3 place, vec3 direction) {
    return radiance;
}

vec3 irradiance(vec3 place, vec3 normal) {
    return PI * radiance;
}
