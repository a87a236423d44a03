"""The editor in the window: the GLSL of the scene, what is wrong on its line, drawn as typed."""

import os
import re

from imgui_bundle import imgui
from imgui_bundle import imgui_color_text_edit as ed

from . import opening
from .errors import Mistake, one_line
from .files import ASSETS
from .phrases import TEXT
from .settings import changed
from .texts import ships, write_text

FONT = os.path.join(ASSETS, "fonts", "DejaVuSansMono.ttf")
NEW = """// model   {}
#include "lib/constants.glsl"

uniform vec3 albedo = vec3(0.8, 0.5, 0.2);  // color: rho, the reflected share
uniform float k = 1.0;                      // [0.1, 10]: exponent of the cosine (unitless)

vec3 scatter(vec3 L, vec3 V) {
    return albedo / PI * pow(max(L.z, 0.0), k);
}
"""
_RED, _DIM = (1.0, 0.55, 0.5, 1.0), (0.62, 0.66, 0.72, 1.0)
_BAD = (imgui.IM_COL32(255, 90, 80, 255), imgui.IM_COL32(120, 30, 30, 150))
_WHERE = re.compile(r"(.+?):(\d+): (.*)", re.DOTALL)


class Editor:
    """Texts of files, one of which is shown; see `drawer.Drawer` for what a tool is."""

    def __init__(self):
        self.sheets, self.path, self._chosen, self._font = {}, "", "", None
        self._asked, self._name, self._refused = "", "", ""

    def release(self):
        """Free the texts; what is not saved in them, the document has."""
        self.sheets.clear()

    @property
    def sheet(self):
        """The ImGui editor that shows the file, or None."""
        return self.sheets[self.path].area if self.path in self.sheets else None

    def draw(self, now):
        """Draw the editor, and return the scene, changed where it uses a file just written."""
        words, texts = TEXT[now.state.lang]["editor"], now.document.texts
        scene = self._follow(now)
        self._list(now, words)
        scene = self._bar(now, scene, words)
        self._notes(now.document, words)
        try:
            text = texts.text(self.path)
        except Mistake as mistake:
            self._say(str(mistake), _RED)
            return scene
        if self.path not in self.sheets:
            self.sheets[self.path] = _Sheet(text, self.path.endswith(".glsl"))
        sheet = self.sheets[self.path]
        fault = texts.faults.get(self.path, now.fault)
        sheet.mark(_at(fault, self.path))
        typed = self._code(sheet, text, self._fixed(now))
        if typed is not None:
            now.document.edit(self.path, typed, now.time)
        self._foot(fault, words)
        return scene

    def _follow(self, now):
        """Go to the file of the model that is chosen, when another one is; return the scene."""
        chosen = now.scene.objects[min(now.state.chosen, len(now.scene.objects) - 1)].model.path
        files = self._files(now.document)
        if chosen != self._chosen or self.path not in files:
            first = files[0] if now.document.awaits else chosen
            self.path, self._chosen, self._asked = first, chosen, ""
        return now.scene

    def _files(self, document):
        shaders = opening.shaders(document.scene)
        libraries = sorted(document.texts.libraries(shaders))
        own = [path for path in document.files if path.endswith(".glsl") or not ships(path)]
        text = [path for path in own if path.endswith((".glsl", ".toml"))]
        return [*dict.fromkeys((*text, *document.texts.drafts, *libraries))]

    def _fixed(self, now):
        """Return whether the file can only be read: no copy of it would do."""
        shaders = opening.shaders(now.scene)
        given = any(one.given for one in shaders if one.path == self.path)
        return ships(self.path) and (given or self.path not in [one.path for one in shaders])

    def _list(self, now, words):
        texts = now.document.texts
        imgui.set_next_item_width(-1.0)
        if imgui.begin_combo("##file", _shown(self.path, texts)):
            for path in self._files(now.document):
                if imgui.selectable(f"{_shown(path, texts)}##{path}", path == self.path)[0]:
                    self.path, self._asked = path, ""
                    if path in self.sheets:
                        self.sheets[path].seeks = True
            imgui.end_combo()

    def _bar(self, now, scene, words):
        """Draw the buttons; return the scene, with a file in it that was just written."""
        document, changed_here = now.document, self.path in now.document.texts.drafts
        said = words["unsaved" if changed_here else "is saved"]
        if ships(self.path):
            said = words["fixed" if self._fixed(now) else "ships"]
        else:
            keyed = imgui.shortcut(
                imgui.Key.mod_ctrl | imgui.Key.s, imgui.InputFlags_.route_global
            )
            if _button(words["save"], words["save tip"], changed_here) or keyed:
                self._save(now, words)
            imgui.same_line()
        if self.path.endswith(".glsl") and not self._fixed(now):
            if ships(self.path) and imgui.shortcut(
                imgui.Key.mod_ctrl | imgui.Key.s, imgui.InputFlags_.route_global
            ):
                self._ask("copy")
            if _button(words["copy"], words["copy tip"]):
                self._ask("copy")
            imgui.same_line()
        if _button(words["new"], words["new tip"]):
            self._ask("new")
        imgui.same_line()
        if _button(words["revert"], words["revert tip"], changed_here):
            document.revert(self.path)
        self._say(said, _DIM)
        return self._name_field(now, scene, words) if self._asked else scene

    def _ask(self, what):
        name = os.path.splitext(os.path.basename(self.path))[0] if what == "copy" else "model"
        self._asked, self._name, self._refused = what, f"my_{name}.glsl", ""

    def _save(self, now, words):
        self._refused = ""
        self._settle(now)
        try:
            if now.document.texts.save(self.path) and self.path in self.sheets:
                self.sheets[self.path].seeks = True
        except OSError as error:
            name = os.path.basename(self.path)
            self._refused = words["refused"].format(name, one_line(error.strerror or error))

    def _settle(self, now):
        """Have what was just typed in the scene at once."""
        now.document.look(now.time, at_once=True)

    def _name_field(self, now, scene, words):
        folder = os.path.basename(os.getcwd()) or os.getcwd()
        imgui.text(words["name"].format(f"{folder}{os.sep}"))
        imgui.set_next_item_width(-1.0)
        entered, self._name = imgui.input_text(
            "##name", self._name, imgui.InputTextFlags_.enter_returns_true
        )
        wanted = _button(words["ok"], "") or entered
        imgui.same_line()
        if _button(words["cancel"], "") or imgui.is_key_pressed(imgui.Key.escape):
            self._asked = ""
        elif wanted:
            scene = self._write(now, scene, words)
        return scene

    def _write(self, now, scene, words):
        """Write a copy or a new model; return the scene with it."""
        name = self._name.strip()
        name += "" if name.endswith(".glsl") else ".glsl"
        path = os.path.abspath(name)
        self._refused = ""
        if name == ".glsl":
            self._refused = words["unnamed"]
        elif os.path.basename(name) != name:
            self._refused = words["plain"]
        elif os.path.exists(path) and path != self.path:
            self._refused = words["named"].format(name)
        if self._refused:
            return scene
        self._settle(now)
        document, copies = now.document, self._asked == "copy"
        try:
            if copies:
                write_text(path, document.texts.text(self.path))
                document.rename(self.path, path)
                scene = document.scene
            else:
                write_text(path, NEW.format(os.path.splitext(name)[0].replace("_", " ")))
                key = f"object.{min(now.state.chosen, len(scene.objects) - 1) + 1}.model"
                scene = changed(scene, key, path)
        except (OSError, Mistake) as error:
            reason = one_line(getattr(error, "strerror", None) or error)
            self._refused = words["refused"].format(name, reason)
            return scene
        self._asked, self.path = "", path
        self._chosen = scene.objects[min(now.state.chosen, len(scene.objects) - 1)].model.path
        return scene

    def _notes(self, document, words):
        """Say what has to be decided about the file, with a button for each way."""
        texts, path = document.texts, self.path
        if self._refused:
            self._say(self._refused, _RED)
        if path in texts.moved:
            self._say(words["moved"], _RED)
            if _button(words["theirs"], ""):
                document.revert(path)
            imgui.same_line()
            if _button(words["mine"], ""):
                texts.keep(path)
        elif texts.left(path):
            self._say(words["left"], _DIM)
            if _button(words["take"], ""):
                document.take_up(path)
            imgui.same_line()
            if _button(words["decline"], ""):
                texts.decline(path)

    def _code(self, sheet, text, fixed):
        """Draw the text; return it as typed in this frame, or None."""
        em = imgui.get_font_size()
        if self._font is None:
            self._font = imgui.get_io().fonts.add_font_from_file_ttf(FONT)
        if text != sheet.text:
            sheet.replace(text)
        sheet.area.set_read_only_enabled(fixed)
        imgui.push_font(self._font, 0.93 * em)
        left = imgui.get_content_region_avail().y - 4.2 * em
        typed = sheet.area.render("##code", (0.0, max(4.0 * em, left)))
        imgui.pop_font()
        if not typed:
            return None
        sheet.text, sheet.seeks = sheet.area.get_text(), False
        return sheet.text

    def _foot(self, fault, words):
        """Say what is wrong, below the text; a click goes there."""
        if not fault:
            return
        found = _WHERE.match(fault)
        self._say(fault.replace(os.getcwd() + os.sep, ""), _RED)
        if found and imgui.is_item_hovered():
            imgui.set_tooltip(words["go"])
        if found and imgui.is_item_clicked() and os.path.isfile(found.group(1)):
            self.path = os.path.abspath(found.group(1))
            if self.path in self.sheets:
                self.sheets[self.path].seeks = True

    def _say(self, text, color):
        imgui.push_text_wrap_pos(0.0)
        imgui.push_style_color(imgui.Col_.text, color)
        imgui.text_unformatted(text)
        imgui.pop_style_color()
        imgui.pop_text_wrap_pos()


