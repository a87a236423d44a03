"""What a picture and an evaluation cost, measured a few milliseconds at a time at rest."""

import contextlib
import statistics
import time

from . import catalog, measure
from .card import OnCard

ENOUGH = 0.4  # seconds of pictures that are drawn to be timed
BRIEF = 4e-3  # seconds that the shortest run of evaluations takes at least
CLEAR = 20e-3  # those of pictures by which the card's clock is judged
AGREES = (0.7, 1.1)  # share of the wall clock's time that an honest one tells of them


class Stopwatch(OnCard):
    """Times a picture, and a model; release it. Both are None until something is known.

    picture     seconds of a whole picture, the median of some runs
    evaluation  (ns of an evaluation of the model, the same of Lambert's)
    by_card     whether the picture's are the card's own; else those of the wall clock
    """

    def __init__(self, context, instrument):
        super().__init__(context)
        self._instrument, self._target, self._query = instrument, None, None
        self.by_card = None
        self.forget()

    def _free(self):
        if self._target:
            self.free_framebuffer(self._target)

    def forget(self):
        """Begin anew: the scene is another one."""
        self.picture = self.evaluation = None
        self._pictures, self._rounds, self._repeats = [], [], 0

    def step(self, scene, model, values, renderer, cost):
        """Do one short run for a scene, and a model with its values; return whether more is due.

        cost: seconds that the last picture took; one that takes long is not drawn again.
        """
        if self.by_card is None:
            self.by_card = self._judged(scene, renderer)
        elif not self._pictures and cost > ENOUGH:
            self._pictures, self.picture = [cost], cost
        elif sum(self._pictures) < ENOUGH and len(self._pictures) < measure.CALM:
            self._pictures.append(self._drawn(scene, renderer)[self.by_card])
            self.picture = statistics.median(self._pictures)
        elif model and len(self._rounds) < measure.CALM:
            self._race(model, values)
        else:
            return False
        return True

    def _race(self, model, values):
        """Time an evaluation once; the first runs compile, and tell how long one must be."""
        lambert = catalog.read("model", "lambert")
        jobs = (measure.empty(), {}), (model, values), (lambert, lambert.defaults())
        spent = self._instrument.spent(jobs, self._repeats or 1)
        if not self._repeats or min(spent) < BRIEF:
            self._repeats = 2 * self._repeats or 4
            return
        self._rounds.append(spent)
        nothing, *own = map(min, zip(*self._rounds, strict=True))  # what else runs only adds
        ns = 1e9 / measure.evaluations(self._repeats)
        self.evaluation = tuple(max(0.0, one - nothing) * ns for one in own)

    def _drawn(self, scene, renderer, count=1):
        """Return the seconds that a picture takes by the wall clock, and by the card's."""
        with self.context:
            if self._target and self._target.size != scene.size:
                self.free_framebuffer(self._target)
                self._target = None
            if not self._target:
                self._target = self.context.framebuffer([self.context.texture(scene.size, 4)])
        self.context.finish()
        began = time.perf_counter()
        with self._query or contextlib.nullcontext():
            for _ in range(count):
                renderer.show(scene, self._target)
        self.context.finish()
        wall = time.perf_counter() - began
        card = self._query.elapsed * 1e-9 if self._query else 0.0
        return wall / count, card / count

    def _judged(self, scene, renderer):
        """Return whether the card's clock is honest: llvmpipe's tells a fiftieth of the truth."""
        with contextlib.suppress(Exception):  # moderngl raises nothing more specific
            self._query = self.context.query(time=True)
        count = 1
        while self._query:
            wall, card = self._drawn(scene, renderer, count)
            if wall * count > CLEAR:
                return AGREES[0] * wall < card < AGREES[1] * wall
            count *= 2
        return False
