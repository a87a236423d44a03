"""Which share of light a model sends where, by measuring it: single numbers for one point.

Directions are tuples in the local frame; angles in radians from the normal, azimuths from the
tangent. What comes back is (3,) float64, linear RGB.
"""

import math

import numpy as np

from . import compose, measure

NODES = 8  # angles that a mean is taken over


def mirrors(model, values):
    """Return whether a model shows an image of its surroundings, mirrored or refracted."""
    if "surround" not in model.defines:
        return False
    text = compose.measured(model, model.constants(values), "surround")["fragment"].text
    return "vec3 environment(" in text


def bidirectional(instrument, model, values, L, V):
    """Return f(L, V) [1/sr]; None for L along the horizon."""
    if abs(L[2]) < 1e-6:
        return None
    return _scatter(instrument, model, values, [L], [V])[0] / abs(L[2])


def albedo(instrument, model, values, angles, azimuth=0.0):
    """Return (k, 3) shares of the light from k angles that leave; 0 from below an opaque model."""
    transmits = model.transmits
    found = measure.albedo(instrument, model, values, angles, azimuth, transmits=transmits)[0]
    if not transmits:
        found[np.asarray(angles) > math.pi / 2.0] = 0.0
    return found


def toward(instrument, model, values, V):
    """Return the share of light from all around that is sent toward V, mirror image included.

    The hemispherical-directional reflectance (F. Nicodemus, 1977), and transmittance.
    """
    angle, azimuth = math.acos(max(-1.0, min(V[2], 1.0))), math.atan2(V[1], V[0])
    index = model.transmits and measure.index_of(values)
    eye, L, weights = (one[0] for one in measure.albedo_pairs([angle], azimuth, 6, index))
    weights = weights * abs(eye[0, 2]) / np.maximum(np.abs(L[:, 2]), 1e-12)  # of f, not f |cos|
    found = weights @ _scatter(instrument, model, values, L, eye)
    if mirrors(model, values):
        found += surround(instrument, model, values, [angle], azimuth)[0]
    return found


def mean(instrument, model, values, sampled):
    """Return the share that leaves of light that is the same all around.

    sampled tells light that a model scatters, and mirrors, from light that `surround` alone sees.
    """
    x, w = np.polynomial.legendre.leggauss(NODES)
    angles = np.arcsin(np.sqrt(0.5 + 0.5 * x))  # evenly in sin^2, whose derivative is 2 sin cos
    turns = (0.0, math.pi / 2.0) if "tangent" in model.needs else (0.0,)
    found = np.zeros(3)
    for turn in turns:
        if sampled:
            found += 0.5 * w @ albedo(instrument, model, values, angles, turn)
        if not sampled or mirrors(model, values):
            found += 0.5 * w @ surround(instrument, model, values, angles, turn)
    return found / len(turns)


def surround(instrument, model, values, angles, azimuth=0.0):
    """Return the radiance (k, 3) toward angles when it is 1 all around, but for light scattered."""
    if "surround" not in model.defines:
        return np.zeros((len(angles), 3))
    V = measure.polar(angles, azimuth)
    pairs = instrument.pairs(V, V)
    found = instrument.surround(model, values, pairs).astype(np.float64)
    instrument.forget(pairs)
    return found


def _scatter(instrument, model, values, L, V):
    pairs = instrument.pairs(L, V)
    found = instrument.scatter(model, values, pairs).astype(np.float64)
    instrument.forget(pairs)
    return found
