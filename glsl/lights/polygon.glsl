// light   Polygon: flat, convex, of uniform radiance; its front sees its corners run counter-clockwise
// paper   J. H. Lambert, "Photometria", 1760; summed without cancellation, see lib/fan.glsl
// sampled  by solid angle, uniform
// note    irradiance within 1e-5 where it stands 0.03 rad above the horizon; far from the origin, float32
//         keeps fewer digits of place - corner
#include "lib/light.glsl"
#include "lib/polygon.glsl"

uniform int corners = 1;                  // {three, four, five, six}: how many, from a on
uniform vec3 a = vec3(-0.5, 2.0, -0.5);   // [.. -10, 10 ..]: corner (m)
uniform vec3 b = vec3(0.5, 2.0, -0.5);    // [.. -10, 10 ..]: corner (m)
uniform vec3 c = vec3(0.5, 2.0, 0.5);     // [.. -10, 10 ..]: corner (m)
uniform vec3 d = vec3(-0.5, 2.0, 0.5);    // [.. -10, 10 ..]: corner, of four or more (m)
uniform vec3 e = vec3(-0.7, 2.0, 0.25);   // [.. -10, 10 ..]: corner, of five or more (m)
uniform vec3 f = vec3(-0.7, 2.0, -0.25);  // [.. -10, 10 ..]: corner, of six (m)
uniform vec3 radiance = vec3(10.0);       // [0, 100 ..] tinted: L, alike toward all in front (W m^-2 sr^-1)

const int POLYGON_CORNERS = corners + 3;

Polygon polygon_from(vec3 place) {
    vec3 none = vec3(0.0), B = b - a, C = c - a;
    vec3 D = corners >= CORNERS_FOUR ? d - a : none;
    vec3 E = corners >= CORNERS_FIVE ? e - a : none;
    vec3 F = corners >= CORNERS_SIX ? f - a : none;
    vec3 area = cross(B, C) + cross(C, D) + cross(D, E) + cross(E, F);  // M. Newell: twice the area
    float size = length(area), extent = dot(B, B) + dot(C, C) + dot(D, D);
    vec3 front = size > 1e-6 * extent ? area / size : none;  // 1e-6: all in one line, but for rounding
    return Polygon(a - place, front, dot(place - a, front), none, B, C, D, E, F);
}

Incident light(vec3 place, vec2 u) {
    vec4 L = polygon_direction(polygon_from(place), POLYGON_CORNERS, u);
    return Incident(L.xyz, radiance * L.w);
}

vec3 irradiance(vec3 place, vec3 normal) {
    return radiance * polygon_irradiance(polygon_from(place), POLYGON_CORNERS, normal);
}

vec3 arriving(vec3 place, vec3 direction) {
    return polygon_met(polygon_from(place), POLYGON_CORNERS, direction, 0.0) ? radiance : vec3(0.0);
}

float density(vec3 place, vec3 direction) {
    return polygon_density(polygon_from(place), POLYGON_CORNERS, direction);
}

float reach(vec3 place, vec3 direction) {
    return polygon_reach(polygon_from(place), direction);
}
