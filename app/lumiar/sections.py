"""The sections of the panel: (scene, state, words) → the scene as edited in one of them."""

import functools
import os

from imgui_bundle import imgui

from . import (
    catalog,
    editing,
    geometry,
    labels,
    materials,
    notation,
    settings,
    spectrum,
    units,
    widgets,
)
from .errors import Mistake
from .parts import CAMERA, LIGHT, OBJECT, SCENE

_SQUARES = tuple(n * n for n in range(1, 9))  # what `samples` may be


def objects(scene, state, words):
    """Draw the chosen object: its mesh, its model with all parameters, where it stands."""
    if not scene.objects or not _section("object", words):
        return scene
    state.chosen = min(state.chosen, len(scene.objects) - 1)
    if len(scene.objects) > 1:
        names = [(i, _named(i, one.name)) for i, one in enumerate(scene.objects)]
        chosen = _list("object", words, names[state.chosen][1], names)
        state.chosen = state.chosen if chosen is None else chosen
    key, one = f"object.{state.chosen + 1}", scene.objects[state.chosen]
    for name, now, options in (
        ("mesh", os.path.basename(one.mesh), _meshes),
        ("model", one.model.name, _models),
        ("material", words["choose"], lambda: _materials(state.lang)),
    ):
        hint = words.get(f"{name} hint", "")
        got = _list(name, words, now, options, hint, _about(one.model) if name == "model" else "")
        if got is not None:
            scene = _set(scene, state, f"{key}.{name}", got)
    one = scene.objects[state.chosen]
    imgui.push_id(one.model.name)
    scene = _parameters(scene, state, words, key, one.model, one.model.parameters, one.values)
    if imgui.small_button(words["reset all"]):
        scene = editing.reset(scene, "object", state.chosen)
    imgui.pop_id()
    if imgui.tree_node(f"{words['placement']}###placement"):
        scene = _values(scene, state, words, f"{key}.", OBJECT.values(), one._asdict())
        if imgui.small_button(words["reset all"]):
            scene = editing.reset(scene, "placement", state.chosen)
        imgui.tree_pop()
    return scene


def model(scene, state, words):
    """Draw the parameters of the chosen object's model, and nothing else."""
    if not scene.objects:
        return scene
    state.chosen = min(state.chosen, len(scene.objects) - 1)
    one, key = scene.objects[state.chosen], f"object.{state.chosen + 1}"
    imgui.push_id(one.model.name)
    scene = _parameters(scene, state, words, key, one.model, one.model.parameters, one.values)
    imgui.pop_id()
    return scene


def some(scene, state, words, keys):
    """Draw a row for each of some values, as `settings.changed` names them."""
    first = next((key for key in keys if key.startswith("camera.")), "")
    clock = functools.partial(_clock, scene, state, words)
    options = {"mesh": _meshes, "model": _models, "material": lambda: _materials(state.lang)}
    for key in keys:
        name, at = key.rpartition(".")[2], settings.found(scene, key)
        imgui.push_id(key)
        if key == first:  # lights have an azimuth, too
            imgui.text_disabled(words["camera"])
        if at:
            one, value, lamp, address = at
            one = editing.in_unit(lamp) if one.tinted else one
            start = editing.start(one.name, state.view) if one.default is None else None
            new = widgets.edit(one, value, words, "", start, clock)
            if new != value:
                scene = _set(scene, state, address if new is None else key, new)
        elif name in options:
            named = [one for one in scene.objects if f"{one.name}.{name}" == key]
            now = (named or scene.objects)[0]
            now = {"mesh": os.path.basename(now.mesh), "model": now.model.name}
            got = _list(name, words, now.get(name, words["choose"]), options[name])
            scene = scene if got is None else _set(scene, state, key, got)
        imgui.pop_id()
    return scene


def lights(scene, state, words):
    """Draw every light with all it can be given, and the list from which one more is taken."""
    if not _section("lights", words):
        return scene
    gone = None
    for i, one in enumerate(scene.lights):
        flags = imgui.TreeNodeFlags_.default_open if i == 0 else 0
        if imgui.tree_node_ex(f"{_named(i, one.name or one.kind.name)}###{i}", flags):
            scene = _light(scene, state, words, i)
            if imgui.small_button(words["reset all"]):
                scene = editing.reset(scene, "light", i)
            imgui.same_line()
            gone = i if imgui.small_button(words["remove"]) else gone
            imgui.tree_pop()
    imgui.set_next_item_width(-1.0)
    got = labels.choice("add", words["add"], _kinds, words["light hint"])
    if got is not None:
        scene = _tried(scene, state, lambda: editing.with_light(scene, got, os.getcwd()))
    return scene if gone is None else editing.without_light(scene, gone)


