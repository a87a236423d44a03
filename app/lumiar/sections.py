"""The sections of the panel: (scene, state, words) → the scene as edited in one of them."""

import functools
import os

from imgui_bundle import imgui

from . import catalog, editing, geometry, labels, materials, rows, settings
from .parts import CAMERA, LIGHT, LIGHT_TEXTS, OBJECT, SCENE

_SQUARES = tuple(n * n for n in range(1, 9))  # what `samples` may be


def objects(scene, state, words):
    """Draw the chosen object: its mesh, its model with all parameters, where it stands."""
    if not scene.objects or not _section("object", words):
        return scene
    state.chosen = min(state.chosen, len(scene.objects) - 1)
    if len(scene.objects) > 1:
        names = [(i, rows.named(i, one.name)) for i, one in enumerate(scene.objects)]
        chosen = rows.listed("object", words, names[state.chosen][1], names)
        state.chosen = state.chosen if chosen is None else chosen
    key, one = f"object.{state.chosen + 1}", scene.objects[state.chosen]
    for name, now, options in (
        ("mesh", os.path.basename(one.mesh), _meshes),
        ("model", one.model.name, _models),
        ("material", words["choose"], lambda: _materials(state.lang)),
    ):
        hint = words.get(f"{name} hint", "")
        note = rows.about(one.model) if name == "model" else ""
        got = rows.listed(name, words, now, options, hint, note)
        if got is not None:
            scene = rows.put(scene, state, f"{key}.{name}", got)
        if name == "mesh":
            scene = _shape(scene, state, words, key)
    one = scene.objects[state.chosen]
    imgui.push_id(one.model.name)
    scene = rows.of_shader(scene, state, words, key, one.model, one.model.parameters, one.values)
    if imgui.small_button(words["reset all"]):
        scene = editing.reset(scene, "object", state.chosen)
    imgui.pop_id()
    if imgui.tree_node(f"{words['placement']}###placement"):
        scene = rows.several(scene, state, words, f"{key}.", OBJECT.values(), one._asdict())
        if imgui.small_button(words["reset all"]):
            scene = editing.reset(scene, "placement", state.chosen)
        imgui.tree_pop()
    return scene


def _shape(scene, state, words, key):
    """Draw the parameters of the chosen object's mesh, where that is a built-in shape."""
    mesh = scene.objects[state.chosen].mesh
    values = geometry.shape(mesh)
    if not values or not imgui.tree_node(f"{words['shape']}###shape"):
        return scene
    sliders = [geometry.slider(mesh, name) for name in values]
    scene = rows.several(scene, state, words, f"{key}.mesh.", sliders, values)
    imgui.tree_pop()
    return scene


def model(scene, state, words):
    """Draw the parameters of the chosen object's model, and nothing else."""
    if not scene.objects:
        return scene
    state.chosen = min(state.chosen, len(scene.objects) - 1)
    one, key = scene.objects[state.chosen], f"object.{state.chosen + 1}"
    imgui.push_id(one.model.name)
    scene = rows.of_shader(scene, state, words, key, one.model, one.model.parameters, one.values)
    imgui.pop_id()
    return scene


def some(scene, state, words, keys):
    """Draw a row for each of some values, as `settings.changed` names them."""
    first = next((key for key in keys if key.startswith("camera.")), "")
    for key in keys:
        imgui.push_id(key)
        if key == first:  # lights have an azimuth, too
            imgui.text_disabled(words["camera"])
        scene = _one(scene, state, words, key)
        imgui.pop_id()
    return scene


def _one(scene, state, words, key):
    """Draw the row of what a key names: a value, or what is chosen from a list."""
    if at := settings.found(scene, key):
        one, value, lamp, address = at
        prefix = address.removesuffix(one.name)
        one = editing.in_unit(lamp) if one.tinted else one
        return rows.several(scene, state, words, prefix, [one], {one.name: value})
    if key == "light":
        return _kind(scene, state, words, 0) if scene.lights else scene
    objects, lamps, name = settings.addressed(scene, key)
    if name in LIGHT_TEXTS:
        own = ((i, settings.own_keys(scene.lights[i].kind)) for i in lamps)
        i, own = next(((i, keys) for i, keys in own if keys.get(name)), (0, {}))
        return rows.lamp_text(scene, state, words, i, name, own) if own else scene
    lists = {"mesh": _meshes, "model": _models, "material": lambda: _materials(state.lang)}
    if name in lists and objects:
        now = scene.objects[objects[0]]
        now = {"mesh": os.path.basename(now.mesh), "model": now.model.name}
        got = rows.listed(name, words, now.get(name, words["choose"]), lists[name])
        scene = scene if got is None else rows.put(scene, state, key, got)
    return scene


