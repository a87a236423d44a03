// The angle of the point (x, y) of the first quadrant, S. Moshier, Cephes atanf, 1992: 2 ulp, where a
// driver's atan and acos may be 4e-4 off (PHYSICS B.0).
// y, x: [0, inf), not both 0
float angle_of(float y, float x) {
    float low = min(x, y), high = max(x, y), t = low / high;
    bool wide = t > 0.41421356;  // tan(22.5 degrees)
    t = wide ? (low - high) / (low + high) : t;
    float z = t * t;
    float series = (((8.05374449e-2 * z - 0.138776856) * z + 0.199777106) * z - 0.333329491) * z;
    float angle = t + t * series + (wide ? 0.785398163 : 0.0);
    return y > x ? 1.57079633 - angle : angle;
}
