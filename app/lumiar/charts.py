"""The plots of the window, drawn by ImPlot: plain arrays (see `panels`) on a dark ground.

Angles in degrees, those in a plane negative on the light's side; f in 1/sr, weighted as luminance.
"""

import math
from typing import NamedTuple

import numpy as np
from imgui_bundle import imgui, implot

from . import facing
from .difference import LUMINANCE

COLOURS = (
    *((0.35, 0.7, 1.0), (1.0, 0.55, 0.25), (0.25, 0.85, 0.6), (0.95, 0.55, 0.8)),
    *((1.0, 0.85, 0.3), (0.75, 0.65, 1.0), (1.0, 1.0, 1.0)),
)
CHANNELS = (("R", (1.0, 0.4, 0.35)), ("G", (0.4, 0.85, 0.45)), ("B", (0.45, 0.65, 1.0)))
AMBER, WHITE, GREEN = (1.0, 0.8, 0.35), (1.0, 1.0, 1.0), (0.6, 0.9, 0.6)
DIM, FAINT = (0.62, 0.66, 0.72), (0.3, 0.32, 0.36)
EDGE = 1.32  # of a polar plot whose circle has radius 1
FIXED = implot.AxisFlags_.lock | implot.AxisFlags_.no_menus | implot.AxisFlags_.no_highlight
FLAGS = (
    implot.Flags_.no_title
    | implot.Flags_.no_menus
    | implot.Flags_.no_box_select
    | implot.Flags_.no_mouse_text
    | implot.Flags_.no_legend
)


class Mark(NamedTuple):
    """A direction w in the local frame: its letter, and its angle in the plane that is drawn."""

    letter: str
    w: tuple
    angle: float
    colour: tuple


