"""The panel of the window: a pure function from a Scene to the Scene as edited in it. No OpenGL."""

import functools
import os
from dataclasses import dataclass

from imgui_bundle import imgui

from . import (
    catalog,
    editing,
    geometry,
    labels,
    materials,
    notation,
    scenefile,
    settings,
    spectrum,
    units,
    widgets,
)
from .errors import Mistake
from .files import ASSETS
from .parts import CAMERA, LIGHT, OBJECT, SCENE
from .words import TEXT

FONT = os.path.join(ASSETS, "fonts", "DejaVuSans.ttf")
_RED = (1.0, 0.55, 0.5, 1.0)
_SQUARES = tuple(n * n for n in range(1, 9))  # what `samples` may be


@dataclass
class State:
    """What the panel remembers that is no part of the scene.

    chosen    index of the object whose model is shown
    message   the line of the last mistake, until something succeeds
    gesture   a number while a widget is held, another one for each time: a key for History
    view      (eye, target) of the picture as it is, at which values that were left out begin
    width     of the panel, in pixels of the screen
    """

    lang: str = ""
    chosen: int = 0
    message: str = ""
    gesture: int | None = None
    view: tuple | None = None
    width: float = 0.0
    holds: int = 0


def prepare(size=16.0):
    """Give ImGui's current context the font and the colours of Lumiar; size: of letters, pixels."""
    io = imgui.get_io()
    io.set_ini_filename("")
    if not io.fonts.fonts:
        io.fonts.add_font_from_file_ttf(FONT, size)
    imgui.style_colors_dark()
    style = imgui.get_style()
    style.font_size_base = size
    style.frame_rounding = style.grab_rounding = style.popup_rounding = 3.0
    style.set_color_(imgui.Col_.window_bg, (0.09, 0.1, 0.12, 0.97))
    style.set_color_(imgui.Col_.popup_bg, (0.05, 0.06, 0.07, 1.0))
    style.set_color_(imgui.Col_.frame_bg, (0.19, 0.21, 0.25, 1.0))
    for grab in (imgui.Col_.slider_grab, imgui.Col_.slider_grab_active):
        style.set_color_(grab, (0.2, 0.42, 0.75, 1.0))
    style.set_color_(imgui.Col_.button, (0.16, 0.38, 0.68, 1.0))
    style.set_color_(imgui.Col_.text_disabled, (0.62, 0.66, 0.72, 1.0))


def draw(scene, state):
    """Draw the panel at the left of the window and return the scene as changed in it.

    The same scene comes back where nothing was changed. What cannot be is said in state.message.
    """
    state.lang = state.lang or scenefile.system_language()
    words, em = TEXT[state.lang], imgui.get_font_size()
    area = imgui.get_main_viewport()
    height = area.work_size.y
    imgui.set_next_window_pos(area.work_pos)
    imgui.set_next_window_size((27.0 * em, height), imgui.Cond_.first_use_ever)
    imgui.set_next_window_size_constraints((20.0 * em, height), (60.0 * em, height))
    flags = imgui.WindowFlags_.no_title_bar | imgui.WindowFlags_.no_move
    imgui.begin("panel", None, flags | imgui.WindowFlags_.no_saved_settings)
    state.width = imgui.get_window_width()
    _top(state, words)
    scene = _object(scene, state, words)
    scene = _lights(scene, state, words)
    scene = _picture(scene, state, words)
    scene = _camera(scene, state, words)
    imgui.end()
    held = imgui.is_any_item_active()
    if held and state.gesture is None:
        state.holds += 1
    state.gesture = state.holds if held else None
    return scene


def _top(state, words):
    for lang in scenefile.LANGUAGES:
        if imgui.radio_button(lang, state.lang == lang):
            state.lang = lang
        imgui.same_line()
    imgui.new_line()
    if state.message:
        imgui.push_text_wrap_pos(0.0)
        imgui.text_colored(_RED, state.message)
        imgui.pop_text_wrap_pos()
        if imgui.small_button(words["close"]):
            state.message = ""


def _object(scene, state, words):
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


def _lights(scene, state, words):
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


def _picture(scene, state, words):
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


def _camera(scene, state, words):
    if not _section("camera", words, opened=False):
        return scene
    imgui.push_id("camera")
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
    for one in parameters:
        value, key = values[one.name], prefix + one.name
        start = None
        if one.default is None and value is None:
            start = editing.start(one.name, state.view)
        new = widgets.edit(one, value, words, note, start, scene.time)
        if new != value:
            scene = _set(scene, state, key, new)
    return scene


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
