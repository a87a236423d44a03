// light   Sky: the clear sky's light by turbidity and solar height, without the sun's disk
// paper   L. Hosek and A. Wilkie, "An analytic model for full spectral sky-dome radiance", SIGGRAPH 2012
// sampled  by a table of the dome's luminance, alike on both sides of the sun
// note    black below the horizon, where the model says nothing, and where it would be negative
#include "lib/constants.glsl"
#include "lib/equirect.glsl"
#include "lib/light.glsl"

uniform float turbidity = 3.0;           // [1, 10]: how hazy: 2 very clear, 3 clear, 6 hazy, 10 murky (unitless)
uniform float albedo = 0.3;              // [0, 1]: share of the light that the ground sends back up (unitless)
uniform float height = radians(40.0);    // [0, 90] degrees: of the sun above the horizon
uniform float azimuth = radians(30.0);   // [-360, 360] degrees: of the sun about y, from +z toward +x
uniform float strength = 1.0;            // [0, 4 ..]: factor on the published radiance (unitless)
uniform vec3 coefficients[9];            // given: A to I of the paper, for X, Y and Z
uniform vec3 mixing[3];                  // given: RGB of X, of Y and of Z [W m^-2 sr^-1]
uniform vec3 toward;                     // given: direction to the sun
uniform vec2 bearing;                    // given: sine and cosine of its azimuth
uniform sampler2D table;                 // given: chances of cells: angle from the sun's azimuth, from +y

vec3 environment(vec3 direction) {
    vec3 off = direction - toward;
    float square = dot(off, off);  // 4 sin^2(gamma / 2): all digits near the sun, where acos has none
    float gamma = 2.0 * angle_of(sqrt(square), length(direction + toward));
    float cosine = 1.0 - 0.5 * square, up = direction.y;
    vec3 rest = 1.0 - coefficients[8];
    vec3 apart = rest * rest + coefficients[8] * square;  // 1 + H^2 - 2 H cos(gamma), never near 0
    vec3 shape = coefficients[2] + coefficients[3] * exp(coefficients[4] * gamma)
        + coefficients[5] * (cosine * cosine) + coefficients[6] * ((1.0 + cosine * cosine) / (apart * sqrt(apart)))
        + coefficients[7] * sqrt(max(up, 0.0));
    vec3 haze = 1.0 + coefficients[0] * exp(coefficients[1] / (max(up, 0.0) + 0.01));
    vec3 xyz = max(haze * shape, 0.0) * (up < 0.0 ? 0.0 : strength);
    return mixing[0] * xyz.x + mixing[1] * xyz.y + mixing[2] * xyz.z;
}

float row_angle(int row) {
    return (0.5 * PI) * float(row) / float(cells_of(table).y);
}

// Density of a cell on one side of the sun, half of its chance.
float cell_density(ivec2 at, float chance) {
    float wide = PI / float(cells_of(table).x);
    return 0.5 * chance / cell_angle(wide, row_angle(at.y), row_angle(at.y + 1));
}

Incident light(vec3 place, vec2 u) {
    float side = u.x < 0.5 ? -1.0 : 1.0;
    Cell cell = picked_cell(table, vec2(abs(2.0 * u.x - 1.0), u.y));
    float across = side * PI * (float(cell.at.x) + cell.within.x) / float(cells_of(table).x);
    vec3 d = direction_between(row_angle(cell.at.y), row_angle(cell.at.y + 1), cell.within.y, across);
    d.xz = vec2(d.x * bearing.y + d.z * bearing.x, d.z * bearing.y - d.x * bearing.x);
    return Incident(d, environment(d) / cell_density(cell.at, cell.chance));
}

float density(vec3 place, vec3 direction) {
    vec3 d = direction;
    d.xz = vec2(d.x * bearing.y - d.z * bearing.x, d.z * bearing.y + d.x * bearing.x);
    vec2 at = vec2(abs(azimuth_of(d)) / PI, polar_of(d) / (0.5 * PI)) * vec2(cells_of(table));
    ivec2 cell = min(ivec2(at), cells_of(table) - 1);
    return direction.y < 0.0 ? 0.0 : cell_density(cell, chance_of(table, cell));
}

vec3 arriving(vec3 place, vec3 direction) {
    return environment(direction);
}
