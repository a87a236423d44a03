"""The pixel that a tool of the window looks at: the one that was clicked, else below the mouse."""

import time

from . import banner, facing
from .errors import Mistake

REST = 3.0  # times what a look took, until the next one: the mouse must not wait for it


class Sight:
    """Where a tool looks, over the frames: pixel (x, y) or None, and facing.Facing there, or None.

    follows: whether it looks at all; a click makes it.
    """

    def __init__(self):
        self.pixel, self.facing, self.follows = None, None, True
        self._picked, self._pinned = None, None
        self._looked, self._next = None, 0.0

    def look(self, now):
        """Look at what a tool is told of, see `drawer.Now`, and put a ring around it.

        A click chooses the object that it hits; one beside all of them lets the mouse lead again.
        """
        if now.picked != self._picked:
            self._picked, self.follows, self._looked = now.picked, True, None
            self._pinned = now.picked and tuple(map(int, now.picked))
        pixel = self._pinned or now.pointed or self.pixel
        if not self.follows or pixel is None:
            return
        if not all(0 <= at < size for at, size in zip(pixel, now.shown.size, strict=True)):
            self.pixel = self.facing = self._looked = None
            return
        if self._has_come(now, pixel):
            self.pixel, self.facing = pixel, self._seen(now, pixel)
            if self._pinned and self.facing:
                now.state.chosen = self.facing.object - 1
            elif self._pinned:
                self._pinned = None
        if self.facing:
            banner.ring(now.corner, self.pixel)

    def directions(self, chosen, light=None):
        """Return (L, V) there on the chosen object, None where that is not what is seen.

        light is the number of the one meant; without it the first that is above the surface.
        """
        there = self.facing if self.follows else None
        if not there or there.object - 1 != chosen or not there.lights:
            return None
        above = (number for number, L in there.lights.items() if L[2] > 0.0)
        number = light if light in there.lights else next(iter((*above, *there.lights)))
        return there.lights[number], there.V

    def _has_come(self, now, pixel):
        """Return whether there is something new to be looked at, and time to do so."""
        bare = tuple(one._replace(values={}) for one in now.shown.objects)
        wanted = (now.shown._replace(objects=bare), pixel)
        if wanted == self._looked:
            return False
        if now.time < self._next and pixel != self._pinned:
            now.state.wake = min(now.state.wake, self._next)
            return False
        self._looked = wanted
        return True

    def _seen(self, now, pixel):
        now.stage.context.finish()  # what is still being drawn is no part of the look
        began = time.perf_counter()
        try:
            found = facing.seen(now.shown, pixel, now.stage.renderer)
        except Mistake:
            found = None
        self._next = now.time + REST * (time.perf_counter() - began)
        return found
