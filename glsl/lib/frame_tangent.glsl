// The local frame of a surface with a direction of its own (brushed metal, fibres).
struct Frame {
    mat3 axes;  // columns T, B, N
};

// The frame of a normal and a tangent that need not be orthogonal (interpolation tilts both).
// N: unit; tangent: xyz along the texture's u, any length, w: the sign of B
Frame tangent_frame(vec3 N, vec4 tangent) {
    vec3 T = normalize(tangent.xyz - N * dot(N, tangent.xyz));
    return Frame(mat3(T, cross(N, T) * tangent.w, N));
}

// A direction turned into the frame, in which T, B, N are (1, 0, 0), (0, 1, 0), (0, 0, 1).
// w: unit, world space
vec3 to_local(vec3 w, Frame frame) {
    return w * frame.axes;
}

// A direction of the frame turned back into the world.
// w: unit, local
vec3 from_local(vec3 w, Frame frame) {
    return frame.axes * w;
}
