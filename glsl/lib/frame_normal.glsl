// The local frame of a surface that has a normal only; the turn about N is arbitrary.
struct Frame {
    vec3 N;
};

// A direction turned into the frame, in which N is (0, 0, 1).
// T. Duff et al., "Building an orthonormal basis, revisited", Journal of Computer Graphics
// Techniques 6(1), 2017, with the basis multiplied out: half the operations of a 3x3 matrix.
// w: unit, world space; frame.N: unit, world space
vec3 to_local(vec3 w, Frame frame) {
    vec3 N = frame.N;
    float side = N.z < 0.0 ? -1.0 : 1.0;
    float along = dot(N.xy, w.xy);
    float k = along * (-1.0 / (side + N.z)) - w.z;  // the quotient is the same for every w
    return vec3(w.x + side * N.x * k, side * w.y + N.y * k, along + N.z * w.z);
}

// A direction of the frame turned back into the world: the transpose of `to_local`.
// w: unit, local; frame.N: unit, world space
vec3 from_local(vec3 w, Frame frame) {
    vec3 N = frame.N;
    float side = N.z < 0.0 ? -1.0 : 1.0, k = -1.0 / (side + N.z), b = N.x * N.y * k;
    vec3 T = vec3(1.0 + side * N.x * N.x * k, side * b, -side * N.x);
    vec3 B = vec3(b, side + N.y * N.y * k, -N.y);
    return T * w.x + B * w.y + N * w.z;
}
