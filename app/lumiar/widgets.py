"""One parameter → one row of the panel: its symbol, name, value, unit, tooltip and reset."""

import math

from imgui_bundle import imgui

from . import labels
from .notation import angles, decoded, domain, encoded, shown, toward, unit
from .parameter import SIZES

_AXES = ((1.0, 0.55, 0.5, 1.0), (0.55, 0.9, 0.5, 1.0), (0.55, 0.7, 1.0, 1.0), (0.8, 0.8, 0.8, 1.0))
_COLORS = _AXES[:3]
_FAR, _FAR_INT = 1e30, 2**30 - 1  # what a bound that is open lets pass, and ImGui can slide to
_POLE = 89.99  # degrees that a ball can be turned up: straight up has no azimuth to come back to
_STEPS = 250.0  # pixels over which a dragged number crosses its range


def edit(one, value, words, note="", start=None, clock=None, opened=()):
    """Draw the row of a Parameter and return its value, another one if it was changed.

    start: what a value that was left out (None) begins with; clock: what draws the value of one
    that is the time of the scene; opened: (the value that the scene was opened with,), or nothing.
    """
    imgui.push_id(one.name)
    several = SIZES[one.type] > 1 and one.widget == "slider"
    ending = _unit(one, words) if several else ""
    ways, about = _ways(one, value, words, opened), lambda: _about(one, words, note)
    way = labels.row(one.name, words, one.text, about, ways, ending)
    if way in ("default", "opened"):
        value = one.default if way == "default" else opened[0]
    elif one.default is None:
        value = _optional(one, value, words, start)
    elif one.widget == "time":
        clock()
    else:
        value = _WIDGETS.get(one.widget, _numbers)(one, value, words)
    imgui.pop_id()
    return value


def _optional(one, value, words, start):
    avail = imgui.calc_item_width()
    here = imgui.get_cursor_pos_x()
    ticked, given = imgui.checkbox("##given", value is not None)
    imgui.same_line()
    if ticked:
        return one.check(start) if given else None
    if value is None:
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(_left_out(one, words))
        return None
    imgui.set_next_item_width(avail - (imgui.get_cursor_pos_x() - here))
    return _numbers(one, value, words)


def _numbers(one, value, words):
    """Draw a slider for a number, or a field to drag in for each component of a vector."""
    whole, size = one.type in ("int", "ivec2"), SIZES[one.type]
    ending = _unit(one, words).replace("%", "%%")
    ending = f" {ending}" if ending and ending != "°" else ending
    if size > 1:
        return _components(one, value, whole, _AXES)
    most = _FAR_INT if whole else _FAR
    low, high = max(-most, one.low), min(most, one.high)
    flags = imgui.SliderFlags_.logarithmic if one.logarithmic else 0
    if whole:
        ends = math.ceil(low), math.floor(high)
        changed, new = imgui.slider_int("##value", value, *ends, f"%d{ending}", flags)
        return new if changed else value
    changed, new = imgui.slider_float("##value", value, low, high, f"%.4g{ending}", flags)
    return _clean(new, value) if changed else value


def _components(one, value, whole, colors):
    gap = imgui.get_style().item_inner_spacing.x
    width = (imgui.calc_item_width() - gap * (len(value) - 1)) / len(value)
    most = _FAR_INT if whole else _FAR
    low = -most if one.open[0] else max(-most, one.low)
    high = most if one.open[1] else min(most, one.high)
    span = one.high - one.low if one.high - one.low < _FAR else 2.0
    new = list(value)
    for i, number in enumerate(value):
        if i:
            imgui.same_line(0.0, gap)
        imgui.set_next_item_width(width)
        if whole:
            changed, got = imgui.drag_int(f"##{i}", number, 1.0, int(low), int(high))
        else:
            speed = min(span / _STEPS, max(abs(number), 0.02 * span) / 100.0)
            changed, got = imgui.drag_float(f"##{i}", number, speed, low, high, "%.4g")
            got = _clean(got, number)
        if changed:
            new[i] = got
        corner, end = imgui.get_item_rect_min(), imgui.get_item_rect_max()
        ink = imgui.color_convert_float4_to_u32(colors[i])
        imgui.get_window_draw_list().add_rect_filled((corner.x, end.y - 2.0), end, ink)
    return tuple(new)


def _color(one, value, words):
    """Draw the colour as the screen shows it, and its linear numbers."""
    width, side = imgui.calc_item_width(), imgui.get_frame_height()
    flags = imgui.ColorEditFlags_.no_tooltip | imgui.ColorEditFlags_.no_alpha
    swatch = [encoded(channel) for channel in value]
    if imgui.color_button("##swatch", (*swatch, 1.0), flags, (side, side)):
        imgui.open_popup("picker")
    new = value
    if imgui.begin_popup("picker"):
        flags = imgui.ColorEditFlags_.display_hex | imgui.ColorEditFlags_.display_rgb
        changed, got = imgui.color_picker3("##picker", swatch, flags)
        if changed:
            pairs = zip(map(decoded, got), value, strict=True)
            new = tuple(_clean(channel, old, 2e-6) for channel, old in pairs)
        imgui.end_popup()
    imgui.same_line(0.0, imgui.get_style().item_inner_spacing.x)
    imgui.set_next_item_width(width - side - imgui.get_style().item_inner_spacing.x)
    typed = _components(one, value, False, _COLORS)
    return typed if typed != value else new


