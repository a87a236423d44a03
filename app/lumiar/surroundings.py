"""What the host gives the lights that surround: coefficients, directions, tables of chances."""

import functools
import math
import os
import struct
import sys
from itertools import accumulate
from typing import NamedTuple

from . import daylight, units
from .errors import Mistake, nearest
from .files import ASSETS

FOLDER = os.path.join(ASSETS, "environments")
DEFAULT = "venice"  # where a scene names no image
LIMIT = 1 << 23  # pixels of an image: 4096 x 2048
SIDE = 8192  # pixels of its longer side, that every driver takes
BRIGHTEST = 1e20  # of a pixel: beyond, sums leave the range of a 32-bit float
COLUMNS, ROWS = 512, 256  # of a table of chances, at most
LEAST = 0.01
_DOME = (32, 16)  # cells of half the sky: its samples then differ by 6 %, rms
_VERSION = 1  # of what is kept in the cache


class Texels(NamedTuple):
    """A table for a sampler2D: size is (columns, rows), data float32, the first row first.

    linear says whether the sampler is to interpolate.
    """

    size: tuple
    components: int
    data: bytes
    linear: bool = False


def shipped():
    """Return {name: path} of the images that come with Lumiar."""
    names = (f for f in sorted(os.listdir(FOLDER)) if f.endswith(".hdr"))
    return {name[:-4]: os.path.join(FOLDER, name) for name in names}


def canonical(name, folder="", where=""):
    """Return an image's name if it comes with Lumiar, else the full path of a .hdr in `folder`.

    Raises Mistake, beginning with `where`, for what is neither.
    """
    if name in shipped():
        return name
    if not name.lower().endswith(".hdr"):
        advice = 'name the path of a .hdr, as in image = "room.hdr"'
        raise Mistake(f"{where}no image '{name}'; {nearest(name, shipped())}; {advice}")
    path = os.path.abspath(os.path.join(folder, os.path.expanduser(name)))
    if not os.path.isfile(path):
        raise Mistake(f"{where}no file {path}; name a .hdr, or one of {', '.join(shipped())}")
    return path


def given(light):
    """Return {name: bytes or Texels} of what the file of a parts.Light asks the host for.

    Empty for a light that asks for nothing. Raises Mistake for an image that cannot be used.
    """
    kind, values = light.kind.name, light.values
    if kind == "sky":
        height, azimuth = math.radians(values["height"]), math.radians(values["azimuth"])
        return _sky(values["turbidity"], values["albedo"], height) | _bearings(height, azimuth)
    if kind == "sun":
        height, azimuth = math.radians(values["height"]), math.radians(values["azimuth"])
        limb = _packed(*daylight.disk(values["turbidity"], height))
        return {"limb": limb} | _bearings(height, azimuth)
    if kind == "environment":
        return _environment(light.image or DEFAULT)
    return {}


def chances(rows, extent=math.pi):
    """Return the Texels of a table of cells, as lib/equirect.glsl reads it.

    rows: lists of the radiances, none below 0, of cells in steps of equal angle from +y down to
    `extent` radians. The chance of a cell is in proportion to its radiance times its solid angle,
    but none is below LEAST of the mean of its row, nor a row below LEAST of the mean of all: no
    direction that sends light is left out, however bright others are.
    """
    step = extent / len(rows)
    angles = [math.sin((y + 0.5) * step) for y in range(len(rows))]
    means = [sum(row) / len(row) for row in rows]
    mean = sum(a * b for a, b in zip(means, angles, strict=True)) / sum(angles) or 1.0
    totals = _sums([a * max(b, LEAST * mean) for a, b in zip(angles, means, strict=True)])
    lines = []
    for row, own, total in zip(rows, means, totals, strict=True):
        least = LEAST * own or 1.0
        lines += [*_sums([max(value, least) for value in row]), total]
    return Texels((len(rows[0]) + 1, len(rows)), 1, struct.pack(f"={len(lines)}f", *lines))


def _sums(weights):
    """Return the running sums of weights, over their total: the last is 1."""
    sums = list(accumulate(weights))
    return [min(value / sums[-1], 1.0) for value in sums[:-1]] + [1.0]


def _packed(*vectors):
    """Return vectors as float32, one behind the other."""
    numbers = [number for vector in vectors for number in vector]
    return struct.pack(f"={len(numbers)}f", *numbers)


def _bearings(height, azimuth):
    return {
        "toward": _packed(daylight.direction(height, azimuth)),
        "bearing": _packed((math.sin(azimuth), math.cos(azimuth))),
    }


