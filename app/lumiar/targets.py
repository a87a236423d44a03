"""The framebuffers that a renderer draws into, kept while they fit."""

from .errors import Mistake

COMMON = 8192  # pixels a side that every driver draws; asking it takes a millisecond


class Targets:
    """Framebuffers of one OnCard owner; release them, in its context."""

    def __init__(self, owner):
        self._owner, self._made = owner, {}

    def release(self):
        """Free all of them."""
        for framebuffer in (f for pair in self._made.values() for f in pair):
            self._owner.free_framebuffer(framebuffer)
        self._made.clear()

    def pair(self, width, rows, side, linear):
        """Return framebuffers (radiance, picture) for rows of a picture, side^2 samples a pixel."""
        key = (width, rows, side, linear)
        if key not in self._made:
            if (width, rows) != (1, 1):  # a pixel that is looked at takes nothing from a picture
                self.release()
            context, size = self._owner.context, (width * side, rows * side)
            _ = context.error  # an older one is not about memory
            radiance = [context.texture(size, 4, dtype="f4")]
            radiance = context.framebuffer(radiance, context.depth_renderbuffer(size))
            pixels = context.texture((width, rows), 4, dtype="f4" if linear else "f1")
            picture = context.framebuffer([pixels])
            self._made[key] = (radiance, picture)
            if context.error != "GL_NO_ERROR":
                self.release()
                raise Mistake(f"the driver has no memory for {width} x {rows} pixels; draw smaller")
        return self._made[key]

    def sum(self, size):
        """Return a framebuffer in which passes of that size are added up."""
        if size not in self._made:
            context = self._owner.context
            self._made[size] = (context.framebuffer([context.texture(size, 4, dtype="f4")]),)
        return self._made[size][0]

    def check(self, width, height, side):
        """Raise Mistake for a size that the driver cannot draw."""
        if max(width, height) * side <= COMMON:
            return
        with self._owner.context as context:
            info = context.info
        most = min(info["GL_MAX_TEXTURE_SIZE"], *info["GL_MAX_VIEWPORT_DIMS"])
        if max(width, height) * side > most:
            raise Mistake(
                f"size {width}x{height} with {side * side} samples is more than this driver draws; "
                f"allowed: up to {most // side} pixels a side, or {most} with samples = 1"
            )
