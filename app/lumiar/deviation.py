"""How far apart two pictures on the card are: in false colour, and in numbers."""

import struct

import numpy as np

from . import compose, difference, scale
from .card import OnCard, compiled
from .judge import Judge

COLOURS = 1024  # of the map


class Deviation(OnCard):
    """The difference of two framebuffers of sRGB; release it, or use `with`.

    canvas   the framebuffer in which it is, top row first
    ruler    the scale.Scale of its colours
    numbers  those of `difference.measure`, None while the pictures move
    """

    def __init__(self, context):
        super().__init__(context)
        self._program = compiled(context, compose.screen("deviation", {}))
        self._screen = context.vertex_array(self._program, [])
        self._map = context.texture((COLOURS, 1), 3, scale.ramp(COLOURS), alignment=1)
        self.canvas, self.ruler, self.numbers = None, scale.fitting(np.zeros(1)), None
        self._judge, self._judges = Judge(), False

    def _free(self):
        for made in (self._screen, self._program, self._map):
            made.release()
        self._drop()
        self._judge.release()

    def _drop(self):
        if self.canvas:
            self.free_framebuffer(self.canvas)
            self.canvas = None

    @property
    def busy(self):
        """Whether a number is still to come."""
        return self.numbers is None or self._judges

    @property
    def flip(self):
        """The FLIP error, None until it is known, and where it cannot be found."""
        return self._judge.value

    def colours(self, count):
        """Return `count` colours (bytes of sRGB, 3 each) from one end of the scale to the other."""
        return scale.ramp(count)

    def follow(self, a, b, changed, moves):
        """Bring all up to date with two framebuffers; where they move, only the colours."""
        if changed or self.canvas is None:
            self.numbers = None
            self._judge.release()
            self._draw(a, b)
        if self.numbers is None and not moves:
            pixels = self._measure(a, b)
            self._draw(a, b)
            self._judge.ask(a.size, *pixels)
        self._judges = self._judge.busy

    def _draw(self, a, b):
        """Draw where two framebuffers of the same size differ."""
        if self.canvas is None or self.canvas.size != a.size:
            self._drop()
            self.canvas = self.context.framebuffer([self.context.texture(a.size, 4)])
        self._program["rig_ends"].write(struct.pack("2f", self.ruler.low, self.ruler.high))
        textures = (a.color_attachments[0], b.color_attachments[0], self._map)
        for unit, (name, one) in enumerate(zip(("a", "b", "colors"), textures, strict=True)):
            self._program[f"rig_{name}"].value = unit
            one.use(unit)
        self.canvas.use()
        self.canvas.viewport = (0, 0, *a.size)
        self.context.enable_only(self.context.NOTHING)
        self._screen.render(self.context.TRIANGLES, vertices=3)

    def _measure(self, a, b):
        """Find the numbers of two framebuffers and a scale that suits them; return their bytes.

        The scale is linear: on a logarithmic one the roundings to 8 bits would stand out.
        """
        pixels = [one.read(components=3) for one in (a, b)]
        arrays = (np.frombuffer(one, np.uint8).reshape(*a.size[::-1], 3) for one in pixels)
        self.numbers = difference.levels(*arrays)
        self.ruler = scale.fitting(np.array([0.0, self.numbers["max"]]))
        return pixels
