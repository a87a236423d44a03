#include "lib/constants.glsl"
#include "lib/fan.glsl"

// A disk, as a place sees it.
struct Disk {
    vec3 centre;   // from the place
    vec3 front;    // unit normal of the side that radiates, or 0
    vec3 x, y;     // unit, in its plane: toward the foot of the place, and across
    float radius;
    float height;  // of the place in front of its plane
    float foot;    // distance of the foot from the centre
    vec2 rim;      // distances of the place from the nearest and the farthest point of the rim
};

Disk disk_from(vec3 centre, vec3 front, float radius) {
    float height = -dot(centre, front);
    vec3 foot = -centre - height * front;
    foot -= dot(foot, front) * front;  // once more: rounding where it is short
    float l = length(foot);
    vec3 n = abs(front), other = n.x < n.y ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 any = cross(front, other);
    vec3 x = l > 1e-6 * length(centre) ? foot / l : any * inversesqrt(max(dot(any, any), 1e-37));
    vec2 rim = vec2(length(vec2(height, l - radius)), length(vec2(height, l + radius)));
    return Disk(centre, front, x, cross(front, x), radius, height, l, max(rim, 1e-18));
}

// W + D and W - D, where W is the product of the distances in `rim` and D that of the vectors there: 2 W
// times the squares of cosine and sine of half the angle between nearest and farthest point. One of
// them would cancel; their product is 4 radius^2 height^2.
vec2 disk_halves(Disk g) {
    float W = g.rim.x * g.rim.y, D = g.height * g.height + (g.foot - g.radius) * (g.foot + g.radius);
    float large = W + abs(D), rest = g.radius * g.height, small = max(4.0 * rest * (rest / large), 1e-37);
    return D > 0.0 ? vec2(large, small) : vec2(small, large);
}

// Irradiance over radiance of a disk that is all above the horizon: the configuration factors of elements
// parallel and perpendicular to a disk, J. Howell's catalog, joined so that nothing cancels near the horizon.
float disk_whole(Disk g, vec3 normal) {
    float W = g.rim.x * g.rim.y, large = disk_halves(g).x, square = g.radius * g.radius;
    float a = g.height / (large + 2.0 * square), b = 2.0 * (a * g.radius) * (g.height * g.radius / large);
    return 2.0 * PI * (square / W) * (a * dot(normal, g.centre) - b * dot(normal, g.front));
}

// Flux of a part of the rim, per u: tan(phi / 2) = sqrt(k) tan(u / 2), phi the azimuth around the centre
// from the nearest point, spreads u evenly over what is near and what is far.
// apex: of the fan; on: its place in the disk, by x and y; z, c: height above the horizon and length along
// the apex's direction, of the centre, of x and of y; k: nearest over farthest distance; s, o: sine and
// cosine of u / 2
vec3 disk_rim_flux(Disk g, Apex apex, vec2 on, vec3 z, vec3 c, float k, vec3 s, vec3 o) {
    vec3 d = o * o + k * s * s;
    vec3 versine = 2.0 * k * s * s / d, sine = 2.0 * sqrt(k) * s * o / d, cosine = 1.0 - versine;
    vec3 square = g.rim.x * g.rim.x + 2.0 * g.foot * g.radius * versine, inverse = inversesqrt(square);
    vec3 area = g.radius * (g.radius - on.x + on.x * versine - on.y * sine);
    vec3 flux = fan_flux(apex.at.w / apex.range, (z.x + z.y * cosine + z.z * sine) * inverse,
        (c.x + c.y * cosine + c.z * sine) * inverse);
    return area * flux * (sqrt(k) / (square * d));
}

