"""What is open in the window: pages of scenes, their history, and the files they are made from."""

import os
import time

from . import compare, opening
from . import lesson as lessons
from .beside import Beside, Edit, opened
from .clock import Clock
from .errors import Mistake, one_line
from .gate import Gate
from .history import History
from .parts import SCENE
from .scene import Scene
from .texts import Texts, at_fault
from .watch import Watch


class Document:
    """A scene as edited, and all that it takes to undo, to go back, and to follow saved files.

    scene   a Scene, or a Lesson, each stop of which is a page with a history of its own
    name    of the scene, and path that of its file, or ""
    opened  the page that is shown, and of what, as to undo: its fields are there by their names
    home    the scene as it was opened; pages and page: (captions, Scene) of a sheet, and which
    stops   of a lesson, one for each page, else []
    beside  what is shown beside the scene
    texts   what is edited and not saved, and what is wrong in which file; restored: as it was left
    gate    what comes into the scene of what was edited

    load() returns the scene once more, should it have to be opened again.
    """

    def __init__(self, scene, name="", path="", restored=False, load=None):
        self.watch, self.texts, self._load = Watch(), Texts(restored), load
        self.gate = Gate(self.texts)
        self.clock, self._running = Clock(SCENE["time"].high), (None, None)
        self.history, self._known, self._waiting = None, (None, None), None
        self.beside = Beside(self)
        self.open(scene, name, path)
        self.read(self.texts.drafts)

    @staticmethod
    def expecting(load, name, path, mistake):
        """Return a Document of a scene whose file has a mistake, opened once that is put right.

        load() returns the scene. Until then the default scene is in its place. Raises the mistake
        where it names no file that could be edited.
        """
        if not at_fault(mistake):
            raise mistake
        document = Document(Scene.default())
        document._expect(load, name, path, mistake)
        return document

    def guard(self, trial):
        """Have a trial.Trial draw what is edited before it comes into the scene, now and later."""
        self.gate.trial, scene = trial, self.history.scene.scene
        try:
            self.gate.admit(self.beside.made(self.history.scene))
        except Mistake as mistake:
            load, name, path = self._load or (lambda: opening.reread(scene)), self.name, self.path
            self.gate.fresh.clear()
            self.history = None  # none of its steps may be taken again
            self.open(Scene.default())
            self._expect(load, name, path, mistake)

    @property
    def fault(self):
        """The line of what is wrong in a file of the scene, until it is put right."""
        faults = self.texts.faults
        return next((faults[path] for path in ("", *self.files) if path in faults), "")

    @property
    def awaits(self):
        """Whether a file has to be put right before its scene can be opened."""
        return self._waiting is not None

    @property
    def files(self):
        """The paths of the files that hold text: awaited, of the scene, its models and lights."""
        awaited = [self._waiting[-1]] if self._waiting else []
        own = [self.path] if self.path else []
        shaders = [shader.path for shader in self._shaders]
        return [*dict.fromkeys((*awaited, *own, *shaders))]

    @property
    def scene(self):
        """The scene as it is, its shaders as their files are, its time where the clock runs."""
        if self._known[0] is not self.history.scene.scene:
            now = self.gate.renewed(self.history.scene.scene)
            self._known = (self.history.scene.scene, now)
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
        new = opened(scene, name, path)
        self.gate.admit([new.pages[0][1]], self.history and self.scene)
        if self._waiting:  # for another one, which nobody wants any more
            self.texts.faults.pop(self._waiting[-1], None)
            self._waiting = None
        self._begin(new)

    def turn(self, step):
        """Show the picture of the sheet that is so many further on, if there is one."""
        page = self.page + step
        if 0 <= page < len(self.pages) and self.gate.admits([self.pages[page][1]], self.scene):
            self._begin(self.opened._replace(page=page))

    def push(self, scene, key=None):
        """Make a scene the one that is; see `History.push`."""
        if scene is not self.scene:
            self.step(Edit(scene, self.beside.comparison), key)

    def step(self, edit, key=None):
        """Make an Edit the one that is; see `History.push`."""
        if self.gate.admits(self.beside.made(edit), self.scene):
            if self.clock.runs and edit.scene.time != self.scene.time:  # set by hand
                self.clock.start(time.monotonic(), edit.scene.time)
            self.history.push(edit._replace(opened=self.opened), key)
            self._follow()

    def play(self):
        """Let the time of the scene run, or stop it where it is, as a step to undo."""
        if self.clock.runs:
            scene = self.scene
            self.clock.stop()
            self.push(scene)
        elif opening.uses_time(self.scene):
            self.clock.start(time.monotonic(), self.scene.time)

    def tick(self, now):
        """Take that it is now; return whether the time of the scene runs."""
        if self.clock.runs and not opening.uses_time(self.scene):
            self.clock.stop()
        self.clock.tick(now)
        return self.clock.runs

    def undo(self):
        """Go back a step."""
        self.history.undo()
        self._take(self.history.scene.opened)
        self._follow()

    def redo(self):
        """Take the step again that was undone last."""
        self.history.redo()
        self._take(self.history.scene.opened)
        self._follow()

    def drop(self, path, chosen=0, onto=0):
        """Bring a file into the scene, or open it if it is one; chosen: the object meant.

        onto: the index of the picture that is meant, where several are shown.
        """
        try:
            scene = lessons.load(path) if lessons.is_lesson(path) else None
            if onto and not scene:
                self.beside.drop(path, chosen, onto)
                return
            scene = scene or opening.dropped(self.scene, path, chosen)
            if opening.is_scene(path):
                self.open(scene, os.path.splitext(os.path.basename(path))[0], path)
            else:
                self.push(scene)
        except (Mistake, OSError) as mistake:
            self.texts.faults[""] = one_line(mistake)

    def reload(self, paths=None):
        """Read files again that were saved, or all; return the names of those that could be."""
        paths = {*self._followed} if paths is None else {*paths}
        if self._waiting and self._waiting[-1] in paths:
            self._expect(*self._waiting[:3])
        if self.path in paths:
            self._load_again()
        files = self.texts.saved(paths)
        self.texts.faults.pop("", None)
        self.read(files)
        return self.gate.names(files)

    def settle(self):
        """Take what was tried by now; return the names of files that came into the scene, or None.

        What is being saved is tried already while it settles.
        """
        self.gate.foresee(self.watch.moving, self.beside)
        if not (decided := self.gate.settle(self.beside)):
            return None
        self._renew()
        return self.gate.names(path for path in decided if path not in self.texts.drafts)

    def look(self, now, at_once=False):
        """Have what was typed in the scene, once it rests; return whether there was anything."""
        quiet = self.gate.quiet(now, at_once)
        self.read(quiet)
        return bool(quiet)

    def rename(self, path, copy):
        """Have the scene use a copy, just written, of the file of a model or a light."""
        self.texts.forget(path)
        scene = opening.renamed(self.scene, path, copy)
        self.gate.rename(path, copy)
        self._known = (None, None)
        self.push(scene)
        self.read([copy])

    def read(self, paths):
        """Read files again, as edited or as saved; those that include them, too."""
        if paths:
            self.gate.read(paths, self.beside)
            self._renew()

    def _renew(self):
        self._known = (None, None)
        self.beside.stale()
        self._follow()

    def _load_again(self):
        """Read the file of the scene again."""
        try:
            is_lesson = lessons.is_lesson(self.path)
            scene = (lessons.load if is_lesson else Scene.load)(self.path)
            new = opened(scene, self.name, self.path)
            new = new._replace(page=min(self.page, len(new.pages) - 1))
            self.gate.admit([new.pages[new.page][1]], self.scene)
        except Mistake as mistake:
            self.texts.faults[self.path] = one_line(mistake)
            return
        self.texts.faults.pop(self.path, None)
        self._begin(new)

    def _expect(self, load, name, path, mistake=None):
        """Open the scene that load() returns; where it has a mistake, keep waiting for it."""
        if self._waiting:
            self.texts.faults.pop(self._waiting[-1], None)
        if not mistake:
            try:
                self.open(load(), name, path)
                self.history = History(self.history.scene)
                return
            except Mistake as again:
                mistake = again
        file = at_fault(mistake) or (self._waiting or [path])[-1]
        self.texts.faults[file] = one_line(mistake)
        self._waiting = (load, name, path, file)
        self._follow()

    def _begin(self, new):
        """Show the page of an Opened; what a lesson compares ends with it."""
        self.clock.stop()
        plain = self.beside.home == compare.Comparison()
        self._take(new)
        if self.history and not self.stops:
            shown = self.beside.comparison if plain else self.beside.home
            self.history.push(Edit(self.home, shown, new))
        else:
            self.history = History(Edit(self.home, self.beside.home, new))
        self._follow()

    def _take(self, new):
        """Take which page is shown, and of what."""
        self.opened = new
        self.stops, self.pages, self.page, self.name, self.path = new
        self.home = self.pages[self.page][1]
        self.beside.home = compare.shots(self.stop.shots) if self.stop else compare.Comparison()

    @property
    def _followed(self):
        """The paths of all files that the scene is made from."""
        sources = (path for one in self.beside.scenes for path in opening.sources(one))
        libraries = self.texts.libraries(self._shaders)
        return [*dict.fromkeys((*self.files, *sources, *self.beside.files, *libraries))]

    @property
    def _shaders(self):
        """The Shaders of the scene, and of those beside it."""
        return [shader for one in self.beside.scenes for shader in opening.shaders(one)]

    def _follow(self):
        before = self.watch.paths
        self.watch.follow(self._followed)
        back = [path for path in self.gate.fresh if path in self.watch.paths - before]
        if back:  # they may have been saved while the scene had no use for them
            self.read(back)
