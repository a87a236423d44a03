"""Which of some files were saved anew: by their size and time, a few times a second."""

import os

SETTLED = 0.05  # seconds that a file must stay as it is: editors save in several steps


class Watch:
    """Looks at files; `changed` tells which were saved since."""

    def __init__(self):
        self._seen, self._moving = {}, {}

    def follow(self, paths):
        """Look at these files from now on, and at no others."""
        self._seen = {path: self._seen.get(path) or _state(path) for path in paths}
        self._moving = {path: at for path, at in self._moving.items() if path in self._seen}

    @property
    def paths(self):
        """The files that are looked at."""
        return {*self._seen}

    @property
    def moving(self):
        """{path: its state} of the files that were saved a moment ago, and may not be whole yet."""
        return {path: state for path, (state, _) in self._moving.items()}

    @property
    def restless(self):
        """Whether a file was saved a moment ago, and may not be whole yet."""
        return bool(self._moving)

    def changed(self, now):
        """Return the paths of the files that were saved and have settled; now in seconds."""
        found = []
        for path, seen in self._seen.items():
            state = _state(path)
            before, since = self._moving.get(path, (seen, now))
            if state is None or state == seen:  # some editors delete it first
                self._moving.pop(path, None)
            elif state != before:
                self._moving[path] = (state, now)
            elif now - since >= SETTLED:
                found.append(path)
        for path in found:
            self._seen[path] = self._moving.pop(path)[0]
        return found


def _state(path):
    try:
        status = os.stat(path)
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino
