// light   Quad: a rectangle of uniform radiance that radiates from its front, the side toward its target
// paper   J. H. Lambert, "Photometria", 1760; summed without cancellation, see lib/fan.glsl
// sampled  by solid angle, uniform
// note    irradiance within 1e-5 where it stands 0.03 rad above the horizon; far from the origin, float32
//         keeps fewer digits of place - position
#include "lib/light.glsl"
#include "lib/polygon.glsl"

uniform vec3 position = vec3(0.0, 3.0, 0.0);  // [.. -10, 10 ..]: its centre (m)
uniform vec3 target = vec3(0.0);              // [.. -10, 10 ..]: what its front faces (m)
uniform float turn = radians(0.0);            // [-180, 180 ..] degrees: about its axis; 0: width level
uniform float width = 1.0;                    // [0, 10 ..]: of the rectangle (m)
uniform float height = 1.0;                   // [0, 10 ..]: of the rectangle (m)
uniform vec3 radiance = vec3(10.0);           // [0, 100 ..] tinted: L, alike toward all in front (W m^-2 sr^-1)

Polygon quad_from(vec3 place) {
    vec3 axis = target - position, toward = position - place;
    vec3 front = axis * inversesqrt(max(dot(axis, axis), 1e-24));  // 1e-24: no axis, no NaN
    vec3 level = vec3(front.z, 0.0, -front.x);                     // (0, 1, 0) x front
    float tilt = length(level);
    level = tilt > 1e-6 ? level / tilt : vec3(1.0, 0.0, 0.0);
    vec3 up = cross(front, level);
    vec3 x = 0.5 * width * (cos(turn) * level + sin(turn) * up);
    vec3 y = 0.5 * height * (cos(turn) * up - sin(turn) * level);
    float in_front = width * height > 0.0 ? -dot(toward, front) : 0.0;
    return Polygon(toward, front, in_front, -x - y, x - y, x + y, y - x, -x - y, -x - y);
}

Incident light(vec3 place, vec2 u) {
    vec4 L = polygon_direction(quad_from(place), 4, u);
    return Incident(L.xyz, radiance * L.w);
}

vec3 irradiance(vec3 place, vec3 normal) {
    return radiance * polygon_irradiance(quad_from(place), 4, normal);
}

vec3 arriving(vec3 place, vec3 direction) {
    return polygon_met(quad_from(place), 4, direction, 0.0) ? radiance : vec3(0.0);
}

float density(vec3 place, vec3 direction) {
    return polygon_density(quad_from(place), 4, direction);
}

float reach(vec3 place, vec3 direction) {
    return polygon_reach(quad_from(place), direction);
}
