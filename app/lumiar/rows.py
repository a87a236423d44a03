"""Rows of the panel for values of a scene, each (scene, state, words, …) → the scene as edited."""

import functools
import os

from imgui_bundle import imgui

from . import editing, geometry, labels, notation, settings, spectrum, units, widgets
from .errors import Mistake


def of_shader(scene, state, words, key, shader, parameters, values):
    """Draw a row for each parameter of a model or a light; the paper stands in the tooltips."""
    paper = shader.header.get("paper", "")
    return several(scene, state, words, f"{key}.", parameters, values, paper)


def several(scene, state, words, prefix, parameters, values, note=""):
    """Draw a row for each of some Parameters; prefix and a name are the key of its value."""
    time, before = functools.partial(clock, scene, state, words), opened(scene, state, prefix)
    for one in parameters:
        value, key = values[one.name], prefix + one.name
        start = None
        if one.default is None and value is None:
            start = editing.start(one.name, state.view)
        was = (before[one.name],) if one.name in before else ()
        new = widgets.edit(one, value, words, note, start, time, was)
        if new != value:
            scene = put(scene, state, key, new)
    return scene


def clock(scene, state, words):
    """Draw the time of the scene, and the button that lets it run, or stops it."""
    if imgui.button("▮▮##play" if state.runs else "▶##play", (2.0 * imgui.get_font_size(), 0.0)):
        state.wish = "play"
    imgui.set_item_tooltip(words["play"])
    imgui.same_line()
    imgui.text(f"t = {scene.time:.2f} s")


def opened(scene, state, prefix):
    """Return {name: value} of what stood behind a prefix of keys when the scene was opened."""
    first, _, rest = prefix.partition(".")
    if state.home is None:  # a panel without a window
        return {}
    if first in ("", "camera"):
        return (state.home.camera if first else state.home)._asdict()
    field, shader = ("objects", "model") if first == "object" else ("lights", "kind")
    number, _, rest = rest.partition(".")
    before, now = (getattr(one, field)[int(number) - 1 :][:1] for one in (state.home, scene))
    if not before or not now:
        return {}
    if rest == "mesh.":
        same = before[0].mesh.partition(":")[0] == now[0].mesh.partition(":")[0]
        return geometry.shape(before[0].mesh) if same else {}
    same = getattr(before[0], shader).path == getattr(now[0], shader).path
    return before[0]._asdict() | (before[0].values if same else {})


def listed(name, words, current, options, hint="", note=""):
    """Draw a named list to choose from; see `labels.choice`."""
    labels.row(name, words, tip=note)
    return labels.choice(name, current, options, hint)


def put(scene, state, key, value):
    """Return the scene with a value changed, None leaving it out; a Mistake leaves the scene."""
    if value is None:
        return editing.left_out(scene, key)
    return tried(scene, state, lambda: settings.changed(scene, key, value, folder=os.getcwd()))


def tried(scene, state, change):
    """Return what `change()` does, or the scene and its message where that is a Mistake."""
    try:
        scene = change()
    except Mistake as mistake:
        state.message = str(mistake)
    else:
        state.message = ""
    return scene


def named(i, name):
    """Return what the light or object of an index is called."""
    return f"{i + 1}  {name}".rstrip()


def about(shader):
    """Return what the header of a GLSL file says, line by line."""
    header = shader.header
    keys = ("model", "light", "paper", "claims", "note")
    return "\n".join(header[key] for key in keys if header.get(key))


def block(name, draw):
    """Return what `draw()` returns; None, and a blank of its height, where it would be unseen.

    ImGui itself keeps how high it was. While anything is held, what was drawn goes on being so.
    """
    kept, key, drawn = imgui.get_state_storage(), imgui.get_id(name), imgui.get_id(f"{name} drawn")
    high, top = kept.get_float(key, 0.0), imgui.get_cursor_pos_y()
    held = imgui.is_any_item_active() and kept.get_bool(drawn, False)
    unseen = high and not held and not imgui.is_rect_visible((1.0, high))
    kept.set_bool(drawn, not unseen)
    if unseen:
        imgui.dummy((1.0, high - imgui.get_style().item_spacing.y))
        return None
    got = draw()
    kept.set_float(key, imgui.get_cursor_pos_y() - top)
    return got


def lamp_text(scene, state, words, i, key, own):
    """Draw the list for the unit, the illuminant or the image of a light, one of its own keys."""
    one = scene.lights[i]
    if not own.get(key):  # empty where a file has a unit of its own invention
        return scene
    if key == "unit":
        native = units.unit(one.kind.tinted.unit)
        options = [(name, notation.unit(name)) for name in own["unit"].split(", ")]
        got = listed("unit", words, notation.unit(one.unit or native), options)
        if got is None:
            return scene
        return tried(scene, state, lambda: editing.with_unit(scene, i, got))
    if key == "illuminant":
        options = [("", words["white"]), *spectrum.names()]
        got = listed("illuminant", words, one.illuminant or words["white"], options)
    else:
        from . import surroundings

        now = os.path.basename(one.image) or words["choose"]
        got = listed("image", words, now, surroundings.shipped, words["image hint"])
    return scene if got is None else put(scene, state, f"light.{i + 1}.{key}", got)
