"""The time of a scene as it runs: from where it was, in real seconds, around and around."""


class Clock:
    """Stands still, or runs; period: seconds after which it begins at 0 again."""

    def __init__(self, period):
        self._period, self._started, self.time = period, None, 0.0

    @property
    def runs(self):
        """Whether it runs; `time` is where it was at the last tick."""
        return self._started is not None

    def start(self, now, time=0.0):
        """Run from a time on; now in seconds."""
        self._started, self.time = now - time, time

    def stop(self):
        """Stand still."""
        self._started = None

    def tick(self, now):
        """Take that it is now."""
        if self.runs:
            self.time = (now - self._started) % self._period
