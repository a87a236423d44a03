"""How GLSL that was edited comes into the scene: once it has been tried, if it has to be."""

import contextlib
import os

from . import opening
from .errors import Mistake, one_line
from .files import GLSL

QUIET = 0.3  # seconds without a key before what is typed is looked at
_OURS = os.path.join(GLSL, "")


class Gate:
    """Shaders that were read again, and those that are still to be tried.

    fresh    {path: Shader}: those that take the place of older ones in a scene
    waiting  {path: Shader}: those that are still to be tried
    trial    trial.Trial, or None: then everything passes
    """

    def __init__(self, texts):
        self.fresh, self.trial = {}, None
        self.waiting, self._texts, self._memory = {}, texts, {}
        self._typed, self._seen = {}, {}

    def renewed(self, scene):
        """Return a scene with what is fresh in place of what is older; see `opening.renewed`."""
        return opening.renewed(scene, self.fresh, self._memory)

    def edit(self, path, text, now):
        """Take what is typed for a file; now in seconds."""
        self._texts.edit(path, text)
        self._typed[path] = now

    def quiet(self, now, at_once=False):
        """Return the paths of what was typed, and rests now."""
        found = [path for path, at in self._typed.items() if at_once or now - at >= QUIET]
        for path in found:
            del self._typed[path]
        return found

    def read(self, paths, beside):
        """Read those Shaders again that are files of such paths, or include them.

        beside: a Beside, of all whose scenes. See `settle` for when they are fresh.
        """
        self._texts.faults.pop("", None)
        for path, (shader, _) in _shaders(beside.scenes).items():
            if path in paths or not self._texts.libraries([shader]).isdisjoint(paths):
                made = self._texts.read(shader, paths)
                self.waiting.pop(path, None)  # what it was a moment ago
                self.waiting |= {path: made} if made else {}
        self.settle(beside)

    def foresee(self, moving, beside):
        """Try what is being saved already while it settles; moving: {path: state} of files."""
        if not moving or not self.trial or self.trial.busy:
            return
        for path, (shader, scene) in _shaders(beside.scenes).items():
            state = moving.get(path)
            if state and state != self._seen.get(path) and path not in self._texts.drafts:
                self._seen[path] = state
                with contextlib.suppress(Mistake):  # told once it has settled
                    self._ask({path: self._texts.parsed(shader)}, scene)
                return

    def settle(self, beside):
        """Return the paths of what is decided by now: fresh, or wrong."""
        trial, decided = self.trial, []
        if trial:
            trial.listen()
        for path, shader in [*self.waiting.items()]:
            line = trial.line(shader) if trial else ""
            if line is not None:
                del self.waiting[path]
                decided.append(path)
                if line:
                    self._texts.faults[path] = line
                else:
                    self._texts.faults.pop(path, None)
                    self.fresh[path] = shader
        if self.waiting and not trial.busy:
            known = _shaders(beside.scenes)
            first = next((path for path in self.waiting if path in known), None)
            if first:
                self._ask(self.waiting, known[first][1])
            else:
                self.waiting.clear()  # no scene has a use for it any more
        return decided

    def _ask(self, shaders, scene):
        """Have those of {path: Shader} tried that a scene has a use for."""
        there = [one for path, one in shaders.items() if path in _shaders([scene])]
        if any(self.trial.line(one) is None for one in there):
            memory = {key: dict(values) for key, values in self._memory.items()}
            tried = opening.renewed(scene, self.fresh | {one.path: one for one in there}, memory)
            self.trial.ask(tried, there, scene)

    def rename(self, path, copy):
        """Have a copy of a file take the place of it."""
        fresh = self.fresh.pop(path, None)
        self.waiting.pop(path, None)
        if fresh:
            self.fresh[copy] = fresh._replace(name=copy, path=copy)
            if self.trial:
                self.trial.trust(fresh, self.fresh[copy])

    def names(self, paths):
        """Return the names of those files that nothing is wrong in, nor still to be tried."""
        bad = self._texts.faults.keys() | self.waiting.keys()
        return sorted(os.path.basename(path) for path in paths if path not in bad)

    def admit(self, scenes, before=None):
        """Try scenes before they are shown, where they have files of one's own; raise Mistake."""
        trial = self.trial
        for scene in scenes if trial else ():
            own = self.own(scene)
            if any(trial.line(shader) is None for shader in own):
                trial.wait()  # for what was asked before
                trial.ask(self.renewed(scene), own, before)
                trial.wait()
            for shader in own:
                if line := trial.line(shader):
                    raise Mistake(line)

    def admits(self, scenes, before):
        """Return whether `admit` does; say why not in the faults."""
        self._texts.faults.pop("", None)
        try:
            self.admit(scenes, before)
        except Mistake as mistake:
            self._texts.faults[""] = one_line(mistake)
            return False
        return True

    def own(self, scene):
        """Return the Shaders of a scene that are not as they came with Lumiar."""
        shaders = [shader for shader, _ in _shaders([self.renewed(scene)]).values()]
        return [one for one in shaders if one.path in self.fresh or not one.path.startswith(_OURS)]


def _shaders(scenes):
    """Return {path: (Shader, the scene it is of)}."""
    return {one.path: (one, scene) for scene in reversed(scenes) for one in opening.shaders(scene)}
