"""What stands over several pictures in the window: captions, the line between two, a legend."""

import os

from imgui_bundle import imgui

from . import banner, phrases
from .comparing import TEXT
from .picture import in_language

_LINE, _EDGE = (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 0.75)
_STRIPS = 96  # of one colour each, in the bar of a scale
_BARE = (
    imgui.WindowFlags_.no_decoration
    | imgui.WindowFlags_.no_background
    | imgui.WindowFlags_.no_saved_settings
    | imgui.WindowFlags_.no_nav
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_focus_on_appearing
)


def caption(document, lang):
    """Return the line below the pictures of a Document: its page, what is on it, not saved."""
    stop, said = document.stop, in_language(document.caption, lang)
    at = (stop.number, stop.steps) if stop else (document.page + 1, len(document.pages))
    page = phrases.TEXT[lang]["page"].format(*at) if at[1] > 1 else ""
    edited = [path for path in document.files if path in document.texts.drafts]
    names = ", ".join(os.path.basename(path) for path in edited)
    unsaved = phrases.TEXT[lang]["editor"]["edited"].format(names) if edited else ""
    return "   ".join(filter(None, (page, said, unsaved)))


def draw(stage, captions, left, points, lang):
    """Write over the pictures of a Stage what they are, and let the line between two be dragged.

    captions  of each picture; left: where they begin, in pixels; points: imgui's in a pixel
    """
    if stage.mode == "split":
        _split(stage, captions, left, points)
    elif stage.mode == "difference":
        _legend(stage, captions, left, points, TEXT[lang]["difference"])
    elif stage.mode == "grid":
        for i, (text, place) in enumerate(zip(captions, stage.places, strict=True)):
            x, y, wide, high = (points * one for one in place)
            _caption(i, text, (left * points + x + 0.5 * wide, y), 0.5, wide, high)


def _caption(index, text, place, pivot, width, height, typical=0.0):
    """Write what a picture is at its upper edge, in letters that suit its size.

    typical: its width where it changes all the time.
    """
    if not text:
        return
    base = imgui.get_style().font_size_base
    imgui.push_font(None, max(base, min(height / 17.0, (typical or width) / 17.0, 1.9 * base)))
    gap = 0.4 * imgui.get_font_size() * (1.0 - 2.0 * pivot)
    most = max(4.0 * imgui.get_font_size(), width - 2.0 * imgui.get_font_size())
    banner.box(
        f"picture {index}",
        text,
        banner.DARK,
        0.85,
        (place[0] + gap, place[1] + 6.0),
        (pivot, 0.0),
        most,
    )
    imgui.pop_font()


def _split(stage, captions, left, points):
    """Draw the line between two pictures, and move it with the mouse."""
    _, _, width, height = (points * one for one in stage.places[0])
    start, grab = left * points, 0.7 * imgui.get_font_size()
    x = start + stage.share * width
    for i, (begin, end) in enumerate(((start, x), (x, start + width))):
        if end - begin > 6.0 * grab:
            edge = end if i else begin
            _caption(i, captions[i], (edge, 0.0), float(i), end - begin, height, 0.5 * width)
    imgui.set_next_window_pos((x - grab, 0.0))
    imgui.set_next_window_size((2.0 * grab, height))
    imgui.push_style_var(imgui.StyleVar_.window_padding, (0.0, 0.0))
    imgui.push_style_var(imgui.StyleVar_.window_min_size, (1.0, 1.0))
    imgui.begin("##line", None, _BARE)
    imgui.invisible_button("line", (2.0 * grab, max(1.0, height)))
    held, near = imgui.is_item_active(), imgui.is_item_hovered()
    if held or near:
        imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ew)
    if held and width > 0.0:
        stage.slide((imgui.get_io().mouse_pos.x - start) / width - stage.share)
    _line(x, height, grab, held or near)
    imgui.end()
    imgui.pop_style_var(2)


