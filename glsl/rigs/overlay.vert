// Widgets: positions in points from the top left corner, the sheet of letters, sRGB colours.
uniform vec4 rig_area;  // left, top, and 2 / width, 2 / height of what is covered

in vec2 rig_position;
in vec2 rig_uv;
in vec4 rig_color;

out vec2 rig_uv_f;
out vec4 rig_color_f;

void main() {
    vec2 place = (rig_position - rig_area.xy) * rig_area.zw;
    gl_Position = vec4(place.x - 1.0, 1.0 - place.y, 0.0, 1.0);
    rig_uv_f = rig_uv;
    rig_color_f = rig_color;
}
