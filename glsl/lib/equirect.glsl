#include "lib/angle.glsl"

// The sphere of directions as a rectangle, azimuth by angle from +y, and directions by chance from a
// table of its cells. Row y of a table holds the chances of columns 0 to x, summed up, given that row;
// its last column those of rows 0 to y. Within a cell all directions have the same density.

struct Cell {
    ivec2 at;      // column and row
    vec2 within;   // where in the cell, [0, 1)^2
    float chance;  // that of the whole cell
};

// The azimuth about y of a direction, from +z toward +x, in [-PI, PI]; straight up 0.
float azimuth_of(vec3 direction) {
    return azimuth(direction.x, direction.z);
}

// The angle between a direction and +y, in [0, PI].
float polar_of(vec3 direction) {
    return angle_between(length(direction.xz), direction.y);
}

// The size of a table in cells.
ivec2 cells_of(sampler2D table) {
    return textureSize(table, 0) - ivec2(1, 0);
}

// What entry `index` of a line of sums adds to the one before it. x: that sum; y: the share
vec2 share_of(sampler2D table, ivec2 start, ivec2 along, int index) {
    float before = index > 0 ? texelFetch(table, start + (index - 1) * along, 0).r : 0.0;
    return vec2(before, texelFetch(table, start + index * along, 0).r - before);
}

// The first of `count` entries of a line of sums that is above u: by halving, so that points u spread
// evenly stay so.
int first_above(sampler2D table, ivec2 start, ivec2 along, int count, float u) {
    int low = 0, high = count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        bool above = texelFetch(table, start + middle * along, 0).r > u;
        low = above ? low : middle + 1;
        high = above ? middle : high;
    }
    return low;
}

// The cell of a table that u picks.
Cell picked_cell(sampler2D table, vec2 u) {
    ivec2 size = cells_of(table), along = ivec2(1, 0), down = ivec2(0, 1);
    u = min(u, vec2(0.99999994));  // the last float below 1: some sum is above it
    ivec2 top = ivec2(size.x, 0);
    int y = first_above(table, top, down, size.y, u.y);
    vec2 row = share_of(table, top, down, y);
    ivec2 left = ivec2(0, y);
    int x = first_above(table, left, along, size.x, u.x);
    vec2 column = share_of(table, left, along, x);
    vec2 within = (u - vec2(column.x, row.x)) / vec2(column.y, row.y);
    return Cell(ivec2(x, y), within, column.y * row.y);
}

// The chance that `picked_cell` gives the cell at this place.
float chance_of(sampler2D table, ivec2 at) {
    ivec2 size = cells_of(table);
    float row = share_of(table, ivec2(size.x, 0), ivec2(0, 1), at.y).y;
    return row * share_of(table, ivec2(0, at.y), ivec2(1, 0), at.x).y;
}

// The solid angle [sr] of a cell `wide` in azimuth, between two angles from +y. The difference of two
// cosines as a product keeps the digits of a thin one.
float cell_angle(float wide, float upper, float lower) {
    return 2.0 * wide * sin(0.5 * (upper + lower)) * sin(0.5 * (lower - upper));
}

// The direction a share t of the solid angle down from one angle from +y to another. sin^2 and cos^2
// of half the angle keep the digits at either pole.
vec3 direction_between(float upper, float lower, float t, float azimuth) {
    vec2 a = vec2(sin(0.5 * upper), sin(0.5 * lower)), b = vec2(cos(0.5 * upper), cos(0.5 * lower));
    float s = mix(a.x * a.x, a.y * a.y, t), c = mix(b.x * b.x, b.y * b.y, t);
    float flat_part = 2.0 * sqrt(s * c);
    return vec3(flat_part * sin(azimuth), c - s, flat_part * cos(azimuth));
}
