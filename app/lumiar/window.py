"""The window: input → next Scene, its picture, the panel on it; drawn only when something moved."""

import math
import time

from imgui_bundle import imgui

from . import banner, gallery, handles, labels, opening, panel, presenter, snapshot, words
from .desktop import LETTERS, Desktop, glfw
from .document import Document
from .drawer import TOOLS, Drawer, Now
from .errors import Mistake, one_line
from .files import shortened, unused
from .overlay import Overlay
from .phrases import TEXT
from .pointer import Pointer
from .stage import REST, Stage
from .trial import Trial

SIZE = (1280, 800)
IDLE, SOON = 0.15, 0.005  # seconds between two looks at the files, and while one is being saved
FRAMES = 3  # that imgui takes to settle after an event
CALM = 0.09  # seconds between two frames in which nothing but time has passed
LINGER = 0.7  # seconds after which a tooltip has come up
NOTICE = 4.0  # seconds that a message of something done stays
KEEP = 2.0  # seconds between two times that the scene is put by
_TOOL_KEYS = {getattr(glfw, f"KEY_{key}"): name for name, key in TOOLS.items()}
_TURNS = {glfw.KEY_PAGE_DOWN: 1, glfw.KEY_RIGHT: 1, glfw.KEY_PAGE_UP: -1, glfw.KEY_LEFT: -1}


