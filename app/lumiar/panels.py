"""The panels of a picture of measurements: each draws plain arrays on axes that it is given.

Angles in degrees, theta from the normal, those in the plane of incidence negative on the light's
side; f in 1/sr. The colours are those of M. Okabe and K. Ito, "Color universal design", 2008, which
all eyes tell apart.
"""

import math
from typing import NamedTuple

import numpy as np

from .difference import LUMINANCE

INK, GREY = "#18181c", "#8a8a90"
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
STYLES = ("-", "--", "-.", ":")
MARKERS = "os^Dv"
CHANNELS = (("R", "#d55e00", "-"), ("G", "#009e73", "--"), ("B", "#0072b2", ":"))
STEEP, DECADES = 30.0, 5.0  # peak over median from which a scale is logarithmic; its length


class Curve(NamedTuple):
    """f (n, 3) of a model, named by label, in the plane of incidence of a light [degrees]."""

    label: str
    light: float
    angles: np.ndarray
    f: np.ndarray


class Albedo(NamedTuple):
    """Albedo (k, 3) and its error (k,) for light from angles (k,); surround: from a furnace."""

    label: str
    angles: np.ndarray
    values: np.ndarray
    error: np.ndarray
    surround: bool = False


class Lobe(NamedTuple):
    """f (a, b, 3) over theta (a,) and phi (b,) for a light at azimuth 0."""

    label: str
    light: float
    theta: np.ndarray
    phi: np.ndarray
    f: np.ndarray


class Look(NamedTuple):
    """How a Curve is drawn; style is that of a line, or the marker of points."""

    curve: Curve
    colour: str
    style: str
    points: bool
    width: float = 2.5


