"""The scale of a false-colour picture: which values it spans, its ticks, and a colour for each."""

import math
from typing import NamedTuple

import numpy as np

# viridis of N. J. Smith and S. van der Walt, 2015 (CC0, from matplotlib 3.11.2), at 33 even steps:
# straight lines between them are within 2/255 of its 256 colours.
VIRIDIS = bytes.fromhex(
    "440154470d6048186a482374472d7b4536814240863f49893b528b375a8d33638d2f6a8e2c728e297a8e26818e23898e"
    "21908c1f988b1f9f8821a68528ae8031b57b3ebc744cc26c5dc9636ece5882d34c96d83fabdc32c0df24d5e21aeae51a"
    "fde725"
)
EMPTY, BROKEN = (96, 96, 96), (255, 0, 255)  # no surface; NaN or infinite
DECADES = 3.0  # from which on a scale is logarithmic
FAR_BELOW = 0.04  # of the largest value: half of them below it hide in one colour
LONGEST = 6.0  # decades below the largest value, that a logarithmic one goes down to
TICKS = 5
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Scale(NamedTuple):
    """A scale from low to high; what lies beyond has the colour of the end.

    step is from mark to mark of a linear scale whose ends are marks, 0 of a logarithmic one.
    """

    low: float
    high: float
    step: float = 0.0

    @property
    def log(self):
        """Whether it is logarithmic."""
        return self.step == 0.0

    def share(self, values):
        """Return where values (an array, or a number) stand on the scale, 0 to 1, float64."""
        values = np.asarray(values, np.float64)
        low, high = self.low, self.high
        if self.log:
            values = np.log10(np.maximum(values, low))
            low, high = math.log10(low), math.log10(high)
        return np.clip((values - low) / (high - low), 0.0, 1.0)

    def ticks(self):
        """Return [(share, label)] of the marks; a mark in between has an empty label."""
        return self._log_ticks() if self.log else self._linear_ticks()

    def _linear_ticks(self):
        first, last = round(self.low / self.step), round(self.high / self.step)
        power = math.floor(math.log10(self.high) + 1e-9)
        unit = 10.0**power if power >= 6 or self.step < 1e-4 else 1.0
        end = f"·{_power(power, plain=False)}" if unit != 1.0 else ""
        marks = [i * self.step / unit for i in range(first, last + 1)]
        digits = next((d for d in range(9) if _whole(self.step / unit * 10**d)), 9)
        labels = [f"{x:.{digits}f}{end}" if x else "0" for x in marks]
        return [(i / (last - first), label) for i, label in enumerate(labels)]

    def _log_ticks(self):
        first, last = math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))
        found = []
        for power in range(first, last + 1):
            for digit in range(1, 10):
                value = digit * 10.0**power
                if self.low * 0.999 <= value <= self.high * 1.001:
                    label = _power(power) if digit == 1 else ""
                    found.append((float(self.share(value)), label))
        return found


def fitting(values):
    """Return the Scale that shows values, an array without NaN, none of them below 0.

    Its ends are round. Linear, from 0 unless all is within the upper half of it; logarithmic where
    a twentieth of the values that are not 0 lie DECADES below the largest, or half of them
    FAR_BELOW it, as beside a lamp.
    """
    high = float(values.max(initial=0.0))
    if not high > 0.0:
        return Scale(0.0, 1.0, 0.2)
    positive = values[values > 0.0]
    dim, middle = (float(x) for x in np.quantile(positive, (0.05, 0.5)))
    if dim < high * 10.0**-DECADES or middle < FAR_BELOW * high:
        low = max(float(np.quantile(positive, 0.01)), high * 10.0**-LONGEST)
        return Scale(_round_digit(low, math.floor), _round_digit(high, math.ceil))
    low = float(values.min())
    if not 0.5 * high < low < 0.98 * high:  # nearly constant: more digits would show noise
        low = 0.0
    step = _step(high - low)
    return Scale(math.floor(low / step) * step, math.ceil(high / step - 1e-6) * step, step)


def colours(values, scale, surface):
    """Return (height, width, 3) uint8 of values (height, width) in false colour.

    surface (height, width) says where there is one; NaN and infinity on it are magenta.
    """
    finite = np.isfinite(values)
    share = scale.share(np.where(finite, values, scale.low))
    painted = _MAP[np.rint(share * (len(_MAP) - 1)).astype(np.intp)]
    painted[~finite] = BROKEN
    painted[~surface] = EMPTY
    return painted


def ramp(count):
    """Return `count` colours (bytes of sRGB, 3 each) from one end of the map to the other."""
    return _MAP[np.linspace(0, len(_MAP) - 1, count).round().astype(np.intp)].tobytes()


def _smooth(table, count=1024):
    """Return (count, 3) uint8 on straight lines between the colours of a table."""
    given = np.frombuffer(table, np.uint8).reshape(-1, 3)
    at = np.linspace(0, len(given) - 1, count)
    lines = [np.interp(at, np.arange(len(given)), channel) for channel in given.T]
    return np.rint(np.stack(lines, axis=1)).astype(np.uint8)


def _whole(x):
    """Return whether a number is whole, but for rounding."""
    return abs(x - round(x)) < 1e-6


def _power(power, plain=True):
    """Return a power of ten as one reads it: 0.01, 1000, 10⁶."""
    if plain and -3 < power < 5:
        return f"{10.0**power:g}"
    return "10" + str(power).translate(_RAISED)


def _step(extent):
    """Return the round number, 1, 2, 2.5 or 5 times a power of ten, nearest to a TICKS-th of it."""
    rough = extent / TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    steps = [digit * power for digit in (1.0, 2.0, 2.5, 5.0, 10.0)]
    return min(steps, key=lambda step: abs(math.log(step / rough)))


def _round_digit(x, towards):
    """Return the number with one digit next to x, below or above as `towards` rounds."""
    power = 10.0 ** math.floor(math.log10(x))
    return towards(x / power + (1e-9 if towards is math.floor else -1e-9)) * power


_MAP = _smooth(VIRIDIS)
