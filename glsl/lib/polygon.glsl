#include "lib/fan.glsl"

// A flat convex polygon of three to six corners, as a place sees it. Exact irradiance, solid angle and
// directions by chance, all from the fan around the point nearest to the place (lib/fan.glsl).
struct Polygon {
    vec3 origin;            // any point of its plane close by, from the place
    vec3 front;             // unit normal of the side that radiates; 0 if it has no area
    float height;           // of the place in front of its plane
    vec3 a, b, c, d, e, f;  // corners from the origin, counter-clockwise seen from the front; those past
};                          // the last are a again

// Its edges, each from s to t, w being heights above a horizon; the seventh lies on the horizon.
struct Border {
    vec4 s[7], t[7];
};

// normal: of the horizon, or 0
Border polygon_border(Polygon g, vec3 normal) {
    float z = dot(normal, g.origin);
    vec4 a = vec4(g.a, z + dot(normal, g.a)), b = vec4(g.b, z + dot(normal, g.b));
    vec4 c = vec4(g.c, z + dot(normal, g.c)), d = vec4(g.d, z + dot(normal, g.d));
    vec4 e = vec4(g.e, z + dot(normal, g.e)), f = vec4(g.f, z + dot(normal, g.f));
    return Border(vec4[7](a, b, c, d, e, f, a), vec4[7](b, c, d, e, f, a, a));
}

// Leaves of an edge what is above the horizon, of one below it nothing but the point top.
// leave, enter: where the border crosses the horizon
void polygon_cut(inout vec4 s, inout vec4 t, vec4 top, inout vec4 leave, inout vec4 enter) {
    bool from = s.w > 0.0, to = t.w > 0.0;
    if (from != to) {
        vec4 cut = vec4(s.xyz + (t.xyz - s.xyz) * (s.w / (s.w - t.w)), 0.0);
        if (from) t = leave = cut;
        else s = enter = cut;
    } else if (!from) {
        s = t = top;
    }
}

// The border of what is above the horizon, D. Baum, H. Rushmeier and J. Winget, "Improving radiosity
// solutions through the use of analytically determined form-factors", SIGGRAPH 1989.
// top: the highest corner, above the horizon
void polygon_clip(inout Border k, int corners, vec4 top) {
    vec4 leave = top, enter = top;
    polygon_cut(k.s[0], k.t[0], top, leave, enter);
    polygon_cut(k.s[1], k.t[1], top, leave, enter);
    polygon_cut(k.s[2], k.t[2], top, leave, enter);
    if (corners > 3) polygon_cut(k.s[3], k.t[3], top, leave, enter);
    if (corners > 4) polygon_cut(k.s[4], k.t[4], top, leave, enter);
    if (corners > 5) polygon_cut(k.s[5], k.t[5], top, leave, enter);
    k.s[6] = leave;
    k.t[6] = enter;
}

vec4 polygon_higher(vec4 a, vec4 b) {
    return b.w > a.w ? b : a;
}

vec4 polygon_top(Border k) {
    vec4 first = polygon_higher(polygon_higher(k.s[0], k.s[1]), k.s[2]);
    return polygon_higher(first, polygon_higher(polygon_higher(k.s[3], k.s[4]), k.s[5]));
}

// Distance of a point of its plane from the line of an edge, positive on the side where it is within.
float polygon_side(Polygon g, vec3 point, vec4 s, vec4 t) {
    vec3 e = t.xyz - s.xyz;
    return dot(g.front, cross(s.xyz - point, e)) * inversesqrt(max(dot(e, e), 1e-37));
}

// The least of those over all edges.
float polygon_within(Polygon g, Border k, int corners, vec3 point) {
    float least = min(polygon_side(g, point, k.s[0], k.t[0]), polygon_side(g, point, k.s[1], k.t[1]));
    least = min(least, polygon_side(g, point, k.s[2], k.t[2]));
    if (corners > 3) least = min(least, polygon_side(g, point, k.s[3], k.t[3]));
    if (corners > 4) least = min(least, polygon_side(g, point, k.s[4], k.t[4]));
    if (corners > 5) least = min(least, polygon_side(g, point, k.s[5], k.t[5]));
    return min(least, polygon_side(g, point, k.s[6], k.t[6]));
}

Apex polygon_apex(Polygon g, Border k, int corners, vec3 normal) {
    vec4 foot = vec4(-g.height * g.front - g.origin, -g.height * dot(normal, g.front));
    if (polygon_within(g, k, corners, foot.xyz) >= 0.0) return fan_apex(g.origin, foot);
    vec4 best = fan_nearer(g.origin, k.s[0], k.t[0], k.s[0]);
    best = fan_nearer(g.origin, k.s[1], k.t[1], best);
    best = fan_nearer(g.origin, k.s[2], k.t[2], best);
    if (corners > 3) best = fan_nearer(g.origin, k.s[3], k.t[3], best);
    if (corners > 4) best = fan_nearer(g.origin, k.s[4], k.t[4], best);
    if (corners > 5) best = fan_nearer(g.origin, k.s[5], k.t[5], best);
    return fan_apex(g.origin, fan_nearer(g.origin, k.s[6], k.t[6], best));
}

Blade polygon_blade(Polygon g, Apex apex, vec4 s, vec4 t) {
    return fan_blade(g.origin, g.front, g.height, apex, s.xyz, t.xyz);
}

