"""A picture of Nusselt's projection: a polygon, its figure on the unit sphere, its shadow."""

import math

import numpy as np

from . import estimates, factors, panels, plots
from .captions import TEXT
from .polygons import Polygons, triangulate

POLYGON, FIGURE, SHADOW = panels.COLOURS[0], "#f2c25c", "#62c2a4"
FINE = 24  # pieces of a side of a triangle that is bent onto the sphere
HALF = 0.086  # half a side of what matplotlib shows of a scene in 3-D, less a margin
REACH = 2.4  # radii of the sphere, how far away the farthest corner is drawn at most


def picture(found, polygon, lang, ending):
    """Return the bytes of a picture of what factor_table.patch Found of a polygon.

    ending is one of plots.ENDINGS.
    """
    words = TEXT[lang]["nusselt"]
    point, normal = (np.array(found.facts["from"][key]) for key in ("point", "normal"))
    turn = estimates.frame(normal).T
    whole = (polygon - point) @ turn
    above = factors.clipped(whole, np.zeros(3), np.array([0.0, 0.0, 1.0]))
    r = np.linalg.norm(whole, axis=1)
    size = min(REACH / r.max(), max(1.9 / np.linalg.norm(whole.mean(axis=0)), 1.2 / r.min()))

    def draw(figure):
        figure.suptitle(words["title"], fontsize=24, y=0.975)
        shares = {"width_ratios": (1.5, 1.0), "height_ratios": (1.25, 1.0)}
        grid = figure.add_gridspec(2, 2, left=0.0, right=0.965, bottom=0.03, top=0.86, **shares)
        grid.update(hspace=0.12, wspace=0.02)
        _solid(figure.add_subplot(grid[:, 0], projection="3d"), whole * size, above * size, words)
        _flat(figure.add_subplot(grid[0, 1]), above, words)
        _table(figure.add_subplot(grid[1, 1]), found, words)

    return plots.drawn(draw, (16.0, 9.0), ending)


def _solid(axes, whole, above, words):
    """Draw the patch, the unit hemisphere, the polygon and what it becomes on sphere and disk."""
    turn = np.linspace(0.0, 2.0 * math.pi, 181)
    ring = np.stack([np.cos(turn), np.sin(turn), 0.0 * turn])
    up = np.linspace(0.0, math.pi / 2.0, 31)
    thin = {"color": "#b9b9c2", "lw": 0.9}
    for azimuth in np.arange(12) * math.pi / 6.0:
        flat = np.cos(up)
        axes.plot(flat * math.cos(azimuth), flat * math.sin(azimuth), np.sin(up), **thin)
    for height in np.radians([30.0, 60.0]):
        axes.plot(*(ring * math.cos(height))[:2], math.sin(height) + ring[2], **thin)
    axes.plot(*ring, color=panels.GREY, lw=1.6)
    axes.plot(*_closed(whole).T, color=POLYGON, lw=1.4, ls="--")
    if len(above):
        corner = above / np.linalg.norm(above, axis=1)[:, None]
        _fill(axes, lambda p: p * [1.0, 1.0, 0.0], above, SHADOW)
        _fill(axes, lambda p: p, above, FIGURE)
        corners = _triangles(above).reshape(-1, 3)
        axes.plot_trisurf(
            *corners.T, triangles=_threes(corners), color=POLYGON, alpha=0.4, shade=False
        )
        axes.plot(*_closed(above).T, color=POLYGON, lw=2.2)
        outline = estimates.arcs(above, 64)
        axes.plot(*_closed(outline).T, color="#9a6a00", lw=2.0)
        axes.plot(*(_closed(outline) * [1, 1, 0]).T, color="#00694c", lw=2.0)
        if len(above) <= 12:
            for p, w in zip(above, corner, strict=True):
                axes.plot(*np.array([0.0 * p, p]).T, color=panels.GREY, lw=1.0)
                axes.plot(*np.array([w, w * [1, 1, 0]]).T, color=panels.GREY, lw=1.0, ls=":")
    axes.quiver(0, 0, 0, 0, 0, 0.42, color=panels.INK, lw=2.4, arrow_length_ratio=0.25)
    axes.text(0.0, 0.0, 0.46, "N", ha="center")
    patch = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * 0.06
    axes.plot_trisurf(*patch.T, triangles=[[0, 1, 2], [0, 2, 3]], color=panels.INK, shade=False)
    every = np.vstack([ring.T, [[0.0, 0.0, 1.0]], whole])
    low, high = every.min(axis=0), every.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    middle = whole.mean(axis=0)
    axes.view_init(20, math.degrees(math.atan2(middle[1], middle[0])) + 62.0)
    zoom = 1.0
    for _ in range(3):  # in perspective a larger picture is also a nearer one
        axes.set_box_aspect(high - low, zoom=zoom)
        seen = np.column_stack([every, np.ones(len(every))]) @ axes.get_proj().T
        zoom *= HALF / np.abs(seen[:, :2] / seen[:, 3:]).max()
    axes.set_box_aspect(high - low, zoom=zoom)
    axes.set_axis_off()
    axes.patch.set_visible(False)


