"""What F12 writes: the pictures in the window as a PNG that carries their scene."""

import math

from . import compare, files, hands, image, picture, scenefile, sheet
from .comparing import TEXT
from .gallery import numbers


def write(stage, document, lang, path):
    """Write what a Stage shows of a Document to `path`, with captions in a language.

    Several pictures are a sheet, and so is the scene that the PNG carries; a difference stands
    above its scale. Where no file can say the scenes of all, the first one is carried. Raises
    Mistake; OSError when the disk refuses.
    """
    stage.draw(document.beside, document.scene, stage.area, math.inf)  # in full, as at rest
    if len(stage.easels) == 1:
        picture.write(stage.shown, path, stage.renderer)
        return
    shown = [one.shown for one in stage.easels if one.shown]
    said = document.beside.said(lang)
    row = [place for place in stage.places if place[1] == stage.places[0][1]]
    base, columns = hands.framed(document.scene, row[0][2:]), len(row)
    made = len(shown) == len(stage.easels) and compare.sheet(
        base, shown, document.beside.comparison, columns
    )
    carried = made._replace(lang=lang) if made else shown[0]
    if made and stage.mode != "difference":
        picture.write(carried, path, stage.renderer)
        return
    if stage.mode == "difference":
        size, pixels = _difference(stage, said, TEXT[lang]["difference"])
    else:
        cells = [
            (text, one.canvas.size, one.canvas.read(components=3))
            for text, one in zip(said, stage.easels, strict=True)
        ]
        size, pixels = sheet.lay_out("", cells, columns)
    text = scenefile.chunk(carried.toml())
    files.write_whole(path, image.png(size, [pixels], [text]))


def _difference(stage, said, words):
    """Return (size, bytes of sRGB) of a difference above its scale and its numbers."""
    one = stage.deviation
    pixels = one.canvas.read(components=3)
    found = numbers(one, words).removesuffix("FLIP …")
    lines = (", ".join(said), words["title"], found)
    title = "  ".join(" ".join(line.split()) for line in lines)  # two blanks end a line there
    from . import legend  # with NumPy and Pillow: not when a window opens

    return legend.with_bar(one.canvas.size, pixels, title, one.ruler)
