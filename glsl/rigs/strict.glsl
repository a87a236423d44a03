// max, min and clamp that pass NaN on. Drivers may drop it there (max(NaN, 0) is 0 on llvmpipe), and
// with it the sign that a formula has broken; the audit evaluates models with these in their place.
bool rig_bad(float x) {
    return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u;
}

float rig_max(float a, float b) {
    return rig_bad(a) ? a : rig_bad(b) ? b : max(a, b);
}

float rig_min(float a, float b) {
    return rig_bad(a) ? a : rig_bad(b) ? b : min(a, b);
}

vec2 rig_max(vec2 a, vec2 b) { return vec2(rig_max(a.x, b.x), rig_max(a.y, b.y)); }
vec2 rig_min(vec2 a, vec2 b) { return vec2(rig_min(a.x, b.x), rig_min(a.y, b.y)); }
vec2 rig_max(vec2 a, float b) { return rig_max(a, vec2(b)); }
vec2 rig_min(vec2 a, float b) { return rig_min(a, vec2(b)); }
vec3 rig_max(vec3 a, vec3 b) { return vec3(rig_max(a.xy, b.xy), rig_max(a.z, b.z)); }
vec3 rig_min(vec3 a, vec3 b) { return vec3(rig_min(a.xy, b.xy), rig_min(a.z, b.z)); }
vec3 rig_max(vec3 a, float b) { return rig_max(a, vec3(b)); }
vec3 rig_min(vec3 a, float b) { return rig_min(a, vec3(b)); }
vec4 rig_max(vec4 a, vec4 b) { return vec4(rig_max(a.xyz, b.xyz), rig_max(a.w, b.w)); }
vec4 rig_min(vec4 a, vec4 b) { return vec4(rig_min(a.xyz, b.xyz), rig_min(a.w, b.w)); }
vec4 rig_max(vec4 a, float b) { return rig_max(a, vec4(b)); }
vec4 rig_min(vec4 a, float b) { return rig_min(a, vec4(b)); }
int rig_max(int a, int b) { return max(a, b); }
int rig_min(int a, int b) { return min(a, b); }
int rig_clamp(int x, int low, int high) { return clamp(x, low, high); }
float rig_clamp(float x, float low, float high) { return rig_min(rig_max(x, low), high); }
vec2 rig_clamp(vec2 x, vec2 low, vec2 high) { return rig_min(rig_max(x, low), high); }
vec2 rig_clamp(vec2 x, float low, float high) { return rig_min(rig_max(x, low), high); }
vec3 rig_clamp(vec3 x, vec3 low, vec3 high) { return rig_min(rig_max(x, low), high); }
vec3 rig_clamp(vec3 x, float low, float high) { return rig_min(rig_max(x, low), high); }
vec4 rig_clamp(vec4 x, vec4 low, vec4 high) { return rig_min(rig_max(x, low), high); }
vec4 rig_clamp(vec4 x, float low, float high) { return rig_min(rig_max(x, low), high); }
