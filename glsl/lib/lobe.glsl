// log(1 - e) by the series of -2 artanh(e / (2 - e)), which keeps its digits where e is small and
// the driver's log does not (73 % off at e = 6e-8, see PHYSICS B.0); at most 2 ulp off for e < 0.3.
// e: [0, 1)
float log_one_minus(float e) {
    float z = e / (2.0 - e), z2 = z * z;
    float series = -2.0 * z * (1.0 + z2 * (1.0 / 3.0 + z2 * (0.2 + z2 * (1.0 / 7.0))));
    return e < 0.3 ? series : log(1.0 - e);
}

// cos(angle)^exponent, zero beyond a right angle. Takes the versine because 1 - cos, formed without
// subtracting, holds the digits that cos has lost near the axis of a narrow lobe.
// versine: 1 - cos(angle), [0, 2]; exponent: [0, 1e6]
float cos_power(float versine, float exponent) {
    return versine < 1.0 ? exp(exponent * log_one_minus(versine)) : 0.0;
}
