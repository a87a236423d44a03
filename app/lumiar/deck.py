"""A lesson as slides: one for each step, two where the class is to predict first."""

import os
from typing import NamedTuple

from . import captions, files, image, picture, plots, scenefile, slide
from .errors import Mistake, one_line
from .lesson import Step
from .parts import Panel
from .picture import in_language


class Slide(NamedTuple):
    """A slide to be drawn: its file's name, its step, its part ("", "ask" or "reveal")."""

    name: str
    step: Step
    part: str
    number: int  # of the step, from 1


def slides(lesson):
    """Return the Slides of a Lesson, in order; their names sort as they stand."""
    digits, found = len(str(max(10, len(lesson.steps)))), []
    for number, step in enumerate(lesson.steps, 1):
        name = f"{lesson.name}-{number:0{digits}}"
        for part in ("ask", "reveal") if step.ask else ("",):
            found.append(Slide(f"{name}-{part}.png" if part else f"{name}.png", step, part, number))
    return found


def write(lesson, folder, lang, size, renderer, progress=None):
    """Write the slides of a Lesson into a folder, which is made; return (paths, broken pixels).

    Each .png carries the scene of its pictures. progress is called with the share done. Raises
    Mistake; OSError when the disk refuses.
    """
    todo, paths, faults, letters = slides(lesson), [], 0, {}
    for one in todo:  # what is wrong shows at once, and both slides of a step get equal letters
        _, room = page(lesson, one, lang, size, [b""] * len(one.step.shots))
        letters[one.number] = min(room, letters.get(one.number, room))
    os.makedirs(folder, exist_ok=True)
    for i, one in enumerate(todo, 1):
        path = os.path.join(folder, one.name)
        pictures, broken = _pictures(one, size, renderer)
        pixels, _ = page(lesson, one, lang, size, pictures, letters[one.number])
        text = _scene(one, size, lang).toml(os.path.abspath(folder))
        files.write_whole(path, image.png(size, [pixels], [scenefile.chunk(text)]))
        paths.append(path)
        faults += broken
        if progress:
            progress(i / len(todo))
    return paths, faults


def page(lesson, one, lang, size, pictures, letters=slide.LARGEST):
    """Return (bytes of sRGB, height of its letters in units, up to `letters`) of a Slide.

    pictures  bytes of sRGB of each shot of its step, as large as `slide.places` says; b"" is open
    """
    step, words = one.step, captions.TEXT[lang]["lesson"]
    named = zip(step.shots, pictures, strict=True)
    box = None
    if one.part:
        colour = slide.ASK if one.part == "ask" else slide.REVEAL
        text = in_language(step.ask if one.part == "ask" else step.reveal, lang)
        box = slide.Box(words[one.part], colour, text)
    source = in_language(step.source, lang)
    made = slide.Page(
        in_language(step.title, lang),
        tuple((in_language(shot.caption, lang), pixels) for shot, pixels in named),
        _formula(step, lang),
        in_language(step.caption, lang),
        box,
        in_language(lesson.title, lang) + (f" · {source}" if source else ""),
        (one.number, len(lesson.steps)),
    )
    try:
        return slide.draw(made, size, letters)
    except Mistake as mistake:
        raise Mistake(f"{step.place}{mistake}") from None


def _formula(step, lang):
    """Return what draws the formula of a step, None if it has none."""
    latex = in_language(step.formula, lang)

    def drawn(letters):
        try:
            return plots.formula(latex, letters)
        except ValueError as error:
            said = one_line(str(error), 160)
            raise Mistake(f"formula: {said}; write LaTeX as mathtext reads it") from None

    return drawn if latex else None


def _visible(one):
    return one.step.shown if one.part == "ask" else one.step.shots


def _pictures(one, size, renderer):
    """Return (bytes of sRGB of each shot, b"" for those not shown yet; broken pixels)."""
    found, faults = [], 0
    spots = slide.places(size, len(one.step.shots))
    for i, (shot, spot) in enumerate(zip(one.step.shots, spots, strict=True)):
        if i < len(_visible(one)):
            drawn = picture.capture(shot.scene._replace(size=spot[2:]), renderer=renderer)
            faults += drawn.broken
            found.append(drawn.pixels)
        else:
            found.append(b"")
    return found, faults


def _scene(one, size, lang):
    """Return the scene that a slide carries: its picture, or a sheet of its pictures."""
    shots, spots = _visible(one), slide.places(size, len(one.step.shots))
    scene = one.step.scene._replace(size=spots[0][2:], lang=lang)
    if len(shots) == 1:
        return shots[0].scene._replace(size=spots[0][2:], lang=lang)
    panels = tuple(Panel(shot.caption, shot.values) for shot in shots)
    return scene._replace(title=one.step.title, panels=panels, columns=len(panels))
