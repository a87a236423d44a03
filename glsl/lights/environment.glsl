// light   Environment: a picture of all that is around, such as a .hdr photograph (equirectangular)
// paper   M. Pharr, W. Jakob and G. Humphreys, "Physically based rendering", 4th ed., 2023, sec. 12.5
// sampled  by a table of the picture's luminance times the solid angle
// note    the middle of the picture is +z, its left quarter +x, its top row +y
#include "lib/constants.glsl"
#include "lib/equirect.glsl"
#include "lib/light.glsl"

uniform vec3 radiance = vec3(1.0);   // [0, 10 ..] tinted: what 1 in the picture stands for (W m^-2 sr^-1)
uniform float turn = radians(0.0);   // [-360, 360] degrees: azimuth of the picture's middle, from +z toward +x
uniform sampler2D picture;           // given: its RGB, top row first
uniform sampler2D table;             // given: chances of cells: across and down the picture

// Where across and down the picture a direction is seen, in [0, 1].
vec2 seen_at(vec3 direction) {
    float across = 0.5 - (azimuth_of(direction) - turn) / (2.0 * PI);
    return vec2(across - floor(across), polar_of(direction) / PI);
}

// Linear between the middles of the pixels; the first column is next to the last. Four fetches, since
// what a sampler has in between is 8 bits fine.
vec3 environment(vec3 direction) {
    ivec2 size = textureSize(picture, 0);
    vec2 at = seen_at(direction) * vec2(size) - 0.5, t = at - floor(at);
    ivec2 low = ivec2(floor(at)), high = low + 1;
    low = ivec2(low.x < 0 ? size.x - 1 : min(low.x, size.x - 1), clamp(low.y, 0, size.y - 1));
    high = ivec2(high.x < size.x ? high.x : 0, min(high.y, size.y - 1));
    vec3 upper = mix(texelFetch(picture, low, 0).rgb, texelFetch(picture, ivec2(high.x, low.y), 0).rgb, t.x);
    vec3 lower = mix(texelFetch(picture, ivec2(low.x, high.y), 0).rgb, texelFetch(picture, high, 0).rgb, t.x);
    return radiance * mix(upper, lower, t.y);
}

float row_angle(int row) {
    return PI * float(row) / float(cells_of(table).y);
}

float cell_density(ivec2 at, float chance) {
    float wide = 2.0 * PI / float(cells_of(table).x);
    return chance / cell_angle(wide, row_angle(at.y), row_angle(at.y + 1));
}

Incident light(vec3 place, vec2 u) {
    Cell cell = picked_cell(table, u);
    float across = (float(cell.at.x) + cell.within.x) / float(cells_of(table).x);
    float azimuth = turn - 2.0 * PI * (across - 0.5);
    vec3 d = direction_between(row_angle(cell.at.y), row_angle(cell.at.y + 1), cell.within.y, azimuth);
    return Incident(d, environment(d) / cell_density(cell.at, cell.chance));
}

float density(vec3 place, vec3 direction) {
    ivec2 cell = min(ivec2(seen_at(direction) * vec2(cells_of(table))), cells_of(table) - 1);
    return cell_density(cell, chance_of(table, cell));
}

vec3 arriving(vec3 place, vec3 direction) {
    return environment(direction);
}
