"""Which scenes are shown beside each other: the same but with some values, or kept as they were."""

import contextlib
from typing import NamedTuple

from . import contrast, settings
from .errors import Mistake
from .parts import RATES, Panel
from .scene import Scene

MODES = ("one", "split", "grid", "difference")
MOST = 4  # pictures at a time
LETTERS = "ABCD"
GAP = 4  # pixels between two pictures


class Variant(NamedTuple):
    """One picture: the scene as edited but with some values, or a scene that edits leave alone.

    values  (key, value) pairs, as `settings.changed` takes them
    kept    a Scene as it was, seen by the camera of the scene as edited unless `apart`
    caption {language: line}; where it is empty, what differs is said
    """

    values: tuple[tuple[str, object], ...] = ()
    kept: Scene | None = None
    apart: bool = False
    caption: dict = {}  # noqa: RUF012  never changed in place


class Comparison(NamedTuple):
    """What is shown: one of MODES, of these Variants.

    "one" is the scene as edited; "split" the first two on either side of a line; "grid" all, each
    in a place of its own; "difference" where the first two differ.
    """

    mode: str = "one"
    variants: tuple[Variant, ...] = (Variant(),)

    @property
    def shown(self):
        """The Variants of which pictures are needed."""
        return {"one": (Variant(),), "grid": self.variants}.get(self.mode, self.variants[:2])


def rates():
    """Return the Comparison of the shading rates."""
    return Comparison("grid", tuple(Variant((("shading", rate),)) for rate in RATES))


def models(names):
    """Return the Comparison of some models side by side."""
    return Comparison("grid", tuple(Variant((("model", name),)) for name in names))


def shots(given):
    """Return the Comparison of the Shots of a lesson's step; of a plain one the scene alone."""
    variants = tuple(Variant(shot.values, caption=shot.caption) for shot in given)
    return Comparison("one" if variants == (Variant(),) else "grid", variants)


def added(comparison, variant):
    """Return a Comparison with one more picture, which takes the place of B where two are shown.

    The same where there are MOST already.
    """
    mode, variants = comparison
    if mode == "one":
        return Comparison("split", (Variant(), variant))
    if mode != "grid":
        return Comparison(mode, (variants[0], variant, *variants[2:]))
    return Comparison(mode, (*variants, variant)) if len(variants) < MOST else comparison


def without(comparison, index):
    """Return a Comparison without one of its pictures; where one is left, of the scene alone."""
    variants = comparison.variants[:index] + comparison.variants[index + 1 :]
    return Comparison(comparison.mode, variants) if len(variants) > 1 else Comparison()


def swapped(comparison):
    """Return a Comparison with its first two pictures in each other's place."""
    a, b, *rest = comparison.variants
    return comparison._replace(variants=(b, a, *rest))


def replaced(comparison, index, variant):
    """Return a Comparison with another Variant in a place."""
    variants = comparison.variants
    return comparison._replace(variants=(*variants[:index], variant, *variants[index + 1 :]))


def in_mode(comparison, mode, scene):
    """Return a Comparison shown in another way; a lone scene is put beside itself as it is now."""
    if mode != "one" and len(comparison.variants) < 2:
        comparison = comparison._replace(variants=(*comparison.variants, Variant(kept=scene)))
    return comparison._replace(mode=mode)


def scene_of(variant, scene):
    """Return the Scene of a Variant of a scene as edited; raise Mistake where there is none."""
    if variant.kept is None:
        return settings.all_changed(scene, variant.values)
    if variant.apart:
        return variant.kept
    return variant.kept._replace(camera=scene.camera, size=scene.size)


def edited(variant, after):
    """Return a Variant with its values as they are in a Scene that was made from it."""
    values = tuple((key, _value_or(after, key, value)) for key, value in variant.values)
    return variant._replace(
        values=values, caption=variant.caption if values == variant.values else {}
    )


