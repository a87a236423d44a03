"""What pieces of a surface reflect of one light, exactly or by so many directions, and how fast.

The very text of model and light that draws pictures, in rigs/estimate.frag, which lets directions
be drawn in other ways than pictures do.
"""

import struct
from typing import NamedTuple

import numpy as np

from . import compose, layout
from .card import OnCard, compiled

TIMED = 64  # the most directions that are timed
STEPS = 16  # directions that a pixel adds up, at least, while timed: a run of a few milliseconds


class Way(NamedTuple):
    """How to find what is reflected: see compose.estimated; samples: how many directions."""

    drawn: str
    points: str = "spread"
    samples: int = 1


class Pieces(NamedTuple):
    """Pieces of a surface on the graphics card, rows of them, and what their estimates go to."""

    shape: tuple
    places: object
    normals: object
    target: object


class Estimator(OnCard):
    """Estimates; release it or use `with`."""

    def __init__(self, context=None):
        super().__init__(context)
        self._programs, self._pieces, self._tables = {}, [], {}

    def _free(self):
        for program, array in self._programs.values():
            array.release()
            program.release()
        for texture in (t for made in self._tables.values() for t in made.values()):
            texture.release()
        for one in self._pieces:
            self.free_framebuffer(one.target)
            one.places.release()
            one.normals.release()

    def pieces(self, places, normals):
        """Return Pieces of places and unit normals (h, w, 3) each, in the world."""
        shape = places.shape[:2]
        with self.context:
            textures = []
            for values in (places, normals):
                texels = np.zeros((*shape, 4), np.float32)
                texels[..., :3] = values
                textures.append(self.context.texture(shape[::-1], 4, texels, dtype="f4"))
            target = self.context.framebuffer([self.context.texture(shape[::-1], 4, dtype="f4")])
        made = Pieces(shape, *textures, target)
        self._pieces.append(made)
        return made

    def radiance(self, pieces, one, light, eye, way):
        """Return the radiance (h, w, 3) float32 of Pieces toward an eye, by a Way.

        one is a parts.Object, of which the model and its values count, light a parts.Light. Every
        piece has random numbers of its own, always the same.
        """
        self.job(pieces, one, light, eye, way)()
        with self.context:
            data = np.frombuffer(pieces.target.read(components=4, dtype="f4"), np.float32)
        return data.reshape(*pieces.shape, 4)[..., :3].copy()

    def job(self, pieces, one, light, eye, way, repeats=1):
        """Return the job of `radiance`; repeats: as many pieces at each pixel, for a clock."""

        def draw():
            with self.context:
                self._draw(pieces, one, light, eye, way, repeats)

        return draw

    def _draw(self, pieces, one, light, eye, way, repeats):
        program, array = self._program(one, light, way)
        values = layout.packed(one.model, one.values, 0.0, "") | layout.of_light(light, 0.0, 1)
        values["rig_eye"] = struct.pack("3f", *eye)
        values["rig_samples"] = struct.pack("i", way.samples)
        values["rig_repeats"] = struct.pack("i", repeats)
        for name, value in values.items():
            if name in program:
                program[name].write(value)
        textures = {"rig_places": pieces.places, "rig_normals": pieces.normals}
        for unit, (name, texture) in enumerate((textures | self._looked_up(light)).items()):
            if name in program:
                program[name].value = unit
                texture.use(unit)
        pieces.target.use()
        self.context.enable_only(0)
        array.render(vertices=3)

    def _program(self, one, light, way):
        fixed = one.model.constants(one.values)
        fixed |= {f"{k}_1": v for k, v in light.kind.constants(light.values).items()}
        key = (one.model.text, light.kind.text, way.drawn, way.points, *fixed.items())
        if key not in self._programs:
            sources = compose.estimated(one.model, light.kind, fixed, way.drawn, way.points)
            program = compiled(self.context, sources)
            self._programs[key] = program, self.context.vertex_array(program, [])
        return self._programs[key]

    def _looked_up(self, light):
        key = (light.kind.name, light.image)
        if key not in self._tables:
            self._tables[key] = {
                name: self.context.texture(texels.size, texels.components, texels.data, dtype="f4")
                for name, texels in layout.tables(light, 1).items()
            }
        return self._tables[key]


def costs(bench, estimator, jobs, pieces, seconds):
    """Return {name: timing.Timing in ns of a piece} of jobs {name: (Object, Light, eye, Way)}.

    By a bench.Bench, in about so many seconds. Ways of few directions race each other, then those
    of many; of more than TIMED directions the time is that of TIMED in proportion, since a loop's
    is; such a job has a twin of TIMED.
    """
    count = pieces.shape[0] * pieces.shape[1]
    timed = {name: job for name, job in jobs.items() if job[3].samples <= TIMED}
    repeats = {name: max(1, STEPS // job[3].samples) for name, job in timed.items()}
    spent = {}
    for many in (False, True):
        some = {name for name, job in timed.items() if (job[3].samples > STEPS) == many}
        work = {
            name: estimator.job(pieces, *jobs[name], repeats[name]) for name in jobs if name in some
        }
        raced = bench.race(work, seconds / 2.0, spread=True) if work else {}
        spent |= {name: one.per(count * repeats[name]) for name, one in raced.items()}
    for name, job in jobs.items():
        if name not in spent:
            twin = (*job[:3], job[3]._replace(samples=TIMED))
            own = next(other for other, it in timed.items() if it == twin)
            spent[name] = spent[own].per(TIMED / job[3].samples, 1.0)
    return spent
