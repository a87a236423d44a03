"""The panel of the window: a pure function from a Scene to the Scene as edited in it. No OpenGL."""

import math
import os
from dataclasses import dataclass

from imgui_bundle import imgui

from . import labels, scenefile, sections, shelf
from .files import ASSETS
from .words import TEXT

FONT = os.path.join(ASSETS, "fonts", "DejaVuSans.ttf")
ALL = (sections.objects, sections.lights, sections.picture, sections.camera)


@dataclass
class State:
    """What the panel remembers that is no part of the scene.

    chosen    index of the object whose model is shown
    lamp      index of the light that was last touched, which Alt moves
    home      the scene as it was opened, or None
    message   the line of the last mistake, until something succeeds
    gesture   a number while a widget is held, another one for each time: a key for History
    view      (eye, target) of the picture as it is, at which values that were left out begin
    width     of the panel, in pixels of the screen
    restless  whether it has to be drawn once more, until all has its size
    wake      when, by time.monotonic, it has to be drawn once more though nothing happens
    tools     the names of those that the window has, and tool the open one
    path      of what is to be opened
    wish      what a button asks the window for: "undo", "redo", "play", or one of the tools
    able      which of undo and redo would do something
    runs      whether the time of the scene does
    """

    lang: str = ""
    chosen: int = 0
    lamp: int = 0
    home: object = None
    message: str = ""
    gesture: int | None = None
    view: tuple | None = None
    width: float = 0.0
    holds: int = 0
    restless: bool = False
    wake: float = math.inf
    tools: tuple = ()
    tool: str = ""
    path: str = ""
    wish: str = ""
    able: tuple = ()
    runs: bool = False


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
    style.set_color_(imgui.Col_.text_disabled, labels.DIM)


def draw(scene, state, parts=ALL):
    """Draw the panel at the left of the window and return the scene as changed in it.

    parts: what it has, from above; each takes (scene, state, words) and returns the scene.
    The same scene comes back where nothing was changed. What cannot be is said in state.message.
    """
    state.lang = state.lang or scenefile.system_language()
    words, em = TEXT[state.lang], imgui.get_font_size()
    area = imgui.get_main_viewport()
    height = area.work_size.y
    imgui.set_next_window_pos(area.work_pos)
    wide = 27.0 if parts is ALL else 23.0
    imgui.set_next_window_size((wide * em, height), imgui.Cond_.first_use_ever)
    imgui.set_next_window_size_constraints((20.0 * em, height), (60.0 * em, height))
    flags = imgui.WindowFlags_.no_title_bar | imgui.WindowFlags_.no_move
    imgui.begin(
        "panel" if parts is ALL else "presenter", None, flags | imgui.WindowFlags_.no_saved_settings
    )
    state.width = imgui.get_window_width()
    _top(state, words)
    if parts is ALL:
        _bar(state, words)
    for section in parts:
        scene = section(scene, state, words)
    imgui.end()
    labels.gesture(state)
    return scene


def _top(state, words):
    for lang in scenefile.LANGUAGES:
        if imgui.radio_button(lang, state.lang == lang):
            state.lang = lang
        imgui.same_line()
    imgui.new_line()
    if state.message:
        labels.wrapped(state.message, labels.BAD)
        if imgui.small_button(words["close"]):
            state.message = ""


def _bar(state, words):
    """Draw the buttons that open a tool, and those that go back and forth."""
    em, right = imgui.get_font_size(), imgui.get_content_region_avail().x
    for name, sign in (("undo", "↶"), ("redo", "↷")):
        imgui.begin_disabled(name not in state.able)
        if imgui.button(f"{sign}##{name}", (2.0 * em, 0.0)):
            state.wish = name
        imgui.end_disabled()
        imgui.set_item_tooltip(words[name])
        imgui.same_line()
    state.path = shelf.draw(state.lang, words) or state.path
    imgui.same_line()
    padding, gap = 2.0 * imgui.get_style().frame_padding.x, imgui.get_style().item_spacing.x
    for name in state.tools:
        said = words["tools"][name]
        if imgui.get_cursor_pos_x() + imgui.calc_text_size(said).x + padding > right:
            imgui.new_line()
        color = imgui.Col_.button if name == state.tool else imgui.Col_.frame_bg
        imgui.push_style_color(imgui.Col_.button, imgui.get_style().color_(color))
        if imgui.button(f"{said}##{name}"):
            state.wish = name
        imgui.pop_style_color()
        imgui.same_line(0.0, gap)
    imgui.new_line()
