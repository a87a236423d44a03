"""The hard cases of a model: directions that break formulas, and every corner of its sliders."""

import itertools
import math
import random

import numpy as np

from .measure import polar, upper

ANGLES = (0.0, 1e-4, 0.06, 1.0, 5.0, 20.0, 41.8, 60.0, 80.0, 85.0, 89.9, 89.999, 90.0)  # degrees
TURNS = (0.0, 37.0, 90.0, 180.0, 217.0)  # degrees around the normal; each has its opposite or not
NOISE = 2.0**-24  # half a step of a float32, of its value
BELOW = -1e-7  # cosine just below the horizon
MOST_CHOICES = 96  # combinations of choices and toggles that are tried
MOST_SLIDERS = 5  # of which every corner is tried; with more of them, some by chance


def directions(model_values):
    """Return hostile directions (m, 3) float32: every pair of them is a case.

    The exact normal, grazing, exactly on and just below the horizon, the critical angle of an index
    of refraction among the values and its neighbours, and the opposite of each, so that L = V and
    L = -V are among the pairs, and below the surface too.
    """
    turns = np.radians(TURNS)
    rings = [polar(np.radians(a), turns if a else turns[:1]) for a in ANGLES]
    rings.append(np.add(polar(math.pi / 2.0, turns), (0.0, 0.0, BELOW)))
    eta = model_values.get("eta")
    for n in {eta, 1.0 / eta} if isinstance(eta, float) and eta > 0.0 else ():
        if n > 1.0:
            z = np.float32(math.sqrt((1.0 - 1.0 / n) * (1.0 + 1.0 / n)))  # of sin(theta) = 1 / n
            for cosine in (np.nextafter(z, np.float32(0)), z, np.nextafter(z, np.float32(2))):
                rings.append(polar(math.acos(cosine), turns[:2]))
                rings[-1][:, 2] = cosine
    above = np.concatenate(rings).astype(np.float32)
    return np.unique(np.concatenate([above, -above]), axis=0)


def choices(model, seed=0):
    """Return the combinations {name: value} of a model's choices and toggles, the default first.

    All of them; where there are more than MOST_CHOICES, those that differ from the default in one
    place, and others drawn by `seed`.
    """
    fixed = [p for p in model.parameters if p.constant]
    ranges = [p.choices if p.widget == "choice" else (False, True) for p in fixed]
    rows = list(itertools.islice(itertools.product(*ranges), 1 << 16))
    random.Random(seed).shuffle(rows)
    rows.sort(key=lambda row: sum(v != p.default for p, v in zip(fixed, row, strict=True)) > 1)
    rows.sort(key=lambda row: any(v != p.default for p, v in zip(fixed, row, strict=True)))
    rows = rows[:MOST_CHOICES]
    return [dict(zip((p.name for p in fixed), row, strict=True)) for row in rows]


def corners(model, names, seed=0):
    """Return the slider settings {name: value} to try: every corner of the named sliders.

    With more than MOST_SLIDERS: both ends of all, each one alone at its ends, and some by chance.
    """
    sliders = [p for p in model.parameters if p.name in names and p.widget in ("slider", "color")]
    ends = {p.name: [_filled(p, p.low), _filled(p, p.high)] for p in sliders}
    keys = list(ends)
    if len(keys) <= MOST_SLIDERS:
        rows = list(itertools.product(*ends.values()))
    else:
        drawn = random.Random(seed)
        rows = [tuple(ends[k][side] for k in keys) for side in (0, 1)]
        rows += [
            tuple(
                ends[k][side] if k == one else p.default for k, p in zip(keys, sliders, strict=True)
            )
            for one in keys
            for side in (0, 1)
        ]
        rows += [tuple(drawn.choice(ends[k]) for k in keys) for _ in range(1 << MOST_SLIDERS)]
    return [dict(zip(keys, row, strict=True)) for row in rows]


def anywhere(model, names, count, seed=0):
    """Return `count` settings {name: value} of the named sliders between their ends, by chance."""
    drawn = random.Random(seed)
    sliders = [p for p in model.parameters if p.name in names and p.widget in ("slider", "color")]

    def value(p):
        share = drawn.random()
        if p.widget == "color" and share > 0.3:
            return p.high  # where energy is gained, it shows
        if p.log:
            return p.low * (p.high / p.low) ** share
        return p.low + (p.high - p.low) * share

    return [{p.name: _filled(p, value(p)) for p in sliders} for _ in range(count)]


def _filled(parameter, number):
    """Return a checked value of a parameter with every component the same number."""
    number = round(number) if parameter.type == "int" else number
    return parameter.check(number)


def ordinary(both, seed=7):
    """Return L, V (n, 3) float32 of ordinary pairs: spread evenly, near mirroring, and retro."""
    generator = np.random.default_rng(seed)
    L, V = (upper(generator.random((3000, 2))) for _ in range(2))
    V[:1400] = L[:1400] * [-1.0, -1.0, 1.0]  # narrow lobes stand here
    V[1400:1600] = L[1400:1600]
    V[:1600] += generator.normal(size=(1600, 3)) * 10.0 ** generator.uniform(-4.5, -0.5, (1600, 1))
    V[:1600, 2] = np.abs(V[:1600, 2])
    V /= np.linalg.norm(V, axis=1, keepdims=True)
    if both:
        L[::2, 2] *= -1.0
        V[::3, 2] *= -1.0
    return L.astype(np.float32), V.astype(np.float32)


def moved(L, V, seed):
    """Return L and V in float64, each component moved by the rounding of a float32 up or down.

    How far a value follows is what no float32 program that is handed directions can know better.
    """
    generator = np.random.default_rng(seed)
    signs = (generator.choice((-NOISE, NOISE), w.shape) for w in (L, V))
    return tuple(w.astype(np.float64) * (1.0 + sign) for w, sign in zip((L, V), signs, strict=True))


def rounded(values, seed):
    """Return slider values moved by the rounding of a float32 up or down; see `moved`."""
    drawn = random.Random(seed)

    def turn(value):
        if isinstance(value, tuple):
            return tuple(map(turn, value))
        return value * (1.0 + drawn.choice((-NOISE, NOISE))) if type(value) is float else value

    return {name: turn(value) for name, value in values.items()}