// The two points of a quadrature at the same distances from the middle.
// mid, off: halves of u
vec3 disk_pair(Disk g, Apex apex, vec2 on, vec3 z, vec3 c, float k, float mid, vec3 off) {
    vec3 a = sin(mid) * cos(off), b = cos(mid) * sin(off), d = cos(mid) * cos(off), e = sin(mid) * sin(off);
    return disk_rim_flux(g, apex, on, z, c, k, a - b, d + e) + disk_rim_flux(g, apex, on, z, c, k, a + b, d - e);
}

// Its integral between two azimuths, by eighteen points of C. F. Gauss and A. Legendre: 3e-6 where the
// nearest point of the rim is 80 times nearer than the farthest, 1e-7 where 8 times.
// from, to: [-pi, pi], with neither 0 nor pi between them, beside which the integrand is steep
float disk_panel(Disk g, Apex apex, vec2 on, vec3 z, vec3 c, float k, float from, float to) {
    float first = azimuth(sin(0.5 * from), sqrt(k) * cos(0.5 * from));
    float last = azimuth(sin(0.5 * to), sqrt(k) * cos(0.5 * to));
    float mid = 0.5 * (first + last), wide = 0.5 * (last - first);
    vec3 near = wide * vec3(0.084775013, 0.251886226, 0.411751161);
    vec3 far = wide * vec3(0.559770831, 0.691687043, 0.803704959);
    vec3 end = wide * vec3(0.892602466, 0.95582395, 0.991565168);
    vec3 sum = vec3(0.169142383, 0.164276484, 0.154684675) * disk_pair(g, apex, on, z, c, k, mid, near);
    sum += vec3(0.140642915, 0.122555207, 0.100942044) * disk_pair(g, apex, on, z, c, k, mid, far);
    sum += vec3(0.0764257303, 0.0497145489, 0.0216160135) * disk_pair(g, apex, on, z, c, k, mid, end);
    return 2.0 * wide * dot(sum, vec3(1.0));
}

// Irradiance over radiance of a disk cut by the horizon, by a fan (lib/fan.glsl) of the arc above and of its
// chord. phi, wide: where the rim is highest, [0, pi], and half the arc, which holds not both 0 and pi
// z: heights of the centre, of x and of y
float disk_part(Disk g, vec3 normal, vec3 y, vec3 z, float phi, float wide) {
    float from = phi - wide, to = phi + wide;
    vec4 s = vec4(g.radius * (cos(to) * g.x + sin(to) * y), 0.0);
    vec4 t = vec4(g.radius * (cos(from) * g.x + sin(from) * y), 0.0);
    vec4 at = fan_nearer(g.centre, s, t, s);
    vec2 on = vec2(dot(at.xyz, g.x), dot(at.xyz, y));
    float foot = -g.height * dot(normal, g.front), near = z.x + z.y;
    if (g.foot < g.radius && foot > 0.0) on = vec2(g.foot, 0.0), at = vec4(g.foot * g.x, foot);
    if (g.foot >= g.radius && near > 0.0) on = vec2(g.radius, 0.0), at = vec4(g.radius * g.x, near);
    Apex apex = fan_apex(g.centre, at);
    vec3 w = apex.direction, c = vec3(dot(w, g.centre), g.radius * vec2(dot(w, g.x), dot(w, y)));
    float k = g.rim.x / g.rim.y, split = from < 0.0 ? 0.0 : min(to > PI ? PI : phi, PI);
    float turn = to > PI ? 2.0 * PI : 0.0;
    float sum = disk_panel(g, apex, on, z, c, k, from, split);
    sum += disk_panel(g, apex, on, z, c, k, split - turn, to - turn);
    bool mirrored = dot(y, g.y) < 0.0;
    vec3 first = mirrored ? t.xyz : s.xyz, last = mirrored ? s.xyz : t.xyz;
    Blade chord = fan_blade(g.centre, g.front, g.height, apex, first, last);
    return g.height / apex.range * sum + fan_blade_flux(chord, apex, 0.0, 0.0);
}

