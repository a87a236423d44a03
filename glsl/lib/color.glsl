// The sRGB value of a linear one, IEC 61966-2-1:1999.
// linear: [0, 1]
vec3 srgb_encode(vec3 linear) {
    vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

// E. Reinhard et al., "Photographic tone reproduction for digital images", SIGGRAPH 2002, eq. 3,
// on the luminance of ITU-R BT.709.
// L: exposed radiance, [0, inf)
vec3 tone_reinhard(vec3 L) {
    return L / (1.0 + max(dot(L, vec3(0.2126, 0.7152, 0.0722)), 0.0));
}

// K. Narkowicz, "ACES filmic tone mapping curve", 2016: a rational fit to the ACES output curve.
// L: exposed radiance; below 0 the curve would rise again, beyond 1e4 it is flat, its squares overflow
vec3 tone_aces(vec3 L) {
    L = clamp(L, 0.0, 1e4);
    return L * (2.51 * L + 0.03) / (L * (2.43 * L + 0.59) + 0.14);
}
