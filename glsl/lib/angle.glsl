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

// The angle between two directions, from y: |cross product| and x: dot product, times anything positive.
// y: [0, inf); 0 if both are 0; [0, pi]
float angle_between(float y, float x) {
    float angle = angle_of(y, max(abs(x), 1e-37));
    return x < 0.0 ? 3.14159265 - angle : angle;
}

// The azimuth of the point (x, y), as atan(y, x) but 3 ulp.
// 0 if both are 0; [-pi, pi]
float azimuth(float y, float x) {
    float angle = angle_between(abs(y), x);
    return y < 0.0 ? -angle : angle;
}
