// Widgets over a picture: letters and shapes, blended.
uniform sampler2D rig_letters;

in vec2 rig_uv_f;
in vec4 rig_color_f;

out vec4 rig_out;

void main() {
    rig_out = rig_color_f * texture(rig_letters, rig_uv_f);
}