@functools.lru_cache(maxsize=16)
def _sky(turbidity, albedo, height):
    """Return what a sky is given, but for the sun's direction."""
    one = daylight.sky(turbidity, albedo, height)
    columns, rows = _DOME
    middles = [(y + 0.5) * math.pi / 2.0 / rows for y in range(rows)]
    across = [math.cos((x + 0.5) * math.pi / columns) * math.cos(height) for x in range(columns)]
    dome = []
    for polar in middles:
        up, flat = math.cos(polar), math.sin(polar)
        cosines = (min(up * math.sin(height) + flat * c, 1.0) for c in across)
        dome.append([daylight.luminance(one, up, math.acos(c)) for c in cosines])
    return {
        "coefficients": _packed(*one.coefficients),
        "mixing": _packed(*daylight.mixing(one)),
        "table": chances(dome, math.pi / 2.0),
    }


def _environment(image):
    """Return what an environment is given: its picture and its chances."""
    path = shipped().get(image) or canonical(image)
    try:
        status = os.stat(path)
        state = (status.st_size, status.st_mtime_ns)
    except (OSError, ValueError):
        state = None  # reading it tells
    return _pictured(os.path.abspath(path), state)


@functools.lru_cache(maxsize=4)
def _pictured(path, _):
    """Return what an environment is given, made of the file at a path or found in the cache."""
    from . import cache, image
    from .files import read_bytes

    data = read_bytes(path, image.FILE_LIMIT, "a .hdr picture")
    key = ("environment", _VERSION, cache.fingerprint(data), sys.byteorder)
    parts = cache.get(key)
    if not parts:
        pixels = _checked(image.read(path)[0], path)
        table = _weighed(pixels)
        sizes = struct.pack("=4i", pixels.shape[1], pixels.shape[0], *table.size)
        parts = [sizes, pixels.tobytes(), table.data]
        cache.put(key, parts)
    wide, high, *cells = struct.unpack("=4i", parts[0])
    picture = Texels((wide, high), 3, parts[1])
    return {"picture": picture, "table": Texels(tuple(cells), 1, parts[2])}


def _checked(pixels, path):
    """Return the pixels of an image, (height, width, 3) float32, none below 0."""
    import numpy as np

    high, wide = pixels.shape[:2]
    if high * wide > LIMIT or max(high, wide) > SIDE:
        raise Mistake(f"{path}: {wide} x {high} pixels; make it smaller, such as 4096 x 2048")
    good = (pixels <= BRIGHTEST).all(axis=2)  # nor is a NaN
    if not good.all():
        y, x = np.unravel_index(np.argmin(good), good.shape)
        shown = ", ".join(f"{value:.4g}" for value in pixels[y, x])
        where = f"{path}: column {x + 1}, row {y + 1}"
        raise Mistake(f"{where} holds ({shown}); a pixel is finite, up to {BRIGHTEST:g}")
    return np.ascontiguousarray(np.maximum(pixels, 0.0), np.float32)


def _weighed(pixels):
    """Return the chances of cells of an image: its luminance times the solid angle.

    A cell weighs what the bilinear lookup in it adds up to, so that what is seen can be drawn.
    """
    import numpy as np

    weights = pixels.astype(np.float64) @ units.LUMINANCE
    for axis, mode in ((1, "wrap"), (0, "edge")):
        pad = [(0, 0), (0, 0)]
        pad[axis] = (1, 1)
        wider = np.pad(weights, pad, mode)
        before, after = np.delete(wider, [-1, -2], axis), np.delete(wider, [0, 1], axis)
        weights = 0.75 * weights + 0.125 * (before + after)
    for axis, most in ((0, ROWS), (1, COLUMNS)):
        weights = _joined(weights, most, axis)
    return chances(weights.tolist())


def _joined(weights, most, axis):
    """Return `most` means over equal widths along an axis, or all where there are no more."""
    import numpy as np

    count = weights.shape[axis]
    if count <= most:
        return weights
    ends = np.arange(most + 1) * count / most
    whole = np.minimum(ends.astype(int), count - 1)
    part = np.expand_dims(ends - whole, 1 - axis)
    first = np.take(weights * 0.0, [0], axis)
    sums = np.concatenate([first, np.cumsum(weights, axis)], axis)
    at_ends = np.take(sums, whole, axis) + part * np.take(weights, whole, axis)
    return np.diff(at_ends, axis=axis) * (most / count)
