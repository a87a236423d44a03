"""A GLFW window with an OpenGL context, and its mouse and keys as events for imgui and for us."""

import os
import sys
import time

import imgui_bundle  # noqa: F401  before glfw, which then takes the library that imgui uses

# isort: split
import glfw
from imgui_bundle import imgui

from .card import INSTALL, window_context
from .errors import Mistake, one_line
from .files import ASSETS

FONT = os.path.join(ASSETS, "fonts", "DejaVuSans.ttf")
LETTERS = 15.0  # height of a line of text, in points
SMALLEST = (320, 240)
NO_DISPLAY = "no display to open a window on; `lumiar capture` draws without one"
_KEYS = {  # where imgui's name is not glfw's
    **{"LEFT": "left_arrow", "RIGHT": "right_arrow", "UP": "up_arrow", "DOWN": "down_arrow"},
    **{f"{side}_CONTROL": f"{side.lower()}_ctrl" for side in ("LEFT", "RIGHT")},
    **{str(digit): f"_{digit}" for digit in range(10)},
    **{
        f"KP_{name}": f"keypad_{name.lower()}"
        for name in ("ENTER", "ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "DECIMAL", "EQUAL")
    },
    **{f"KP_{digit}": f"keypad{digit}" for digit in range(10)},
}
_SAME = (
    *("TAB", "PAGE_UP", "PAGE_DOWN", "HOME", "END", "INSERT", "DELETE", "BACKSPACE", "SPACE"),
    *("ENTER", "ESCAPE", "MINUS", "PERIOD", "COMMA", "SLASH", "EQUAL", "MENU", "CAPS_LOCK"),
    *("APOSTROPHE", "SEMICOLON", "LEFT_BRACKET", "RIGHT_BRACKET", "BACKSLASH", "GRAVE_ACCENT"),
    *(f"F{number}" for number in range(1, 13)),
    *(f"{side}_{key}" for side in ("LEFT", "RIGHT") for key in ("SHIFT", "ALT", "SUPER")),
    *"ABCDEFGHIJKLMNOPQRSTUVWXYZ",
)
_MODIFIERS = (
    (glfw.MOD_CONTROL, imgui.Key.mod_ctrl),
    (glfw.MOD_SHIFT, imgui.Key.mod_shift),
    (glfw.MOD_ALT, imgui.Key.mod_alt),
    (glfw.MOD_SUPER, imgui.Key.mod_super),
)
_CURSORS = {
    int(imgui.MouseCursor_.text_input): glfw.IBEAM_CURSOR,
    int(imgui.MouseCursor_.resize_ew): glfw.HRESIZE_CURSOR,
    int(imgui.MouseCursor_.resize_ns): glfw.VRESIZE_CURSOR,
}


class Desktop:
    """One window; release it. hidden opens one that needs no display, for tests.

    events holds what came since they were last taken: ("key", key, modifiers), ("press", button,
    modifiers), ("release", button), ("move", (x, y)) in pixels from the top left corner, ("wheel",
    notches), ("drop", paths) and ("other",).
    """

    def __init__(self, size, title, hidden=False):
        self._keys = _key_map()
        self.events, self._windowed, self._last = [], None, time.monotonic()
        self._cursors, self._title = {None: None}, title
        self.window = _open(size, title, hidden)
        try:
            self.context = window_context()
        except Mistake:
            glfw.terminate()
            raise
        glfw.swap_interval(1)
        self._imgui = imgui.create_context()
        self.io = imgui.get_io()
        self.io.set_ini_filename("")
        flags = imgui.BackendFlags_
        self.io.backend_flags |= flags.renderer_has_textures.value
        self.io.config_input_text_cursor_blink = False  # an idle window draws nothing
        self.io.fonts.add_font_from_file_ttf(FONT, LETTERS)
        board = imgui.get_platform_io()
        board.platform_get_clipboard_text_fn = lambda _: self._pasted()
        board.platform_set_clipboard_text_fn = lambda _, text: self._copied(text)
        self._listen()

    def release(self):
        """Close the window; the second time does nothing."""
        if self.window:
            imgui.destroy_context(self._imgui)
            self.context.release()
            glfw.destroy_window(self.window)
            glfw.terminate()
            self.window = None

    @property
    def size(self):
        """Width and height of what is drawn, in pixels; 0 while it is minimised."""
        if glfw.get_window_attrib(self.window, glfw.ICONIFIED):
            return 0, 0
        return glfw.get_framebuffer_size(self.window)

    @property
    def scale(self):
        """How many points of imgui a length of one takes on this monitor: 1, or 2 where fine."""
        wide, pixels = glfw.get_window_size(self.window)[0], self.size[0]
        content = glfw.get_window_content_scale(self.window)[0]
        return max(1.0, content * wide / pixels) if pixels else 1.0

    @property
    def closing(self):
        """Whether the user has asked to close the window."""
        return bool(glfw.window_should_close(self.window))

    def close(self):
        """Ask for the window to be closed."""
        glfw.set_window_should_close(self.window, True)

    def title(self, text):
        """Write the title of the window."""
        if text != self._title:  # a frame need not ask the desktop for it
            glfw.set_window_title(self.window, text)
            self._title = text

    def take(self, wait=0.0):
        """Return the events since the last time; wait for one, up to so many seconds."""
        if wait > 0.0 and not self.events:
            glfw.wait_events_timeout(wait)
        else:
            glfw.poll_events()
        taken, self.events = self.events, []
        return taken

    def use(self):
        """Make the window's context the current one; who drew elsewhere may have left another."""
        glfw.make_context_current(self.window)

    def begin(self):
        """Begin a frame of imgui."""
        window, now = glfw.get_window_size(self.window), time.monotonic()
        self.io.display_size = window
        pixels = self.size
        self.io.display_framebuffer_scale = [
            of / max(1, wide) for of, wide in zip(pixels, window, strict=True)
        ]
        self.io.delta_time = max(1e-4, now - self._last)
        self._last = now
        imgui.new_frame()

    def show(self):
        """Bring what was drawn to the screen, and the mouse in the shape that suits its place."""
        shape = _CURSORS.get(int(imgui.get_mouse_cursor()))
        if shape not in self._cursors:
            self._cursors[shape] = glfw.create_standard_cursor(shape)
        glfw.set_cursor(self.window, self._cursors[shape])
        glfw.swap_buffers(self.window)

    def toggle_full_screen(self):
        """Fill the monitor on which the window mostly is, or go back to what it was before."""
        window = self.window
        if self._windowed:
            glfw.set_window_monitor(window, None, *self._windowed, glfw.DONT_CARE)
            self._windowed = None
            return
        self._windowed = (*glfw.get_window_pos(window), *glfw.get_window_size(window))
        monitor = max(glfw.get_monitors(), key=lambda one: _shared(one, self._windowed))
        mode = glfw.get_video_mode(monitor)
        glfw.set_window_monitor(window, monitor, 0, 0, *mode.size, mode.refresh_rate)

    def _listen(self):
        window = self.window
        glfw.set_key_callback(window, lambda _, key, __, action, held: self.key(key, action, held))
        glfw.set_char_callback(window, lambda _, letter: self.letter(letter))
        glfw.set_cursor_pos_callback(window, lambda _, x, y: self.move(x, y))
        glfw.set_mouse_button_callback(window, lambda _, *how: self.button(*how))
        glfw.set_scroll_callback(window, lambda _, x, y: self.wheel(x, y))
        glfw.set_drop_callback(window, lambda _, paths: self.events.append(("drop", list(paths))))
        glfw.set_window_focus_callback(window, lambda _, has: self.focus(has))
        for listen in (
            *(glfw.set_framebuffer_size_callback, glfw.set_window_content_scale_callback),
            *(glfw.set_window_refresh_callback, glfw.set_window_iconify_callback),
            *(glfw.set_window_close_callback, glfw.set_cursor_enter_callback),
        ):
            listen(window, lambda *_: self.events.append(("other",)))

    def key(self, key, action, held):
        """Take a key, as glfw tells of it."""
        for bit, name in _MODIFIERS:
            self.io.add_key_event(name, bool(held & bit))
        if key in self._keys:
            self.io.add_key_event(self._keys[key], action != glfw.RELEASE)
        self.events.append(("other",) if action == glfw.RELEASE else ("key", key, held))

    def letter(self, letter):
        """Take a typed letter."""
        self.io.add_input_character(letter)
        self.events.append(("other",))

    def move(self, x, y):
        """Take a place of the mouse, in the window's own measure."""
        self.io.add_mouse_pos_event(x, y)
        self.events.append(("move", self._pixel(x, y)))

    def button(self, button, action, held):
        """Take a button of the mouse."""
        self.io.add_mouse_button_event(button, action == glfw.PRESS)
        pressed = action == glfw.PRESS
        self.events.append(("press", button, held) if pressed else ("release", button))

    def wheel(self, x, y):
        """Take a turn of the wheel."""
        self.io.add_mouse_wheel_event(x, y)
        self.events.append(("wheel", y))

    def focus(self, has):
        """Take that the window has, or has not, the keyboard."""
        self.io.add_focus_event(bool(has))
        self.events.append(("other",))

    def _pixel(self, x, y):
        window = glfw.get_window_size(self.window)
        return tuple(
            place * pixels / max(1, wide)
            for place, pixels, wide in zip((x, y), self.size, window, strict=True)
        )

    def _pasted(self):
        text = glfw.get_clipboard_string(self.window)
        return text.decode("utf-8", "replace") if text else ""

    def _copied(self, text):
        glfw.set_clipboard_string(self.window, text)


def has_display():
    """Return whether there is a display to open a window on."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def _open(size, title, hidden):
    """Return a glfw window with an OpenGL 3.3 core context, which becomes the current one."""
    said = []
    glfw.set_error_callback(lambda _, text: said.append(text.decode("utf-8", "replace")))
    platform = glfw.PLATFORM_NULL if hidden else glfw.ANY_PLATFORM
    glfw.init_hint(glfw.PLATFORM, platform)
    if not hidden and not has_display():
        raise Mistake(NO_DISPLAY)
    if not glfw.init():
        raise Mistake(f"{NO_DISPLAY} ({one_line(said[-1] if said else 'no reason given', 120)})")
    glfw.default_window_hints()
    hints = {
        glfw.CONTEXT_VERSION_MAJOR: 3,
        glfw.CONTEXT_VERSION_MINOR: 3,
        glfw.OPENGL_PROFILE: glfw.OPENGL_CORE_PROFILE,
        glfw.OPENGL_FORWARD_COMPAT: True,  # macOS gives no core profile without it
        glfw.DEPTH_BITS: 0,
        glfw.STENCIL_BITS: 0,
        glfw.ALPHA_BITS: 0,  # else some desktops let what is behind shine through
        glfw.SCALE_TO_MONITOR: True,
    }
    if hidden:
        hints[glfw.CONTEXT_CREATION_API] = glfw.EGL_CONTEXT_API
    for hint, value in hints.items():
        glfw.window_hint(hint, value)
    window = glfw.create_window(*size, title, None, None)
    if not window:
        glfw.terminate()
        reason = one_line(said[-1] if said else "no reason given", 120)
        raise Mistake(f"no window with OpenGL 3.3 could be opened ({reason}); {INSTALL}")
    if not hidden:  # where glfw takes DONT_CARE for a size
        glfw.set_window_size_limits(window, *SMALLEST, glfw.DONT_CARE, glfw.DONT_CARE)
    glfw.make_context_current(window)
    return window


def _key_map():
    """Return {glfw's key: imgui's key}."""
    names = {**{name: name.lower() for name in _SAME}, **_KEYS}
    return {getattr(glfw, f"KEY_{ours}"): getattr(imgui.Key, its) for ours, its in names.items()}


def _shared(monitor, place):
    """Return how many pixels of a monitor a window at (x, y, width, height) covers."""
    area = (*glfw.get_monitor_pos(monitor), *glfw.get_video_mode(monitor).size)
    sides = (
        min(place[k] + place[k + 2], area[k] + area[k + 2]) - max(place[k], area[k])
        for k in range(2)
    )
    across, down = (max(0, side) for side in sides)
    return across * down
