// e^x - 1 near 0, S. Moshier, Cephes expf, 1992.
// x: [-0.5, 0.5]
float exponential_series(float x) {
    float high = (1.9875691500e-4 * x + 1.3981999507e-3) * x + 8.3334519073e-3;
    return x + x * x * (((high * x + 4.1665795894e-2) * x + 1.6666665459e-1) * x + 5.0000001201e-1);
}

// e^x to 1.3 ulp, where a driver's exp may be 63 ulp off (PHYSICS B.0).
// x: [-104, 88.7], cut to that; below -87 drivers may return 0
float exponential(float x) {
    x = clamp(x, -104.0, 88.72);
    float n = floor(x * 1.44269504 + 0.5);
    float rest = x - n * 0.693359375 + n * 2.12194440e-4;  // log(2) in two parts
    int low = int(n) / 2, high = int(n) - low;             // 2^n alone may be out of range
    float scale = intBitsToFloat((low + 127) << 23) * intBitsToFloat((high + 127) << 23);
    return (1.0 + exponential_series(rest)) * scale;
}

// e^x - 1 to 2.1 ulp, where exp(x) - 1 has no digits left near 0.
// x: as above
float exponential_minus_one(float x) {
    return abs(x) < 0.5 ? exponential_series(x) : exponential(x) - 1.0;
}
