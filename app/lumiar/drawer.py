"""The tools at the right of the picture: one is open at a time, made when it is first asked for."""

from typing import NamedTuple

from imgui_bundle import imgui

from .words import TEXT

# {name: its key}, in the order of their buttons
TOOLS = {
    **{"compare": "F2", "plots": "F3", "sheet": "F4", "probe": "F6"},
    **{"editor": "F7", "film": "F8", "study": "F9"},
}
WIDE, NARROWEST = 0.34, 18.0  # share of the window, and the least in sizes of letters
WIDEST = 0.7  # share of what the panel leaves
WIDER = {"editor": 0.42}  # share for what has long lines


class Now(NamedTuple):
    """What a tool is told in every frame.

    scene    as edited; what `draw` returns takes its place
    shown    the last one that could be drawn, as framed for the picture; view its (eye, target)
    picked   pixel (x, y) of the picture that was clicked, or None; pointed: that below the mouse
    fault    the line of what is wrong, while something is
    rests    whether nothing has changed for a moment: the time for what takes long
    state    panel.State; words: those of its language
    stage    the picture, with its renderer and context; images: Overlay, see `image` there
    document what is open, and its files
    corner   (x, y) of the window where that picture begins, in pixels
    time     of this frame, in seconds
    """

    scene: object
    shown: object
    view: tuple
    picked: tuple | None
    pointed: tuple | None
    fault: str
    rests: bool
    state: object
    words: dict
    stage: object
    images: object
    document: object
    corner: tuple
    time: float


class Drawer:
    """The window of ImGui in which the open tool stands; release it.

    A tool has `draw(now)`, which draws its widgets and returns the scene, and `release()`. It sets
    now.state.restless where it has to be drawn once more, though nothing happens; and
    now.state.wake where that is so at a later moment.
    """

    def __init__(self):
        self._made, self.open, self.width = {}, "", 0.0
        self._kept = {}  # {tool: (room and letters, share of that room, width)}

    def release(self):
        """Free what the tools have."""
        for tool in self._made.values():
            tool.release()
        self._made.clear()

    def toggle(self, name):
        """Open a tool, or close it where it is the one that is open."""
        self.open = "" if name == self.open else name

    @property
    def tool(self):
        """The tool that is open, or None."""
        return self._made.get(self.open)

    def draw(self, now):
        """Draw the open tool and return the scene as changed in it; without one do nothing."""
        self.width = 0.0
        if not self.open:
            return now.scene
        if self.open not in self._made:
            self._made[self.open] = _made(self.open, now)
        area, em = imgui.get_main_viewport(), imgui.get_font_size()
        room, height = area.work_size
        right = area.work_pos.x + room
        imgui.set_next_window_pos((right, area.work_pos.y), 0, (1.0, 0.0))
        name, least, first = self.open, NARROWEST * em, WIDER.get(self.open, WIDE)
        known, share, before = self._kept.get(name, (None, first, 0.0))
        if known != (room, em):  # it keeps its share of a window that has another size
            imgui.set_next_window_size((max(least, share * room), height))
        most = max(least, WIDEST * (room - now.state.width))
        imgui.set_next_window_size_constraints((least, height), (most, height))
        flags = imgui.WindowFlags_.no_move | imgui.WindowFlags_.no_collapse
        title = f"{TEXT[now.state.lang]['tools'][self.open]}###{self.open}"
        shown, stays = imgui.begin(title, True, flags | imgui.WindowFlags_.no_saved_settings)
        scene = self.tool.draw(now) if shown else now.scene
        self.width = imgui.get_window_width()
        if known == (room, em) and self.width != before:  # by hand
            share = self.width / room
        self._kept[name] = (room, em), share, self.width
        imgui.end()
        if not stays:
            self.open = ""
        return scene


def _made(name, now):
    """Return a tool; what it needs is imported only here."""
    if name == "compare":
        from .comparison import Comparing

        return Comparing()
    if name == "sheet":
        from .datasheet import Datasheet

        return Datasheet(now)
    if name == "editor":
        from .editor import Editor

        return Editor()
    if name == "film":
        from .filming import Filming

        return Filming()
    if name == "plots":
        from .plotter import Plots

        return Plots(now)
    if name == "probe":
        from .prober import Prober

        return Prober(now)
    if name == "study":
        from .bargains import Bargains

        return Bargains()
    raise ValueError(name)
