"""What is open in the window: pages of scenes, their history, and the files they are made from."""

import os
from typing import NamedTuple

from . import catalog, compare, contrast, opening
from . import lesson as lessons
from .errors import Mistake, one_line
from .history import History
from .scene import Scene
from .watch import Watch


class Edit(NamedTuple):
    """What a step of the history leads to: the scene, and what is shown beside it."""

    scene: Scene
    comparison: compare.Comparison


class Shown(NamedTuple):
    """A picture that is wanted: its Scene, or None and the line of what keeps it from being made.

    caption: {language: line}, what sets it apart from the others.
    """

    scene: Scene | None
    fault: str
    caption: dict


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
        self.fault, self.history, self._known = "", None, (None, None)
        self._pictures = (None, None, [])
        self.open(scene, name, path)

    @property
    def scene(self):
        """The scene as it is, its shaders as their files are."""
        if self._known[0] is not self.history.scene.scene:
            now = opening.renewed(self.history.scene.scene, self._fresh, self._memory)
            self._known = (self.history.scene.scene, now)
        return self._known[1]

    @property
    def comparison(self):
        """The Comparison that says what is shown beside the scene."""
        return self.history.scene.comparison

    @property
    def pictures(self):
        """The pictures of the comparison, each a Shown."""
        scene, comparison, found = self._pictures
        if scene is not self.scene or comparison is not self.comparison:
            made = [self._made(i, one) for i, one in enumerate(self.comparison.shown)]
            said = compare.captions(self.comparison, [one for one, _ in made])
            found = [Shown(*one, words) for one, words in zip(made, said, strict=True)]
            self._pictures = (self.scene, self.comparison, found)
        return found

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

    def said(self, lang):
        """Return the captions of the pictures in a language, after their letters."""
        found = []
        for letter, variant, one in zip(
            compare.LETTERS, self.comparison.shown, self.pictures, strict=False
        ):
            line = one.caption.get(lang) or one.caption.get("en", "")
            found.append(line if variant.caption and not variant.kept else f"{letter}   {line}")
        return found

    def push(self, scene, key=None):
        """Make a scene the one that is; see `History.push`."""
        if scene is not self.scene:
            self._step(Edit(scene, self.comparison), key)

    def compare(self, comparison, key=None):
        """Show something else beside the scene; see `History.push`."""
        if comparison is not self.comparison:
            self._step(Edit(self.scene, comparison), key)

    def move(self, turn, key):
        """Move camera or light of all pictures: turn(scene) gives a scene in which it is moved."""
        comparison, scene = compare.moved(self.comparison, self.scene, turn)
        if (scene, comparison) != (self.scene, self.comparison):
            self._step(Edit(scene, comparison), key)

    def look_home(self):
        """Look at all pictures as when they were opened."""
        scene = self.scene._replace(camera=self.home.camera)
        self._step(Edit(scene, compare.looking_as(self.comparison, self._beside)))

    def undo(self):
        """Go back a step."""
        self.history.undo()
        self._follow()

    def redo(self):
        """Take the step again that was undone last."""
        self.history.redo()
        self._follow()

    def drop(self, path, chosen=0, onto=0):
        """Bring a file into the scene, or open it if it is one; chosen: the object meant.

        onto: which picture is meant, where several are shown; the first one is the scene.
        """
        try:
            if onto and not lessons.is_lesson(path):
                self.compare(self._dropped(path, chosen, onto))
                self.fault = ""
                return
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
        paths = {*self._sources(), *own} if paths is None else set(paths)
        try:
            if paths & own:
                is_lesson = lessons.is_lesson(self.path)
                self._take((lessons.load if is_lesson else Scene.load)(self.path))
                self.page = min(self.page, len(self.pages) - 1)
                self._begin()
            shaders = {
                shader.path: catalog.read(shader.kind, shader.name)
                for one in self._scenes()
                for shader in opening.shaders(one)
                if shader.path in paths
            }
        except Mistake as mistake:
            self.fault = one_line(mistake)
            return []
        self._fresh |= shaders
        self._known, self._pictures, self.fault = (None, None), (None, None, []), ""
        return sorted(map(os.path.basename, paths))

    def _take(self, scene):
        """Take the pages of a Scene or of a Lesson."""
        self.stops = lessons.stops(scene) if isinstance(scene, lessons.Lesson) else []
        shots = [stop.shot for stop in self.stops]
        self.pages = [(shot.caption, shot.scene) for shot in shots] or opening.pages(scene)

    def _begin(self):
        self.home, compared = self.pages[self.page][1], compare.Comparison()
        self._beside = compared
        if self.history and not self.stops:
            self.history.push(Edit(self.home, self.comparison))
        else:
            self.history = History(Edit(self.home, compared))
        self._follow()

    def _step(self, edit, key=None):
        self.history.push(edit, key)
        self._follow()

    def _made(self, index, variant):
        """Return (scene, line of what is wrong) of a picture."""
        try:
            one = compare.scene_of(variant, self.scene)
        except (Mistake, OSError) as mistake:
            return None, one_line(mistake)
        if variant.kept:
            one = opening.renewed(one, self._fresh, self._memory.setdefault(index, {}))
        return one, ""

    def _dropped(self, path, chosen, onto):
        """Return the comparison with a file in one of its pictures."""
        variant = self.comparison.shown[onto]
        before = compare.scene_of(variant, self.scene)
        scene = opening.dropped(before, path, chosen)
        if opening.is_scene(path):
            name = os.path.splitext(os.path.basename(path))[0]
            _, scene = opening.pages(scene)[0]
            made = compare.Variant(
                kept=scene, apart=True, caption=dict.fromkeys(("en", "pt"), name)
            )
        else:
            made = variant._replace(kept=scene, caption={})
            pairs = contrast.differences(before, scene)
            if variant.kept is None and pairs is not None:
                old = {key: value for key, value in variant.values if key not in dict(pairs)}
                made = compare.Variant((*old.items(), *pairs))
        return compare.replaced(self.comparison, onto, made)

    def _scenes(self):
        """Return the scene, and those beside it."""
        return [self.scene, *(one.scene for one in self.pictures if one.scene)]

    def _sources(self):
        named = (value for one in self.comparison.variants for _, value in one.values)
        files = (value for value in named if isinstance(value, str) and os.path.isabs(value))
        found = (path for one in self._scenes() for path in opening.sources(one))
        return list(dict.fromkeys((*found, *files)))

    def _follow(self):
        self.watch.follow([*self._sources(), *([self.path] if self.path else [])])
