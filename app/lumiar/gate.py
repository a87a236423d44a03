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

    def read(self, paths, scene):
        """Read those Shaders of a scene again that are files of such paths, or include them.

        See `settle` for when they are fresh.
        """
        self._texts.faults.pop("", None)
        for path, shader in self._shaders(scene).items():
            if path in paths or not self._texts.libraries([shader]).isdisjoint(paths):
                made = self._texts.read(shader, paths)
                self.waiting.pop(path, None)  # what it was a moment ago
                self.waiting |= {path: made} if made else {}
        self.settle(scene)

    def foresee(self, moving, scene):
        """Try what is being saved already while it settles; moving: {path: state} of files."""
        trial = self.trial
        if not moving or not trial:
            return
        for path, shader in self._shaders(scene).items():
            state = moving.get(path)
            if not state or state == self._seen.get(path) or path in self._texts.drafts:
                continue
            if not trial.busy:
                self._seen[path] = state
                with contextlib.suppress(Mistake):  # told once it has settled
                    made = self._texts.parsed(shader)
                    if trial.line(made) is None:
                        trial.ask(self._with(scene, {path: made}), [made], self.renewed(scene))

    def settle(self, scene):
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
            shaders = [*self.waiting.values()]
            trial.ask(self._with(scene, self.waiting), shaders, self.renewed(scene))
        return decided

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

    def admit(self, scene, before=None):
        """Try a scene before it is shown, where it has files of one's own; raise Mistake."""
        trial, own = self.trial, self.own(scene)
        if not trial:
            return
        if any(trial.line(shader) is None for shader in own):
            trial.wait()  # for what was asked before
            trial.ask(self.renewed(scene), own, before)
            trial.wait()
        for shader in own:
            if line := trial.line(shader):
                raise Mistake(line)

    def admits(self, scene, before):
        """Return whether `admit` does; say why not in the faults."""
        self._texts.faults.pop("", None)
        try:
            self.admit(scene, before)
        except Mistake as mistake:
            self._texts.faults[""] = one_line(mistake)
            return False
        return True

    def own(self, scene):
        """Return the Shaders of a scene that are not as they came with Lumiar."""
        shaders = self._shaders(scene).values()
        return [one for one in shaders if one.path in self.fresh or not one.path.startswith(_OURS)]

    def _shaders(self, scene):
        return {shader.path: shader for shader in opening.shaders(self.renewed(scene))}

    def _with(self, scene, shaders):
        memory = {key: dict(values) for key, values in self._memory.items()}
        return opening.renewed(scene, {**self.fresh, **shaders}, memory)
