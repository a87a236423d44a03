"""A lesson: steps in order, each a scene with a title, a caption, a formula, perhaps a question."""

import os
import re
from typing import NamedTuple

from . import scenefile, settings, tomltext
from .content import confine
from .errors import Mistake, nearest
from .files import ASSETS, read_text
from .scene import Scene
from .tomltext import Place

LANGUAGES = scenefile.LANGUAGES
MOST_STEPS, MOST_PICTURES, MOST_SLIDERS = 64, 3, 8
_LESSON = ("title", "source", "scene", "set", "step")
_LENGTHS = {"title": 60, "source": 90, "caption": 360, "formula": 300, "plain": 200}
_LENGTHS |= {"ask": 260, "reveal": 300}  # letters: what a slide can show large
_IS_LESSON = re.compile(r"^\s*\[\[\s*step\s*\]\]", re.M)
_BLANKS = re.compile(r"[ \t]+")  # but no-break spaces
_STEP = (*_LENGTHS, "scene", "set", "sliders", "compare")


class Shot(NamedTuple):
    """One picture of a step; caption {language: line} names it where there are several.

    values are the (key, value) pairs by which its scene differs from that of the step.
    """

    scene: Scene
    caption: dict = {}  # noqa: RUF012  never changed in place
    values: tuple[tuple[str, object], ...] = ()


class Step(NamedTuple):
    """One step of a lesson; every text is {language: text}, empty where there is none.

    formula  LaTeX, line by line, plain the same as text
    ask      what the class is to predict, reveal what it then finds
    sliders  the values that are worth moving here, as `settings.changed` takes them
    shots    the pictures, side by side where there are several; the last one of several is the
             answer to what is asked
    place    where its formula stands, as the beginning of a message
    """

    title: dict
    caption: dict
    formula: dict
    plain: dict
    source: dict
    ask: dict
    reveal: dict
    sliders: tuple[str, ...]
    scene: Scene
    shots: tuple[Shot, ...]
    place: Place

    @property
    def shown(self):
        """The pictures that are shown while the question stands."""
        return self.shots[:-1] if self.ask and len(self.shots) > 1 else self.shots


class Lesson(NamedTuple):
    """A lesson: its short name, its title {language: line}, its steps."""

    name: str
    title: dict
    steps: tuple[Step, ...]


class Stop(NamedTuple):
    """One halt on the way through a lesson: a step, its part ("", "ask", "reveal"), its Shots."""

    step: Step
    part: str
    shots: tuple[Shot, ...]
    number: int  # of the step, from 1
    steps: int


def stops(lesson):
    """Return the Stops of a Lesson: one for each step, a second one for its answer."""
    found, count = [], len(lesson.steps)
    for number, step in enumerate(lesson.steps, 1):
        found.append(Stop(step, "ask" if step.ask else "", step.shown, number, count))
        if step.ask:
            found.append(Stop(step, "reveal", step.shots, number, count))
    return found


def is_lesson(name, folder=""):
    """Return whether a name is that of a lesson, or of a .toml file that has steps."""
    if name in shipped() or not name.lower().endswith(".toml"):
        return name in shipped()
    try:
        path = os.path.join(folder, os.path.expanduser(name))
        return bool(_IS_LESSON.search(read_text(path, scenefile.LIMIT, "a lesson file")))
    except Mistake:
        return False


def shipped():
    """Return the lessons that come with Lumiar, {name: path}."""
    folder = os.path.join(ASSETS, "lessons")
    files = (f for f in sorted(os.listdir(folder)) if f.endswith(".toml"))
    return {f[:-5]: os.path.join(folder, f) for f in files}


def load(name, folder="", where=""):
    """Return the Lesson of a name, or of the path (from `folder`) of a .toml file.

    Raises Mistake naming file:line, or beginning with `where`.
    """
    path = shipped().get(name)
    if not path and not name.lower().endswith(".toml"):
        raise Mistake(f"{where}no lesson '{name}'; {nearest(name, shipped())}, or a .toml file")
    path = path or os.path.join(folder, os.path.expanduser(name))
    return parse(read_text(path, scenefile.LIMIT, "a lesson file"), path)


def parse(text, path):
    """Return the Lesson of TOML text that came from `path`; raise Mistake naming path:line."""
    data, file = tomltext.parse(text, path), _File(text, path)
    _check_keys(data, _LESSON, file.at)
    for key in ("title", "step"):
        if key not in data:
            raise Mistake(f"{file.at(key)}a lesson needs {_sample(key)}")
    steps = data["step"]
    if not isinstance(steps, list) or not all(isinstance(one, dict) for one in steps):
        raise Mistake(f"{file.at('step')}'step' is a section; write [[step]]")
    if not 1 <= len(steps) <= MOST_STEPS:
        raise Mistake(f"{file.at('step')}{len(steps)} steps; allowed: 1 to {MOST_STEPS}")
    title = _words(data, "title", file.at)
    source = _words(data, "source", file.at)
    scene = _scene(file, data, None, file.at)
    made = [_step(file, i, one, scene, source) for i, one in enumerate(steps)]
    return Lesson(os.path.splitext(os.path.basename(path))[0], title, tuple(made))


