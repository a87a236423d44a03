"""Films: the scenes of a turntable or a sweep frame by frame, encoded while the next is drawn."""

import contextlib
import io
import math
import os
import queue
import threading

from . import files, image, navigate, settings
from .errors import Mistake, one_line

ENDINGS = (".webp", ".png", ".gif")
MOST = 16383  # pixels a side that a WebP has


def turntable(scene, view, count):
    """Yield the scenes of one full turn of the eye about its target, the last next to the first.

    view: (eye, target) of the scene as it is drawn.
    """
    for i in range(count):
        camera = scene.camera
        if camera.position:
            camera = navigate.orbit(camera, *view, -2.0 * i / count, 0.0) if i else camera
        else:
            azimuth = math.remainder(camera.azimuth + 360.0 * i / count, 360.0)
            camera = camera._replace(azimuth=azimuth) if i else camera
        yield scene._replace(camera=camera)


def sweep(scene, key, start, end, count, back=False):
    """Yield the scenes in which a value goes from start to end, or there and back without a halt.

    key: of one number, as `settings.changed` takes it. It moves as on its slider, evenly, or by
    equal factors where that is logarithmic.
    """
    parameter = settings.found(scene, key)[0]
    for i in range(count):
        share = 1.0 - abs(1.0 - 2.0 * i / count) if back else i / max(1, count - 1)
        yield settings.changed(scene, key, between(parameter, start, end, share))


def between(parameter, start, end, share):
    """Return the value of a Parameter at a share of the way from start to end."""
    if share in (0.0, 1.0):
        return end if share else start
    if parameter.logarithmic and start > 0.0 and end > 0.0:
        value = start * (end / start) ** share
    else:
        value = start + (end - start) * share
    return round(value) if parameter.type == "int" else value


class Film:
    """A film that is being made: `put` its frames, until `done`; release it to give it up.

    path    ends in one of ENDINGS; the file is there once the film is done, whole or not at all
    fault   the line of what went wrong, or ""
    chunks  what a .png has to carry, as `image.png` takes them
    """

    def __init__(self, path, size, count, rate, lossless=True, chunks=()):
        if max(size) > MOST:
            raise Mistake(f"size {size[0]}x{size[1]}: a film has at most {MOST} pixels a side")
        self.path, self.count, self.fault, self.given = path, count, "", 0
        self._frames, self._wanted = queue.Queue(2), True
        self._job = threading.Thread(
            target=self._make, args=(size, rate, lossless, chunks), daemon=True
        )
        self._job.start()

    @property
    def ready(self):
        """Whether another frame is wanted, and can be put in at once."""
        return self.given < self.count and not self._frames.full() and not self.done

    @property
    def done(self):
        """Whether the film is written, or never will be."""
        return not self._job.is_alive()

    def put(self, pixels):
        """Take the next frame: bytes of sRGB, rows from the top."""
        self._frames.put(pixels)
        self.given += 1

    def release(self):
        """Give up what is not yet written, without a trace; the second time does nothing."""
        self._wanted = False
        with contextlib.suppress(queue.Full):
            self._frames.put_nowait(None)
        self._job.join()

    def _make(self, size, rate, lossless, chunks):
        try:
            ending = os.path.splitext(self.path)[1]
            frames = (self._next() for _ in range(self.count))
            data = [*encoded(ending, size, frames, rate, lossless, chunks)]
            if self._wanted:
                files.write_whole(self.path, data)
        except _GivenUp:
            pass
        except Exception as error:  # whatever an encoder raises, there is no film
            self.fault = f"{self.path}: {one_line(error)}"

    def _next(self):
        pixels = self._frames.get() if self._wanted else None
        if pixels is None:
            raise _GivenUp
        return pixels


class _GivenUp(Exception):
    """No more frames will come."""


def encoded(ending, size, frames, rate, lossless=True, chunks=()):
    """Yield the bytes of a film that runs for ever: WebP, an animated PNG, or a GIF.

    frames: an iterator of bytes of sRGB; rate: of them in a second. A GIF has 256 colours a frame,
    and times in hundredths of a second.
    """
    if ending == ".png":
        yield from image.animated(size, frames, rate, chunks)
        return
    from PIL import Image

    pictures = (Image.frombytes("RGB", size, pixels) for pixels in frames)
    out, first = io.BytesIO(), next(pictures)
    how = {"save_all": True, "append_images": pictures, "loop": 0}
    if ending == ".gif":
        how["duration"] = 10 * max(
            2, math.floor(100.0 / rate + 0.5)
        )  # what is shorter, viewers slow down
    else:
        quality = 30 if lossless else 90  # of lossless ones: how hard it tries
        how |= {"duration": round(1000.0 / rate), "lossless": lossless, "quality": quality}
        how["method"] = 2
    first.save(out, ending[1:].upper(), **how)
    yield out.getvalue()
