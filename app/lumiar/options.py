"""Options → the Scene that they describe."""

import os
import re

from .errors import Mistake

SHEET_CELL = 384  # pixels of the long side of a picture varied on a sheet, where no size is given


def scene(options):
    """Return the Scene that the options of `capture` or `source` describe."""
    from . import scenefile, settings
    from .scene import Scene

    here = os.getcwd()
    one = Scene.load(options.scene, here) if options.scene else Scene.default()
    _check_sheet(one, options)
    for key in ("model", "mesh", "shading"):
        value = getattr(options, key)
        if value is not None:
            one = one.changed(key, value, f"--{key}: ", here)
    if options.material:
        from . import materials

        where, keep = "--material: ", options.model is not None
        objects = (materials.applied(o, options.material, keep, where) for o in one.objects)
        one = one._replace(objects=tuple(objects))
    most = scenefile.SECTIONS["light"]
    if options.light and len(options.light) > most:
        raise Mistake(f"--light: {len(options.light)} lights; allowed: up to {most}")
    if options.light:
        lights = (settings.light(spec, "--light: ", here) for spec in options.light)
        one = one._replace(lights=tuple(lights))
    return settings.all_changed(one, pairs(options), "--set: ", here)


def pairs(options):
    """Return the [(key, value)] of `--set`; raise Mistake for what has no equals sign."""
    found = []
    for setting in options.set:
        key, equals, value = setting.partition("=")
        if not equals:
            raise Mistake(f"--set {setting}: write --set key=value")
        found.append((key.strip(), value))
    return found


def _check_sheet(one, options):
    """Refuse options that a sheet of other scenes would silently ignore."""
    others = [os.path.basename(panel.scene) for panel in one.panels if panel.scene]
    keys = ("model", "material", "mesh", "shading", "light", "set", "size", "samples", "vary")
    given = [key for key in keys if getattr(options, key, None)]
    if others and given:
        advice = f"draw one of them: {', '.join(others)}"
        raise Mistake(f"--{given[0]}: {options.scene} is a sheet of other scenes; {advice}")


def varied(one, varies, sized):
    """Return a Scene with a panel for each combination of values; varies are `key=a,b,c` texts.

    sized says that the size of the pictures was chosen; otherwise they are made small.
    """
    from . import settings
    from .parts import Panel

    panels = [()]
    for text in varies:
        key, _, values = text.partition("=")
        values = [v.strip() for v in re.findall(r"(?:\[[^\]]*\]|[^,\[\]])+", values) if v.strip()]
        if not values:
            raise Mistake(f"--vary {text}: write --vary key=one,other; vectors as [1,0,0]")
        if len(panels) * len(values) > 256:
            raise Mistake(f"--vary {text}: more than 256 pictures; vary less")
        values = [settings.canonical(key, v, "--vary: ", os.getcwd()) for v in values]
        panels = [(*panel, (key, value)) for panel in panels for value in values]
    for panel in panels:
        settings.all_changed(one, panel, "--vary: ")
    captions = [", ".join(f"{k} = {_shown(v)}" for k, v in panel) for panel in panels]
    made = (Panel({"en": c}, panel) for c, panel in zip(captions, panels, strict=True))
    if not sized:
        share = min(1.0, SHEET_CELL / max(one.size))
        one = one._replace(size=tuple(max(1, round(side * share)) for side in one.size))
    return one._replace(panels=tuple(made), columns=min(len(values), 64))


def _shown(value):
    return os.path.basename(value) if os.path.isabs(value) else value