def lights(scene, state, words):
    """Draw every light with all it can be given, and the list from which one more is taken."""
    if not _section("lights", words):
        return scene
    gone = None
    for i, one in enumerate(scene.lights):
        flags = imgui.TreeNodeFlags_.default_open if i == 0 else 0
        mark = "   ◉" if i == state.lamp and len(scene.lights) > 1 else ""
        name = rows.named(i, one.name or one.kind.name)
        top = imgui.get_cursor_screen_pos().y
        if imgui.tree_node_ex(f"{name}{mark}###{i}", flags):
            draw = functools.partial(_light, scene, state, words, i)
            changed, removed = rows.block("light", draw) or (scene, False)
            scene, gone = changed, i if removed else gone
            imgui.tree_pop()
        held = imgui.HoveredFlags_.allow_when_blocked_by_active_item
        touched = imgui.is_mouse_clicked(0) and imgui.is_window_hovered(held)
        if touched and top <= imgui.get_mouse_pos().y < imgui.get_cursor_screen_pos().y:
            state.lamp = i
    imgui.set_next_item_width(-1.0)
    got = labels.choice("add", words["add"], _kinds, words["light hint"])
    if got is not None:
        scene = rows.tried(scene, state, lambda: editing.with_light(scene, got, os.getcwd()))
    return scene if gone is None else editing.without_light(scene, gone)


def _light(scene, state, words, i):
    """Draw all that one light can be given; return the scene, and whether it is to go."""
    scene = _lamp(scene, state, words, i)
    if imgui.small_button(words["reset all"]):
        scene = editing.reset(scene, "light", i)
    imgui.same_line()
    return scene, imgui.small_button(words["remove"])


def _lamp(scene, state, words, i):
    one, key = scene.lights[i], f"light.{i + 1}"
    scene = _kind(scene, state, words, i)
    if scene.lights[i] is not one:
        return scene
    own = settings.own_keys(one.kind)
    parameters = [editing.in_unit(one) if p.tinted else p for p in one.kind.parameters]
    scene = rows.of_shader(scene, state, words, key, one.kind, parameters, one.values)
    for name in LIGHT_TEXTS:
        scene = rows.lamp_text(scene, state, words, i, name, own)
    one = scene.lights[i]
    rest = [parameter for name, parameter in LIGHT.items() if name in own]
    return rows.several(scene, state, words, f"{key}.", rest, one._asdict())


def _kind(scene, state, words, i):
    """Draw the list of kinds for a light; what was set by hand and suits the other one is kept."""
    kind = scene.lights[i].kind
    got = rows.listed("kind", words, kind.name, _kinds, words["light hint"], rows.about(kind))
    if got is None:
        return scene
    return rows.tried(scene, state, lambda: editing.with_kind(scene, i, got, os.getcwd()))


def picture(scene, state, words):
    """Draw what the picture as a whole is made with."""
    if not _section("picture", words):
        return scene
    labels.row("samples", words, tip=SCENE["samples"].text)
    samples = labels.pick("samples", scene.samples, _SQUARES)
    scene = scene if samples == scene.samples else rows.put(scene, state, "samples", samples)
    others = [SCENE[name] for name in editing.PICTURE if name != "samples"]
    scene = rows.several(scene, state, words, "", others, scene._asdict())
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
    scene = rows.several(scene, state, words, "camera.", given, scene.camera._asdict())
    if imgui.small_button(words["reset all"]):
        scene = editing.reset(scene, "camera")
    imgui.pop_id()
    return scene


def _section(name, words, opened=True):
    flags = imgui.TreeNodeFlags_.default_open if opened else 0
    return imgui.collapsing_header(f"{words[name]}###{name}", flags)


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
