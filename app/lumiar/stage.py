"""The pictures in the window: how many, where each stands, and what is between them."""

import contextlib

from . import compare, hands
from .easel import Easel
from .errors import Mistake
from .renderer import Renderer

PROMPT = 0.04  # seconds that all pictures may take while they move
PAPER = (0.16, 0.17, 0.2)  # between pictures
REST = 0.2  # seconds without a change before those that take longer are drawn in full


class Stage:
    """The pictures that are shown, an Easel for each; release it.

    good    the last scene as edited with which all could be drawn
    fault   the line of what keeps a picture from being drawn, or ""
    cost    seconds that all took when they were drawn last
    active  the index of the one that was clicked last, which shown, view and canvas are of
    places  (left, top, width, height) of each, in pixels of the area that they fill
    deviation  the Deviation of the two of which the difference is shown, else None
    area    the (width, height) in pixels that they fill together
    share   of the width where one ends and the other begins, of two on either side of a line
    """

    def __init__(self, context):
        self.context, self.renderer = context, Renderer(context)
        self.easels, self.places, self.active = [Easel(context)], [(0, 0, 1, 1)], 0
        self.mode, self.share = "one", 0.5
        self.good, self.cost = None, 0.0
        self.deviation, self.area = None, (1, 1)

    @property
    def shown(self):
        """The scene of the active picture, as framed for it."""
        return self.easels[self.active].shown

    @property
    def view(self):
        """Its (eye, target)."""
        return self.easels[self.active].view

    @property
    def canvas(self):
        """The framebuffer that it is in."""
        return self.easels[self.active].canvas

    @property
    def coarse(self):
        """Whether a picture has one sample per pixel, as while it moves."""
        return any(one.coarse for one in self.easels)

    @property
    def broken(self):
        """How many pixels have no finite radiance."""
        return sum(one.broken or 0 for one in self.easels)

    @property
    def begun(self):
        """Whether rows of a picture that takes long are still to be drawn."""
        return any(one.begun for one in self.easels)

    @property
    def busy(self):
        """Whether a number is still to come."""
        counts = any(one.broken is None for one in self.easels)
        return counts or bool(self.deviation and self.deviation.busy)

    @property
    def fault(self):
        """The line of what keeps a picture from being drawn, after its letter; or ""."""
        several = len(self.easels) > 1
        for letter, one in zip(compare.LETTERS, self.easels, strict=False):
            if one.fault:
                return f"{letter}: {one.fault}" if several else one.fault
        return ""

    def release(self):
        """Free what is on the card."""
        for one in self.easels:
            one.release()
        self._end_difference()
        self.renderer.release()

    def restart(self):
        """Forget all that was compiled and loaded."""
        self.renderer.release()
        self.renderer = Renderer(self.context)
        self.stale()

    def stale(self):
        """Have the next pictures drawn, whatever they show: a file of theirs may be another one."""
        for one in self.easels:
            one.stale()
        self.renderer.forget()

    def draw(self, beside, scene, size, since):
        """Bring the pictures up to date; since: seconds for which nothing has changed.

        beside   a Beside, of whose pictures each is shown
        scene    as edited; size: of the area that the pictures fill

        Pictures that take long have one sample per pixel while they move, all of them at rest.
        The default scene is in the place of one that could not be drawn yet.
        """
        mode, pictures = beside.comparison.mode, beside.pictures
        self._place(len(pictures), mode, size)
        coarse = self.cost > PROMPT and since < REST
        drawn = [
            one.draw(picture.scene, picture.fault, place[2:], coarse, self.renderer)
            for one, picture, place in zip(self.easels, pictures, self.places, strict=True)
        ]
        if any(drawn):
            self.cost = sum(one.cost for one in self.easels)
        for one in self.easels if since >= REST else ():  # it takes milliseconds
            one.count()
        if mode == "difference":
            if self.deviation is None:
                from .deviation import Deviation

                self.deviation = Deviation(self.context)
            canvases = [one.canvas for one in self.easels]
            self.deviation.follow(*canvases, any(drawn), self.coarse or since < REST)
        elif self.deviation:
            self._end_difference()
        if not self.fault:
            self.good = scene

    def at(self, x, y):
        """Return the index of the picture at a pixel of the area; beside all of them the first."""
        if self.mode == "split":
            return int(x >= self.share * self.places[0][2])
        for i, (left, top, wide, high) in enumerate(self.places):
            if left <= x < left + wide and top <= y < top + high and self.mode == "grid":
                return i
        return 0

    def looks(self, scene, size):
        """Return a scene, or the last one that could be drawn, as framed, and its viewpoint.

        (None, None) where neither can be.
        """
        for one in filter(None, (scene, self.good)):
            with contextlib.suppress(Mistake):
                shown = hands.framed(one, size)
                return shown, self.renderer.viewpoint(shown)
        return None, None

    def slide(self, by):
        """Move the line between two pictures by a share of the width."""
        self.share = max(0.0, min(1.0, self.share + by))

    def within(self, x, y):
        """Return the pixel of the picture there that is a pixel of the area."""
        left, top, *_ = self.places[self.at(x, y)]
        return x - left, y - top

    def corner(self, left):
        """Return where in the window the active picture begins, if the area does at `left`."""
        x, y, *_ = self.places[self.active]
        return left + x, y

    def present(self, overlay, left):
        """Bring the pictures into the window, from a pixel of its width on."""
        screen = self.context.screen
        textures = [one.canvas.color_attachments[0] for one in self.easels]
        width, height = self.area
        if self.mode == "split":
            line = round(self.share * width)
            for texture, begin, end in zip(textures, (0, line), (line, width), strict=True):
                if end > begin:
                    overlay.picture(
                        texture, screen, (left, 0), (left + begin, 0, end - begin, height)
                    )
            return
        if self.mode == "difference":
            textures = [self.deviation.canvas.color_attachments[0]]
        elif self.mode == "grid":
            screen.use()
            screen.clear(*PAPER)
        for texture, (x, y, _, high) in zip(textures, self.places, strict=False):
            overlay.picture(texture, screen, (left + x, height - y - high))

    def _end_difference(self):
        if self.deviation:
            self.deviation.release()
            self.deviation = None

    def _place(self, count, mode, size):
        """Have as many easels as there are pictures, each with its place."""
        while len(self.easels) > count:
            self.easels.pop().release()
        while len(self.easels) < count:
            self.easels.append(Easel(self.context))
        self.active, self.mode = min(self.active, count - 1), mode
        self.places, self.area = compare.places(mode, count, size), size
