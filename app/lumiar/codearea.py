"""The text of a file in the window: coloured, numbered, to be edited, a mistake on its line."""

import os

from imgui_bundle import imgui
from imgui_bundle import imgui_color_text_edit as ed

from .files import ASSETS

FONT = os.path.join(ASSETS, "fonts", "DejaVuSansMono.ttf")
_BAD = (imgui.IM_COL32(255, 90, 80, 255), imgui.IM_COL32(120, 30, 30, 150))


class Code:
    """A text with its own undo; seeks: whether to go to what is wrong, once something is."""

    def __init__(self, text, is_glsl):
        self.area, self.text, self.seeks, self._marked = ed.TextEditor(), text, True, None
        if is_glsl:
            self.area.set_language(ed.TextEditor.Language.glsl())
        self.area.set_palette(ed.TextEditor.get_dark_palette())
        self.area.set_show_whitespaces_enabled(False)
        self.area.set_complete_paired_glyphs(False)  # it leaves those there that are typed, too
        self.area.set_tab_size(4)
        self.area.set_insert_spaces_on_tabs(True)
        self.area.set_text(text)

    def draw(self, text, height, fixed):
        """Draw the text, or what it has become elsewhere; return it as typed just now, or None.

        fixed says that it can only be read.
        """
        em = imgui.get_font_size()
        if text != self.text:
            self.replace(text)
        self.area.set_read_only_enabled(fixed)
        imgui.push_font(font(em), 0.95 * em)
        typed = self.area.render("##code", (0.0, max(4.0 * em, height)))
        imgui.pop_font()
        if not typed:
            return None
        ended = self.text.endswith("\n")  # what ImGui's editor gives always does
        self.text = self.area.get_text() if ended else self.area.get_text().removesuffix("\n")
        self.seeks = False
        return self.text

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
        self.text, self.seeks, self._marked = text, True, None

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


def font(size):
    """Return the font of fixed pitch, read when it is first asked for in a context of ImGui."""
    fonts = imgui.get_io().fonts
    name = os.path.basename(FONT)
    known = (one for one in fonts.fonts if one.get_debug_name().startswith(name))
    return next(known, None) or fonts.add_font_from_file_ttf(FONT, size)
