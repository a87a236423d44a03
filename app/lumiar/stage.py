"""The picture in the window: drawn when its scene changes; the last good one where it cannot be."""

import contextlib
import time

from . import hands, opening
from .errors import Mistake, one_line
from .renderer import Renderer
from .scene import Scene

PROMPT = 0.04  # seconds that a picture may take while it moves
REST = 0.2  # seconds without a change before one that takes longer is drawn in full


class Stage:
    """A picture on the card and what it shows; release it.

    good    the last scene that could be drawn, shown the same as framed for the picture
    view    (eye, target) of it
    fault   the line of what keeps the scene wanted from being drawn, or ""
    cost    seconds that the last whole picture took
    coarse  whether the picture has one sample per pixel, as while it moves
    """

    def __init__(self, context):
        self.context, self.renderer = context, Renderer(context)
        self.canvas = self.good = self.shown = self.view = None
        self.fault, self.cost, self.coarse = "", 0.0, False
        self._drawn = None

    def release(self):
        """Free what is on the card."""
        self._drop_canvas()
        self.renderer.release()

    def restart(self):
        """Forget all that was compiled and loaded."""
        self.renderer.release()
        self.renderer, self._drawn = Renderer(self.context), None

    def stale(self):
        """Have the next picture drawn, whatever it shows: a file of it may be another one."""
        self._drawn = None
        self.renderer.forget()

    def draw(self, scene, size, since):
        """Bring the picture up to date; since: seconds for which nothing has changed.

        A picture that takes long has one sample per pixel while it moves, all of them at rest.
        The default scene is in its place where none could be drawn yet.
        """
        coarse = self.cost > PROMPT and since < REST
        if self._drawn == (scene, size) and self.coarse in (False, coarse):
            return
        began = time.perf_counter()
        try:
            self.shown = self._show(scene, size, coarse)
        except Mistake as mistake:
            self.fault = one_line(mistake)
            with contextlib.suppress(Mistake):  # larger than any picture can be
                self.shown = self._show(self.good or Scene.default(), size, coarse)
                self.view = self.renderer.viewpoint(self.shown)
            if self.canvas is None:
                raise
        else:
            self._forget_edited(scene)
            self.good, self.fault = scene, ""
            self.view = self.renderer.viewpoint(self.shown)
        self.context.finish()
        self.cost = self.cost if coarse else time.perf_counter() - began
        self._drawn, self.coarse = (scene, size), coarse

    def looks(self, scene, size):
        """Return a scene, or the last one that could be drawn, as framed, and its viewpoint."""
        for one in (scene, self.good):
            with contextlib.suppress(Mistake):
                shown = hands.framed(one, size)
                return shown, self.renderer.viewpoint(shown)
        return None

    def _show(self, scene, size, coarse):
        """Draw a scene into the canvas; return it as drawn."""
        shown = hands.framed(scene, size)
        if self.canvas is None or self.canvas.size != size:
            self._drop_canvas()
            self.canvas = self.context.framebuffer([self.context.texture(size, 4)])
        self.renderer.show(shown._replace(samples=1) if coarse else shown, self.canvas)
        return shown

    def _forget_edited(self, scene):
        """Free what was compiled from files as they were before their last good save."""
        sources = {shader.path: shader.source for shader in opening.shaders(scene)}
        for old in opening.shaders(self.good) if self.good else ():
            if sources.get(old.path, old.source) != old.source:
                self.renderer.forget(old.source)

    def _drop_canvas(self):
        if self.canvas:
            self.context.screen.use()
            self.canvas.color_attachments[0].release()
            self.canvas.release()
            self.canvas = None
