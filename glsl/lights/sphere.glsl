// light   Sphere: a ball of uniform radiance
// paper   J. Snyder, "Area light sources for real-time graphics", Microsoft Research, 1996
// sampled  by solid angle, uniform
// note    irradiance within 1e-5; inside, it surrounds, with irradiance pi L. Far from the origin, float32
//         keeps fewer digits of place - position
#include "lib/light.glsl"
#include "lib/cap.glsl"
#include "lib/sampling.glsl"

uniform vec3 position = vec3(0.0, 3.0, 0.0);  // [.. -10, 10 ..]: its centre (m)
uniform float radius = 0.5;                   // [0, 5 ..]: of the ball (m)
uniform vec3 radiance = vec3(10.0);           // [0, 100 ..] tinted: L, alike in all directions (W m^-2 sr^-1)

// Its centre from a place: unit direction and distance; and sine and cosine of the angle it is seen under.
void sphere_seen(vec3 place, out vec4 centre, out vec2 cap) {
    vec3 toward = position - place;
    float range = max(length(toward), 1e-18), sine = min(radius / range, 1.0);
    centre = vec4(fan_unit(toward), range);
    cap = vec2(sine, sqrt((1.0 - sine) * (1.0 + sine)));
}

bool sphere_around(vec4 centre) {
    return centre.w < radius;
}

// 1 - cos of the angle within which its directions lie: 2 all around.
float sphere_width(vec4 centre, vec2 cap) {
    return sphere_around(centre) ? 2.0 : cap.x * cap.x / (1.0 + cap.y);
}

Incident light(vec3 place, vec2 u) {
    vec4 centre;
    vec2 cap;
    sphere_seen(place, centre, cap);
    float width = sphere_width(centre, cap), off = u.x * width, phi = 2.0 * PI * u.y;
    float s = sqrt(off * (2.0 - off));
    vec3 L = about(centre.xyz, vec3(s * cos(phi), s * sin(phi), 1.0 - off));
    return Incident(L, radiance * (2.0 * PI * width));
}

vec3 irradiance(vec3 place, vec3 normal) {
    vec4 centre;
    vec2 cap;
    sphere_seen(place, centre, cap);
    if (sphere_around(centre)) return radiance * PI;
    return radiance * cap_irradiance(cap.x, cap.y, clamp(dot(normal, centre.xyz), -1.0, 1.0));
}

// Whether a direction meets it, or misses it by less than a slack of its distance; and at which distance.
bool sphere_met(vec3 place, vec3 direction, float slack, out float far) {
    vec3 toward = position - place;
    float along = dot(toward, direction), across = length(cross(toward, direction));
    bool around = dot(toward, toward) < radius * radius;
    far = along + (around ? 1.0 : -1.0) * sqrt(max((radius - across) * (radius + across), 0.0));
    return around || (across <= radius + slack * along && along > 0.0);
}

vec3 arriving(vec3 place, vec3 direction) {
    float far;
    return sphere_met(place, direction, 0.0, far) ? radiance : vec3(0.0);
}

float density(vec3 place, vec3 direction) {
    vec4 centre;
    vec2 cap;
    sphere_seen(place, centre, cap);
    float far, width = max(sphere_width(centre, cap), 1e-37);
    return sphere_met(place, direction, FAN_SLACK, far) ? 1.0 / (2.0 * PI * width) : 0.0;
}

float reach(vec3 place, vec3 direction) {
    float far;
    bool met = sphere_met(place, direction, 0.0, far);
    return far;
}