def _triangles(polygon):
    """Return the triangles (n, 3, 3) of a polygon."""
    n = len(polygon)
    return polygon[triangulate(Polygons(polygon, np.arange(n), np.array([n])))[0]]


def _threes(corners):
    return np.arange(len(corners)).reshape(-1, 3)


def _closed(points):
    return np.vstack([points, points[:1]])


def _fill(axes, bent, polygon, colour):
    """Fill the figure of a polygon on the unit sphere, bent by a function of its points."""
    i, j = np.meshgrid(np.arange(FINE + 1), np.arange(FINE + 1), indexing="ij")
    kept = (i + j).ravel() <= FINE
    index = np.cumsum(kept).reshape(i.shape) - 1
    a, b = (side.ravel()[kept][:, None] / FINE for side in (i, j))
    below = np.stack([index[:-1, :-1], index[1:, :-1], index[:-1, 1:]], axis=-1)[
        (i + j)[:-1, :-1] < FINE
    ]
    upper = np.stack([index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1)
    upper = upper[(i + j)[:-1, :-1] < FINE - 1]
    faces = np.concatenate([below, upper])
    for p, q, r in _triangles(polygon):
        points = p + a * (q - p) + b * (r - p)
        points = bent(points / np.linalg.norm(points, axis=1)[:, None])
        look = {"color": colour, "edgecolor": colour, "lw": 0.6, "shade": False}
        axes.plot_trisurf(*points.T, triangles=faces, **look)


def _flat(axes, above, words):
    """Draw the disk from above, with the shadow."""
    turn = np.linspace(0.0, 2.0 * math.pi, 361)
    axes.fill(np.cos(turn), np.sin(turn), color="#ececf0")
    axes.plot(np.cos(turn), np.sin(turn), color=panels.GREY, lw=1.6)
    if len(above):
        shadow = estimates.arcs(above, 64)[:, :2]
        axes.fill(*shadow.T, color=SHADOW)
        axes.plot(*_closed(shadow).T, color="#00694c", lw=2.0)
    axes.plot([0], [0], "s", color=panels.INK, ms=6)
    axes.set(xlim=(-1.05, 1.05), ylim=(-1.05, 1.05), title=words["disk"])
    axes.set_aspect("equal")
    axes.set_axis_off()


def _table(axes, found, words):
    """Write solid angle and form factor by every way, below each other."""
    axes.set_axis_off()
    y = 1.0
    for key in ("omega_above", "F"):
        colour = {"omega_above": "#9a6a00", "F": "#00694c"}[key]
        axes.text(0.0, y, words[key], color=colour, weight="bold")
        axes.text(1.0, y, words["error"], color="#444", fontsize=12, ha="right")
        for way, (value, error) in found.values[key].items():
            y -= 0.085
            axes.text(0.02, y, words[way].format(found.samples), fontsize=13)
            axes.text(0.78, y, f"{value:.9g}", fontsize=13, ha="right")
            axes.text(1.0, y, f"{error:.0e}", fontsize=13, ha="right")
        y -= 0.13
