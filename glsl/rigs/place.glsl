// From object space to the scene. An object left where its mesh lies needs none of this.
uniform mat4 rig_clip;   // object space to clip space
uniform mat4 rig_world;  // object space to world space
uniform mat3 rig_turn;   // for normals: the inverse of its 3x3 part, transposed, the largest value 1
uniform mat3 rig_lead;   // for tangents: its 3x3 part, the largest value 1

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
    float hand = determinant(rig_lead) < 0.0 ? -1.0 : 1.0;  // where transformed
    return vec4(rig_lead * tangent.xyz, hand * tangent.w);  // where transformed
}
