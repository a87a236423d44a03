"""GLSL tried in a process of its own, before the window takes it: a driver may hang or crash."""

import contextlib
import json
import math
import os
import pickle
import re
import select
import signal
import subprocess
import time

from .files import python

LIMIT = 2.0  # seconds of work for a small picture; where others work too, it may take LONGER
LONGER = 5.0  # times
CODE = "from lumiar.tryout import serve; serve()"
START = 30.0  # seconds until a process has begun with it: a mesh may have to be read
SLOW = 10.0  # seconds that a picture of the window may take
_OF_GLSL = re.compile(r"\.(?:glsl|frag|vert|geom):\d+: |does not compile")


class Trial:
    """A process that draws what was edited, small; started when there is something. Release it.

    driver  the renderer's name of the window; what another one does not compile, this one may
    works   whether there can be such a process; else all passes
    """

    def __init__(self, driver=""):
        self.driver, self.works, self._pixels, self._patience = driver, True, 0, SLOW
        self._lines, self._child, self._name, self._warm = {}, None, "", False
        self._asked = None
        self._heard, self._since, self._limit, self._before = b"", 0.0, START, 0.0

    def release(self):
        """End the process."""
        child, self._child, self._asked, self._heard = self._child, None, None, b""
        if child:
            child.kill()
            child.wait()
            for pipe in (child.stdin, child.stdout):
                with contextlib.suppress(OSError):  # what it was told last never arrived
                    pipe.close()

    @property
    def busy(self):
        """Whether something is being tried."""
        return self._asked is not None

    def expect(self, size, cost):
        """Take the size of the window's picture, and how many seconds it takes as it is."""
        self._pixels, self._patience = size[0] * size[1], max(SLOW, 4.0 * cost)

    def line(self, shader):
        """Return what is wrong with a Shader, "" if nothing is, None until that is known."""
        return self._lines.get((shader.path, shader.source)) if self.works else ""

    def trust(self, shader, copy):
        """Know of a copy what is known of a Shader."""
        self._lines[copy.path, copy.source] = self._lines.get((shader.path, shader.source), "")

    def forget(self):
        """Know no more what was wrong: it may be tried again."""
        self._lines = {key: line for key, line in self._lines.items() if not line}

    def start(self):
        """Have the process at hand."""
        if self._child or not self.works:
            return
        command, env = python("-c", CODE)
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        try:
            self._child = subprocess.Popen(command, env=env, stderr=subprocess.DEVNULL, **pipes)
            os.set_blocking(self._child.stdout.fileno(), False)
        except (OSError, AttributeError):  # Windows has no such pipes before Python 3.12
            self.works = False
            self.release()
            return
        self._name, self._warm = "", False

    def ask(self, scene, shaders, before=None):
        """Have a scene tried for the sake of Shaders in it, edited last the last one.

        Nothing else may be being tried. before: a scene that is known to be drawn.
        """
        self._asked = (scene, tuple(shaders))
        self.start()
        if self.works:
            self._limit, self._since, self._before = START, time.monotonic(), 0.0
            told = (None if self._warm else before, scene, [one.source for one in shaders])
            self._warm = True
            with contextlib.suppress(OSError):  # it has ended: `_listen` tells how
                self._child.stdin.write(pickle.dumps(told))
                self._child.stdin.flush()

    def listen(self):
        """Take what the process says."""
        line = None if self._asked is None else self._listen() if self.works else ""
        if line is not None:
            shaders, self._asked = self._asked[1], None
            for shader in shaders if not line else [_at_fault(shaders, line)]:
                self._lines[shader.path, shader.source] = line

    def wait(self):
        """Take what the process says until what was asked is known."""
        while self.busy:
            if self._child:
                select.select([self._child.stdout], [], [], 0.05)
            self.listen()

    def _listen(self):
        """Return the line of what is wrong, "" where nothing is, None while that is not known."""
        heard = None
        with contextlib.suppress(BlockingIOError):
            while heard := os.read(self._child.stdout.fileno(), 65536):
                self._heard += heard
        while b"\n" in self._heard:
            first, _, self._heard = self._heard.partition(b"\n")
            said = json.loads(first)
            self._name = said.get("name", self._name)
            if "began" in said:
                self._limit, self._since = LIMIT, time.monotonic()
                self._before = _worked(self._child.pid)
            if "line" in said:
                return self._judged(said["line"], said["cost"])
        return self._ended(heard == b"") if heard == b"" or self._overdue() else None

    def _overdue(self):
        """Return whether the process has worked longer than it may."""
        took = time.monotonic() - self._since
        worked = min(took, _worked(self._child.pid) - self._before)
        return worked > self._limit or took > LONGER * self._limit

    def _judged(self, line, cost):
        """Return the line for a picture that was drawn, at such a cost in seconds a sample."""
        if self._name != self.driver:
            return ""
        seconds = cost * self._pixels
        if not line and seconds > self._patience:
            return f"{self._blamed}: too slow: this picture would take about {seconds:.0f} s"
        return line if _OF_GLSL.search(line) else ""

    def _ended(self, by_itself):
        """Return the line for a process that has ended, or has to be, and have another one."""
        code = self._child.wait() if by_itself else None
        asked, draws, began = self._asked, bool(self._name), self._limit == LIMIT
        self.release()
        self._asked = asked
        if not draws:  # there can be none here
            self.works = False
            return ""
        self.start()
        if not began:  # what it stumbled over is no GLSL
            return ""
        if code is None:
            why = f"hangs the driver: nothing was drawn in {LIMIT:g} s; look at its loops"
        else:
            name = signal.Signals(-code).name if code < 0 else f"exit code {code}"
            why = f"crashes the driver ({name}); take back what was written last"
        return f"{self._blamed}: {why}"

    @property
    def _blamed(self):
        """The path of the file that was edited last."""
        return self._asked[1][-1].path


def _worked(process):
    """Return the seconds of work of a process, infinity where the system does not tell."""
    try:
        with open(f"/proc/{process}/stat", "rb") as file:
            ticks = file.read().rpartition(b")")[2].split()[11:13]
        return sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return math.inf


def _at_fault(shaders, line):
    """Return the Shader that a line names, else the one edited last."""
    return next((one for one in shaders if line.startswith(f"{one.path}:")), shaders[-1])