class Charts:
    """What ImPlot needs in the current context of ImGui; release it.

    Every plot has a size (width, height) and shows (Curve or another, colour) pairs and Marks. What
    comes back is what stands below the mouse, for `tooltip`, or None.
    """

    def __init__(self):
        self._context = implot.create_context()
        style = implot.get_style()
        style.set_color_(implot.Col_.frame_bg.value, (0.0, 0.0, 0.0, 0.0))
        style.set_color_(implot.Col_.plot_bg.value, (0.05, 0.055, 0.065, 1.0))
        style.set_color_(implot.Col_.axis_grid.value, (*DIM, 0.35))

    def release(self):
        """Give it back."""
        implot.destroy_context(self._context)

    def polar(self, size, shown, scale, marks, value, _):
        """Draw Curves around the normal, on a Scale; value: f toward the V marked, or None."""
        if not implot.begin_plot("##polar", size, FLAGS | implot.Flags_.equal):
            return None
        most, em = _reach(shown), imgui.get_font_size()
        bare = FIXED | implot.AxisFlags_.no_decorations
        implot.setup_axes("", "", bare, bare)
        low = -0.16 if most == 90 else -EDGE
        implot.setup_axes_limits(-EDGE, EDGE, low, EDGE, implot.Cond_.always)
        implot.setup_finish()
        _rings(scale, most, em)
        for mark in marks:
            x, y = _toward(mark.angle)
            _line(f"##{mark.letter}", [0.0, 1.15 * x], [0.0, 1.15 * y], mark.colour, 2.0)
            _text(mark.letter, 1.23 * x, 1.23 * y, mark.colour)
        for i, (curve, colour) in enumerate(shown):
            turn, r = np.radians(curve.angles), scale.radius(curve.f @ LUMINANCE)
            _line(f"##{i}", r * np.sin(turn), r * np.cos(turn), colour, 3.0)
        if value is not None:
            radius = float(scale.radius(np.array([value]))[0])
            _dot(*(radius * way for way in _toward(marks[-1].angle)))
        read = None
        if implot.is_plot_hovered():
            place = implot.get_plot_mouse_pos()
            read = _read(shown, math.degrees(math.atan2(place.x, place.y)))
        implot.end_plot()
        return read

    def cartesian(self, size, shown, scale, marks, value, words):
        """Draw Curves against the angle of view; see `polar`."""
        if not implot.begin_plot("##curve", size, FLAGS):
            return None
        most = _reach(shown)
        wide = imgui.calc_text_size(words["view"]).x > 0.85 * size[0]
        title = words["plots"]["view"] if wide else words["view"]
        implot.setup_axes(title, words["f"], FIXED, FIXED)
        low, high = (scale.low, scale.high) if scale.log else (0.0, 1.02 * scale.high)
        if scale.log:
            implot.setup_axis_scale(implot.ImAxis_.y1.value, implot.Scale_.log10.value)
        implot.setup_axes_limits(-most, most, low, high, implot.Cond_.always)
        step = most // (3 if size[0] > 24.0 * imgui.get_font_size() else 2)
        _ticks(implot.ImAxis_.x1, {x: _degrees(x) for x in range(-most, most + 1, step)})
        _ticks(implot.ImAxis_.y1, {f: _short(f) for f in scale.ticks()})
        implot.setup_finish()
        for i, mark in enumerate(marks):
            _upright(mark, mark.angle, low, high, i)
        for i, (curve, colour) in enumerate(shown):
            f = curve.f @ LUMINANCE
            _line(f"##{i}", curve.angles, np.where(f > 0.0, f, np.nan) if scale.log else f, colour)
        if value is not None and (value > 0.0 or not scale.log):
            _dot(marks[-1].angle, value)
        read = None
        if implot.is_plot_hovered():
            read = _read(shown, implot.get_plot_mouse_pos().x)
        implot.end_plot()
        return read

    def shares(self, size, shown, marks, titles):
        """Draw Albedos against the angle of incidence; titles: of that angle, of the share.

        One alone is drawn in its channels, where they differ.
        """
        if not implot.begin_plot("##shares", size, FLAGS):
            return None
        lines = [line for one, colour in shown for line in _channels(one, colour, len(shown) == 1)]
        tops = [np.max(y, initial=0.0, where=np.isfinite(y)) for _, _, y, _, _ in lines]
        top = 1.05 * float(min(10.0, max(1.0, *tops, 1.0)))
        implot.setup_axes(*titles, FIXED, FIXED)
        implot.setup_axes_limits(0.0, 90.0, 0.0, top, implot.Cond_.always)
        step = 15 if size[0] > 24.0 * imgui.get_font_size() else 30
        _ticks(implot.ImAxis_.x1, {x: _degrees(x) for x in range(0, 91, step)})
        implot.setup_finish()
        _line("##one", [0.0, 90.0], [1.0, 1.0], DIM, 1.0)
        for i, mark in enumerate(marks):
            _upright(mark, abs(mark.angle), 0.0, top, i)
        for i, (_, x, y, error, colour) in enumerate(lines):
            spec = implot.Spec(fill_color=(*colour, 0.3), line_color=(*colour, 0.0))
            implot.plot_shaded(f"##error{i}", *_flat(x, y - error, y + error), spec=spec)
            _line(f"##{i}", x, y, colour, 3.0)
        read = None
        if implot.is_plot_hovered():
            angle = implot.get_plot_mouse_pos().x
            read = angle, [(name, c, _at(angle, x, y)) for name, x, y, _, c in lines]
        implot.end_plot()
        return read


def marks(aim, pixel):
    """Return the Marks of an Aim's L and R; of H and, last, V where a pixel's (L, V) is given."""
    L, V = pixel or (tuple(map(float, aim.L)), None)
    found = [("L", L, AMBER), ("R", (-L[0], -L[1], L[2]), DIM)]
    if V:
        found += [("H", facing.halfway(L, V), GREEN), ("V", V, WHITE)]
    return [Mark(letter, w, aim.angle(w)[0], colour) for letter, w, colour in found]


def facet_marks(pixel, smooth):
    """Return the Mark of the angle at which a facet, or a smooth surface, mirrors at a pixel."""
    if not pixel:
        return []
    L, V = pixel
    H = facing.halfway(L, V)
    if smooth:
        return [Mark("θᵥ", V, facing.theta(V), WHITE)]
    return [Mark("L·H", H, facing.between(L, H), GREEN)]


def tooltip(angle, values, unit):
    """Say at the mouse what curves have there: values are (name, colour, value or None)."""
    if imgui.begin_tooltip():
        imgui.text(f"{angle:.1f}°")
        for name, colour, value in values:
            if value is not None:
                imgui.text_colored((*colour, 1.0), f"{name}  {value:.4g}{unit}")
        imgui.end_tooltip()


