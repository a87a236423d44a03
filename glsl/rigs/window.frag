// A finished picture, its top row first, pixel by pixel into a window, whose top row is the last.
uniform sampler2D rig_picture;
uniform ivec2 rig_corner;  // where in the window it begins, from the lower left

out vec4 rig_out;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) - rig_corner;
    pixel.y = textureSize(rig_picture, 0).y - 1 - pixel.y;
    rig_out = vec4(texelFetch(rig_picture, pixel, 0).rgb, 1.0);
}
