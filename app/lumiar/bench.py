"""What a study measures with: an instrument, a renderer and a clock in one OpenGL context."""

import os

import numpy as np

from . import catalog, timing
from .files import GLSL
from .measure import NOTHING, Instrument
from .renderer import Renderer
from .scene import Scene

LOAD = ("torus", (256, 256))  # mesh and size of a frame that clocks are tried on


class Bench:
    """Times and draws for the studies; release it or use `with`. quick: less of everything."""

    def __init__(self, quick=False):
        self.quick = quick
        self.instrument = Instrument()
        self.renderer = Renderer(self.instrument.context)
        self._targets = {}
        mesh, size = LOAD
        frame = self.frame(Scene.default().set(mesh=mesh, size=size, samples=1))
        loads = [self.instrument.timed(*NOTHING, 64), frame]
        self.clock = timing.believed(self.instrument.context, loads)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.release()

    def release(self):
        """Free everything on the graphics card."""
        for target in self._targets.values():
            with self.renderer.context:
                self.renderer.free_framebuffer(target)
        self._targets = {}
        self.renderer.release()
        self.instrument.release()

    def costs(self, jobs, seconds):
        """Return {key: timing.Timing in ns of an evaluation} of jobs {key: (model, values)}.

        They race for about so many seconds; an empty model's time is taken off.
        """
        found = self.instrument.costs([*jobs.values()], seconds, self.clock)
        return dict(zip(jobs, found, strict=True))

    def race(self, jobs, seconds, empty=None, spread=False):
        """Return {key: timing.Timing in s} of jobs {key: callable} as `timing.race` has it.

        empty is a key.
        """
        place = None if empty is None else [*jobs].index(empty)
        found = timing.race([*jobs.values()], self.clock, seconds, place, spread)
        return dict(zip(jobs, found, strict=True))

    def frame(self, scene):
        """Return the job of drawing a Scene as the window does, into sRGB pixels on the card."""
        if scene.size not in self._targets:
            with self.renderer.context as context:
                texture = context.texture(scene.size, 4)
                self._targets[scene.size] = context.framebuffer([texture])
        target = self._targets[scene.size]
        return lambda: self.renderer.show(scene, target)

    def image(self, scene):
        """Return the linear radiance of a Scene as (height, width, 3) float32, top row first."""
        strips = [data for data, _ in self.renderer.strips(scene, linear=True)]
        width, height = scene.size
        return np.frombuffer(b"".join(strips), np.float32).reshape(height, width, 3)

    def formulas(self, name):
        """Return the catalog.Shader of glsl/studies/NAME.glsl."""
        return catalog.read("model", os.path.join(GLSL, "studies", f"{name}.glsl"))
