// The direction on the other side of the plane z = 0 that V is seen along, W. Snell, 1621, with V.z > 0.
// P. Heckbert, "Writing a ray tracer", 1989; (1 - e)(1 + e) + e^2 c^2 adds positive terms. w = 0: no
// such direction, total internal reflection.
// e: index on V's side over the other, [0.25, 4]
vec4 refracted(vec3 V, float e) {
    float k = (1.0 - e) * (1.0 + e) + e * e * V.z * V.z;
    return k < 0.0 ? vec4(0.0) : vec4(-e * V.xy, -sqrt(k), 1.0);
}
