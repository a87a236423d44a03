"""The audit of a model in a process of its own, while the window goes on; what it found is kept."""

import contextlib
import json
import os
import shutil
import subprocess
import tempfile

from . import __version__, cache, catalog
from .errors import Mistake, one_line
from .files import GLSL, python, write_whole

_JUDGES = ("audit", "claims", "compose", "examine", "hostile", "measure", "reference")


class Auditor:
    """Audits one model at a time; release it.

    driver: what the sheets are of, beside the model: the renderer's name.
    """

    def __init__(self, driver):
        self._driver, self._known = driver, {}
        self._key = self._child = self._folder = self._said = None

    def release(self):
        """Stop what is being audited."""
        if self._child:
            self._child.terminate()  # it stops its own child, too
            self._child.wait()
            self._tidy()

    def sheet(self, model):
        """Return the data sheet of a catalog.Shader as `audit.audit` does, None until it is there.

        A model that cannot be audited has a sheet with a "fault", the line of why. One that is
        asked for while another one is being audited takes its place.
        """
        key = (model.path, model.text, *_stamps(os.path.join(GLSL, "lib")))
        if key not in self._known and self._key != key:
            self.release()
            self._begin(key, model)
        if self._child and self._child.poll() is not None:
            self._end()
        return self._known.get(key)

    def _begin(self, key, model):
        self._key = key
        if kept := cache.get(self._entry()):
            self._known[key] = json.loads(bytes(kept[0]))
            return
        name = model.name
        with contextlib.suppress(Mistake):
            name = name if catalog.read("model", name).text == model.text else ""
        try:
            self._folder = tempfile.mkdtemp(prefix="lumiar-")
            if not name:  # as it is in the window, not as it was saved
                name = os.path.join(self._folder, os.path.basename(model.path))
                write_whole(name, [model.text.encode()])
            self._said = [
                open(os.path.join(self._folder, part), "w+b")  # noqa: SIM115  closed by _tidy
                for part in ("out", "err")
            ]
            command, env = python("-m", "lumiar", "audit", name, "--json")
            pipes = dict(zip(("stdout", "stderr"), self._said, strict=True))
            self._child = subprocess.Popen(command, env=env, stdin=subprocess.DEVNULL, **pipes)
            with contextlib.suppress(OSError, AttributeError):
                os.setpriority(os.PRIO_PROCESS, self._child.pid, 5)  # the window comes first
        except OSError as error:
            self._known[key] = {"fault": one_line(error)}
            self._tidy()

    def _end(self):
        told, faults = [], ""
        for file in self._said:
            file.seek(0)
            told.append(file.read().decode("utf-8", "replace"))
        try:
            (sheet,) = json.loads(told[0]).values()
            cache.put(self._entry(), [json.dumps(sheet).encode()])
        except ValueError:
            faults = told[1].strip().rpartition("\n")[2] or f"exit code {self._child.returncode}"
            sheet = {"fault": one_line(faults.removeprefix("lumiar: "))}
        self._known[self._key] = sheet
        self._tidy()

    def _entry(self):
        """Return the key of what is kept between windows."""
        here = os.path.dirname(os.path.abspath(__file__))
        own = [one for one in _stamps(here) if one[0].partition(".")[0].startswith(_JUDGES)]
        return ("audit", __version__, self._driver, *own, *self._key[1:])

    def _tidy(self):
        for file in self._said or ():
            file.close()
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)
        self._key = self._child = self._folder = self._said = None


def _stamps(folder):
    """Return (name, size, time) of the files of a folder, in order."""
    with os.scandir(folder) as entries:
        found = [(one.name, one.stat().st_size, one.stat().st_mtime_ns) for one in entries]
    return sorted(found)
