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
    vec3 axis = position - target;
    vec3 off = L - axis * inversesqrt(max(dot(axis, axis), 1e-24));  // 1e-24: no axis, no NaN
    // The cosines fall from that of the inner angle to that of the outer; 1 - cos keeps the digits.
    float s = sin(0.5 * outer), edge = 2.0 * s * s;
    float c = sin(0.5 * inner), width = max(edge - 2.0 * c * c, 1e-20);  // 1e-20: a sharp edge
    float t = clamp((edge - 0.5 * dot(off, off)) / width, 0.0, 1.0);
    return Incident(L, intensity * (t * t * (3.0 - 2.0 * t) / square));
}

float reach(vec3 place, vec3 direction) {
    return distance(place, position);
}
