// light   Studio: a room to be mirrored, with a floor, walls, a lamp above and two windows
// note    only what smooth surfaces mirror or let through, and ambient terms, see it
uniform vec3 radiance = vec3(1.0);  // [0, 10 ..] tinted: L of the upper walls (W m^-2 sr^-1)
uniform float lamp = 6.0;           // [0, 50 ..]: how many times brighter lamp and windows are (unitless)
uniform float floor_share = 0.15;   // [0, 1]: how bright the floor is beside the walls (unitless)

// A soft-edged rectangle, 1 within.
// p: where it is looked at, 0 in its middle; size: half width and height
float studio_panel(vec2 p, vec2 size) {
    vec2 edge = smoothstep(size * 1.15, size * 0.85, abs(p));
    return edge.x * edge.y;
}

vec3 environment(vec3 direction) {
    float walls = mix(floor_share, 1.0, smoothstep(-0.25, 0.6, direction.y));
    float bright = 0.0;
    if (direction.y > 0.1) bright += studio_panel(direction.xz / direction.y - vec2(0.2, 0.3), vec2(0.5, 0.3));
    if (direction.x < -0.1) bright += studio_panel(direction.yz / -direction.x - vec2(0.35, 0.3), vec2(0.4, 0.2));
    if (direction.x > 0.1) bright += 0.5 * studio_panel(direction.yz / direction.x - vec2(0.3, 0.5), vec2(0.5, 0.15));
    return radiance * (walls + lamp * bright);
}

// The cosine-weighted mean of the above, fitted: walls within 0.01, lamp and windows within 0.035.
vec3 ambience(vec3 normal) {
    float y = normal.y, walls = mix(floor_share, 1.0, 0.389 + y * (0.466 + 0.071 * y));
    float bright = 0.050 + dot(normal, vec3(-0.013, 0.077, 0.030)) + 0.030 * y * y;
    return radiance * (walls + lamp * max(bright, 0.0));
}
