"""The GLSL files of an open scene as texts: as saved, edited and not saved, wrong, put by."""

import contextlib
import json
import os
import re
from typing import NamedTuple

from . import catalog, compose
from .errors import Mistake, one_line
from .files import GLSL, cache_folder, read_text, write_whole

KEPT = 50  # texts that were not saved, and are put by
_LIMIT = 64 << 20  # bytes of them
_AT_FAULT = re.compile(r"(.+?\.(?:glsl|toml)):")


class Draft(NamedTuple):
    """A text that is not saved, and what the file held when it was begun."""

    text: str
    base: str


class Texts:
    """What is known of GLSL files beside what the scene says.

    drafts  {path: Draft}
    faults  {path: line}: what is wrong in a file, until it is put right
    moved   paths of drafts whose file was saved by another program since
    """

    def __init__(self, restored=False):
        self.drafts, self.faults, self.moved = {}, {}, set()
        self._left, self._mine = kept(), set()
        self._saved, self._included, self._readings = {}, {}, 0
        if restored:
            for path in [*self._left]:
                self.take(path)
        self._put_by = self._state

    def text(self, path):
        """Return a file as edited, or as saved; raise Mistake where it cannot be read."""
        return self.drafts[path].text if path in self.drafts else self._on_disk(path)

    def edit(self, path, text):
        """Take a text for a file, which stays as it is."""
        self._mine.add(path)
        base = self.drafts[path].base if path in self.drafts else self._base(path)
        if text == base and path not in self.moved:
            self.drafts.pop(path, None)
        else:
            self.drafts[path] = Draft(text, base)

    def save(self, path):
        """Write the draft of a file; return whether.

        A file that another program has saved meanwhile is left alone, and is in `moved` then. An
        OSError tells that the disk refuses.
        """
        draft = self.drafts.get(path)
        if draft is None or self._is_moved(path):
            return False
        write_text(path, draft.text, _ends(path))
        self.forget(path)
        return True

    def forget(self, path):
        """Have a file as it is saved, and no draft."""
        self.drafts.pop(path, None)
        self.moved.discard(path)
        self._saved.pop(path, None)

    def keep(self, path):
        """Have the draft, whatever another program has saved."""
        self._saved.pop(path, None)
        self.drafts[path] = self.drafts[path]._replace(base=self._base(path))
        self.moved.discard(path)

    def left(self, path):
        """Return whether a window before this one was closed with a draft of the file."""
        draft = None if path in self._mine else self._left.get(path)
        return draft is not None and draft.text != self._base(path)

    def take(self, path):
        """Take up the draft that was left."""
        self._mine.add(path)
        self.drafts[path] = self._left[path]
        self._is_moved(path)

    def decline(self, path):
        """Forget the draft that was left."""
        self._mine.add(path)

    def saved(self, paths):
        """Take that files were saved by somebody; return those that are not edited here."""
        for path in paths:
            self._saved.pop(path, None)
        self._included.clear()
        return [path for path in paths if path not in self.drafts or not self._is_moved(path)]

    def read(self, shader, again=()):
        """Return a Shader as its file or its draft is now, or None, and why not in faults.

        again holds paths of files that were saved since and that it may include.
        """
        try:
            return self.parsed(shader, again)
        except Mistake as mistake:
            self.faults[shader.path] = one_line(mistake)
            return None

    def parsed(self, shader, again=()):
        """Return a Shader as its file or its draft is now; raise Mistake."""
        path, kind, name = shader.path, shader.kind, shader.name
        count = shader.library
        if not self.libraries([shader]).isdisjoint(again):
            self._readings += 1
            count = self._readings
        if path in self.drafts:
            made = catalog.parse(kind, name, path, self.drafts[path].text, edited=True)
        else:
            made = catalog.read(kind, name, edited=True)
        return made._replace(library=count)

    def libraries(self, shaders):
        """Return the paths of the files that Shaders include, directly or not."""
        found = set()
        for shader in shaders:
            if shader.text not in self._included:
                try:
                    files = compose.library(shader.text).values()
                except Mistake:  # one of them cannot be read: told when it is drawn
                    files = ()
                self._included[shader.text] = [path for path, _, _ in files]
            found.update(self._included[shader.text])
        return found

    def put_by(self):
        """Write the drafts where `kept` finds them, beside those of other windows."""
        if self._state == self._put_by:
            return
        others = {path: draft for path, draft in kept().items() if path not in self._mine}
        newest = dict([*others.items(), *self.drafts.items()][-KEPT:])
        with contextlib.suppress(OSError, UnicodeEncodeError):
            os.makedirs(cache_folder(), exist_ok=True)
            write_whole(_place(), [json.dumps(newest).encode()])
            self._put_by = self._state

    @property
    def _state(self):
        return dict(self.drafts), len(self._mine)

    def _on_disk(self, path):
        if path not in self._saved:
            self._saved[path] = catalog.unix(read_text(path, catalog.SOURCE_LIMIT, "a GLSL file"))
        return self._saved[path]

    def _base(self, path):
        with contextlib.suppress(Mistake):
            return self._on_disk(path)
        return ""

    def _is_moved(self, path):
        """Return whether a file is another than when its draft was begun.

        One that is like the draft ends it.
        """
        self._saved.pop(path, None)
        draft, now = self.drafts[path], self._base(path)
        if now == draft.text:
            self.forget(path)
        elif now != draft.base:
            self.moved.add(path)
        return path in self.moved


def at_fault(mistake):
    """Return the path of the file that a Mistake names and that can be edited, or None."""
    found = _AT_FAULT.match(str(mistake))
    path = os.path.abspath(found.group(1)) if found else ""
    return path if os.path.isfile(path) and not ships(path) else None


def ships(path):
    """Return whether a file came with Lumiar, and is never written."""
    return os.path.realpath(path).startswith(os.path.join(os.path.realpath(GLSL), ""))


def write_text(path, text, ends="\n"):
    """Write a text whole, its lines ended so; raise OSError where the disk refuses."""
    write_whole(path, [text.replace("\n", ends).encode("utf-8", "replace")])


def kept():
    """Return {path: Draft} of what was not saved when windows were closed."""
    try:
        data = json.loads(read_text(_place(), _LIMIT, "unsaved texts"))
        return {path: Draft(*map(str, pair)) for path, pair in data.items()}
    except (Mistake, ValueError, TypeError, AttributeError, RecursionError):
        return {}


def _ends(path):
    """Return how the lines of a file end."""
    with contextlib.suppress(Mistake):
        return "\r\n" if "\r\n" in read_text(path, catalog.SOURCE_LIMIT, "a GLSL file") else "\n"
    return "\n"


def _place():
    return os.path.join(cache_folder(), "drafts.json")
