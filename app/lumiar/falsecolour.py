"""Views of a scene as false-colour pictures above their scale, and as files of values."""

import io
import os

import numpy as np

from . import captions, files, image, legend, picture, scale, scenefile, sheet, views
from .errors import Mistake

TITLE = 240  # letters of what an error's title says at most


def write(scene, path, view, renderer, where="", folder="", progress=None):
    """Write a view of a scene to `path` and return the number of broken pixels.

    .png is in false colour above its scale, and carries the scene; .npy holds the values as
    `views.Seen` has them; .hdr holds them three times, 0 where there is nothing. A sheet of panels
    has one scale for all. progress is called with the share done.
    """
    kind = image.ending(path)
    if scene.lang == "system":
        scene = scene._replace(lang=scenefile.system_language())
    if kind != ".png":
        if scene.panels:
            raise Mistake(f"{path}: a sheet of several pictures has no values; write a .png")
        found = views.seen(scene, view, renderer, where, folder)
        files.write_whole(path, _values(found, scene.size, path))
        return int(found.broken.sum())
    cells = []
    for i, (one, caption) in enumerate(_panels(scene), 1):
        cells.append((caption, views.seen(one, view, renderer, where, folder)))
        if progress and scene.panels:
            progress(i / len(scene.panels))
    size, pixels = _page(scene, view, cells)
    text = scene.toml(os.path.dirname(os.path.abspath(path)))
    files.write_whole(path, image.png(size, [pixels], [scenefile.chunk(text)]))
    return sum(int(found.broken.sum()) for _, found in cells)


def _panels(scene):
    """Yield (scene, caption) of each picture of a scene."""
    if not scene.panels:
        yield scene, ""
    for panel, one, caption in picture.panels(scene, scene.lang):
        if one.panels:
            raise Mistake(f"{panel.scene}: a sheet within a sheet has no view; draw it alone")
        yield one, caption


def _page(scene, view, cells):
    """Return (size, bytes of sRGB) of the pictures in false colour above their legend."""
    words = captions.TEXT[scene.lang]["views"]
    every = [found for _, found in cells]
    swatches = []
    if any(not found.surface.all() for found in every):
        swatches.append((scale.EMPTY, words["empty"]))
    if any(found.broken.any() for found in every):
        swatches.append((scale.BROKEN, words["broken"]))
    said = {"log": "", "what": "", "rms": 0.0}
    if view.name == "normal":
        pictures = [_directions(found) for found in every]
        axes = [(_colour(axis), name) for name, axis in _AXES.items()]
    else:
        good = [found.values[found.surface & ~found.broken] for found in every]
        good = np.concatenate(good) if len(good) > 1 else good[0]
        ruler = scale.fitting(good)
        pictures = [scale.colours(found.values, ruler, found.surface) for found in every]
        if view.name == "error":
            what = ", ".join(
                f"{key}\u00a0=\u00a0{os.path.basename(value)}" for key, value in view.pairs
            )
            rms = float(np.sqrt(np.mean(np.square(good, dtype=np.float64)))) if good.size else 0.0
            said |= {"what": what[:TITLE], "rms": rms}
        said["log"] = words["log"] if ruler.log else ""
    title = words[view.name].format(**said)
    sizes = [found.surface.shape[::-1] for found in every]
    size, pixels = sizes[0], pictures[0].tobytes()
    if scene.panels:
        laid = zip((caption for caption, _ in cells), sizes, pictures, strict=True)
        laid = [(caption, one, colours.tobytes()) for caption, one, colours in laid]
        heading = picture.in_language(scene.title, scene.lang)
        size, pixels = sheet.lay_out(heading, laid, scene.columns)
    if view.name == "normal":
        return legend.with_swatches(size, pixels, title, axes + swatches)
    return legend.with_bar(size, pixels, title, ruler, swatches)


_AXES = {
    f"{sign}{name}": tuple((1.0 if sign == "+" else -1.0) * (k == i) for k in range(3))
    for i, name in enumerate("xyz")
    for sign in "+−"
}


def _colour(normal):
    """Return the colour of a unit vector: each part from -1 to 1 becomes 0 to 255."""
    return tuple(round(255.0 * (0.5 + 0.5 * part)) for part in normal)


def _directions(found):
    """Return (height, width, 3) uint8 of normals as colours."""
    empty, broken = ~found.surface, found.broken
    shares = np.where((empty | broken)[..., None], 0.0, found.values)
    painted = np.rint(255.0 * np.clip(0.5 + 0.5 * shares, 0.0, 1.0)).astype(np.uint8)
    painted[broken] = scale.BROKEN
    painted[empty] = scale.EMPTY
    return painted


def _values(found, size, path):
    """Return the bytes of a .npy or .hdr of what is seen, in parts."""
    if image.ending(path) == ".hdr":
        if found.values.ndim == 3:
            raise Mistake(f"{path}: .hdr holds no negative numbers, as normals have; write a .npy")
        grey = np.where(found.surface | np.isfinite(found.values), found.values, np.float32(0.0))
        return image.hdr(size, [np.repeat(grey[..., None], 3, axis=2).tobytes()])
    data = io.BytesIO()
    np.save(data, found.values)
    return [data.getvalue()]
