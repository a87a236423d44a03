"""The mouse over the pictures: which one it is on, which pixel was clicked, what is dragged."""

import math

from .hands import LEFT, Hands


class Pointer:
    """The mouse over the pictures of a Stage, moving the camera and the light of a document's.

    picked  pixel (x, y) of the active picture that was clicked, or None
    left    where the pictures begin, in pixels of the window
    place   of the mouse, in the same
    """

    def __init__(self, stage, beside):
        self._stage, self._beside, self._hands = stage, beside, Hands()
        self.picked, self.left = None, 0
        self.place, self._pressed, self._index = (0.0, 0.0), None, 0
        self._lens = None  # (size, pixels of a length of 1 at the target) of the active picture

    @property
    def index(self):
        """The index of the picture that the mouse is on."""
        return self._stage.at(*self._local)

    @property
    def pixel(self):
        """The pixel of that picture, None while it is dragged, or where none is."""
        place = tuple(map(int, self._stage.within(*self._local)))
        size = self._stage.places[self.index][2:]
        inside = all(0 <= x < side for x, side in zip(place, size, strict=True))
        return place if inside and not self._hands.holds else None

    def press(self, button, held, lamp=0, grabbed=False):
        """Take that a button is pressed; held: the modifier keys; the rest as `Hands.press`."""
        self._index = self.index
        height = self._stage.places[self._index][3]
        self._hands.press(button, held, height, lamp, grabbed)
        picks = button == LEFT and not held and not grabbed
        self._pressed = self.place if picks else None

    def release(self):
        """Take that a button is let go: without a drag it has picked a pixel."""
        self._hands.release()
        if self._pressed and self._pressed == self.place:
            self._stage.active = self._index
            self.picked = self._stage.within(*self._local)
        self._pressed = None

    def move(self, place):
        """Take a place of the mouse in pixels of the window."""
        self.place = place
        self._turn(*self._hands.move(place))

    def wheel(self, notches):
        """Take a turn of the wheel."""
        self._index = self.index
        self._turn(*self._hands.wheel(notches))

    def keep(self, left):
        """Take where the pictures begin; what was picked stays on its thing in another size."""
        self.left, shown, view = left, self._stage.shown, self._stage.view
        if not shown or not view:
            return
        half = math.tan(math.radians(shown.camera.fov) / 2.0) * math.dist(*view)
        before, self._lens = self._lens, (shown.size, shown.size[1] / half)
        if self.picked and before and before[0] != shown.size:
            share = self._lens[1] / before[1]
            sides = zip(self.picked, before[0], shown.size, strict=True)
            self.picked = tuple(0.5 * new + share * (x - 0.5 * old) for x, old, new in sides)

    @property
    def _local(self):
        return self.place[0] - self.left, self.place[1]

    def _turn(self, turn, key):
        """Do what the mouse does to the picture under it, to all that are shown."""
        if turn:
            places = self._stage.places
            size = places[min(self._index, len(places) - 1)][2:]
            self._beside.move(lambda one: turn(one, *self._stage.looks(one, size)), key)
