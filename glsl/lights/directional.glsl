// light   Directional: so far away that its rays are parallel
#include "lib/light.glsl"

uniform vec3 direction = vec3(0.75, 0.8, 0.6);  // direction: toward the light
uniform vec3 irradiance = vec3(3.14159265);     // [0, 20 ..] tinted: E on a surface facing it (W/m^2)

Incident light(vec3 place, vec2 u) {
    return Incident(direction, irradiance);
}
