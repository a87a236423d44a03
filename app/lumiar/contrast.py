"""By what two scenes differ: as values to be changed, and in words."""

import os

from . import captions, notation, settings
from .errors import Mistake
from .parts import CAMERA, LIGHT_TEXTS, OBJECT, SCENE
from .words import TEXT

TOLD = 3  # values that a line names


def differences(a, b):
    """Return the (key, value) pairs that make scene `a` into scene `b`, None where none can."""
    pairs, now = [], a

    def take(key, wanted, has):
        nonlocal now
        if wanted != has:
            now = settings.changed(now, key, wanted)
            pairs.append((key, wanted))

    if len(a.objects) != len(b.objects) or len(a.lights) != len(b.lights):
        return None
    try:
        for key in (key for key in SCENE if key not in ("lang", "columns")):
            take(key, getattr(b, key), getattr(a, key))
        for key in CAMERA:
            take(f"camera.{key}", getattr(b.camera, key), getattr(a.camera, key))
        for i, one in enumerate(b.objects):
            at = f"object.{i + 1}." if len(b.objects) > 1 else ""
            take(f"{at}model", one.model.name, now.objects[i].model.name)
            take(f"{at}mesh", one.mesh, now.objects[i].mesh)
            for key in OBJECT:
                take(f"{at}{key}", getattr(one, key), getattr(now.objects[i], key))
            for key, value in one.values.items():
                take(f"{at}{key}", value, now.objects[i].values.get(key))
        for i, one in enumerate(b.lights):
            for key, value in one.values.items():
                take(f"light.{i + 1}.{key}", value, now.lights[i].values.get(key))
    except Mistake:
        return None
    return tuple(pairs) if same(now, b) else None


def told(scene, given, keys):
    """Return {language: "name = value, …"} of a scene, or of None, for some keys.

    given: {key: value} of those that the scene itself does not hold, as of a material.
    """
    return {lang: _line(scene, given, keys, lang) for lang in TEXT}


def same(a, b):
    """Return whether two scenes make the same picture by what they say, but for its captions."""
    a, b = (one._replace(title={}, lang="system", columns=0) for one in (a, b))
    return a == b


def value(scene, key):
    """Return (value, unit) of what `settings.changed` changes first; value None for nothing."""
    found = settings.found(scene, key)
    if found:
        one, given, lamp, _ = found
        return given, notation.unit(lamp.unit if lamp and one.tinted and lamp.unit else one.unit)
    objects, lamps, name = settings.addressed(scene, key)
    if name in ("mesh", "model") and len(objects):
        one = scene.objects[objects[0]]
        return one.mesh if name == "mesh" else one.model.name, ""
    if name in LIGHT_TEXTS and len(lamps):
        return getattr(scene.lights[lamps[0]], name), ""
    if key == "light":
        return ", ".join(os.path.basename(one.kind.name) for one in scene.lights), ""
    return None, ""


def _line(scene, given, keys, lang):
    """Return "name = value, …" of a scene for some keys."""
    told = []
    for key in keys if scene else ():
        shown, unit = value(scene, key)
        shown = given.get(key) if shown is None else shown
        if shown is None:
            continue
        first, _, name = key.rpartition(".")
        first = "" if first in ("camera", "mesh") else first.removeprefix("object.")
        first = first.replace("light.", TEXT[lang]["names"].get("light", "light") + " ")
        if isinstance(shown, bool):
            shown = captions.TEXT[lang]["sheet"]["yes" if shown else "no"]
        elif name in ("mesh", "model"):
            shown = os.path.basename(shown)
        name = TEXT[lang]["names"].get(name, name.replace("_", " "))
        shown = notation.shown(shown) + (unit if unit == "°" else f" {unit}".rstrip())
        told.append(f"{first} {name} = {shown}".lstrip())
    return ", ".join(told[:TOLD]) + ", …" * (len(told) > TOLD)