class _Sheet:
    """A file in ImGui's text editor, with its own undo, and the mark of what is wrong."""

    def __init__(self, text, is_glsl):
        self.area, self.text, self.seeks, self._marked = ed.TextEditor(), text, True, None
        if is_glsl:
            self.area.set_language(ed.TextEditor.Language.glsl())
        self.area.set_palette(ed.TextEditor.get_dark_palette())
        self.area.set_tab_size(4)
        self.area.set_insert_spaces_on_tabs(True)
        self.area.set_text(text)

    def replace(self, text):
        """Show another text, as a step that can be undone."""
        place = self.area.get_main_cursor_position()
        last = self.area.get_line_count() - 1
        end = ed.TextEditor.DocPos(last, len(self.area.get_line_text(last)))
        self.area.replace_section_text(ed.TextEditor.DocPos(0, 0), end, text)
        lines = text.split("\n")
        line = min(place.line, len(lines) - 1)
        index = min(place.index, len(lines[line]))
        self.area.set_cursor(ed.TextEditor.DocPos(line, index))
        self.text, self.seeks, self._marked = self.area.get_text(), True, None

    def mark(self, fault):
        """Mark a line, (number from 1, message), or none; go there unless somebody is typing."""
        if fault != self._marked:
            self.area.clear_markers()
            if fault:
                line = min(fault[0], self.area.get_line_count()) - 1
                self.area.add_marker(line, *_BAD, fault[1], fault[1])
            self._marked = fault
        if fault and self.seeks:
            line = min(fault[0], self.area.get_line_count()) - 1
            self.area.scroll_to_line(line, ed.TextEditor.Scroll.align_middle)
            self.seeks = False


def _at(fault, path):
    """Return (line, message) of a fault in a file, or None."""
    found = _WHERE.match(fault)
    if not found or os.path.abspath(found.group(1)) != path:
        return None
    return int(found.group(2)), found.group(3)


def _shown(path, texts):
    """Return how a file is called in the list: marked where it is not saved, or wrong."""
    sign = "• " if path in texts.drafts else ""
    folder, name = os.path.split(path)
    return f"{sign}{name}   ({os.path.basename(folder)}/)"


def _button(label, tip, able=True):
    imgui.begin_disabled(not able)
    pressed = imgui.button(label)
    imgui.end_disabled()
    if tip:
        imgui.set_item_tooltip(tip)
    return pressed
