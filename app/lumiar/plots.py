"""Whole pictures of measurements: four panels of one or more models, or one model's data sheet.

Every function takes plain arrays (see `panels` for their units) and returns the bytes of a file.
"""

import io
import logging
import os
import textwrap
import warnings
from typing import NamedTuple

import numpy as np

from . import panels
from .captions import TEXT
from .errors import one_line
from .files import ASSETS, cache_folder
from .panels import Albedo, Curve, Lobe

__all__ = ["ENDINGS", "Albedo", "Curve", "Lobe", "Sheet", "data_sheet", "drawn", "measurement"]
ENDINGS = (".png", ".svg", ".pdf")
STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 15,
    "axes.titlesize": 18,
    "text.parse_math": False,  # a name may hold any sign
    "text.color": panels.INK,
    "axes.edgecolor": panels.GREY,
    "axes.grid": True,
    "grid.color": "#dcdce0",
    "lines.linewidth": 2.5,
    "svg.hashsalt": "lumiar",
    "figure.facecolor": "#fafaf7",
    "axes.facecolor": "#fafaf7",
}


class Sheet(NamedTuple):
    """What a data sheet tells of one model.

    claims   (property, "yes" or "no" as claimed, what was found, whether the two agree) each
    curves   Curves, albedo an Albedo; numbers (label, value) texts
    """

    title: str
    paper: str
    claims: tuple
    curves: tuple
    albedo: Albedo
    numbers: tuple


def measurement(title, subtitle, curves, points, albedos, lobes, lang, ending):
    """Return the bytes of a picture of four panels: polar, Cartesian, albedo and lobes in 3-D.

    curves, albedos and lobes are sequences of Curve, Albedo and Lobe; points are Curves drawn as
    points over them, such as those of another measurement. ending is one of ENDINGS.
    """
    words, scale = TEXT[lang], panels.scale([*curves, *points])

    def draw(figure):
        grid = figure.add_gridspec(2, 2, left=0.07, right=0.97, bottom=0.165, top=0.845)
        grid.update(hspace=0.45, wspace=0.22)
        figure.suptitle(one_line(title, 90), fontsize=24, y=0.985)
        _under(figure, subtitle)
        labels = [one.label for one in albedos]
        look = panels.looks(labels, curves, points)
        panels.polar(figure.add_subplot(grid[0, 0], projection="polar"), look, scale, words)
        panels.cartesian(figure.add_subplot(grid[0, 1]), look, scale, words)
        panels.albedo(figure.add_subplot(grid[1, 0]), albedos, words)
        if lobes:
            axes = figure.add_subplot(grid[1, 1], projection="3d")
            panels.lobes(axes, lobes, scale, labels, words)
        _legend(figure, look, words)

    return drawn(draw, (16.0, 10.5), ending)


def single(kind, title, subtitle, shown, points, lang):
    """Return the bytes of a .png of one panel: polar, curve, lobe, albedo or fresnel.

    shown holds what such a panel has, Curves, Lobes, or Albedos; points: Curves drawn as points.
    """
    words, labels = TEXT[lang], [one.label for one in shown]
    if points:
        words = {**words, "plane": words["plots"]["plane"]}

    def draw(figure):
        lines = [*shown] if kind in ("polar", "curve") else []
        look = panels.looks(labels, lines, points if lines else ())
        where = {"left": 0.13, "right": 0.95, "bottom": 0.25, "top": 0.82}
        place = figure.add_gridspec(1, 1, **where)[0, 0]
        figure.suptitle(one_line(title, 60), fontsize=22, y=0.98)
        _under(figure, subtitle, 90)
        scale = panels.scale([*shown, *points]) if kind in ("polar", "curve", "lobe") else None
        if kind == "polar":
            panels.polar(figure.add_subplot(place, projection="polar"), look, scale, words)
        elif kind == "curve":
            panels.cartesian(figure.add_subplot(place), look, scale, words)
        elif kind == "lobe":
            axes = figure.add_subplot(place, projection="3d")
            panels.lobes(axes, shown, scale, labels, words)
        elif kind == "albedo":
            panels.albedo(figure.add_subplot(place), shown, words)
        else:
            panels.reflectance(figure.add_subplot(place), shown, words)
        if kind != "fresnel":
            given = [panels.Curve(one.label, 0.0, None, None) for one in shown]
            _legend(figure, look or panels.looks(labels, given), words)

    return drawn(draw, (11.0, 9.0), ".png")


def data_sheet(sheet, picture_pixels, size, lang):
    """Return the bytes of a PNG, one page that shows all of a Sheet beside a rendered picture.

    picture_pixels  bytes of sRGB, 3 per pixel, rows from the top, of size (width, height)
    """
    words = TEXT[lang]
    picture = np.frombuffer(picture_pixels, np.uint8).reshape(size[1], size[0], 3)

    def draw(figure):
        grid = figure.add_gridspec(2, 3, left=0.06, right=0.97, bottom=0.14, top=0.85)
        grid.update(hspace=0.38, wspace=0.3)
        figure.suptitle(one_line(sheet.title, 80), fontsize=26, y=0.985)
        _under(figure, sheet.paper, 150)
        image = figure.add_subplot(grid[0, 0])
        image.imshow(picture)
        image.set_axis_off()
        look = panels.looks([sheet.albedo.label], sheet.curves)
        scale = panels.scale(sheet.curves)
        panels.polar(figure.add_subplot(grid[0, 1], projection="polar"), look, scale, words)
        _claims(figure.add_subplot(grid[0, 2]), sheet.claims, words)
        panels.cartesian(figure.add_subplot(grid[1, 0]), look, scale, words)
        panels.albedo(figure.add_subplot(grid[1, 1]), [sheet.albedo], words)
        _numbers(figure.add_subplot(grid[1, 2]), sheet.numbers, words)
        _legend(figure, look, words)

    return drawn(draw, (20.0, 11.25), ".png")