class _File(NamedTuple):
    """A lesson file being read."""

    text: str
    path: str

    @property
    def folder(self):
        return os.path.dirname(os.path.abspath(self.path))

    def at(self, key, index=None):
        """Return the Place of a key at the top, or in the step of an index."""
        section = "" if index is None else "step"
        return Place(self.text, self.path, key, section, index or 0)


def _step(file, index, data, base, source):
    """Return the Step of a table; what it has no scene or source for is the lesson's."""

    def where(key):
        return file.at(key, index)

    _check_keys(data, _STEP, where)
    for key in ("title", "caption"):
        if key not in data:
            raise Mistake(f"{where(key)}a step needs {_sample(key)}")
    words = {key: _words(data, key, where) for key in _LENGTHS}
    for one, other in (("formula", "plain"), ("ask", "reveal")):
        for key, missing in ((one, other), (other, one)):
            if words[key] and not words[missing]:
                raise Mistake(f"{where(key)}{key} without {missing}; write {_sample(missing)} too")
    scene = _scene(file, data, base, where)
    shots = _shots(file, data, scene, where)
    words["source"] = words["source"] or source
    sliders = _sliders(data.get("sliders", []), scene, where("sliders"))
    return Step(**words, sliders=sliders, scene=scene, shots=shots, place=where("formula"))


def _scene(file, data, base, where):
    """Return the scene of a lesson or of a step, `base` where it names none; no sheet."""
    name = data.get("scene", "")
    if not isinstance(name, str):
        raise Mistake(f'{where("scene")}scene = {name!r}; write text in quotes: "…"')
    scene = base or Scene.default()
    if name:
        if name not in scenefile.shipped():
            confine(name, "scene", file.folder, {}, where("scene"))
        scene = Scene.load(name, file.folder, where("scene"))
        if not scene.objects:
            raise Mistake(f"{where('scene')}{name} shows nothing; name a scene with an object")
        scene = scene._replace(panels=(), title={})
    return _with(file, data.get("set", {}), scene, where("set"))[1]


def _with(file, given, scene, where):
    """Return (pairs, scene with them) of a table of settings."""
    return scenefile.settings_of(given, scene, file.folder, {}, where)


def _shots(file, data, scene, where):
    """Return the Shots of a step: its scene, or those that it compares."""
    given, place = data.get("compare", []), where("compare")
    sample = "compare = [{ caption = …, set = { … } }, { … }]"
    if not isinstance(given, list) or not all(isinstance(one, dict) for one in given):
        raise Mistake(f"{place}compare is a list of pictures; write {sample}")
    if not given:
        return (Shot(scene),)
    if not 2 <= len(given) <= MOST_PICTURES:
        raise Mistake(f"{place}{len(given)} pictures compared; allowed: 2 to {MOST_PICTURES}")
    shots = []
    for i, one in enumerate(given, 1):
        at = f"{place}picture {i}: "
        _check_keys(one, ("caption", "set"), lambda key, at=at: at)
        if "caption" not in one:
            raise Mistake(f"{at}needs {_sample('caption')}")
        caption = _words(one, "caption", lambda key, at=at: at, 60)
        pairs, other = _with(file, one.get("set", {}), scene, at)
        shots.append(Shot(other, caption, pairs))
    return tuple(shots)


def _sliders(given, scene, where):
    """Return the keys of values that a step names."""
    if not isinstance(given, list) or not all(isinstance(key, str) for key in given):
        raise Mistake(f'{where}sliders = {given!r}; write sliders = ["shininess", …]')
    if len(given) > MOST_SLIDERS:
        raise Mistake(f"{where}{len(given)} sliders; allowed: up to {MOST_SLIDERS}")
    allowed = settings.keys(scene)
    for key in given:
        if key not in allowed:
            raise Mistake(f"{where}no value '{key}'; {nearest(key, allowed)}")
    return tuple(given)


def _words(data, key, where, most=0):
    """Return {language: text} of a key, {} where it is left out; a lone text is for all."""
    value, most = data.get(key, {}), most or _LENGTHS[key]
    words = dict.fromkeys(LANGUAGES, value) if isinstance(value, str) else value
    if key in data and not (isinstance(words, dict) and words):
        raise Mistake(f"{where(key)}{key} = {value!r}; write {_sample(key)}")
    for lang, text in words.items():
        if lang not in LANGUAGES or not isinstance(text, str):
            raise Mistake(f"{where(key)}{key}.{lang} = {text!r}; write {_sample(key)}")
        if not text.strip() or len(text) > most:
            size = f"{len(text)} letters" if text.strip() else "empty"
            raise Mistake(f"{where(key)}{key}.{lang} is {size}; allowed: 1 to {most} letters")
    lines = {lang: _BLANKS.sub(" ", text).strip().split("\n") for lang, text in words.items()}
    joint = "\n" if key in ("formula", "plain") else " "
    return {lang: joint.join(map(str.strip, rows)) for lang, rows in lines.items()}


def _sample(key):
    return "[[step]]" if key == "step" else f'{key} = {{ en = "…", pt = "…" }}'


def _check_keys(data, allowed, where):
    for key in data:
        if key not in allowed:
            raise Mistake(f"{where(key)}unknown key '{key}'; {nearest(key, allowed)}")
