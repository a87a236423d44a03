// light   Disk: a round plate of uniform radiance that radiates from its front, toward its target
// paper   J. Howell, "A catalog of radiation configuration factors", 1982; quadrature along the rim where
//         the horizon cuts it, see lib/disk.glsl
// sampled  by solid angle, within a factor of two of uniform, exactly where the disk is small
// note    irradiance within 1e-5 where it stands 0.03 rad above the horizon; far from the origin, float32
//         keeps fewer digits of place - position
#include "lib/light.glsl"
#include "lib/disk.glsl"

uniform vec3 position = vec3(0.0, 3.0, 0.0);  // [.. -10, 10 ..]: its centre (m)
uniform vec3 target = vec3(0.0);              // [.. -10, 10 ..]: what its front faces (m)
uniform float radius = 0.5;                   // [0, 5 ..]: of the plate (m)
uniform vec3 radiance = vec3(10.0);           // [0, 100 ..] tinted: L, alike toward all in front (W m^-2 sr^-1)

Disk disk_from_place(vec3 place) {
    vec3 axis = target - position;
    vec3 front = radius > 0.0 ? axis * inversesqrt(max(dot(axis, axis), 1e-24)) : vec3(0.0);  // 1e-24: no NaN
    return disk_from(position - place, front, radius);
}

Incident light(vec3 place, vec2 u) {
    float inverse;
    vec3 L = disk_direction(disk_from_place(place), u, inverse);
    return Incident(L, radiance * inverse);
}

vec3 irradiance(vec3 place, vec3 normal) {
    return radiance * disk_irradiance(disk_from_place(place), normal);
}

vec3 arriving(vec3 place, vec3 direction) {
    return disk_met(disk_from_place(place), direction, 0.0) ? radiance : vec3(0.0);
}

float density(vec3 place, vec3 direction) {
    return disk_density(disk_from_place(place), direction);
}

float reach(vec3 place, vec3 direction) {
    Disk g = disk_from_place(place);
    return g.height / max(-dot(direction, g.front), 1e-9);
}
