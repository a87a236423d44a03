"""FLIP of two pictures, found in a process of its own, so that the window goes on."""

import subprocess
import tempfile

from .files import python

_JOB = """
import sys
import numpy as np
from lumiar import difference
shape = (2, int(sys.argv[2]), int(sys.argv[1]), 3)
a, b = np.frombuffer(sys.stdin.buffer.read(), np.uint8).reshape(shape).astype(np.float32) / 255.0
print(difference.flip(a, b, False))
"""


class Judge:
    """Finds one number at a time; release it.

    value is None until it is known, and where it cannot be found.
    """

    def __init__(self):
        self._process, self.value = None, None

    @property
    def busy(self):
        """Whether the number is still to come; takes it where it has come."""
        if self._process and self._process.poll() is not None:
            said, _ = self._process.communicate()
            self.value = float(said) if self._process.returncode == 0 else None
            self._process = None
        return self._process is not None

    def ask(self, size, a, b):
        """Begin to find the FLIP of b against a, bytes of sRGB of pictures (width, height)."""
        self.release()
        command, env = python("-c", _JOB, *map(str, size))
        with tempfile.TemporaryFile() as both:
            both.write(a + b)
            both.seek(0)
            self._process = subprocess.Popen(
                command,
                stdin=both,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env={**env, "OPENBLAS_NUM_THREADS": "1"},
            )

    def release(self):
        """Give up what is not known yet."""
        if self._process:
            self._process.kill()
            self._process.communicate()
        self._process, self.value = None, None
