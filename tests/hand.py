"""A hand on the panel: ImGui driven by mouse and keyboard events, without a window or OpenGL."""

from imgui_bundle import imgui

from lumiar import labels, panel, rows, sections, shelf, widgets
from lumiar.history import History

PANEL = (panel, sections, rows, shelf, widgets, labels)  # what draws it
SIZE = (1000, 3000)  # of the screen; high, so that nothing has to be scrolled
_WIDGETS = {
    *("slider_float", "slider_int", "drag_float", "drag_int", "checkbox", "radio_button"),
    *("button", "small_button", "color_button", "invisible_button", "color_picker3"),
    *("begin_combo", "selectable", "input_text_with_hint", "begin_menu", "menu_item_simple"),
    *("collapsing_header", "tree_node", "tree_node_ex"),
}


class Spy:
    """ImGui, noting where each widget was drawn, and what was written.

    places maps "id/…/label" to (left, top, right, bottom).
    """

    def __init__(self):
        self.places, self.path, self.said = {}, [], []

    def __getattr__(self, name):
        true = getattr(imgui, name)
        if name in _WIDGETS:
            return lambda *given, **named: self._drawn(name, true, given, named)
        if name in ("text", "text_colored", "text_unformatted"):
            return lambda *given: (self.said.append(given[-1]), true(*given))[1]
        if name == "push_id":
            return lambda part: (self.path.append(str(part)), true(part))[1]
        if name in ("pop_id", "tree_pop"):
            return lambda: (self.path.pop(), true())[1]
        return true

    def _drawn(self, name, true, given, named):
        got = true(*given, **named)
        label = given[0]
        low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
        self.places["/".join((*self.path, label))] = (low.x, low.y, high.x, high.y)
        if name.startswith("tree_node") and got:
            self.path.append(label.rpartition("###")[2])
        return got


def spied(viewer, patch, modules):
    """Draw a window.Viewer once more and return the Spy that these modules drew through."""
    spy = Spy()
    with patch.context() as patched:
        for module in modules:
            patched.setattr(module, "imgui", spy)
        viewer.due = 1
        viewer.frame()
    return spy


class Hand:
    """A panel with a scene in it, and the events that a person causes; one frame for each."""

    def __init__(self, scene, lang="en", patch=None):
        self.context = imgui.create_context()
        imgui.set_current_context(self.context)
        self.io = imgui.get_io()
        self.io.backend_flags |= imgui.BackendFlags_.renderer_has_textures
        self.io.display_size, self.io.delta_time = SIZE, 1.0 / 60.0
        panel.prepare()
        self.scene, self.history = scene, History(scene)
        self.state = panel.State(lang=lang, home=scene)
        self.patch = patch
        self.frame(3)

    def frame(self, count=1):
        """Draw frames, each with the scene that the one before gave."""
        for _ in range(count):
            self.spy = Spy()
            for module in PANEL:
                self.patch.setattr(module, "imgui", self.spy)
            imgui.new_frame()
            self.scene = panel.draw(self.scene, self.state)
            self.history.push(self.scene, self.state.gesture)
            imgui.render()
            for texture in imgui.get_draw_data().textures or ():
                texture.set_tex_id(1)
                texture.set_status(imgui.ImTextureStatus.ok)

    def place(self, name, share=0.5):
        """Return the pixel at a share of the width of a widget, named by the end of its path."""
        found = [at for path, at in self.spy.places.items() if f"/{path}".endswith(f"/{name}")]
        assert len(found) == 1, (name, found, [*self.spy.places])
        left, top, right, bottom = found[0]
        return left + share * (right - left), (top + bottom) / 2.0

    def sees(self, name):
        """Return whether a widget is there."""
        return any(f"/{path}".endswith(f"/{name}") for path in self.spy.places)

    def move(self, x, y):
        """Move the mouse."""
        self.io.add_mouse_pos_event(x, y)
        self.frame(2)

    def button(self, down, button=0):
        """Press a button of the mouse, the left one, or let it go."""
        self.io.add_mouse_button_event(button, down)
        self.frame(2)

    def click(self, name, share=0.5, button=0):
        """Click on a widget."""
        self.move(*self.place(name, share))
        self.button(True, button)
        self.button(False, button)
        self.frame()

    def drag(self, name, by, share=0.5, steps=5):
        """Drag from a widget by (x, y) pixels."""
        x, y = self.place(name, share)
        self.move(x, y)
        self.button(True)
        for step in range(1, steps + 1):
            self.move(x + by[0] * step / steps, y + by[1] * step / steps)
        self.button(False)

    def key(self, key):
        """Press a key and let it go."""
        self.io.add_key_event(key, True)
        self.frame(2)
        self.io.add_key_event(key, False)
        self.frame(2)

    def type(self, name, text):
        """Type a value into a widget: Ctrl-click, the text, Enter."""
        self.io.add_key_event(imgui.Key.mod_ctrl, True)
        self.frame()
        self.click(name)
        self.io.add_key_event(imgui.Key.mod_ctrl, False)
        self.frame()
        self.io.add_input_characters_utf8(text)
        self.frame(2)
        self.key(imgui.Key.enter)

    def choose(self, name, option):
        """Open a list and click on what it offers."""
        self.click(f"##{name}")
        self.click(option)

    def close(self):
        """End it."""
        imgui.destroy_context(self.context)
