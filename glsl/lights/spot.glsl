// light   Spot: a point light within a cone, smooth between its inner and its outer angle
// paper   M. Pharr, W. Jakob and G. Humphreys, "Physically based rendering", 4th ed., 2023, sec. 12.2.1
#include "lib/light.glsl"

uniform vec3 position = vec3(2.0, 3.0, 4.0);  // [.. -10, 10 ..]: where it stands (m)
uniform vec3 target = vec3(0.0);              // [.. -10, 10 ..]: where it points (m)
uniform vec3 intensity = vec3(60.0);          // [0, 500 ..] tinted: I on its axis (W/sr)
uniform float inner = radians(10.0);          // [0, 90] degrees: half-angle of the full-strength cone
uniform float outer = radians(20.0);          // [0, 90] degrees: half-angle beyond which it is dark

Incident light(vec3 place, vec2 u) {
    vec3 toward = position - place;
    float square = max(dot(toward, toward), 1e-12);  // a micrometre: a point on the light itself
    vec3 L = toward * inversesqrt(square);
    vec3 axis = normalize(position - target);
    float edge = cos(outer), width = max(cos(inner) - edge, 1e-4);  // inner = outer: a sharp edge
    float t = clamp((dot(L, axis) - edge) / width, 0.0, 1.0);
    return Incident(L, intensity * (t * t * (3.0 - 2.0 * t) / square));
}
