// How far apart two finished pictures are: the largest difference of a pixel's channels of sRGB, in
// false colour.
uniform sampler2D rig_a;
uniform sampler2D rig_b;
uniform sampler2D rig_colors;  // from one end of the scale to the other, in a row
uniform vec2 rig_ends;         // of the scale

out vec4 rig_out;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 apart = abs(texelFetch(rig_a, pixel, 0).rgb - texelFetch(rig_b, pixel, 0).rgb);
    float largest = max(apart.r, max(apart.g, apart.b));
    float share = clamp((largest - rig_ends.x) / (rig_ends.y - rig_ends.x), 0.0, 1.0);
    int count = textureSize(rig_colors, 0).x;
    rig_out = texelFetch(rig_colors, ivec2(int(share * float(count - 1) + 0.5), 0), 0);
}
