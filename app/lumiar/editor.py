"""The editor in the window: the GLSL of the scene, what is wrong on its line, drawn as typed."""

import os
import re

from imgui_bundle import imgui

from . import opening
from .codearea import Code
from .errors import Mistake, one_line
from .files import shortened
from .labels import BAD, DIM, wrapped
from .phrases import TEXT
from .settings import changed
from .texts import ships, write_text

NEW = """// model   {}
#include "lib/constants.glsl"

uniform vec3 albedo = vec3(0.8, 0.5, 0.2);  // color: rho, the reflected share
uniform float k = 1.0;                      // [0.1, 10]: exponent of the cosine (unitless)

vec3 scatter(vec3 L, vec3 V) {
    return albedo / PI * pow(max(L.z, 0.0), k);
}
"""
_WHERE = re.compile(r"(.+?):(\d+): (.*)", re.DOTALL)


class Editor:
    """Texts of files, one of which is shown; see `drawer.Drawer` for what a tool is."""

    def __init__(self):
        self.sheets, self.path, self._chosen = {}, "", ""
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
        words, document = TEXT[now.state.lang]["editor"], now.document
        self._follow(now)
        self._list(now, words)
        made = self._bar(now, words)
        self._notes(document, words)
        try:
            text = document.texts.text(self.path)
        except Mistake as mistake:
            wrapped(shortened(str(mistake)), BAD)
        else:
            self._text(now, text, words)
        return made or document.scene

    def _text(self, now, text, words):
        """Draw the text, and what is wrong below it; take what is typed."""
        texts, path = now.document.texts, self.path
        if path not in self.sheets:
            now.document.gate.trial.start()  # while it is read
            self.sheets[path] = Code(text, path.endswith(".glsl"))
        sheet, fault = self.sheets[path], texts.faults.get(path, now.fault)
        sheet.mark(_at(fault, path))
        room = imgui.get_content_region_avail().y - (4.4 * imgui.get_font_size() if fault else 0.0)
        typed = sheet.draw(text, room, self._fixed(now))
        if typed is not None:
            now.document.gate.edit(path, typed, now.time)
        self._foot(fault, words)

    def _follow(self, now):
        """Go to the file of the model that is chosen, when that is another one than before."""
        files, chosen = self._files(now.document), _chosen(now.scene, now.state)
        if chosen != self._chosen or self.path not in files:
            first = files[0] if now.document.awaits or not chosen else chosen
            self.path, self._chosen, self._asked = first, chosen, ""

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

    def _bar(self, now, words):
        """Draw the buttons; return the scene with a file in it that was just written, or None."""
        document, edited = now.document, self.path in now.document.texts.drafts
        said, fixed = words["unsaved" if edited else "is saved"], self._fixed(now)
        keyed = imgui.shortcut(imgui.Key.mod_ctrl | imgui.Key.s, imgui.InputFlags_.route_global)
        if ships(self.path):
            said = words["fixed" if fixed else "ships"]
        else:
            if _button(words["save"], words["save tip"], edited) or keyed:
                self._save(now, words)
            _along(words["copy"])
        if self.path.endswith(".glsl") and not fixed:
            if _button(words["copy"], words["copy tip"]) or (keyed and ships(self.path)):
                self._ask("copy", words)
            _along(words["new"])
        if _button(words["new"], words["new tip"]):
            self._ask("new", words)
        _along(words["revert"])
        if _button(words["revert"], words["revert tip"], edited):
            self._read(document, document.texts.forget)
        wrapped(said, DIM)
        return self._name_field(now, words) if self._asked else None

    def _ask(self, what, words):
        name = os.path.splitext(os.path.basename(self.path))[0] if what == "copy" else "model"
        self._asked, self._name, self._refused = what, words["own"].format(name), ""

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

    def _name_field(self, now, words):
        """Draw the field for a name; return the scene with the file written, or None."""
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
            return None
        return self._write(now, words) if wanted else None

    def _write(self, now, words):
        """Write a copy or a new model; return the scene with it, or None."""
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
            return None
        self._settle(now)
        document = now.document
        try:
            if self._asked == "copy":
                write_text(path, document.texts.text(self.path))
                document.rename(self.path, path)
                scene = document.scene
            else:
                write_text(path, NEW.replace("{}", os.path.splitext(name)[0].replace("_", " "), 1))
                number = min(now.state.chosen + 1, len(document.scene.objects))
                scene = changed(document.scene, f"object.{number}.model", path)
        except (OSError, Mistake) as error:
            reason = one_line(getattr(error, "strerror", None) or error)
            self._refused = words["refused"].format(name, reason)
            return None
        self._asked, self.path = "", path
        self._chosen = _chosen(scene, now.state)
        return scene

    def _notes(self, document, words):
        """Say what has to be decided about the file, with a button for each way."""
        texts, path = document.texts, self.path
        if self._refused:
            wrapped(self._refused, BAD)
        if path in texts.moved:
            wrapped(words["moved"], BAD)
            if _button(words["theirs"], ""):
                self._read(document, texts.forget)
            imgui.same_line()
            if _button(words["mine"], ""):
                texts.keep(path)
        elif texts.left(path):
            wrapped(words["left"], DIM)
            if _button(words["take"], ""):
                self._read(document, texts.take)
            imgui.same_line()
            if _button(words["decline"], ""):
                texts.decline(path)

    def _read(self, document, change):
        """Have another text for the file, which change(path) sees to."""
        change(self.path)
        document.read([self.path])

    def _foot(self, fault, words):
        """Say what is wrong, below the text; a click goes there."""
        if not fault:
            return
        found = _WHERE.match(fault)
        wrapped(shortened(fault), BAD)
        if found and imgui.is_item_hovered():
            imgui.set_tooltip(words["go"])
        if found and imgui.is_item_clicked() and os.path.isfile(found.group(1)):
            self.path = os.path.abspath(found.group(1))
            if self.path in self.sheets:
                self.sheets[self.path].seeks = True


def _chosen(scene, state):
    """Return the path of the model of the object that is chosen, or "" where there is none."""
    models = [one.model.path for one in scene.objects]
    return models[min(state.chosen, len(models) - 1)] if models else ""


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


def _along(label):
    """Let the next button stand beside the last one, where there is room for it."""
    imgui.same_line()
    wide = imgui.calc_text_size(label).x + 2.0 * imgui.get_style().frame_padding.x
    if imgui.get_content_region_avail().x < wide:
        imgui.new_line()


def _button(label, tip, able=True):
    imgui.begin_disabled(not able)
    pressed = imgui.button(label)
    imgui.end_disabled()
    if tip:
        imgui.set_item_tooltip(tip)
    return pressed
