// light   Point: radiates alike in all directions; irradiance falls with the square of the distance
#include "lib/light.glsl"

uniform vec3 position = vec3(2.0, 3.0, 4.0);  // [.. -10, 10 ..]: where it stands (m)
uniform vec3 intensity = vec3(60.0);          // [0, 500 ..] tinted: I, radiant intensity (W/sr)

Incident light(vec3 place, vec2 u) {
    vec3 toward = position - place;
    float square = max(dot(toward, toward), 1e-12);  // a micrometre: a point on the light itself
    return Incident(toward * inversesqrt(square), intensity / square);
}

float reach(vec3 place, vec3 direction) {
    return distance(place, position);
}
