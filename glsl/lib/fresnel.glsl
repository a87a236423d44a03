// Reflectance x and transmittance y of a dielectric, A. Fresnel, 1823, in the form of R. Cook and
// K. Torrance, 1982, eq. 6, arranged so that no digits cancel and y is not 1 - x: 5 ulp at any n.
// c: cosine of incidence, [0, 1]; n: index behind the interface over the one before it, [0.25, 4]
vec2 F_dielectric(float c, float n) {
    float d = (n - 1.0) * (n + 1.0), g2 = d + c * c;
    if (g2 <= 0.0) return vec2(1.0, 0.0);  // total internal reflection
    float g = sqrt(g2), u = c + g, w = (d + 1.0) * c + g;
    float s = -d / (u * u), p = d * ((d + 2.0) * c * c - 1.0) / (w * w);
    return vec2(0.5 * (s * s + p * p), 2.0 * c * g * (1.0 / (u * u) + (d + 1.0) / (w * w)));
}

// Transmittance alone where both angles are known, without a root that cancels near total reflection.
// c: cosine of incidence, (0, 1]; g: n times the cosine of refraction, > 0; n: as in F_dielectric
float T_dielectric(float c, float g, float n) {
    float u = c + g, w = n * n * c + g;
    return 2.0 * c * g * (1.0 / (u * u) + n * n / (w * w));
}

// The lecture's misprint: g = sqrt((n_i/n_t)^2 + c^2) - 1 where it should be sqrt(1/(..)^2 + c^2 - 1).
// c: cosine of incidence, [0, 1]; n: index behind the interface over the one before it
float F_slide(float c, float n) {
    float g = sqrt(1.0 / (n * n) + c * c) - 1.0;
    float sum = abs(g + c) < 1e-3 ? 1e-3 : g + c;  // 1e-3: its pole, 73.9 degrees for n = 1.5
    float a = (g - c) / sum, b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Absorptance 1 - F of a metal of index eta + i k, M. Born and E. Wolf, "Principles of optics", ch. 14;
// computed itself, since 1 - F loses all digits of good mirrors: 4e-7.
// c: cosine of incidence, [0, 1]; eta: [0.01, 10]; k: [0, 12]
vec3 A_conductor(float c, vec3 eta, vec3 k) {
    float s2 = (1.0 - c) * (1.0 + c);
    vec3 er = (eta - k) * (eta + k), ei = 2.0 * eta * k, t = er - s2;
    vec3 m = sqrt(t * t + ei * ei), r = sqrt(0.5 * (m + abs(t)));
    vec3 q = 0.5 * ei / max(r, 1e-18);  // 1e-18: eta = sin(theta), k = 0
    bvec3 lossy = lessThan(t, vec3(0.0));
    vec3 a = mix(r, q, lossy), b = mix(q, r, lossy);
    vec3 ca = c * a, z = c * (er * a + ei * b);
    vec3 s_wave = 2.0 * ca / (c * c + 2.0 * ca + m);
    vec3 p_wave = 2.0 * z / max(c * c * (er * er + ei * ei) + 2.0 * z + m, 1e-30);
    return s_wave + p_wave;
}

// C. Schlick, "An inexpensive BRDF model for physically-based rendering", Eurographics 1994, eq. 15.
// f0: reflectance at normal incidence; c: cosine of incidence, [0, 1]
vec3 F_schlick(vec3 f0, float c) {
    float x = 1.0 - c, x2 = x * x;
    return f0 + (1.0 - f0) * (x2 * x2 * x);
}

// How much a metal falls below Schlick's curve, N. Hoffman, "Fresnel equations considered harmful",
// Eurographics MAM 2019: F = F_schlick - dip c (1 - c)^6.
// f0: reflectance at normal incidence; f82: at cos = 1/7, 82 degrees
vec3 F82_dip(vec3 f0, vec3 f82) {
    return (F_schlick(f0, 1.0 / 7.0) - f82) * 17.6512600;  // 1 / (1/7 (6/7)^6)
}

// f0: reflectance at normal incidence; dip: see F82_dip; c: cosine of incidence, [0, 1]
vec3 F_f82(vec3 f0, vec3 dip, float c) {
    float x = 1.0 - c, x2 = x * x;
    return clamp(F_schlick(f0, c) - dip * (c * x2 * x2 * x2), 0.0, 1.0);  // f0 0, f82 1 overshoots
}

// Mean over the hemisphere, 2 int F c dc, of F_f82; of F_schlick with dip 0.
vec3 F_average(vec3 f0, vec3 dip) {
    return f0 + (1.0 - f0) / 21.0 - dip / 126.0;
}

// Mean over the hemisphere of F_dielectric from outside, S. Duntley and J. Walsh (see E. Ody et al.,
// Applied Optics 1985), n > 1.
float F_average_dielectric(float n) {
    float n2 = n * n, n4 = n2 * n2, a = n2 - 1.0, b = n2 + 1.0;
    float l = log((n - 1.0) / (n + 1.0));
    return 0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0)) + n2 * a * a / (b * b * b) * l
        - 2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / (b * (n4 - 1.0))
        + 8.0 * n4 * (n4 + 1.0) / (b * (n4 - 1.0) * (n4 - 1.0)) * log(n);
}
