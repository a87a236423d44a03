// One of several passes over the same picture, to be added to the others.
uniform sampler2D rig_radiance;
uniform float rig_share;  // one over the number of passes

out vec4 rig_out;

void main() {
    rig_out = texelFetch(rig_radiance, ivec2(gl_FragCoord.xy), 0) * rig_share;
}
