"""Scene → a quantity at every pixel: luminance, irradiance, albedo, normals, an error."""

import re
from typing import NamedTuple

import numpy as np

from . import settings, units, variants
from .errors import Mistake, nearest

NAMES = ("luminance", "irradiance", "illuminance", "albedo", "normal", "error")
MOST = 4096  # directions to a light, which are as many for a pixel as its picture takes
_PAIR = re.compile(r"\s*[A-Za-z_][\w.]*\s*=")


class View(NamedTuple):
    """What to draw: one of NAMES; of an error the (key, value) pairs that are changed."""

    name: str
    pairs: tuple[tuple[str, str], ...] = ()


class Seen(NamedTuple):
    """What a view shows of a scene.

    values   (height, width) float32, or (height, width, 3) of normals; NaN where there is nothing
    surface  (height, width), whether there is something to be measured
    """

    values: np.ndarray
    surface: np.ndarray

    @property
    def broken(self):
        """(height, width), where a measured value is NaN or infinite."""
        finite = np.isfinite(self.values)
        return self.surface & ~(finite.all(-1) if self.values.ndim == 3 else finite)


def chosen(text, where=""):
    """Return the View that text such as `luminance` or `error:shading=flat,kd=1,0,0` names."""
    name, colon, rest = text.partition(":")
    if name not in NAMES:
        raise Mistake(f"{where}no view '{name}'; {nearest(name, NAMES)}")
    if name != "error" and colon:
        raise Mistake(f"{where}'{text}'; {name} takes no values: write {name}")
    if name != "error":
        return View(name)
    pieces = []
    for piece in rest.split(","):
        if _PAIR.match(piece) or not pieces:
            pieces.append(piece)
        else:  # the rest of a vector
            pieces[-1] += f",{piece}"
    pairs = [piece.partition("=") for piece in pieces]
    if not all(key.strip() and equals for key, equals, _ in pairs):
        raise Mistake(f"{where}'{text}'; write what to change: error:shading=flat")
    return View(name, tuple((key.strip(), value.strip().strip("[]")) for key, _, value in pairs))


def seen(scene, view, renderer, where="", folder=""):
    """Return the Seen of a view of a scene without panels.

    luminance [cd/m^2] and error [cd/m^2] are means over each pixel, and there where no surface is,
    too; the others belong to the middle of each pixel: irradiance [W/m^2], illuminance [lx],
    albedo (luminance over that of a white surface), normal (world space, toward the eye). Raises
    Mistake, its line beginning with `where`; folder is where relative paths of an error begin.
    """
    if view.name in ("luminance", "error"):
        values = luminance(scene, renderer)
        if view.name == "error":
            other = settings.all_changed(scene, view.pairs, where, folder)
            if other.size != scene.size:
                raise Mistake(f"{where}pictures of another size cannot be compared; leave it")
            with np.errstate(invalid="ignore"):  # infinite less infinite
                values = np.abs(values - luminance(other, renderer))
        visible = any(light.visible for light in scene.lights)
        surface = np.full(values.shape, True) if visible else _surface(scene, renderer)
        return Seen(values, surface)
    more = (min(MOST, light.samples * scene.samples) for light in scene.lights)
    lights = [light._replace(samples=n) for light, n in zip(scene.lights, more, strict=True)]
    one = variants.lit_by(scene._replace(samples=1), lights)
    surface = _surface(one, renderer)
    if view.name == "normal":
        values = _drawn(variants.shape(one), renderer, "normal")
    elif view.name == "albedo":
        values = units.luminance(_drawn(variants.furnace(one), renderer)) / units.EFFICACY
        if variants.emits(one):
            dark = _drawn(variants.lit_by(one, ()), renderer)
            values = values - units.luminance(dark) / units.EFFICACY
    else:
        values = _irradiance(one, renderer, watts=view.name == "irradiance")
    values = values.astype(np.float32)
    values[~surface] = np.nan
    return Seen(values, surface)


def luminance(scene, renderer):
    """Return the luminance (height, width) float32 of the picture of a scene [cd/m^2]."""
    return units.luminance(_drawn(scene, renderer)).astype(np.float32)


def _irradiance(scene, renderer, watts):
    """Return the illuminance [lx], or the irradiance [W/m^2], of a scene, float64.

    Each light's watts are its lumens over the efficacy of its spectrum: one picture for each.
    """
    groups = {}
    for light in scene.lights:
        groups.setdefault(variants.efficacy(light) if watts else 1.0, []).append(light)
    found = np.zeros((scene.size[1], scene.size[0]))
    for efficacy, lights in groups.items():
        one = variants.white(scene._replace(lights=tuple(lights)))
        found += units.luminance(_drawn(one, renderer)) / efficacy
    return found


def _surface(scene, renderer):
    """Return (height, width), whether an object is seen in the middle of each pixel."""
    return _drawn(variants.shape(scene), renderer, "object")[..., 0] > 0.5


def _drawn(scene, renderer, shows="radiance"):
    """Return (height, width, 3) float32 of what the renderer shows of a scene."""
    strips = renderer.strips(scene, linear=True, shows=shows)
    data = b"".join(strip for strip, _ in strips)
    return np.frombuffer(data, "<f4").reshape(scene.size[1], scene.size[0], 3)
