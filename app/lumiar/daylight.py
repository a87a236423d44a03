"""Daylight by turbidity and solar height: the sky and the sun of Hosek and Wilkie, in float64.

Plain Python, so that a picture needs no NumPy. RGB is linear sRGB in Lumiar's scale: luminance over
units.EFFICACY is the weighted sum of the channels. assets/sky/SOURCES.md says whose data these are.
"""

import functools
import math
import os
import sys
from array import array
from typing import NamedTuple

from . import spectrum, units
from .files import ASSETS, read_bytes

RADIUS = math.radians(0.2665)  # of the sun's disk
SOLID_ANGLE = 4.0 * math.pi * math.sin(RADIUS / 2.0) ** 2  # 6.797e-5 sr
_BINOMIALS = (1, 5, 10, 10, 5, 1)
_PIECES, _WAVES = 45, range(320, 721, 40)  # cubics over the solar height, each at these nm


class Sky(NamedTuple):
    """The skylight of one sun: nine (X, Y, Z) coefficients A to I, and the radiance they scale."""

    coefficients: tuple
    radiance: tuple


def direction(height, azimuth):
    """Return the unit vector to the sun: y is up, the azimuth runs from +z toward +x; radians."""
    flat = math.cos(height)
    return flat * math.sin(azimuth), math.sin(height), flat * math.cos(azimuth)


def sky(turbidity, albedo, height):
    """Return the Sky for a turbidity in [1, 10] over ground of an albedo in [0, 1].

    height: of the sun, radians in [0, pi/2].
    L. Hosek and A. Wilkie, "An analytic model for full spectral sky-dome radiance", SIGGRAPH 2012:
    a quintic Bezier curve in the cube root of the height, linear in turbidity and albedo.
    """
    x = min(height / (math.pi / 2.0), 1.0) ** (1.0 / 3.0)
    curve = [b * x**i * (1.0 - x) ** (5 - i) for i, b in enumerate(_BINOMIALS)]
    data, (low, high, share) = _data("sky.f64", "d"), _between(turbidity)
    weights = [
        (600 * ground + 60 * step + 10 * point, a * t * curve[point])
        for ground, a in enumerate((1.0 - albedo, albedo))
        for step, t in ((low, 1.0 - share), (high, share))
        for point in range(6)
    ]
    triples = [
        tuple(sum(data[1200 * c + at + k] * weight for at, weight in weights) for c in range(3))
        for k in range(10)
    ]
    return Sky(tuple(triples[:9]), triples[9])


def radiance(one, up, gamma):
    """Return RGB [W m^-2 sr^-1] of a Sky; nothing below the horizon, where it is not defined.

    up: vertical component of the unit direction; gamma: its angle from the sun, radians.
    """
    return _rgb([_value(one, channel, up, gamma) for channel in range(3)])


def luminance(one, up, gamma):
    """Return the luminance of a Sky over units.EFFICACY; see `radiance`."""
    return _value(one, 1, up, gamma) * spectrum.LUMENS / units.EFFICACY


def mixing(one):
    """Return three RGB triples: what 1 of the model's X, Y and Z before its radiance stands for."""
    unit = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    return tuple(_rgb([a * b for a, b in zip(axis, one.radiance, strict=True)]) for axis in unit)


def sun(turbidity, height):
    """Return RGB irradiance [W m^-2] from the sun's disk on a surface that faces it.

    turbidity in [1, 10]; height in [0, pi/2], radians. L. Hosek and A. Wilkie, "Adding a solar
    radiance function to the Hosek-Wilkie skylight model", IEEE CG&A 33(3), 2013, 320 to 720 nm.
    """
    every = disk(turbidity, height)
    return tuple(
        SOLID_ANGLE * sum(triple[c] * 2.0 / (i + 2) for i, triple in enumerate(every))
        for c in range(3)
    )


def disk(turbidity, height):
    """Return six RGB triples [W m^-2 sr^-1]: the disk's radiance is their sum times mu^0 … mu^5.

    mu: 1 in the middle of the disk, 0 on its rim; mu^2 falls evenly with the solid angle within.
    The published radiance is taken as the mean over the disk; see `sun`, and SOURCES.md.
    """
    data, (low, high, share) = _data("sun.f32", "f"), _between(turbidity)
    piece = min(int((height / (math.pi / 2.0)) ** (1.0 / 3.0) * _PIECES), _PIECES - 1)
    x = height - (piece / _PIECES) ** 3 * math.pi / 2.0
    totals = [[0.0, 0.0, 0.0] for _ in range(6)]
    for wave, matched in enumerate(_matching()):
        spectral = 0.0
        for step, weight in ((low, 1.0 - share), (high, share)):
            at = ((step * _PIECES + piece) * len(_WAVES) + wave) * 4
            a, b, c, d = data[at : at + 4]
            spectral += weight * (a + x * (b + x * (c + x * d)))
        at = 10 * _PIECES * len(_WAVES) * 4 + 6 * wave
        limb = data[at : at + 6]
        spectral = max(spectral, 0.0) / sum(k * 2.0 / (i + 2) for i, k in enumerate(limb))
        for total, k in zip(totals, limb, strict=True):
            for channel in range(3):
                total[channel] += k * spectral * matched[channel]
    return tuple(_rgb(total) for total in totals)


def _value(one, channel, up, gamma):
    """Return X, Y or Z of a Sky [W m^-2 sr^-1]; where the model would be negative, 0."""
    if up < 0.0:
        return 0.0
    A, B, C, D, E, F, G, top, H = (triple[channel] for triple in one.coefficients)
    cosine = math.cos(gamma)
    glow = (1.0 + cosine**2) / (1.0 + H * H - 2.0 * H * cosine) ** 1.5
    shape = C + D * math.exp(E * gamma) + F * cosine**2 + G * glow + top * math.sqrt(up)
    haze = 1.0 + A * math.exp(B / (up + 0.01))
    return max(haze * shape, 0.0) * one.radiance[channel]


def _between(turbidity):
    """Return the two indices of the data next to a turbidity, and the share of the second."""
    low = min(int(turbidity), 10)
    return low - 1, min(low, 9), turbidity - low


@functools.lru_cache(maxsize=2)
def _data(name, kind):
    """Return a file of assets/sky as an array of numbers."""
    values = array(kind, read_bytes(os.path.join(ASSETS, "sky", name), 1 << 20, "the sky's data"))
    if sys.byteorder == "big":
        values.byteswap()
    return values


@functools.lru_cache(maxsize=1)
def _matching():
    """Return (X, Y, Z) of 1 per nm at each of _WAVES, falling to 0 at the next."""
    waves = range(_WAVES[0], _WAVES[-1] + 1, 5)
    return tuple(
        spectrum.xyz({nm: 1000.0 * max(0.0, 1.0 - abs(nm - wave) / 40.0) for nm in waves})
        for wave in _WAVES
    )


def _rgb(xyz):
    """Return RGB in Lumiar's scale of X, Y, Z, whose Y times 683 lm/W is the luminance."""
    return tuple(spectrum.LUMENS / units.EFFICACY * value for value in spectrum.rgb(xyz))
