#include "lib/constants.glsl"
#include "lib/fan.glsl"

// A cap of directions, as a sphere is seen, by sine and cosine of its half-angle.

// A part of the rim of a cap that sets, for the fan around the point of the horizon below its top.
// t: azimuth around the axis from the top; tau: where it sets; the others as below
vec3 cap_rim_flux(float sine, float cosine, float z, float level, float up, float tau, vec3 t) {
    vec3 h = sin(0.5 * t), height = 2.0 * sine * level * sin(0.5 * (tau + t)) * sin(0.5 * (tau - t));
    vec3 azimuth = sine * (up - 2.0 * cosine * z * h * h);
    return height * fan_far(cosine * level - sine * z * cos(t)) * azimuth;
}

// Its irradiance on the horizon over its radiance. J. Snyder, "Area light sources for real-time graphics",
// Microsoft Research, 1996, has it in closed form, whose terms cancel where the cap is small, or a sliver;
// here as a fan (lib/fan.glsl) around its axis or, where that is below, around a point of the horizon.
// sine, cosine: of its half-angle, [0, 1]; z: cosine from the normal to its axis
float cap_irradiance(float sine, float cosine, float z) {
    if (z >= sine) return PI * sine * sine * z;
    if (z <= -sine) return 0.0;
    float level = sqrt((1.0 - z) * (1.0 + z));
    float up = max(sine * level + cosine * z, 0.0), down = max(sine * level - cosine * z, 0.0);
    float tau = 2.0 * angle_between(sqrt(up), sqrt(down));
    if (z < 0.0) {
        vec3 sum = cap_rim_flux(sine, cosine, z, level, up, tau, tau * FAN_NEAR);
        sum += cap_rim_flux(sine, cosine, z, level, up, tau, tau * (1.0 - FAN_NEAR));
        return 2.0 * tau * dot(FAN_WEIGHT, sum);
    }
    float chord = sqrt(up * down) / level;  // sine of half the chord on the horizon
    float psi = angle_between(chord, cosine / level);
    vec3 sum = fan_flux(1.0, vec3(0.0), level * cos(psi * FAN_NEAR));
    sum += fan_flux(1.0, vec3(0.0), level * cos(psi * (1.0 - FAN_NEAR)));
    float rim = z * tau + 2.0 * level * chord * fan_far(vec3(cosine)).x;
    return sine * sine * rim + 2.0 * z * z * psi * dot(FAN_WEIGHT, sum);
}