class Scale(NamedTuple):
    """How f becomes a radius between 0 and 1."""

    log: bool
    low: float
    high: float

    def radius(self, f):
        """Return the radius, 0 to 1, of values f."""
        with np.errstate(divide="ignore", invalid="ignore"):
            if self.log:
                f = np.log10(f / self.low) / math.log10(self.high / self.low)
                return np.where(np.isnan(f), np.nan, np.maximum(f, 0.0))
            return np.asarray(f) / self.high

    def ticks(self):
        """Return the values of f to mark."""
        if not self.log:
            return [self.high * i / 4.0 for i in range(5)]
        decades = round(math.log10(self.high / self.low))
        return [self.low * 10.0**i for i in range(0, decades + 1, 1 + decades // 6)]


def scale(curves, log=None):
    """Return the Scale that suits Curves or Lobes: logarithmic where a peak towers above the rest.

    log says so instead, unless it is None.
    """
    every = np.concatenate([(c.f @ LUMINANCE).ravel() for c in curves] or [np.zeros(1)])
    every = every[np.isfinite(every) & (every > 0.0)]
    if not len(every):
        return Scale(False, 0.0, 1.0)
    peak, middle = every.max(), np.median(every)
    if not (peak >= STEEP * middle if log is None else log):
        digit = 10.0 ** math.floor(math.log10(peak))
        nice = next(m for m in (1.0, 1.2, 1.6, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0) if m * digit >= peak)
        return Scale(False, 0.0, nice * digit)
    high = 10.0 ** math.ceil(math.log10(peak))
    low = max(10.0 ** math.floor(math.log10(middle / 3)), high / 10**DECADES)
    return Scale(True, min(low, high / 10.0), high)


def looks(labels, curves, points=()):
    """Return the Look of every curve, then of the points: coloured by model, or one's by light.

    labels are those of all models, in the order of their colours.
    """
    lights = [*dict.fromkeys(c.light for c in (*curves, *points))]
    files = [*dict.fromkeys(c.label for c in points)]
    alone, found = len(labels) == 1, []
    for curve in curves:
        k = lights.index(curve.light) if alone else labels.index(curve.label)
        style = "-" if alone else STYLES[lights.index(curve.light) % len(STYLES)]
        width = 2.5 if alone else 2.5 + 1.2 * (len(labels) - 1 - k)  # what is beneath peeks out
        found.append(Look(curve, COLOURS[k % len(COLOURS)], style, False, width))
    for curve in points:
        ours = [k for k, label in enumerate(labels) if curve.label.endswith(f": {label}")]
        k = lights.index(curve.light) if alone else ours[0] if ours else -1
        marker = MARKERS[files.index(curve.label) % len(MARKERS)]
        found.append(Look(curve, COLOURS[k % len(COLOURS)], marker, True))
    return found


def _draw(axes, x, y, look, most=90):
    if look.points:
        some = slice(None, None, -(-len(x) // most))
        style = {"ms": 7 if most > 50 else 5, "mfc": "none", "mec": look.colour, "mew": 1.4}
        axes.plot(x[some], y[some], look.style, **style)
    else:
        axes.plot(x, y, look.style, color=look.colour, lw=look.width)


def polar(axes, look, scale, words):
    """Draw lobes in the plane of incidence; look as `looks` returns it.

    Half a circle is given twice its height, as the axes leave room for the other half.
    """
    full = _reach(look) > 90.5
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    log = words["log"] if scale.log else ""
    box = _title(axes, f"{words['plane']}: {words['polar']}{log}")
    if not full:
        axes.set_thetalim(-math.pi / 2, math.pi / 2)
        axes.set_position([box.x0, box.y0 - 0.42 * box.height, box.width, 1.7 * box.height])
    else:
        axes.set_position([box.x0, box.y0 - 0.06 * box.height, box.width, 0.96 * box.height])
    for one in look:
        f = one.curve.f @ LUMINANCE
        _draw(axes, np.radians(one.curve.angles), scale.radius(f), one, 45)
    lines = [one for one in look if not one.points]
    alone = len({one.curve.label for one in lines}) == 1
    for light, colour in {one.curve.light: one.colour for one in lines}.items():
        arrow = {"arrowstyle": "-|>", "color": colour if alone else GREY, "lw": 2, "ls": ":"}
        at = math.radians(-light)
        axes.annotate("", (at, 0.03), (at, 1.0), arrowprops=arrow, annotation_clip=False)
    axes.set_ylim(0.0, 1.0)
    ticks = scale.ticks()[1:]
    axes.set_yticks(scale.radius(np.array(ticks)), [_short(t) for t in ticks], fontsize=11)
    axes.set_rlabel_position(225 if full else 90)
    marks = range(-150, 181, 30) if full else range(-90, 91, 30)
    turns = [math.radians(t % 360 if full else t) for t in marks]
    axes.set_xticks(turns, [f"{t}°" for t in marks])


def _title(axes, text):
    """Write a title above the place of a panel, and return that place; its axes may then move."""
    box = axes.get_position(original=True)
    x, y = (box.x0 + box.x1) / 2.0, box.y1 + 0.012
    axes.figure.text(x, y, text, ha="center", size=18)
    return box


def _reach(look):
    return max((np.nanmax(np.abs(one.curve.angles), initial=0.0) for one in look), default=0.0)


def cartesian(axes, look, scale, words):
    """Draw f against the angle of view; look as `looks` returns it."""
    for one in look:
        f = one.curve.f @ LUMINANCE
        _draw(axes, one.curve.angles, np.where(f > 0.0, f, np.nan) if scale.log else f, one)
    if scale.log:
        axes.set_yscale("log")
        axes.set_ylim(scale.low, scale.high)
        axes.set_yticks(scale.ticks(), [_short(t) for t in scale.ticks()])
        axes.minorticks_off()
    else:
        axes.set_ylim(0.0, scale.high * 1.02)
    limit = 180 if _reach(look) > 90.5 else 90
    axes.set_xlim(-limit, limit)
    axes.set_xticks(range(-limit, limit + 1, limit // 3))
    if not any((one.curve.f > 0.0).any() for one in look):
        axes.text(0.5, 0.5, words["black"], transform=axes.transAxes, ha="center", va="center")
    axes.set(xlabel=words["view"], ylabel=words["f"], title=words["curve"])


def albedo(axes, albedos, words):
    """Draw directional albedo against the angle of incidence, with its error."""
    top, worst, one = 1.0, 0.0, len({a.label for a in albedos}) == 1
    labels = [*dict.fromkeys(a.label for a in albedos)]
    for curve in albedos:
        values, error = curve.values, curve.error
        grey = np.ptp(values, axis=1).max() < 1e-3 * max(values.max(), 1e-9)
        channels = [(values @ LUMINANCE, COLOURS[labels.index(curve.label) % 7], "-", None)]
        if one and not grey:
            channels = [(values[:, i], c, s, name) for i, (name, c, s) in enumerate(CHANNELS)]
        for value, colour, style, name in channels:
            style = (0, (1, 1)) if curve.surround and not name else style
            axes.plot(curve.angles, value, color=colour, ls=style, label=name)
            axes.fill_between(curve.angles, value - error, value + error, color=colour, alpha=0.25)
            top = max(top, np.nanmax(value, initial=0.0, where=np.isfinite(value)))
        worst = max(worst, np.nanmax(error, initial=0.0))
        if one and not grey:
            axes.legend(loc="lower left", ncols=3, framealpha=0.8)
    axes.axhline(1.0, color=INK, lw=1.2, ls=(0, (6, 3)))
    axes.set_xlim(0, 90)
    axes.set_ylim(0.0, 1.05 * min(top, 10.0))
    axes.set_xticks(range(0, 91, 15))
    axes.set(xlabel=words["incidence"], ylabel=words["share"], title=words["albedo"])
    said = [words["error"].format(worst)] if worst else []
    if any(a.surround for a in albedos):
        said.append(words["mirror"].format("" if one else words["dotted"]))
    axes.text(0.5, -0.26, "; ".join(said), transform=axes.transAxes, ha="center", fontsize=12)


def reflectance(axes, reflectances, words):
    """Draw Fresnel reflectances, Albedos without an error, against the angle on the facet."""
    one, top = len(reflectances) == 1, 1.0
    for i, curve in enumerate(reflectances):
        channels = [(curve.values @ LUMINANCE, COLOURS[i % len(COLOURS)], "-", curve.label)]
        if one and np.ptp(curve.values, axis=1).max() > 1e-3:
            channels = [(curve.values[:, k], c, s, name) for k, (name, c, s) in enumerate(CHANNELS)]
        for value, colour, style, name in channels:
            axes.plot(curve.angles, value, color=colour, ls=style, label=name)
            top = max(top, np.nanmax(value, initial=0.0, where=np.isfinite(value)))
    axes.legend(loc="upper left")
    axes.set(xlim=(0, 90), ylim=(0.0, 1.05 * min(top, 10.0)), xticks=range(0, 91, 15))
    words = words["plots"]
    axes.set(xlabel=words["facet"], ylabel=words["reflected"], title=words["tabs"]["fresnel"])


def lobes(axes, lobes, size, labels, words):
    """Draw lobes of one light over each other, in 3-D; size is a Scale, labels as in `looks`."""
    from matplotlib.colors import LightSource

    lamp = LightSource(azdeg=205, altdeg=-50)  # from behind: the faces are wound that way
    full = max(one.theta.max() for one in lobes) > 90.5
    log = words["log"] if size.log else ""
    box = _title(axes, words["lobe"].format(lobes[0].light) + log)
    w, h = box.width, box.height
    axes.set_position([box.x0 - 0.1 * w, box.y0 - (0.55 if full else 0.45) * h, 1.2 * w, 1.8 * h])
    for one in lobes:
        r = np.nan_to_num(size.radius(one.f @ LUMINANCE), posinf=1.0)
        theta, phi = np.meshgrid(np.radians(one.theta), np.radians(one.phi), indexing="ij")
        x, y = r * np.sin(theta) * np.cos(phi), r * np.sin(theta) * np.sin(phi)
        colour = COLOURS[labels.index(one.label) % len(COLOURS)]
        look = {"color": colour, "alpha": 1.0 if len(lobes) == 1 else 0.6, "lightsource": lamp}
        axes.plot_surface(x, y, r * np.cos(theta), rcount=200, ccount=200, lw=0, **look)
    turn, at = np.linspace(0.0, 2.0 * math.pi, 90), math.radians(lobes[0].light)
    axes.plot(np.cos(turn), np.sin(turn), 0.0 * turn, color=GREY, lw=1.2)
    axes.plot([-1, 1], [0, 0], [0, 0], color=GREY, lw=1.2)
    x, z = math.sin(at), math.cos(at)
    axes.quiver(x, 0, z, -0.93 * x, 0, -0.93 * z, color=INK, lw=2.5, arrow_length_ratio=0.12)
    axes.plot([0, 0], [0, 0], [0, 1], color=GREY, lw=1.2, ls="--")
    axes.text(0, 0, 1.05, "N", ha="center")
    axes.text(1.08 * x, 0, 1.08 * z, "L", ha="center")
    axes.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1 if full else 0, 1))
    axes.set_box_aspect((1, 1, 1.0 if full else 0.5), zoom=1.05 if full else 1.4)
    axes.view_init(18, 65)
    axes.set_axis_off()
    axes.patch.set_visible(False)
    for line in axes.lines:
        line.set_clip_on(False)


def _short(x):
    """Return a number as one reads it: 0.25, 10, 1e-4."""
    text = f"{x:.3g}"
    return f"{x:.0e}".replace("e-0", "e-").replace("e+0", "e") if "e" in text else text
