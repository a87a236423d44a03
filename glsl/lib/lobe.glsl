// c^exponent for a cosine c, zero from a right angle on, as cheap as pow. Near the axis of a narrow lobe
// c has few digits left, and the driver's log of it none (73 % off at 1 - c = 6e-8, see PHYSICS B.0);
// so the gap is given too. log(c) = n log(2) + 2 artanh(t / (2 + t)), where c = 2^n (1 + t) and 1 + t
// lies between the roots of 1/2 and 2; four terms of the series are 1e-7 off at most.
// c: (-inf, 1]; gap: 1 - c, from a formula that does not cancel; exponent: [0, 1e6]
float cos_power(float c, float gap, float exponent) {
    int bits = floatBitsToInt(c), n = (bits - 0x3f3504f3) >> 23;  // the bits of sqrt(1/2)
    float t = n == 0 ? -gap : intBitsToFloat(bits - (n << 23)) - 1.0;
    float s = t / (2.0 + t), s2 = s * s;  // below: 2 / log(2) over 1, 3, 5, 7
    float log2_c = float(n) + s * (2.88539008 + s2 * (0.961796694 + s2 * (0.577078016 + s2 * 0.412198583)));
    return gap < 1.0 ? exp2(exponent * log2_c) : 0.0;
}
