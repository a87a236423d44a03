#include "lib/angle.glsl"

// What a patch of uniform radiance sends to a place, without cancellation at any size, distance or tilt.
//
// The patch, flat and convex, is cut into triangles that share its point nearest to the place, the apex:
// a fan. With B the angle from the apex to a point w of the border, z the cosines to the normal there,
// and psi the azimuth around the apex, the radial integral is closed,
//     int_0^B sin(b) z(b) db dpsi = (z_apex (1 - B cot B) + z_w (B / sin B - cos B)) / 2 dpsi,
// so that along the border only smooth terms >= 0 are left to sum, and where place and patch come close,
// or the patch is tiny, on edge or cut by the horizon, none cancels another, as those of J. H. Lambert's
// sum over the edges (Photometria, 1760) do (PHYSICS B.9). Since the apex is nearest, B <= 90 degrees.
struct Apex {
    vec4 at;         // from the origin of the patch; w: its height above the horizon
    vec3 direction;  // unit, from the place
    float range;     // distance from the place
};

// The six points of C. F. Gauss and A. Legendre of [0, 1] are these, and 1 minus these.
const vec3 FAN_NEAR = vec3(0.0337652429, 0.169395307, 0.380690407);
const vec3 FAN_WEIGHT = vec3(0.0856622462, 0.180380787, 0.233956967);

// By how much of its distance rounding moves a point along a direction off what it was meant for.
const float FAN_SLACK = 2e-7;

// (B / sin B - cos B) / (2 sin^2 B) as a polynomial in c = cos B, minimax of its relative error, 1.4e-7.
// c: [0, 1]
vec3 fan_far(vec3 c) {
    vec3 sum = 0.231747031 - 0.0387255586 * c;
    sum = sum * c - 0.636259615;
    sum = sum * c + 1.09178281;
    sum = sum * c - 1.37022936;
    sum = sum * c + 1.41748929;
    sum = sum * c - 1.32538617;
    sum = sum * c + 1.17749929;
    sum = sum * c - 0.999982536;
    return sum * c + 0.785398066;
}

// Flux on the horizon per sin^2(B) dpsi: the radial integral above, over sin^2 B.
// apex, z: cosines to the normal; c: cos B; all in [0, 1] but for rounding where the place touches the patch
vec3 fan_flux(float apex, vec3 z, vec3 c) {
    c = clamp(c, 0.0, 1.0);
    vec3 far = fan_far(c);
    return apex * (0.5 - c * far) + min(z, 1.0) * far;
}

// A vector with length 1, or some unit vector if it is 0.
vec3 fan_unit(vec3 v) {
    float square = dot(v, v);
    return square > 1e-37 ? v * inversesqrt(square) : vec3(0.0, 0.0, 1.0);
}

// The nearer of a point and of the points on the line from s to t.
// origin: of the patch, from the place; s, t, best: from there, and the height
vec4 fan_nearer(vec3 origin, vec4 s, vec4 t, vec4 best) {
    vec3 p = origin + s.xyz, e = t.xyz - s.xyz, q = origin + best.xyz;
    float along = clamp(-dot(p, e) / max(dot(e, e), 1e-37), 0.0, 1.0);
    vec4 near = s + along * (t - s);
    p = origin + near.xyz;
    return dot(p, p) < dot(q, q) ? near : best;
}

Apex fan_apex(vec3 origin, vec4 at) {
    vec3 p = origin + at.xyz;
    float range = max(length(p), 1e-18);
    return Apex(at, p / range, range);
}

// One triangle of the fan as the place sees it.
struct Blade {
    vec3 p, q;      // unit directions to the ends of the border
    vec3 range;     // distance of p, of q, and sin(theta)
    float theta;    // angle between p and q
    float measure;  // sin^2(B) dpsi along the border, divided by dtheta, times theta
};

// origin: of the patch, from the place; front: its unit normal; height: of the place above its plane
// s, t: ends of the border from the origin, counter-clockwise seen from the front
Blade fan_blade(vec3 origin, vec3 front, float height, Apex apex, vec3 s, vec3 t) {
    vec3 p = origin + s, q = origin + t, e = t - s;
    float P = max(length(p), 1e-18), Q = max(length(q), 1e-18);
    float sine = max(length(cross(p / P, e / Q)), 1e-18);
    float theta = angle_between(sine, dot(p / P, q / Q));
    float area = dot(front, cross(s - apex.at.xyz, e));
    float measure = height / apex.range * (area / (P * Q)) * (theta / sine);
    return Blade(p / P, q / Q, vec3(P, Q, sine), theta, max(measure, 0.0));
}

// Flux of a blade, by six points within 7e-7.
// s, t: heights of the ends above the horizon
float fan_blade_flux(Blade blade, Apex apex, float s, float t) {
    vec3 near = sin(FAN_NEAR * blade.theta) / blade.range.z;
    vec3 far = sin((1.0 - FAN_NEAR) * blade.theta) / blade.range.z;
    vec2 z = vec2(s, t) / blade.range.xy;
    vec2 c = vec2(dot(apex.direction, blade.p), dot(apex.direction, blade.q));
    float top = apex.at.w / apex.range;
    vec3 sum = fan_flux(top, far * z.x + near * z.y, far * c.x + near * c.y);
    sum += fan_flux(top, near * z.x + far * z.y, near * c.x + far * c.y);
    return blade.measure * dot(FAN_WEIGHT, sum);
}

// Triple product of the apex and the ends, all unit.
float fan_product(Blade blade) {
    return blade.measure * (blade.range.z / blade.theta);
}

// Solid angle of a blade [sr], A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983.
float fan_blade_angle(Blade blade, Apex apex) {
    float sum = dot(apex.direction, blade.p) + dot(blade.p, blade.q) + dot(blade.q, apex.direction);
    return 2.0 * angle_between(fan_product(blade), 1.0 + sum);
}

// A direction within a blade, evenly over its solid angle; see polygon_direction.
// part: solid angle on the side of p [sr], and a number in [0, 1)
vec3 fan_direction(Blade blade, Apex apex, vec2 part) {
    float P = dot(apex.direction, blade.p), Q = dot(apex.direction, blade.q);
    float b = (Q - P * dot(blade.p, blade.q)) / blade.range.z, s = sin(0.5 * part.x);
    float k = fan_product(blade) / blade.range.z;
    float angle = min(2.0 * angle_between(s * (1.0 + P), max(k * cos(0.5 * part.x) - b * s, 0.0)), blade.theta);
    vec2 share = sin(vec2(blade.theta - angle, angle)) / blade.range.z;
    vec3 w = fan_unit(share.x * blade.p + share.y * blade.q), off = w - apex.direction;
    float y = min(0.5 * dot(off, off), 1.0);  // 1 - cos B
    float far = sqrt(part.y * (2.0 - part.y * y) / (2.0 - y));
    return fan_unit((1.0 - part.y * y - (1.0 - y) * far) * apex.direction + far * w);
}