def _under(figure, text, width=130):
    """Write up to two lines below the title."""
    lines = textwrap.wrap(one_line(text, 2 * width - 20), width)
    figure.text(0.5, 0.935, "\n".join(lines), ha="center", va="top", fontsize=13, color="#444")


def _legend(figure, look, words):
    """Write below all panels which colour, line and point is what."""
    from matplotlib.lines import Line2D

    lines = [one for one in look if not one.points]
    labels = [*dict.fromkeys(one.curve.label for one in lines)]
    alone = len(labels) == 1
    models, lights, points = {}, {}, {}
    for one in look:
        name, style = one.curve.label, {"color": one.colour, "ls": "-"}
        light = words["light"].format(one.curve.light)
        if one.points:
            edge = panels.INK if alone else one.colour
            points.setdefault(
                name, {"marker": one.style, "ls": "", "mfc": "none", "ms": 9, "mec": edge}
            )
        elif alone:
            lights.setdefault(light, style)
        else:
            models.setdefault(name, style)
            lights.setdefault(light, {"color": panels.GREY, "ls": one.style})
    if not alone and len(lights) == 1:
        lights = {}  # the line below the title says it
    entries = {**models, **lights, **points}
    names = [one_line(name, 48) for name in entries]
    columns = max(1, min(len(names), 150 // (6 + max(map(len, names), default=1))))
    handles = [Line2D([], [], **style) for style in entries.values()]
    figure.legend(handles, names, loc="lower center", ncols=columns, frameon=False)


def _claims(axes, claims, words):
    """Write what a model claims and what was found; green where the two agree."""
    axes.set_axis_off()
    axes.set_title(words["claims"])
    places = (0.0, 0.42, 0.68)
    for x, word in zip(places, words["claim"], strict=True):
        axes.text(x, 0.93, word, color="#444", fontsize=13)
    for i, (*texts, agree) in enumerate(claims):
        y = 0.8 - 0.75 * i / max(6, len(claims))
        colour, sign = ("#00694c", "✓") if agree else ("#a04000", "✗")
        for x, text in zip(places, texts, strict=True):
            axes.text(x, y, one_line(text, 24))
        axes.text(0.62, y, sign, color=colour, weight="bold")


def _numbers(axes, numbers, words):
    """Write (label, value) texts below each other."""
    axes.set_axis_off()
    axes.set_title(words["numbers"])
    step = 0.95 / max(12, len(numbers))
    for i, (label, value) in enumerate(numbers):
        for x, text, side in ((0.0, label, "left"), (1.0, value, "right")):
            axes.text(x, 0.93 - i * step, one_line(text, 40), ha=side, fontsize=min(14, 300 * step))


def drawn(draw, inches, ending):
    """Return the bytes of a figure that `draw` fills, the same wherever it is drawn."""
    _quiet()
    import matplotlib
    from matplotlib import font_manager
    from matplotlib.figure import Figure

    font_manager.fontManager.addfont(os.path.join(ASSETS, "fonts", "DejaVuSans.ttf"))
    out = io.BytesIO()
    undated = {".png": {}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}[ending]
    with matplotlib.rc_context(), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a sign that no font has becomes a box
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        figure = Figure(figsize=inches, dpi=100)
        draw(figure)
        figure.savefig(out, format=ending[1:], metadata=undated)
    return out.getvalue()


def formula(latex, size):
    """Return (width, height, bytes) of a formula as coverage, 0 to 255, letters of `size` pixels.

    Its lines stand below each other. Raises ValueError for what is not LaTeX that mathtext knows.
    """
    _quiet()
    import matplotlib
    from matplotlib.mathtext import MathTextParser

    with matplotlib.rc_context(), warnings.catch_warnings():
        warnings.simplefilter("error")  # a sign that no font has
        matplotlib.rcdefaults()
        matplotlib.rcParams["mathtext.fontset"] = "stix"
        matplotlib.rcParams["font.size"] = size
        try:
            rows = [MathTextParser("agg").parse(f"${row}$", 72) for row in latex.split("\n")]
        except (UserWarning, RecursionError) as error:
            raise ValueError(str(error)) from None
    images = [np.asarray(row.image) for row in rows]
    step, width = round(0.45 * size), max(image.shape[1] for image in images)
    images = [np.pad(image, ((0, step), (0, width - image.shape[1]))) for image in images]
    page = np.concatenate(images)[:-step]
    return width, len(page), page.astype(np.uint8).tobytes()


def _quiet():
    """Keep matplotlib's cache in ours, and its notes, such as that it is being made, to itself."""
    os.environ.setdefault("MPLCONFIGDIR", os.path.join(cache_folder(), "matplotlib"))
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
