"""What is shown beside the scene that is open, and what the mouse and files do to all of it."""

import contextlib
import os
from typing import NamedTuple

from . import compare, contrast, opening
from . import lesson as lessons
from .compare import Comparison, Variant
from .comparing import TEXT
from .errors import Mistake, one_line
from .scene import Scene


class Opened(NamedTuple):
    """What an Edit has begun with, and its page of that.

    stops are those of a Lesson, else []; pages: (captions, Scene) of each; name: of the scene, and
    path that of its file, or "".
    """

    stops: list
    pages: list
    page: int
    name: str
    path: str


class Edit(NamedTuple):
    """What a step of the history leads to: the scene as edited, and what is compared."""

    scene: Scene
    comparison: Comparison = Comparison()
    opened: Opened | None = None


class Shown(NamedTuple):
    """A picture that is wanted: its Scene, or None and the line of what keeps it from being made.

    caption: {language: line}, what sets it apart from the others.
    """

    scene: Scene | None
    fault: str
    caption: dict


def opened(scene, name="", path=""):
    """Return what is Opened with a Scene or a Lesson, at its first page."""
    stops = lessons.stops(scene) if isinstance(scene, lessons.Lesson) else []
    pages = [({}, stop.step.scene) for stop in stops] or opening.pages(scene)
    return Opened(stops, pages, 0, name, path)


class Beside:
    """The pictures of a Document, and all that is done to several of them at once."""

    def __init__(self, document):
        self._document, self._memory, self._last = document, {}, {}
        self._known = (None, None, [])
        self.home = Comparison()  # as it was opened

    @property
    def comparison(self):
        """The Comparison that is shown."""
        return self._document.history.scene.comparison

    @property
    def pictures(self):
        """The pictures of the comparison, each a Shown."""
        scene, comparison, found = self._known
        if scene is not self._document.scene or comparison is not self.comparison:
            scene, comparison = self._document.scene, self.comparison
            made = [self._made(i, one, scene) for i, one in enumerate(comparison.shown)]
            said = compare.captions(comparison, [one for one, _ in made])
            found = [Shown(*one, words) for one, words in zip(made, said, strict=True)]
            self._known = (scene, comparison, found)
        return found

    @property
    def scenes(self):
        """The scene as edited, and those of the pictures, where they are wrong as they were."""
        others = [one.scene or self._last.get(i) for i, one in enumerate(self.pictures)]
        return [self._document.scene, *filter(None, others)]

    def made(self, edit):
        """Return the scenes of an Edit: the one edited, and those of new pictures."""
        found = [edit.scene]
        for variant in edit.comparison.shown if edit.comparison is not self._known[1] else ():
            with contextlib.suppress(Mistake, OSError):  # told in its picture
                found.append(compare.scene_of(variant, edit.scene))
        return found

    @property
    def files(self):
        """The paths that the values of pictures name, also of those that cannot be made."""
        named = (value for one in self.comparison.variants for _, value in one.values)
        return [value for value in named if isinstance(value, str) and os.path.isabs(value)]

    def said(self, lang):
        """Return the captions of the pictures in a language, after their letters."""
        found = []
        for letter, variant, one in zip(
            compare.LETTERS, self.comparison.shown, self.pictures, strict=False
        ):
            line = one.caption.get(lang) or one.caption.get("en", "")
            line = line or ("", TEXT[lang]["compare"]["kept"])[bool(variant.kept)]
            named = variant.caption and not variant.kept
            found.append(line if named else f"{letter}   {line}".rstrip())
        return found

    def stale(self):
        """Have the pictures made anew: files of theirs are other ones."""
        self._known = (None, None, [])

    def show(self, comparison, key=None):
        """Show something else beside the scene; see `History.push`."""
        if comparison is not self.comparison:
            self._document.step(Edit(self._document.scene, comparison), key)

    def move(self, turn, key):
        """Move camera or light of all pictures: turn(scene) gives a scene in which it is moved."""
        scene = self._document.scene
        edit = Edit(*reversed(compare.moved(self.comparison, scene, turn)))
        if edit != (scene, self.comparison):
            self._document.step(edit, key)

    def look_home(self):
        """Look at all pictures as when they were opened."""
        scene = self._document.scene._replace(camera=self._document.home.camera)
        self._document.step(Edit(scene, compare.looking_as(self.comparison, self.home)))

    def drop(self, path, chosen, index):
        """Bring a file into one of the pictures; chosen: the object meant. Raises Mistake."""
        variant = self.comparison.shown[index]
        before = compare.scene_of(variant, self._document.scene)
        scene = opening.dropped(before, path, chosen)
        if opening.is_scene(path):
            name = os.path.splitext(os.path.basename(path))[0]
            made = Variant((), opening.pages(scene)[0][1], True, dict.fromkeys(("en", "pt"), name))
        elif variant.kept or (pairs := contrast.differences(before, scene)) is None:
            made = Variant((), scene, variant.apart)
        else:
            old = [pair for pair in variant.values if pair[0] not in dict(pairs)]
            made = Variant((*old, *pairs))
        self.show(compare.replaced(self.comparison, index, made))

    def _made(self, index, variant, scene):
        """Return (scene, line of what is wrong) of a picture."""
        try:
            one = compare.scene_of(variant, scene)
        except (Mistake, OSError) as mistake:
            return None, one_line(mistake)
        memory = self._memory.setdefault(index, {})
        self._last[index] = opening.renewed(one, self._document.gate.fresh, memory)
        return self._last[index], ""
