// The radiance that arrives from a direction of the local frame, summed over the lights that surround
// the scene and those with a shape. Lines marked "each environment" are repeated for every such light.
Frame rig_here;  // that of the point being shaded
vec3 rig_place;  // in the world

vec3 environment(vec3 direction) {
    vec3 world = from_local(direction, rig_here), radiance = vec3(0.0);
    radiance += environment(world);  // each environment
    radiance += arriving(rig_place, world);  // each arriving
    return radiance;
}

// The mean radiance about a direction of the local frame, weighted by the cosine: irradiance over pi.
vec3 ambience(vec3 normal) {
    vec3 world = from_local(normal, rig_here), radiance = vec3(0.0);
    radiance += ambience(world);  // each ambience
    return radiance;
}