float polygon_edge_flux(Polygon g, Apex apex, vec4 s, vec4 t) {
    return fan_blade_flux(polygon_blade(g, apex, s, t), apex, s.w, t.w);
}

// Irradiance on a surface there over the radiance of the polygon: pi times the form factor.
// corners: 3 to 6, a constant; normal: unit
float polygon_irradiance(Polygon g, int corners, vec3 normal) {
    Border k = polygon_border(g, normal);
    vec4 top = polygon_top(k);
    if (g.height <= 0.0 || top.w <= 0.0) return 0.0;
    polygon_clip(k, corners, top);
    Apex apex = polygon_apex(g, k, corners, normal);
    float sum = polygon_edge_flux(g, apex, k.s[6], k.t[6]);
    sum += polygon_edge_flux(g, apex, k.s[0], k.t[0]);
    sum += polygon_edge_flux(g, apex, k.s[1], k.t[1]);
    sum += polygon_edge_flux(g, apex, k.s[2], k.t[2]);
    if (corners > 3) sum += polygon_edge_flux(g, apex, k.s[3], k.t[3]);
    if (corners > 4) sum += polygon_edge_flux(g, apex, k.s[4], k.t[4]);
    if (corners > 5) sum += polygon_edge_flux(g, apex, k.s[5], k.t[5]);
    return min(sum, 3.14159265);
}

// The sums, from the first edge on, of the solid angles of the triangles of the fan [sr].
float[6] polygon_angles(Polygon g, Border k, int corners, Apex apex) {
    float a = fan_blade_angle(polygon_blade(g, apex, k.s[0], k.t[0]), apex);
    float b = a + fan_blade_angle(polygon_blade(g, apex, k.s[1], k.t[1]), apex);
    float c = b + fan_blade_angle(polygon_blade(g, apex, k.s[2], k.t[2]), apex), d = c;
    if (corners > 3) d += fan_blade_angle(polygon_blade(g, apex, k.s[3], k.t[3]), apex);
    float e = d;
    if (corners > 4) e += fan_blade_angle(polygon_blade(g, apex, k.s[4], k.t[4]), apex);
    float f = e;
    if (corners > 5) f += fan_blade_angle(polygon_blade(g, apex, k.s[5], k.t[5]), apex);
    return float[6](a, b, c, d, e, f);
}

// The solid angle of its front [sr].
// corners: 3 to 6, a constant
float polygon_solid_angle(Polygon g, int corners) {
    if (g.height <= 0.0) return 0.0;
    Border k = polygon_border(g, vec3(0.0));
    return polygon_angles(g, k, corners, polygon_apex(g, k, corners, vec3(0.0)))[5];
}

// Whether a direction meets it, or misses it by less than a slack of its distance.
bool polygon_met(Polygon g, int corners, vec3 direction, float slack) {
    Border k = polygon_border(g, vec3(0.0));
    float toward = -dot(direction, g.front), range = g.height / max(toward, 1e-9);
    bool within = polygon_within(g, k, corners, direction * range - g.origin) >= -slack * range;
    return g.height > 0.0 && toward > 1e-9 && within;
}

// A direction to it, spread evenly over its solid angle: one of the triangles, a point w on its border that
// splits off the right part of it, a point between apex and w evenly over the cosine, as in J. Arvo,
// "Stratified sampling of spherical triangles", SIGGRAPH 1995. That part of solid angle x is found from
//     tan(x / 2) = k T / (1 + cos P + b T),   T = tan(angle from p to w, halved),
// in which nothing cancels where the triangle is tiny. Returns 1 / density, the solid angle, in w.
// corners: 3 to 6, a constant
vec4 polygon_direction(Polygon g, int corners, vec2 u) {
    if (g.height <= 0.0) return vec4(fan_unit(g.origin), 0.0);
    Border k = polygon_border(g, vec3(0.0));
    Apex apex = polygon_apex(g, k, corners, vec3(0.0));
    float sum[6] = polygon_angles(g, k, corners, apex);
    float x = u.x * sum[5], before = 0.0;
    vec4 s = k.s[0], t = k.t[0];
    if (x > sum[0]) s = k.s[1], t = k.t[1], before = sum[0];
    if (x > sum[1]) s = k.s[2], t = k.t[2], before = sum[1];
    if (corners > 3 && x > sum[2]) s = k.s[3], t = k.t[3], before = sum[2];
    if (corners > 4 && x > sum[3]) s = k.s[4], t = k.t[4], before = sum[3];
    if (corners > 5 && x > sum[4]) s = k.s[5], t = k.t[5], before = sum[4];
    return vec4(fan_direction(polygon_blade(g, apex, s, t), apex, vec2(x - before, u.y)), sum[5]);
}

// The density of those directions over solid angle [1/sr], also of those that rounding carries off its edge.
// corners: 3 to 6, a constant; direction: unit
float polygon_density(Polygon g, int corners, vec3 direction) {
    bool met = polygon_met(g, corners, direction, FAN_SLACK);
    return met ? 1.0 / max(polygon_solid_angle(g, corners), 1e-37) : 0.0;
}

// Distance to its plane along a direction that meets it.
float polygon_reach(Polygon g, vec3 direction) {
    return g.height / max(-dot(direction, g.front), 1e-9);
}
