"""The tool that films: a turntable, a slider or the time, into a file that plays anywhere."""

import time
from dataclasses import dataclass

from imgui_bundle import imgui

from . import editing, film, hands, labels, picture, scenefile, settings, widgets
from .errors import Mistake, one_line
from .files import unused
from .labels import BAD, BRIGHT, DIM, GOOD
from .parameter import Parameter
from .parts import SCENE
from .phrases import TEXT

KINDS = ("turntable", "sweep")
_COUNT = Parameter("frames", "int", 60, low=2, high=240, open=(False, True))
_RATE = Parameter("rate", "float", 25.0, low=1.0, high=50.0)
_SIZE = SCENE["size"]._replace(default=(640, 480), low=16, high=film.MOST)


@dataclass
class Plan:
    """What is to be filmed, and how; key, start and end are those of a sweep."""

    kind: str = "turntable"
    key: str = ""
    start: float = 0.0
    end: float = 1.0
    back: bool = True
    size: tuple = _SIZE.default
    count: int = _COUNT.default
    rate: float = _RATE.default
    ending: str = ".webp"
    lossless: bool = True


class Filming:
    """The tool "film" of the drawer."""

    def __init__(self):
        self.plan, self.film, self.saved, self.fault = Plan(), None, "", ""
        self._scenes, self._began = None, 0.0

    def release(self):
        """Give up a film that is not yet written."""
        if self.film:
            self.film.release()
            self.film = None

    def draw(self, now):
        """Draw what there is to choose, or how far the film is; the scene stays."""
        words = TEXT[now.state.lang]["film"]
        panel = {**now.words, "names": {**now.words["names"], **words["names"]}}
        imgui.push_text_wrap_pos(0.0)
        if self.film:
            self._go_on(now, words)
        else:
            self._choose(now, words, panel)
        for text, color in ((self.saved, GOOD), (self.fault, BAD)):
            if text:
                imgui.text_colored(color, text)
        imgui.pop_text_wrap_pos()
        return now.scene

    def begin(self, now):
        """Begin to film the scene as it is, by the plan."""
        self.saved = self.fault = ""
        plan, path = self.plan, unused("lumiar", self.plan.ending)
        scene = hands.framed(now.scene, plan.size)
        try:
            if plan.kind == "sweep":
                how = (plan.start, plan.end, plan.count, plan.back)
                self._scenes = film.sweep(scene, plan.key, *how)
            else:
                self._scenes = film.turntable(
                    scene, now.stage.looks(scene, plan.size)[1], plan.count
                )
            chunks = [scenefile.chunk(scene.toml())]
            how = (plan.size, plan.count, plan.rate, plan.lossless, chunks)
            self.film = film.Film(path, *how)
        except (Mistake, OSError) as error:
            self.fault = one_line(error)
        self._began = time.monotonic()

    def _go_on(self, now, words):
        """Draw one more frame of the film, and tell how far it is."""
        one = self.film
        if one.ready and now.shown is not None:
            try:
                scene = next(self._scenes)
                one.put(picture.capture(scene, renderer=now.stage.renderer).pixels)
            except Mistake as mistake:
                self.fault = one_line(mistake)
                self.release()
                return
            now.state.restless = True
        now.state.wake = min(now.state.wake, time.monotonic() + 0.02)
        if one.done:
            self.fault = one.fault
            self.saved = "" if one.fault else words["saved"].format(one.path)
            self.film = None
            return
        share = one.given / one.count
        spent = time.monotonic() - self._began
        left = spent * (1.0 - share) / share if share else 0.0
        text = words["left"].format(one.given, one.count, left) if share < 1.0 else words["writing"]
        imgui.progress_bar(share, (-1.0, 0.0), "")
        imgui.text(text)
        imgui.text_colored(DIM, one.path)
        if imgui.button(words["cancel"]):
            self.release()

    def _choose(self, now, words, panel):
        plan = self.plan
        labels.row("kind", panel)
        plan.kind = labels.pick("what", plan.kind, [(kind, words[kind]) for kind in KINDS])
        if plan.kind == "sweep":
            self._choose_value(now, words, panel)
        plan.size = widgets.edit(_SIZE, plan.size, panel)
        plan.count = widgets.edit(_COUNT, plan.count, panel)
        plan.rate = widgets.edit(_RATE, plan.rate, panel)
        labels.row("format", panel)
        endings = [(ending, words[ending]) for ending in film.ENDINGS]
        plan.ending = labels.pick("ending", plan.ending, endings)
        if plan.ending == ".webp":
            labels.row("lossless", panel)
            plan.lossless = imgui.checkbox("##lossless", plan.lossless)[1]
        imgui.text_colored(DIM, words["about"].format(plan.count / plan.rate))
        imgui.begin_disabled(now.shown is None or (plan.kind == "sweep" and not plan.key))
        if imgui.button(words["begin"]):
            self.begin(now)
        imgui.end_disabled()
        imgui.same_line()
        imgui.text_colored(BRIGHT, unused("lumiar", plan.ending))

    def _choose_value(self, now, words, panel):
        """Draw which value the film sweeps through, from where to where."""
        plan, keys = self.plan, values(now.scene, panel)
        if plan.key not in keys and keys:
            self._take(now.scene, next(iter(keys)))
        labels.row("value", panel)
        got = labels.choice("value", keys.get(plan.key, ""), [*keys.items()])
        if got:
            self._take(now.scene, got)
        at = settings.found(now.scene, plan.key) if plan.key in keys else None
        if not at:
            plan.key = ""
            return
        one = _ranged(at)
        for field in ("start", "end"):
            row = one._replace(name=field, default=getattr(plan, field))
            setattr(plan, field, widgets.edit(row, getattr(plan, field), panel))
        labels.row("back", panel)
        plan.back = imgui.checkbox("##back", plan.back)[1]

    def _take(self, scene, key):
        """Take a value for the sweep, over the whole of its slider."""
        one = _ranged(settings.found(scene, key))
        self.plan.key, self.plan.start, self.plan.end = key, one.low, one.high


def values(scene, words):
    """Return {key: what it is called} of the values of a scene that are one number."""

    def named(parameter, place):
        return f"{place}{words['names'].get(parameter.name, parameter.name.replace('_', ' '))}"

    found = {}
    several = len(scene.objects) > 1
    for i, one in enumerate(scene.objects, 1):
        place = f"{i}  {one.name or one.model.name}: " if several else ""
        found |= {
            f"object.{i}.{p.name}": named(p, place) for p in filter(_swept, one.model.parameters)
        }
    for i, one in enumerate(scene.lights, 1):
        place = f"{one.name or one.kind.name} {i}: "
        found |= {
            f"light.{i}.{p.name}": named(p, place) for p in filter(_swept, one.kind.parameters)
        }
    place = f"{words['camera']}: "
    for key in ("fov", "azimuth", "elevation", "distance"):
        at = settings.found(scene, f"camera.{key}")
        if (scene.camera.position is None and at[1] is not None) or key == "fov":
            found[f"camera.{key}"] = named(at[0], place)
    return found | {key: named(SCENE[key], "") for key in ("exposure", "time")}


def _swept(parameter):
    return parameter.widget == "slider" and parameter.type in ("float", "int")


def _ranged(at):
    """Return the Parameter of what `settings.found` gives, in the unit of its light."""
    one, _, lamp, _ = at
    return editing.in_unit(lamp) if one.tinted else one
