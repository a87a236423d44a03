"""Undo and redo over scenes that never change: a list of them and a place in it."""

MOST = 1000  # steps that are kept; scenes share what they have in common


class History:
    """The scenes that were, the one that is, and those that were undone.

    A change pushed with a key replaces the one before if that had the same key: so one drag of a
    slider is one step, however many scenes it passed through. A push without a key, also of the
    same scene, ends the drag.
    """

    def __init__(self, scene):
        self._past, self._future, self._key = [], [], None
        self._scene = scene

    @property
    def scene(self):
        """The scene that is."""
        return self._scene

    @property
    def able(self):
        """Which of "undo" and "redo" would do something."""
        return ("undo",) * bool(self._past) + ("redo",) * bool(self._future)

    def push(self, scene, key=None):
        """Make `scene` the one that is, forget what was undone, and return it."""
        if scene != self._scene:
            if key is None or key != self._key:
                self._past = [*self._past[1 - MOST :], self._scene]
            self._scene, self._future, self._key = scene, [], key
        elif key != self._key:
            self._key = None
        return self._scene

    def undo(self):
        """Return the scene before the last step, now the one that is; where it is the first, it."""
        return self._step(self._past, self._future)

    def redo(self):
        """Return the scene that was undone last, now the one that is; without one, that stays."""
        return self._step(self._future, self._past)

    def _step(self, source, rest):
        if source:
            rest.append(self._scene)
            self._scene = source.pop()
        self._key = None
        return self._scene
