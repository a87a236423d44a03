// The radiance that arrives from a direction of the local frame, summed over the lights that surround
// the scene. Lines marked "each environment" are repeated for every such light.
vec3 environment(vec3 direction) {
    vec3 radiance = vec3(0.0);
    radiance += environment(direction);  // each environment
    return radiance;
}
