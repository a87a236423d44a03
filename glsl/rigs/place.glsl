// From object space to the scene. An object left where its mesh lies needs none of this.
uniform mat4 rig_clip;   // object space to clip space
uniform mat4 rig_world;  // object space to world space
uniform mat3 rig_turn;   // the same for normals: the inverse of its 3x3 part, transposed

vec4 rig_projected(vec3 p) {
    return rig_clip * vec4(p, 1.0);
}

vec3 rig_placed(vec3 p) {
    return p;  // where not transformed
    return (rig_world * vec4(p, 1.0)).xyz;  // where transformed
}

vec3 rig_turned(vec3 normal) {
    return normal;  // where not transformed
    return normalize(rig_turn * normal);  // where transformed
}

vec4 rig_along(vec4 tangent) {
    return tangent;  // where not transformed
    return vec4(mat3(rig_world) * tangent.xyz, tangent.w);  // where transformed
}
