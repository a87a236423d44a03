"""What is open in the window: pages of scenes, their history, and the files they are made from."""

import os
import time

from . import catalog, opening
from . import lesson as lessons
from .clock import Clock
from .errors import Mistake, one_line
from .history import History
from .parts import SCENE
from .scene import Scene
from .watch import Watch


class Document:
    """A scene as edited, and all that it takes to undo, to go back, and to follow saved files.

    scene   a Scene, or a Lesson, each stop of which is a page with a history of its own
    name    of the scene, and path that of its file, or ""
    home    the scene as it was opened; pages and page: (captions, Scene) of a sheet, and which
    stops   of a lesson, one for each page, else []
    fault   the line of what is wrong in a file, until it is put right
    """

    def __init__(self, scene, name="", path=""):
        self.watch, self._fresh, self._memory = Watch(), {}, {}
        self.clock, self._running = Clock(SCENE["time"].high), (None, None)
        self.fault, self.history, self._known = "", None, (None, None)
        self.open(scene, name, path)

    @property
    def scene(self):
        """The scene as it is, its shaders as their files are, its time where the clock runs."""
        if self._known[0] is not self.history.scene:
            now = opening.renewed(self.history.scene, self._fresh, self._memory)
            self._known = (self.history.scene, now)
        if not self.clock.runs:
            return self._known[1]
        still, time = self._known[1], self.clock.time
        if self._running[0] is not still or self._running[1].time != time:
            self._running = (still, still._replace(time=time))
        return self._running[1]

    @property
    def caption(self):
        """{language: line} of what is shown."""
        return self.pages[self.page][0]

    @property
    def stop(self):
        """The Stop of a lesson that is shown, or None."""
        return self.stops[self.page] if self.stops else None

    def open(self, scene, name="", path=""):
        """Show a scene, or the first picture of a sheet, instead of what was shown."""
        self._take(scene)
        self.page = 0
        self.name, self.path = name, path
        self._begin()

    def turn(self, step):
        """Show the picture of the sheet that is so many further on, if there is one."""
        if 0 <= self.page + step < len(self.pages):
            self.page += step
            self._begin()

    def push(self, scene, key=None):
        """Make a scene the one that is; see `History.push`."""
        if scene is not self.scene:
            if self.clock.runs and scene.time != self.scene.time:  # set by hand
                self.clock.start(time.monotonic(), scene.time)
            self.history.push(scene, key)
            self._follow()

    def play(self):
        """Let the time of the scene run, or stop it where it is, as a step to undo."""
        if self.clock.runs:
            scene = self.scene
            self.clock.stop()
            self.push(scene)
        elif uses_time(self.scene):
            self.clock.start(time.monotonic(), self.scene.time)

    def tick(self, now):
        """Take that it is now; return whether the time of the scene runs."""
        if self.clock.runs and not uses_time(self.scene):
            self.clock.stop()
        self.clock.tick(now)
        return self.clock.runs

    def undo(self):
        """Go back a step."""
        self.history.undo()
        self._follow()

    def redo(self):
        """Take the step again that was undone last."""
        self.history.redo()
        self._follow()

    def drop(self, path, chosen=0):
        """Bring a file into the scene, or open it if it is one; chosen: the object meant."""
        try:
            scene = lessons.load(path) if lessons.is_lesson(path) else None
            scene = scene or opening.dropped(self.scene, path, chosen)
            if opening.is_scene(path):
                self.open(scene, os.path.splitext(os.path.basename(path))[0], path)
            else:
                self.push(scene)
            self.fault = ""
        except (Mistake, OSError) as mistake:
            self.fault = one_line(mistake)

    def reload(self, paths=None):
        """Read files again that were saved, or all; return the names of those that could be."""
        own = {self.path} if self.path else set()
        paths = {*opening.sources(self.scene), *own} if paths is None else set(paths)
        try:
            if paths & own:
                is_lesson = lessons.is_lesson(self.path)
                self._take((lessons.load if is_lesson else Scene.load)(self.path))
                self.page = min(self.page, len(self.pages) - 1)
                self._begin()
            shaders = {
                shader.path: catalog.read(shader.kind, shader.name)
                for shader in opening.shaders(self.scene)
                if shader.path in paths
            }
        except Mistake as mistake:
            self.fault = one_line(mistake)
            return []
        self._fresh |= shaders
        self._known, self.fault = (None, None), ""
        return sorted(map(os.path.basename, paths))

    def _take(self, scene):
        """Take the pages of a Scene or of a Lesson."""
        self.stops = lessons.stops(scene) if isinstance(scene, lessons.Lesson) else []
        shots = [stop.shot for stop in self.stops]
        self.pages = [(shot.caption, shot.scene) for shot in shots] or opening.pages(scene)

    def _begin(self):
        self.clock.stop()
        self.home = self.pages[self.page][1]
        if self.history and not self.stops:
            self.history.push(self.home)
        else:
            self.history = History(self.home)
        self._follow()

    def _follow(self):
        self.watch.follow([*opening.sources(self.scene), *([self.path] if self.path else [])])


def uses_time(scene):
    """Return whether a model or a light of a scene changes with its time."""
    return any(p.widget == "time" for shader in opening.shaders(scene) for p in shader.parameters)
