// cos(angle)^exponent, zero beyond a right angle, from the square of the tangent of half the angle:
// log(cos) = -2 artanh(z), whose series keeps near the axis of a narrow lobe the digits that cos and
// the driver's log do not (73 % off at 1 - cos = 6e-8, see PHYSICS B.0). The series is 1e-7 off at
// z = 0.18, cos = 0.7; beyond, a plain log does.
// z: tan^2(angle / 2), [0, inf); exponent: [0, 1e6]
float cos_power(float z, float exponent) {
    float z2 = z * z;
    float near = -2.0 * z * (1.0 + z2 * (1.0 / 3.0 + z2 * (0.2 + z2 * (1.0 / 7.0))));
    float log_cos = z < 0.18 ? near : log((1.0 - z) / (1.0 + z));
    return z < 1.0 ? exp(exponent * log_cos) : 0.0;
}
