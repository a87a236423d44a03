// light   A square lamp that faces down, by points spread evenly over its area
// paper   M. Pharr, W. Jakob and G. Humphreys, "Physically based rendering", 4th ed., 2023, sec. 12.4
// sampled  by area, uniform
// note    what `lumiar bench area-light` compares with the light Quad, which is drawn by solid angle
#include "lib/light.glsl"

uniform vec3 position = vec3(0.0, 1.0, 0.0); // [.. -10, 10 ..]: its centre (m)
uniform float width = 1.0;                   // [0, 10 ..]: of the square (m)
uniform vec3 radiance = vec3(1.0);           // [0, 100 ..]: L (W m^-2 sr^-1)

Incident light(vec3 place, vec2 u) {
    vec3 toward = position + width * vec3(u.x - 0.5, 0.0, u.y - 0.5) - place;
    float square = dot(toward, toward), distance = sqrt(square);
    float solid_angle = width * width * max(toward.y, 0.0) / (square * distance);
    return Incident(toward / distance, radiance * solid_angle);
}
