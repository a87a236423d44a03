// A white furnace: the same radiance, 1, from everywhere.
vec3 environment(vec3 direction) {
    return vec3(1.0);
}

vec3 ambience(vec3 normal) {
    return vec3(1.0);
}