def _reach(shown):
    """Return 90, or 180 where a curve has both sides of the surface."""
    widest = max((np.abs(curve.angles).max() for curve, _ in shown), default=0.0)
    return 180 if widest > 90.5 else 90


def _channels(one, colour, alone):
    """Return (name, angles, values, error, colour) of each line of an Albedo."""
    if alone and len(one.values) and np.ptp(one.values, axis=1).max() > 1e-3:
        lines = ((name, one.values[:, k], colour) for k, (name, colour) in enumerate(CHANNELS))
    else:
        lines = ((one.label, one.values @ LUMINANCE, colour),)
    return [(name, one.angles, y.astype(float), one.error, colour) for name, y, colour in lines]


def _rings(scale, most, em):
    """Draw the grid of a polar plot: a ring for each value marked, a spoke every 30 degrees."""
    ticks = scale.ticks()[1:]
    radii = scale.radius(np.array(ticks))
    turn = np.append(np.radians(np.linspace(-most, most, 91)), np.nan)
    _line("##rings", np.outer(radii, np.sin(turn)), np.outer(radii, np.cos(turn)), FAINT, 1.0)
    spokes = range(-150, 181, 30) if most > 90 else range(-90, 91, 30)
    ways, out = np.radians(spokes), np.array([0.0, 1.0, np.nan])
    _line("##spokes", np.outer(np.sin(ways), out), np.outer(np.cos(ways), out), FAINT, 1.0)
    for angle in spokes:
        x, y = _toward(angle)
        _text(_degrees(angle), 1.08 * x, 1.08 * y, DIM)
    right = 2.0  # where the label outside begins
    for value, r in reversed([*zip(ticks, radii, strict=True)]):
        half = 0.5 * imgui.calc_text_size(_short(value)).x + 0.3 * em
        half *= 2.0 * EDGE / implot.get_plot_size().x
        if r + half < right:
            _text(_short(value), r, 0.0, DIM, (0.0, 0.75 * em))
            right = r - half


def _toward(angle):
    return math.sin(math.radians(angle)), math.cos(math.radians(angle))


def _flat(*arrays):
    return [np.ascontiguousarray(array, np.float64).ravel() for array in arrays]


def _line(name, x, y, colour, width=2.5):
    x, y = _flat(x, y)
    width *= imgui.get_font_size() / 15.0
    spec = implot.Spec(line_color=(*colour, 1.0), line_weight=width)
    implot.plot_line(name, x, np.where(np.isfinite(y), y, np.nan), spec=spec)


def _upright(mark, x, low, high, row):
    """Draw a line from the foot of a plot to its head, and a Mark's letter there, in its row."""
    em = imgui.get_font_size()
    _line(f"##{mark.letter}", [x, x], [low, high], mark.colour, 1.5)
    _text(
        mark.letter, x, high, mark.colour, (0.3 * em + 0.3 * em * len(mark.letter), em * (1 + row))
    )


def _dot(x, y):
    size = imgui.get_font_size()
    spec = implot.Spec(marker=implot.Marker_.circle.value, marker_size=0.35 * size)
    spec.marker_fill_color, spec.marker_line_color = (*WHITE, 1.0), (0.0, 0.0, 0.0, 1.0)
    implot.plot_scatter("##dot", *_flat([x], [y]), spec=spec)


def _text(text, x, y, colour, offset=(0.0, 0.0)):
    implot.push_style_color(implot.Col_.inlay_text.value, (*colour, 1.0))
    implot.plot_text(text, x, y, offset)
    implot.pop_style_color()


def _ticks(axis, said):
    implot.setup_axis_ticks(axis.value, [*map(float, said)], [*said.values()])


def _degrees(angle):
    return f"{angle}°".replace("-", "−")


def _short(x):
    """Return a number as one reads it: 0.25, 10, 1e-4."""
    text = f"{x:.3g}"
    return f"{x:.0e}".replace("e-0", "e-").replace("e+0", "e") if "e" in text else text


def _at(x, xs, ys):
    """Return the value of a curve at x, None beyond its ends."""
    return float(np.interp(x, xs, ys)) if len(xs) and xs[0] <= x <= xs[-1] else None


def _read(shown, angle):
    """Return (angle, [(label, colour, f)]) of Curves at an angle of view."""
    return angle, [(c.label, colour, _at(angle, c.angles, c.f @ LUMINANCE)) for c, colour in shown]
