"""Scene → picture: in memory, as a file, as a sheet of panels."""

import os
from typing import NamedTuple

from . import files, image, scenefile, settings, sheet
from .errors import Mistake
from .renderer import Renderer
from .scene import Scene

DEPTH = 3  # sheets within sheets


class Picture(NamedTuple):
    """A picture as people see it.

    pixels  bytes of sRGB, 3 per pixel, rows from the top
    broken  number of pixels whose radiance is NaN or infinite; they are magenta
    toml    the scene it was made from, which its PNG carries
    """

    size: tuple[int, int]
    pixels: bytes
    broken: int
    toml: str

    def _repr_png_(self):
        return b"".join(image.png(self.size, [self.pixels], [scenefile.chunk(self.toml)]))

    def save(self, path):
        """Write the picture as a PNG, whole or not at all."""
        if image.ending(path) != ".png":
            raise Mistake(f"{path}: write a .png; `capture(scene, path)` writes the other kinds")
        files.write_whole(path, [self._repr_png_()])


def capture(scene, path=None, renderer=None, progress=None):
    """Return the Picture of a Scene, and write it to `path` if given.

    path ends in .png, or in .hdr or .npy for linear radiance [W m^-2 sr^-1]. A renderer of one's
    own saves opening one for every call. progress is called with the share done. Raises
    Mistake; OSError when the disk refuses.
    """
    if renderer is None:
        with Renderer() as renderer:
            return capture(scene, path, renderer, progress)
    folder = os.path.dirname(os.path.abspath(path)) if path else os.getcwd()
    if path and image.ending(path) != ".png":
        write(scene, path, renderer, _half(progress, 0.0))
        path, progress = None, _half(progress, 0.5)
    if scene.panels:
        if scene.lang == "system":
            scene = scene._replace(lang=scenefile.system_language())
        size, pixels, broken = _sheet(scene, renderer, scene.lang, progress)
    else:
        size, pixels, broken = _drawn(scene, renderer, progress)
    picture = Picture(size, pixels, broken, scene.toml(folder))
    if path:
        picture.save(path)
    return picture


def write(scene, path, renderer, progress=None):
    """Write the picture of a Scene to `path` and return the number of broken pixels.

    As `capture`, but strip by strip, so that the memory does not grow with the picture.
    """
    kind = image.ending(path)
    if scene.panels:
        if kind != ".png":
            raise Mistake(f"{path}: a sheet of several pictures has no radiance; write a .png")
        return capture(scene, path, renderer, progress).broken
    faults = []
    strips = _counted(scene, renderer, faults, progress, linear=kind != ".png")
    if kind == ".png":
        text = scene.toml(os.path.dirname(os.path.abspath(path)))
        data = image.png(scene.size, strips, [scenefile.chunk(text)])
    else:
        data = image.npy(scene.size, strips) if kind == ".npy" else image.hdr(scene.size, strips)
    files.write_whole(path, data)
    return sum(faults)


def radiance(scene, renderer=None):
    """Return the linear radiance of a Scene, (height, width, 3) float32 [W m^-2 sr^-1]."""
    import numpy as np

    if renderer is None:
        with Renderer() as renderer:
            return radiance(scene, renderer)
    data = b"".join(strip for strip, _ in renderer.strips(scene, linear=True))
    return np.frombuffer(data, "<f4").reshape(scene.size[1], scene.size[0], 3)


def in_language(words, lang):
    """Return the line for a language, else the English one, else any."""
    return words.get(lang) or words.get("en") or next(iter(words.values()), "")


def panels(scene, lang):
    """Yield (Panel, Scene, caption) of each picture of a sheet; a caption left out is the title."""
    for number, panel in enumerate(scene.panels, 1):
        one = Scene.load(panel.scene) if panel.scene else scene._replace(panels=(), title={})
        one = settings.all_changed(one, panel.values, f"panel {number}: ")
        caption = in_language(panel.caption, lang)
        if not caption and not one.panels:
            caption = in_language(one.title, lang)
        yield panel, one, caption


def _half(progress, start):
    """Return what tells `progress` of one half of the work, from a share of `start` on."""
    return progress and (lambda share: progress(start + 0.5 * share))


def _drawn(scene, renderer, progress=None):
    """Return (size, pixels, broken pixels) of a scene without panels."""
    faults = []
    strips = _counted(scene, renderer, faults, progress)
    return scene.size, b"".join(strips), sum(faults)


def _counted(scene, renderer, faults, progress, linear=False):
    """Yield the strips of a picture, noting broken pixels; tell progress the share done."""
    done, total = 0, scene.size[0] * scene.size[1] * (12 if linear else 3)
    for pixels, broken in renderer.strips(scene, linear):
        faults.append(broken)
        done += len(pixels)
        if progress:
            progress(done / total)
        yield pixels


def _sheet(scene, renderer, lang, progress, depth=1):
    """Return (size, pixels, broken pixels) of a scene with panels."""
    cells, broken = [], 0
    for number, (panel, one, caption) in enumerate(panels(scene, lang), 1):
        if one.panels and depth == DEPTH:
            raise Mistake(f"{panel.scene}: sheets within sheets; allowed: {depth} levels")
        if one.panels:
            size, pixels, faults = _sheet(one, renderer, lang, None, depth + 1)
        else:
            size, pixels, faults = _drawn(one, renderer)
        cells.append((caption, size, pixels))
        broken += faults
        if progress:
            progress(number / len(scene.panels))
    return *sheet.lay_out(in_language(scene.title, lang), cells, scene.columns), broken
