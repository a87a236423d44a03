"""What a picture and an evaluation cost, measured a few milliseconds at a time at rest."""

import statistics

from . import catalog, timing
from .card import OnCard

ENOUGH = 0.4  # seconds of pictures that are drawn to be timed
ROUNDS = 9  # of evaluations, and pictures at most


class Stopwatch(OnCard):
    """Times a picture, and a model; release it. All are None until something is known.

    picture     seconds of a whole picture, the median of some
    evaluation  (ns of an evaluation of the model, the same of Lambert's)
    clock       the one that is believed, in the words of `timing.believed`
    """

    def __init__(self, context, instrument):
        super().__init__(context)
        self._instrument, self._target, self._clock = instrument, None, None
        self.clock = None
        self.forget()

    def _free(self):
        if self._target:
            self.free_framebuffer(self._target)

    def forget(self):
        """Begin anew: the scene is another one."""
        self.picture = self.evaluation = None
        self._pictures, self._rounds = [], []

    def step(self, scene, model, values, renderer, cost):
        """Do one short run for a scene, and a model with its values; return whether more is due.

        cost: seconds that the last picture took; one that takes long is not drawn again.
        """
        if not self._clock:
            picture = self._drawing(scene, renderer)
            self._clock = timing.believed(self.context, [picture])
            self.clock = self._clock.said
        elif not self._pictures and cost > ENOUGH:
            self._pictures, self.picture = [cost], cost
        elif sum(self._pictures) < ENOUGH and len(self._pictures) < ROUNDS:
            self._pictures.append(self._clock.time(self._drawing(scene, renderer))[1])
            self.picture = statistics.median(self._pictures)
        elif model and len(self._rounds) < ROUNDS:
            self._race(model, values)
        else:
            return False
        return True

    def _race(self, model, values):
        """Time an evaluation of the model, of Lambert's, and nothing, once each."""
        lambert = catalog.read("model", "lambert")
        jobs = (model, values), (lambert, lambert.defaults())
        runs, count = self._instrument.racers(jobs, self._clock)
        times = [self._clock.time(run) for run in runs]
        if self.evaluation is None:  # that round compiled
            times = [self._clock.time(run) for run in runs]
        self._rounds.append(times)
        found = timing.settled(self._rounds, empty=0, cores=self._clock.cores)
        self.evaluation = tuple(max(0.0, one.per(count).cost) for one in found[1:])

    def _drawing(self, scene, renderer):
        """Return the job of drawing the picture of a scene."""
        with self.context:
            if self._target and self._target.size != scene.size:
                self.free_framebuffer(self._target)
                self._target = None
            if not self._target:
                self._target = self.context.framebuffer([self.context.texture(scene.size, 4)])
        return lambda: renderer.show(scene, self._target)