def _direction(one, value, words):
    """Draw a direction: its components, and a ball to turn it by, with its two angles."""
    here, width = imgui.get_cursor_pos_x(), imgui.calc_item_width()
    new = _components(one, value, False, _AXES)
    if new != value:
        return new if any(new) else value
    imgui.set_cursor_pos_x(here)
    side = 2.0 * imgui.get_frame_height_with_spacing() - imgui.get_style().item_spacing.y
    imgui.invisible_button("ball", (side, side))
    azimuth, elevation = angles(value)
    turned = False
    if imgui.is_item_active():
        moved = imgui.get_io().mouse_delta
        turned = bool(moved.x or moved.y)
        azimuth, elevation = azimuth + moved.x, max(-_POLE, min(_POLE, elevation - moved.y))
    _ball(value, side)
    imgui.same_line()
    imgui.begin_group()
    rest = width - side - imgui.get_style().item_spacing.x
    for name, limit in (("azimuth", 180.0), ("elevation", 90.0)):
        imgui.set_next_item_width(rest)
        before = azimuth if name == "azimuth" else elevation
        form = f"{words[name]} %.1f°"
        changed, got = imgui.slider_float(f"##{name}", before, -limit, limit, form)
        if changed and math.isfinite(got):
            turned = True
            azimuth, elevation = (got, elevation) if name == "azimuth" else (azimuth, got)
    imgui.end_group()
    return toward(azimuth, elevation, math.hypot(*value)) if turned else value


def _ball(direction, side):
    """Draw the ball that the last item is, lit from the direction, seen from +z."""
    ink, corner = imgui.get_window_draw_list(), imgui.get_item_rect_min()
    radius, length = 0.5 * side, math.hypot(*direction)
    middle = (corner.x + radius, corner.y + radius)
    x, y, z = (number / length for number in direction)
    color = imgui.color_convert_float4_to_u32
    ink.add_circle_filled(middle, radius - 1.0, color((0.2, 0.22, 0.26, 1.0)))
    if z > 0.0:
        for step in (0.8, 0.55, 0.3):
            at = (middle[0] + x * radius * (1 - step), middle[1] - y * radius * (1 - step))
            ink.add_circle_filled(at, radius * step, color((1.0, 0.9, 0.6, 0.22)))
    end = (middle[0] + 0.9 * x * radius, middle[1] - 0.9 * y * radius)
    ink.add_line(middle, end, color(labels.BRIGHT), 2.0)
    draw = ink.add_circle_filled if z >= 0.0 else ink.add_circle
    draw(end, 0.13 * radius + 1.0, color(labels.BRIGHT))
    ink.add_circle(middle, radius - 1.0, color(labels.DIM))


def _toggle(one, value, words):
    return imgui.checkbox("##value", value)[1]


def _choice(one, value, words):
    return labels.pick("value", value, one.choices)


_WIDGETS = {"color": _color, "direction": _direction, "toggle": _toggle, "choice": _choice}


def _clean(new, old, lost=1e-7):
    """Return a number that went through 32 bits as it was meant: `old`, or 7 digits.

    lost: the relative error with which it comes back.
    """
    same = math.isclose(new, old, rel_tol=lost, abs_tol=1e-37)
    return old if same else float(f"{new:.7g}")


def _ways(one, value, words, opened):
    """Return the ways to set a value back that would change it, as `labels.row` takes them."""
    if one.widget == "time":
        return ()
    back = [("default", one.default), *(("opened", before) for before in opened[:1])]
    if len(back) > 1 and back[1][1] == one.default:
        back.pop()
    return [(way, _said(one, words, before)) for way, before in back if before != value]


def _said(one, words, value):
    return _left_out(one, words) if value is None else shown(value)


def _unit(one, words):
    said = words["texts"].get(one.unit, one.unit)
    return unit("degrees" if one.degrees else said)


def _left_out(one, words):
    return words["off" if one.name in ("ev100", "temperature", "fit") else "auto"]


def _about(one, words, note):
    """Write what a Parameter is: its name, unit, text, domain and default; then the note."""
    ending = _unit(one, words)
    imgui.text(f"{one.name} [{ending}]" if ending else one.name)
    imgui.text(words["texts"].get(one.text, one.text))
    if domain(one):
        imgui.text_colored(labels.DIM, f"{words['allowed']}: {domain(one)}")
    imgui.text_colored(labels.DIM, f"{words['default']}: {_said(one, words, one.default)}")
    if not one.constant:
        imgui.text_colored(labels.DIM, words["typed"])
    if note:
        imgui.separator()
        imgui.text_colored(labels.DIM, note)
