"""GLSL tried in a process of its own before the window takes it, since a driver may hang or crash."""

import contextlib
import json
import os
import pickle
import re
import select
import signal
import subprocess
import sys
import time

LIMIT = 2.0  # seconds for a small picture
START = 30.0  # seconds until a process has begun with it: a mesh may have to be read
SLOW = 10.0  # seconds that a picture of the window may take
_OF_GLSL = re.compile(r"\.(?:glsl|frag|vert|geom):\d+: |does not compile")


class Trial:
    """A process that draws what was edited, small; started when there is something. Release it.

    driver  the renderer's name of the window; what another one does not compile, this one may
    pixels  samples in the window's picture; patience: seconds that one may take
    works   whether there can be such a process; else all passes
    """

    def __init__(self, driver=""):
        self.driver, self.pixels, self.patience, self.works = driver, 0, SLOW, True
        self._passed, self._child, self._name, self._warm = set(), None, "", False
        self._asked = self._next = None
        self._heard, self._since, self._limit = b"", 0.0, START

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

    def passed(self, shader):
        """Return whether a catalog.Shader has been drawn as it is now."""
        return (shader.path, shader.source) in self._passed

    def start(self):
        """Have the process at hand."""
        if self._child or not self.works:
            return
        own = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
        paths = os.pathsep.join(filter(None, (own, os.environ.get("PYTHONPATH"))))
        env = {**os.environ, "PYTHONPATH": paths}
        env.pop("LUMIAR_SUPERVISOR", None)
        command = [sys.executable, "-c", "from lumiar.tryout import serve; serve()"]
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        try:
            self._child = subprocess.Popen(command, env=env, stderr=subprocess.DEVNULL, **pipes)
            os.set_blocking(self._child.stdout.fileno(), False)
        except (OSError, AttributeError):  # Windows has no such pipes before Python 3.12
            self.works = False
            self.release()
            return
        self._name, self._warm = "", False
        self._limit, self._since = START, time.monotonic()

    def ask(self, scene, shaders, before=None):
        """Have a scene tried for the sake of Shaders in it, edited last the last one.

        What was asked before is dropped. before: a scene that is known to be drawn.
        """
        self._next = (scene, tuple(shaders), before)
        if not self._asked:
            self._send()

    def answer(self):
        """Return (shaders, the line of what is wrong or "") of what was asked last, or None."""
        if self._asked is None:
            return None
        line = self._listen() if self.works else ""
        if line is None:
            return None
        shaders, self._asked = self._asked[1], None
        if not line:
            self._passed |= {(one.path, one.source) for one in shaders}
        if self._next:
            self._send()
            return None if self._asked else self.answer()
        return shaders, line

    def wait(self):
        """Return what `answer` does, once it is there."""
        while self.busy:
            if self._child:
                select.select([self._child.stdout], [], [], 0.05)
            answer = self.answer()
            if answer:
                return answer
        return (), ""

    def _send(self):
        self._asked, self._next = self._next, None
        self.start()
        if self.works:
            scene, shaders, before = self._asked
            self._limit, self._since = START, time.monotonic()
            told = (None if self._warm else before, scene, [one.source for one in shaders])
            self._warm = True
            with contextlib.suppress(OSError):  # it has ended: `_listen` tells how
                self._child.stdin.write(pickle.dumps(told))
                self._child.stdin.flush()

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
            if "line" in said:
                return self._judged(said["line"], said["cost"])
        if heard == b"" or time.monotonic() - self._since > self._limit:
            return self._ended(heard == b"")
        return None

    def _judged(self, line, cost):
        """Return the line for a picture that was drawn, at such a cost in seconds a sample."""
        if self._name != self.driver:
            return ""
        seconds = cost * self.pixels
        if not line and seconds > self.patience:
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