def _line(x, height, grab, bright):
    ink, color = imgui.get_window_draw_list(), imgui.color_convert_float4_to_u32
    light, dark = color(_LINE), color(_EDGE)
    ink.add_line((x, 0.0), (x, height), dark, 5.0)
    ink.add_line((x, 0.0), (x, height), light, 2.0)
    middle, radius = (x, 0.5 * height), 0.95 * grab
    ink.add_circle_filled(middle, radius + 1.5, dark)
    ink.add_circle_filled(middle, radius, color(_LINE if bright else (0.85, 0.87, 0.9, 1.0)))
    for side in (-1.0, 1.0):
        tip = (x + side * 0.7 * radius, middle[1])
        feet = (
            (x + side * 0.22 * radius, middle[1] - 0.4 * radius),
            (
                x + side * 0.22 * radius,
                middle[1] + 0.4 * radius,
            ),
        )
        ink.add_triangle_filled(tip, *feet, dark)


def _legend(stage, captions, left, points, words):
    """Draw the scale of a difference, what is compared, and its numbers."""
    _, _, width, _ = (points * one for one in stage.places[0])
    one, base = stage.deviation, imgui.get_style().font_size_base
    imgui.set_next_window_pos((left * points + 0.6 * base, 6.0))
    imgui.set_next_window_bg_alpha(0.85)
    imgui.push_style_color(imgui.Col_.window_bg, (*banner.DARK, 1.0))
    imgui.begin("##legend", None, banner.FLAGS)
    imgui.push_font(None, 1.2 * base)
    wide = max(10.0 * base, min(30.0 * base, width - 3.0 * base))
    imgui.push_text_wrap_pos(wide)
    for text in filter(None, captions):
        imgui.text_unformatted(text)
    imgui.pop_font()
    imgui.text_unformatted(words["title"])
    _bar(one.ruler, one.colours(_STRIPS), wide)
    imgui.push_font(None, 1.2 * base)
    imgui.text_unformatted(numbers(one, words))
    imgui.pop_font()
    imgui.pop_text_wrap_pos()
    imgui.end()
    imgui.pop_style_color()


def numbers(one, words):
    """Return the line of the numbers of a Deviation."""
    if one.numbers is None:
        return "RMS …"
    flip = "…" if one.busy else words["unknown"] if one.flip is None else f"{one.flip:.4f}"
    found = one.numbers
    line = f"RMS {found['rmse']:.4f}    {words['largest']} {found['max']:.3f}    FLIP {flip}"
    return words["alike"] if not found["max"] else line


def _bar(ruler, colours, width):
    """Draw the colours of a scale from left to right, with its marks below."""
    ink, em = imgui.get_window_draw_list(), imgui.get_font_size()
    color, ticks = imgui.color_convert_float4_to_u32, ruler.ticks()
    ends = [0.5 * imgui.calc_text_size(label).x for _, label in (ticks[0], ticks[-1])]
    x, y = imgui.get_cursor_screen_pos()
    x, long = x + ends[0], max(1.0, width - sum(ends) - em)
    for i in range(_STRIPS):
        red, green, blue = (part / 255.0 for part in colours[3 * i : 3 * i + 3])
        begin, end = (round(x + long * k / _STRIPS) for k in (i, i + 1))  # no seam between two
        ink.add_rect_filled((begin, y), (end, y + 0.9 * em), color((red, green, blue, 1.0)))
    free, text = x - em, imgui.get_color_u32(imgui.Col_.text)
    for share, label in ticks:
        at, half = x + share * long, 0.5 * imgui.calc_text_size(label).x
        ink.add_line((at, y + 0.9 * em), (at, y + (1.25 if label else 1.1) * em), text)
        if label and at - half > free:
            ink.add_text((at - half, y + 1.25 * em), text, label)
            free = at + half + 0.4 * em
    imgui.dummy((width, 2.4 * em))
