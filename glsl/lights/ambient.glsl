// light   Ambient: the same radiance from everywhere, the course's I_a
uniform vec3 radiance = vec3(1.0);  // [0, 5 ..] tinted: L, the same in every direction (W m^-2 sr^-1)

vec3 environment(vec3 direction) {
    return radiance;
}

vec3 ambience(vec3 normal) {
    return radiance;
}
