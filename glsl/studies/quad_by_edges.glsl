// light   A square lamp that faces down, exact irradiance by Lambert's sum over its edges as it stands
// paper   J. H. Lambert, "Photometria", 1760; P. Heckbert and J. Winget, 1991
// note    what `lumiar bench area-light` compares with the light Quad; for floors wholly in front of it
#include "lib/light.glsl"

uniform vec3 position = vec3(0.0, 1.0, 0.0); // [.. -10, 10 ..]: its centre (m)
uniform float width = 1.0;                   // [0, 10 ..]: of the square (m)
uniform vec3 radiance = vec3(1.0);           // [0, 100 ..]: L (W m^-2 sr^-1)

vec3 edge(vec3 a, vec3 b) {
    return acos(clamp(dot(a, b), -1.0, 1.0)) * normalize(cross(a, b));
}

vec3 irradiance(vec3 place, vec3 normal) {
    vec3 middle = position - place;
    float h = 0.5 * width;
    vec3 a = normalize(middle + vec3(-h, 0.0, -h)), b = normalize(middle + vec3(h, 0.0, -h));
    vec3 c = normalize(middle + vec3(h, 0.0, h)), d = normalize(middle + vec3(-h, 0.0, h));
    vec3 sum = edge(a, b) + edge(b, c) + edge(c, d) + edge(d, a);
    return radiance * max(-0.5 * dot(sum, normal), 0.0);
}

Incident light(vec3 place, vec2 u) {
    return Incident(vec3(0.0, 1.0, 0.0), vec3(0.0));
}
