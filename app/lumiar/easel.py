"""A picture in the window: drawn when its scene changes; the last good one where it cannot be."""

import contextlib
import time

from . import hands, layout, opening
from .errors import Mistake, one_line
from .scene import Scene

LONG, SLICE = 0.15, 0.06  # seconds of a picture that is drawn some rows at a time; of those


class Easel:
    """A picture on the card and what it shows; release it.

    good    the last scene that could be drawn, shown the same as framed for the picture
    view    (eye, target) of it
    fault   the line of what keeps the scene wanted from being drawn, or ""
    cost    seconds that the last whole picture took, or about so many that it will
    coarse  whether the picture, or a part, has one sample per pixel and one toward each light,
            as while it moves
    broken  how many of its pixels have no finite radiance, in magenta; None until `count` is called
    begun   whether rows of it are still to be drawn, by as many calls as that takes
    """

    def __init__(self, context):
        self.context, self.canvas = context, None
        self.begun, self._top, self._rows, self._first, self._spent = False, 0, 0, 0, 0.0
        self.good = self.shown = self.view = None
        self.fault, self.cost, self.coarse = "", 0.0, False
        self._drawn, self._hidden, self.broken = None, 0, None

    def release(self):
        """Free what is on the card."""
        if self.canvas:
            self.context.screen.use()
            self.canvas.color_attachments[0].release()
            self.canvas.release()
            self.canvas = None

    def stale(self):
        """Have the next picture drawn, whatever it shows."""
        self._drawn = None

    def draw(self, scene, fault, size, coarse, renderer):
        """Bring the picture up to date; return whether it had to be drawn.

        scene is None where there is none, for the reason that `fault` says.
        """
        hidden = layout.directions(scene)[1] if scene else 0
        new = hidden > max(1, self._hidden)  # nobody knows yet how long it takes
        coarse = coarse or new
        if self._drawn == (scene, fault, size) and self.coarse in (False, coarse):
            return False
        began = time.perf_counter()
        if self._drawn != (scene, fault, size) or coarse or not self.begun:
            self.begun, self._top, self._rows, self._spent = False, 0, 0, 0.0
        try:
            if scene is None:
                raise Mistake(fault)
            self.shown = self._show(scene, size, coarse, renderer)
        except Mistake as mistake:
            self.fault = one_line(mistake)
            self._show_last(size, coarse, renderer)
            if self.canvas is None:
                raise
        else:
            self._forget_edited(scene, renderer)
            self.good, self.fault = scene, ""
            self.view = renderer.viewpoint(self.shown)
        self.context.finish()
        took = time.perf_counter() - began
        self._spent += took
        if self.begun and took < 0.5 * SLICE:
            self._rows = min(2 * self._rows, 8 * self._first)  # rows below may take longer
        elif self.begun:
            self._rows = max(1, min(self._rows, int(self._rows * SLICE / took)))
        if not coarse and not self.begun:
            self.cost, self._hidden = self._spent, hidden
        elif new:
            self.cost, self._hidden = self._spent * hidden * scene.samples, hidden
        self._drawn, self.coarse = (scene, fault, size), coarse or self.begun
        self.broken = None
        return True

    def count(self):
        """Count the pixels that have no finite radiance, once for each whole picture."""
        if self.broken is None and not self.coarse:
            self.broken = self.canvas.read(components=4)[3::4].count(0)

    def _show(self, scene, size, coarse, renderer, whole=False):
        """Draw a scene into the canvas, or the next rows of it; return it as drawn."""
        shown = hands.framed(scene, size)
        self._fit(size)
        if coarse or whole or self.cost < LONG:
            self.begun = False
            renderer.show(_coarse(shown) if coarse else shown, self.canvas)
            return shown
        if not self.begun:
            self._rows = self._first = max(1, int(size[1] * SLICE / self.cost))
        renderer.show(shown, self.canvas, self._top, self._rows)
        self._top += self._rows
        self.begun = self._top < size[1]
        return shown

    def _show_last(self, size, coarse, renderer):
        """Draw the last good scene, or the default one where there is none."""
        with contextlib.suppress(Mistake):  # larger than any picture can be
            self.shown = self._show(self.good or Scene.default(), size, coarse, renderer, True)
            self.view = renderer.viewpoint(self.shown)

    def _fit(self, size):
        if self.canvas is None or self.canvas.size != size:
            self.release()
            self.canvas = self.context.framebuffer([self.context.texture(size, 4)])

    def _forget_edited(self, scene, renderer):
        """Free what was compiled from files as they were before their last good save."""
        sources = {shader.path: shader.source for shader in opening.shaders(scene)}
        for old in opening.shaders(self.good) if self.good else ():
            if sources.get(old.path, old.source) != old.source:
                renderer.forget(old.source)


def _coarse(scene):
    """Return a scene with one sample per pixel, and one direction to each light."""
    lights = tuple(light._replace(samples=1) for light in scene.lights)
    return scene._replace(samples=1, lights=lights)
