"""What comes with Lumiar, to be opened: lessons and scenes by title, any file by its path."""

import functools
import os

from imgui_bundle import imgui

from . import files, lesson, scenefile, tomltext
from .errors import Mistake
from .labels import BRIGHT, DIM


def draw(lang, words):
    """Draw the button with all there is to open; return the path of what was chosen, or ""."""
    chosen, em = "", imgui.get_font_size()
    if imgui.button(f"{words['open']}##open"):
        imgui.open_popup("shelf")
    imgui.set_next_window_size_constraints((24.0 * em, 0.0), (44.0 * em, 36.0 * em))
    if not imgui.begin_popup("shelf"):
        return ""
    imgui.set_next_item_width(-1.0)
    flags = imgui.InputTextFlags_.enter_returns_true
    entered, text = imgui.input_text_with_hint("##path", words["open hint"], "", flags)
    if entered and text.strip():
        chosen = text.strip()
        chosen = _paths().get(chosen) or os.path.abspath(os.path.expanduser(chosen))
        imgui.close_current_popup()
    for kind, shipped in (("lessons", lesson.shipped()), ("scenes", scenefile.shipped())):
        imgui.text_colored(BRIGHT, words[kind])
        for name, path in shipped.items():
            if imgui.selectable(f"{_title(path, lang) or name}##{name}", False)[0]:
                chosen = path
            imgui.same_line()
            imgui.text_colored(DIM, name)
    imgui.end_popup()
    return chosen


def _paths():
    return {**scenefile.shipped(), **lesson.shipped()}


@functools.lru_cache(maxsize=256)  # asked in every frame in which the list is open
def _title(path, lang):
    """Return the title of a scene or a lesson, read without the rest of it."""
    try:
        title = tomltext.parse(files.read_text(path, scenefile.LIMIT, ""), path).get("title", "")
    except Mistake:  # telling is for whoever opens it
        return ""
    return title if isinstance(title, str) else title.get(lang) or title.get("en", "")