// Irradiance on a surface there over the radiance of the disk: pi times the form factor.
// normal: unit
float disk_irradiance(Disk g, vec3 normal) {
    vec3 z = vec3(dot(normal, g.centre), g.radius * vec2(dot(normal, g.x), dot(normal, g.y)));
    float tilt = length(z.yz);
    if (g.height <= 0.0 || z.x <= -tilt) return 0.0;
    float whole = disk_whole(g, normal);
    if (z.x >= tilt) return whole;
    // Above are the nearest and the farthest point: then what is below, seen from the other side, is less.
    bool most = z.x > abs(z.y);
    if (most) z = -z;
    vec3 y = z.z < 0.0 ? -g.y : g.y;
    z.z = abs(z.z);
    float phi = angle_between(z.z, z.y), wide = 2.0 * angle_between(sqrt(tilt + z.x), sqrt(tilt - z.x));
    float part = disk_part(g, most ? -normal : normal, y, z, phi, wide);
    return min(most ? whole + part : part, PI);
}

// The elliptic cone of its directions, E. Heitz, "Analytical calculation of the solid angle subtended by an
// arbitrarily positioned ellipsoid to a point source", 2017: its axis, and half-axes as sines of half-angles.
struct Ellipse {
    vec3 axis, x, y;  // unit
    vec2 sine;        // along x and y
};

Ellipse disk_ellipse(Disk g) {
    vec2 halves = disk_halves(g);
    float W = g.rim.x * g.rim.y, ends = g.rim.x + g.rim.y;
    vec3 axis = fan_unit(-g.height * g.front - g.foot * (2.0 * halves.x / (ends * ends)) * g.x);
    float a = g.radius * inversesqrt(g.radius * g.radius + 0.5 * halves.x), b = sqrt(halves.y / (2.0 * W));
    return Ellipse(axis, g.y, cross(axis, g.y), vec2(a, b));
}

// A direction to the disk, spread evenly over the ellipse as seen along its axis from afar, then over the
// cosine: the density, (1 + cos B) / (2 pi sine.x sine.y), B of the rim beyond, is within a factor of two of
// the solid angle's, without the elliptic integrals of I. Guillen et al., EGSR 2017. inverse is 1 / density [sr], 0 from behind.
vec3 disk_direction(Disk g, vec2 u, out float inverse) {
    Ellipse e = disk_ellipse(g);
    float tau = 2.0 * PI * u.y;
    vec2 rim = e.sine * vec2(cos(tau), sin(tau));
    float square = min(dot(rim, rim), 1.0), cosine = sqrt(1.0 - square);
    float off = u.x * square / (1.0 + cosine), s = sqrt(off * (2.0 - off) / max(square, 1e-37));
    inverse = g.height > 0.0 ? 2.0 * PI * e.sine.x * e.sine.y / (1.0 + cosine) : 0.0;
    return fan_unit((1.0 - off) * e.axis + s * (rim.x * e.x + rim.y * e.y));
}

// Whether a direction meets it, or misses it by less than a slack of its distance.
bool disk_met(Disk g, vec3 direction, float slack) {
    float toward = -dot(direction, g.front), range = g.height / max(toward, 1e-9);
    float off = distance(direction * range, g.centre);
    return g.height > 0.0 && toward > 1e-9 && off <= g.radius + slack * range;
}

// The density of those directions over solid angle [1/sr], also of those that rounding carries off its edge.
// direction: unit
float disk_density(Disk g, vec3 direction) {
    if (!disk_met(g, direction, FAN_SLACK)) return 0.0;
    Ellipse e = disk_ellipse(g);
    vec2 rim = vec2(dot(direction, e.x), dot(direction, e.y)), part = rim / max(e.sine, 1e-18);
    float square = min(dot(rim, rim) / max(dot(part, part), 1e-37), 1.0);
    return (1.0 + sqrt(1.0 - square)) / max(2.0 * PI * e.sine.x * e.sine.y, 1e-37);
}