class Viewer:
    """A window with a scene; `run` it, or turn it frame by frame, then release it, or use `with`.

    name and path are those of the scene; hidden opens it without a display.
    """

    def __init__(self, scene, lang, name="", path="", hidden=False, size=SIZE):
        self.document = scene if isinstance(scene, Document) else Document(scene, name, path)
        self.trial = Trial()
        if self.document.gate.own(self.scene):
            self.trial.start()  # while the window opens
        self.desktop = Desktop(size, "Lumiar", hidden)
        context = self.desktop.context
        self.stage, self.overlay, self.drawer = Stage(context), Overlay(context), Drawer()
        panel.prepare(LETTERS * self.desktop.scale)
        imgui.get_style().scale_all_sizes(self.desktop.scale)
        self.state = panel.State(lang=lang, tools=tuple(TOOLS))
        self.presenter, self.handles = presenter.Presenter(self.overlay), handles.Handles()
        self.presents = bool(self.document.stop)
        self.fault, self.notice = "", ("", 0.0)
        self.moved = self.awake = self.painted = 0.0
        self.pointer, self._seen = Pointer(self.stage, self.document.beside), None
        self.with_panel, self.with_keys, self.due = True, False, FRAMES
        self.kept, self.kept_at = None, time.monotonic()
        self.trial.driver = self.stage.renderer.name
        self.document.guard(self.trial)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.release()

    def release(self):
        """Put the scene by, and close the window; the second time does nothing."""
        if self.desktop.window:
            self._keep()
            self.desktop.use()
            self.trial.release()
            self.drawer.release()
            self.stage.release()
            self.overlay.release()
            self.desktop.release()

    @property
    def scene(self):
        """The scene as edited."""
        return self.document.scene

    def run(self):
        """Turn until the window is closed."""
        while not self.desktop.closing:
            now, soon = time.monotonic(), self.trial.busy or self.document.watch.restless
            wait = SOON if soon else min(IDLE, 0.1) if self._lingers(now) else IDLE
            wait = 0.0 if self.due and 0 not in self.desktop.size else wait
            self.frame(max(0.0, min(wait, self.state.wake - now)))

    def frame(self, wait=0.0):
        """Take what came, for up to `wait` seconds; draw if anything moved; return whether."""
        events, now = self.desktop.take(wait), time.monotonic()
        self.due = max(self.due, now >= self.state.wake)
        if self.document.tick(now):
            self.due, self.moved = max(self.due, 1), now
        saved, typed = self.document.watch.changed(now), self.document.look(now)
        tried = self.document.settle()
        if events or saved or typed or tried is not None or self.due or self._lingers(now):
            self.desktop.use()
        if events or typed:
            self.due, self.awake = FRAMES, now + LINGER
        for event, *how in events:
            getattr(self, f"_on_{event}")(*how)
        if saved:
            self._reload(saved)
        if tried is not None:
            self._renewed(tried)
        self._notice_step()
        if not (self.due or self._lingers(now)) or 0 in self.desktop.size:
            if now - self.kept_at > KEEP:
                self._keep()
            return False
        self.due, self.painted = max(0, self.due - 1), now
        self._frame(now)
        return True

    def _lingers(self, now):
        waits = now < self.awake or now < self.notice[1] or self.stage.coarse
        return waits and now - self.painted > CALM

    def _frame(self, now):
        desktop = self.desktop
        high = glfw.get_window_size(desktop.window)[1] if self.presents else 0
        imgui.get_style().font_size_base = max(high / presenter.LINES, LETTERS * desktop.scale)
        desktop.begin()
        self.state.restless, self.state.wake = False, math.inf
        if self.with_panel:
            self.state.view, self.state.tool = self.stage.view, self.drawer.open
            self.state.home = self.document.home
            self.state.able, self.state.runs = self.document.history.able, self.document.clock.runs
            parts = self.presenter.parts(self.document) if self.presents else panel.ALL
            self._push(panel.draw(self.scene, self.state, parts), self.state.gesture)
            self._wish()
        else:
            self.state.width = 0.0
        self._push(self.drawer.draw(self._now(now)), labels.gesture(self.state))
        self.due = max(self.due, 2 * self.state.restless)
        self._notice_step()
        (left, size), broken = self._area(), self.stage.broken
        self.stage.draw(self.document.beside, self.scene, size, now - self.moved)
        self.pointer.keep(left)
        self.due = max(self.due, self.stage.begun, FRAMES * (self.stage.broken != broken))
        self.trial.expect(size, self.stage.cost)
        if self.stage.busy:
            self.state.wake = min(self.state.wake, now + IDLE)
        self._say_over(left, size, now)
        imgui.render()
        self.stage.present(self.overlay, left)
        self.overlay.widgets(imgui.get_draw_data(), desktop.context.screen, desktop.size)
        desktop.show()
        desktop.title(f"{self.document.name} · Lumiar".removeprefix(" · "))

    def _area(self):
        """Return (left, (width, height)) in pixels of where the picture goes."""
        width, height = self.desktop.size
        fine = width / imgui.get_io().display_size.x
        right = width - round(self.drawer.width * fine)
        left = min(round(self.state.width * fine), width - 1)
        return left, (max(1, right - left), height)

    def _now(self, now):
        """Return what the tools are told."""
        stage, state = self.stage, self.state
        fault = self.document.fault or stage.fault
        pointed = None if self.desktop.io.want_capture_mouse else self.pointer.pixel
        return Now(
            *(self.scene, stage.shown, stage.view, self.pointer.picked, pointed),
            *(fault, now - self.moved > REST, state, words.TEXT[state.lang]),
            *(stage, self.overlay, self.document, stage.corner(self._area()[0]), now),
        )

    def _wish(self):
        """Do what a button of the panel asks for."""
        wish, self.state.wish = self.state.wish, ""
        if self.state.path:
            self._on_drop([self.state.path])
            self.state.path, self.due = "", FRAMES
        if wish:
            self.drawer.toggle(wish) if wish in TOOLS else getattr(self.document, wish)()
            self.due = FRAMES

    def _say_over(self, left, size, now):
        """Say over the picture what has to be said."""
        words, document = TEXT[self.state.lang], self.document
        caption = gallery.caption(document, self.state.lang)
        fault = shortened(document.fault or self.stage.fault or self.fault)
        fault = f"{fault}\n{words['last']}" if fault else ""
        broken = words["broken"].format(self.stage.broken) if self.stage.broken else ""
        fault = fault or ("" if self.with_panel else self.state.message) or broken
        done = self.notice[0] if now < self.notice[1] and not fault else ""
        points = imgui.get_io().display_size.x / self.desktop.size[0]
        area = (left * points, size[0] * points, size[1] * points)
        marked = None if self.presents or self.stage.mode != "one" else self.stage.shown
        self.handles.draw(marked, self.stage.view, left, self.state.lamp)
        banner.draw(area, f"{1000.0 * self.stage.cost:.1f} ms", caption, fault, done)
        gallery.draw(
            self.stage, document.beside.said(self.state.lang), left, points, self.state.lang
        )
        if self.with_keys:
            banner.keys(area, words["keys"])

    def _push(self, scene, key=None):
        if scene is not self.scene:
            self.document.push(scene, key)

    def _notice_step(self):
        """Take note of a change of the scene, or of what is shown beside it."""
        if self.document.history.scene is not self._seen:
            self._seen, self.fault = self.document.history.scene, ""
            self.due, self.moved = FRAMES, time.monotonic()

    def _on_press(self, button, held):
        if not self.desktop.io.want_capture_mouse:
            grabbed = self.handles.at(self.pointer.place)
            self.state.lamp = self.state.lamp if grabbed is None else grabbed
            self.pointer.press(button, held, self.state.lamp, grabbed is not None)

    def _on_release(self, _):
        self.pointer.release()
        self.document.history.push(self.document.history.scene)  # ends the step

    def _on_move(self, place):
        self.pointer.move(place)

    def _on_wheel(self, notches):
        if not self.desktop.io.want_capture_mouse:
            self.pointer.wheel(notches)

    def _on_drop(self, paths):
        for path in paths:
            self.document.drop(path, self.state.chosen, self.pointer.index)
        self.presents = self.presents or bool(self.document.stop)

    def _on_other(self):
        """Only drawn again."""

    def _on_key(self, key, held):
        io, popup = self.desktop.io, imgui.PopupFlags_.any_popup
        typed = io.want_text_input and not glfw.KEY_F1 <= key <= glfw.KEY_F12
        if typed or (key == glfw.KEY_ESCAPE and imgui.is_popup_open("", popup)):
            return
        document, forward = self.document, held & glfw.MOD_SHIFT
        if held & (glfw.MOD_CONTROL | glfw.MOD_SUPER):
            if key in (glfw.KEY_Z, glfw.KEY_Y):
                (document.redo if forward or key == glfw.KEY_Y else document.undo)()
        elif key == glfw.KEY_R:
            document.beside.look_home()
        elif key in _TURNS and forward and self.stage.mode == "split":
            self.stage.slide(0.05 * _TURNS[key])
        elif key in _TURNS:
            document.turn(_TURNS[key])
        elif key == glfw.KEY_SPACE:
            document.play()
        elif key == glfw.KEY_L:
            self.handles.shown = not self.handles.shown
        elif key == glfw.KEY_P:
            self.presents = not self.presents
        elif key in _TOOL_KEYS:
            self.drawer.toggle(_TOOL_KEYS[key])
        elif key == glfw.KEY_F5:
            self.stage.restart()
            self.trial.forget()
            self._reload(None)
        elif key == glfw.KEY_F12:
            self._screenshot()
        elif key == glfw.KEY_F11:
            self.desktop.toggle_full_screen()
        elif key == glfw.KEY_H:
            self.with_panel = not self.with_panel
        elif key == glfw.KEY_F1:
            self.with_keys = not self.with_keys
        elif key == glfw.KEY_ESCAPE:
            self.desktop.close()

    def _reload(self, paths):
        self._renewed(self.document.reload(paths))
        self.stage.stale()

    def _renewed(self, names):
        self.due = FRAMES
        if names:
            self._tell("reloaded", ", ".join(names))

    def _screenshot(self):
        path = unused("lumiar", ".png")
        try:
            snapshot.write(self.stage, self.document, self.state.lang, path)
        except (Mistake, OSError) as error:
            self.fault = one_line(error)
        else:
            self.fault = ""
            self._tell("saved", path)

    def _tell(self, word, what):
        self.notice = TEXT[self.state.lang][word].format(what), time.monotonic() + NOTICE

    def _keep(self):
        self.document.texts.put_by()
        good = self.stage.good
        if self.kept is not good and good is not None:
            opening.keep(good)
            self.kept, self.kept_at = good, time.monotonic()