def _light(scene, state, words, i):
    one, key = scene.lights[i], f"light.{i + 1}"
    got = _list("kind", words, one.kind.name, _kinds, words["light hint"], _about(one.kind))
    if got is not None:
        scene = _tried(scene, state, lambda: editing.with_kind(scene, i, got, os.getcwd()))
        if scene.lights[i] is not one:
            return scene
    own = settings.own_keys(one.kind)
    parameters = [editing.in_unit(one) if p.tinted else p for p in one.kind.parameters]
    scene = _parameters(scene, state, words, key, one.kind, parameters, one.values)
    if own.get("unit"):  # empty where a file has a unit of its own invention
        native = units.unit(one.kind.tinted.unit)
        options = [(name, notation.unit(name)) for name in own["unit"].split(", ")]
        got = _list("unit", words, notation.unit(one.unit or native), options)
        if got is not None:
            scene = _tried(scene, state, lambda: editing.with_unit(scene, i, got))
    if "illuminant" in own:
        options = [("", words["white"]), *spectrum.names()]
        got = _list("illuminant", words, one.illuminant or words["white"], options)
        if got is not None:
            scene = _set(scene, state, f"{key}.illuminant", got)
    if "image" in own:
        from . import surroundings

        now = os.path.basename(one.image) or words["choose"]
        got = _list("image", words, now, surroundings.shipped, words["image hint"])
        if got is not None:
            scene = _set(scene, state, f"{key}.image", got)
    rest = [parameter for name, parameter in LIGHT.items() if name in own]
    return _values(scene, state, words, f"{key}.", rest, one._asdict())


def picture(scene, state, words):
    """Draw what the picture as a whole is made with."""
    if not _section("picture", words):
        return scene
    labels.row("samples", words, tip=SCENE["samples"].text)
    samples = labels.pick("samples", scene.samples, _SQUARES)
    scene = scene if samples == scene.samples else _set(scene, state, "samples", samples)
    others = [SCENE[name] for name in editing.PICTURE if name != "samples"]
    scene = _values(scene, state, words, "", others, scene._asdict())
    if imgui.small_button(f"{words['reset all']}##picture"):
        scene = editing.reset(scene, "picture")
    return scene


def camera(scene, state, words):
    """Draw the eye: views from the sides, and all its values."""
    if not _section("camera", words, opened=False):
        return scene
    imgui.push_id("camera")
    labels.row("view", words)
    names = [(name, words["views"][name]) for name in editing.VIEWS]
    view = labels.pick("view", editing.seen_from(scene.camera), names)
    scene = editing.looking_from(scene, view) if view else scene
    given = [CAMERA[name] for name in editing.camera_keys(scene.camera)]
    scene = _values(scene, state, words, "camera.", given, scene.camera._asdict())
    if imgui.small_button(words["reset all"]):
        scene = editing.reset(scene, "camera")
    imgui.pop_id()
    return scene


def _section(name, words, opened=True):
    flags = imgui.TreeNodeFlags_.default_open if opened else 0
    return imgui.collapsing_header(f"{words[name]}###{name}", flags)


def _parameters(scene, state, words, key, shader, parameters, values):
    """Draw a row for each parameter of a model or a light; the paper stands in the tooltips."""
    paper = shader.header.get("paper", "")
    return _values(scene, state, words, f"{key}.", parameters, values, paper)


def _values(scene, state, words, prefix, parameters, values, note=""):
    """Draw a row for each of some Parameters and return the scene with what was changed."""
    clock = functools.partial(_clock, scene, state, words)
    for one in parameters:
        value, key = values[one.name], prefix + one.name
        start = None
        if one.default is None and value is None:
            start = editing.start(one.name, state.view)
        new = widgets.edit(one, value, words, note, start, clock)
        if new != value:
            scene = _set(scene, state, key, new)
    return scene


def _clock(scene, state, words):
    """Draw the time of the scene, and the button that lets it run, or stops it."""
    if imgui.button("▮▮##play" if state.runs else "▶##play", (2.0 * imgui.get_font_size(), 0.0)):
        state.wish = "play"
    imgui.set_item_tooltip(words["play"])
    imgui.same_line()
    imgui.text(f"t = {scene.time:.2f} s")


def _list(name, words, current, options, hint="", note=""):
    """Draw a named list to choose from; see `labels.choice`."""
    labels.row(name, words, tip=note)
    return labels.choice(name, current, options, hint)


def _set(scene, state, key, value):
    """Return the scene with a value changed, None leaving it out; a Mistake leaves the scene."""
    if value is None:
        return editing.left_out(scene, key)
    return _tried(scene, state, lambda: settings.changed(scene, key, value, folder=os.getcwd()))


def _tried(scene, state, change):
    try:
        scene = change()
    except Mistake as mistake:
        state.message = str(mistake)
    else:
        state.message = ""
    return scene


def _named(i, name):
    return f"{i + 1}  {name}".rstrip()


def _about(shader):
    """Return what the header of a GLSL file says, line by line."""
    header = shader.header
    keys = ("model", "light", "paper", "claims", "note")
    return "\n".join(header[key] for key in keys if header.get(key))


def _meshes():
    return *geometry.SHAPES, *geometry.shipped()


def _models():
    return catalog.names("model")


def _kinds():
    return catalog.names("light")


@functools.lru_cache(maxsize=2)
def _materials(lang):
    """Return ((name, title) …) of the materials that come with Lumiar."""
    read = ((name, materials.read(name).title) for name in materials.names())
    return tuple((name, title.get(lang) or title["en"]) for name, title in read)