def moved(comparison, scene, turn):
    """Return (comparison, scene) after `turn`, which moves the camera or a light of any scene.

    A picture with a camera or a light of its own moves by as much as the others.
    """

    def one_moved(one):
        with contextlib.suppress(Mistake):
            if one.kept:
                return one._replace(kept=turn(one.kept)) if one.apart else one
            return edited(one, turn(scene_of(one, scene))) if one.values else one
        return one

    variants = tuple(map(one_moved, comparison.variants))
    if variants != comparison.variants:
        comparison = comparison._replace(variants=variants)
    return comparison, turn(scene)


def looking_as(comparison, other):
    """Return a Comparison with the camera values that another one's pictures have."""
    variants = list(comparison.variants)
    for i, (one, home) in enumerate(zip(variants, other.variants, strict=False)):
        old = {key: value for key, value in home.values if key.startswith("camera.")}
        variants[i] = one._replace(values=tuple((k, old.get(k, v)) for k, v in one.values))
        if variants[i].values == home.values:
            variants[i] = variants[i]._replace(caption=home.caption)
    return comparison._replace(variants=tuple(variants))


def common(comparison, key):
    """Return whether moving a value of the scene as edited moves a picture, or more."""
    return any(
        one.kept is None and key not in (other for other, _ in one.values)
        for one in comparison.shown
    )


def captions(comparison, scenes):
    """Return the {language: line} of each picture that is shown: what differs, and how.

    scenes: those of `scene_of`, None where there is none.
    """
    shown, first = comparison.shown, scenes[0]
    if comparison.mode == "one":
        return [{}]
    keys = dict.fromkeys(key for one in shown for key, _ in one.values)
    for one, scene in zip(shown, scenes, strict=True):
        if one.kept and not one.caption and first and scene:
            found = contrast.differences(first, scene) or ()
            keys |= dict.fromkeys(
                key for key, _ in found if not key.startswith(("camera.", "size"))
            )
    return [
        one.caption or contrast.told(scene, dict(one.values), keys)
        for one, scene in zip(shown, scenes, strict=True)
    ]


def sheet(base, scenes, comparison, columns):
    """Return the Scene of a sheet that shows the pictures, None where no file can say them.

    base: the scene as edited, with the size of a picture; scenes: those of the pictures.
    """
    panels = []
    for one, scene, caption in zip(
        comparison.shown, scenes, captions(comparison, scenes), strict=True
    ):
        values = one.values if _made(base, one.values, scene) else contrast.differences(base, scene)
        if values is None:
            return None
        panels.append(Panel(caption, values))
    return base._replace(panels=tuple(panels), columns=columns, title={})


def places(mode, count, size):
    """Return the (left, top, width, height) of each picture in an area (width, height), in pixels.

    In a grid they are as large as they can be.
    """
    if mode != "grid":
        return [(0, 0, *size)] * count
    columns, cell = max(
        ((n, _cell(size, n, -(-count // n))) for n in range(1, count + 1)),
        key=lambda pair: (min(pair[1]), -abs(pair[0] * -(-count // pair[0]) - count)),
    )
    (wide, high), rows = cell, -(-count // columns)
    used = columns * wide + (columns - 1) * GAP, rows * high + (rows - 1) * GAP
    left, top = max(0, (size[0] - used[0]) // 2), max(0, (size[1] - used[1]) // 2)
    return [
        (left + (i % columns) * (wide + GAP), top + (i // columns) * (high + GAP), wide, high)
        for i in range(count)
    ]


def _cell(size, columns, rows):
    """Return the (width, height) of a place where so many stand in an area, 1 pixel at least."""
    counts = (columns, rows)
    return tuple(max(1, (side - (n - 1) * GAP) // n) for side, n in zip(size, counts, strict=True))


def _made(base, values, scene):
    with contextlib.suppress(Mistake):
        return contrast.same(settings.all_changed(base, values), scene)
    return False


def _value_or(scene, key, value):
    """Return the value that a Scene has, `value` where it names none, as of a whole light."""
    found = None if key == "light" else contrast.value(scene, key)[0]
    return value if found is None else found
