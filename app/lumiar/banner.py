"""What is said over the picture in the window: its time, its caption, a mistake, the keys."""

from imgui_bundle import imgui

DARK, _RED, _GREEN = (0.05, 0.06, 0.07), (0.42, 0.06, 0.06), (0.05, 0.28, 0.14)
FLAGS = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.no_inputs
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_nav
    | imgui.WindowFlags_.no_focus_on_appearing
    | imgui.WindowFlags_.always_auto_resize
)


def draw(area, time, caption, fault, done):
    """Write lines at the foot of a picture's area (left, width, height); those empty are left out.

    From below: time to the right, caption, fault in red, what was done in green.
    """
    left, width, height = area
    em = imgui.get_font_size()
    bottom, most = height - 0.6 * em, max(10.0 * em, width - 4.0 * em)
    box("time", time, DARK, 0.45, (left + width - 0.6 * em, bottom), (1.0, 1.0), most)
    for name, text, colour in (
        ("caption", caption, DARK),
        ("fault", fault, _RED),
        ("done", done, _GREEN),
    ):
        if text:
            room = most - 6.0 * em if name == "caption" else most
            high = box(name, text, colour, 0.85, (left + 0.6 * em, bottom), (0.0, 1.0), room)
            bottom -= high + 0.4 * em


def keys(area, lines):
    """Draw a table of (keys, what they do) in the middle of a picture's area, as large as fits.

    Where that is narrow, in the middle of the window.
    """
    left, width, height = area
    room, em = imgui.get_io().display_size.x, imgui.get_font_size()
    wide = sum(max(imgui.calc_text_size(line[i]).x for line in lines) for i in (0, 1)) + 4.0 * em
    high = len(lines) * (imgui.get_text_line_height() + 0.4 * em) + 2.0 * em
    if wide > width:
        left, width = 0.0, room
    imgui.set_next_window_pos((left + width / 2.0, height / 2.0), 0, (0.5, 0.5))
    imgui.set_next_window_bg_alpha(0.92)
    imgui.push_font(None, em * min(1.0, width / wide, height / high))
    imgui.begin("##keys", None, FLAGS)
    if imgui.begin_table("##lines", 2, imgui.TableFlags_.sizing_fixed_fit):
        for line in lines:
            imgui.table_next_row()
            for text in line:
                imgui.table_next_column()
                imgui.text(text)
        imgui.end_table()
    imgui.end()
    imgui.pop_font()


def ring(corner, pixel):
    """Mark a pixel of the picture, which begins at a pixel of the window."""
    scale = imgui.get_io().display_framebuffer_scale
    at = [begin + x + 0.5 for begin, x in zip(corner, pixel, strict=True)]
    place = (at[0] / scale.x, at[1] / scale.y)
    ink, radius = imgui.get_background_draw_list(), 0.5 * imgui.get_font_size()
    for colour, width in ((0xC0000000, 4.0), (0xFFFFFFFF, 2.0)):
        ink.add_circle(place, radius, colour, 0, width)


def box(name, text, colour, alpha, place, pivot, most):
    """Write a text in a box of its own, of which `place` is the share `pivot` (across, down).

    Returns the height of the box.
    """
    imgui.set_next_window_pos(place, 0, pivot)
    imgui.set_next_window_bg_alpha(alpha)
    imgui.push_style_color(imgui.Col_.window_bg, (*colour, 1.0))
    imgui.push_style_color(imgui.Col_.border, (0.0, 0.0, 0.0, 0.0))
    imgui.begin(f"##{name}", None, FLAGS)
    imgui.push_text_wrap_pos(most)
    imgui.text_unformatted(text)
    imgui.pop_text_wrap_pos()
    height = imgui.get_window_height()
    imgui.end()
    imgui.pop_style_color(2)
    return height
