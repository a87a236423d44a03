"""Which share of light a model sends where, by measuring it: single numbers for one point.

Directions are tuples in the local frame; angles in radians from the normal, azimuths from the
tangent. What comes back is (3,) float64, linear RGB.
"""

import math

import numpy as np

from . import compose, measure

NODES = 8  # angles that a mean is taken over


def surroundings(model, values):
    """Return which of environment and ambience a model asks for: an image of what is around it, or
    its mean. A model that asks for both reflects nothing that `surround` leaves out."""
    if "surround" not in model.defines:
        return ()
    text = compose.measured(model, model.constants(values), "surround")["fragment"].text
    return tuple(name for name in ("environment", "ambience") if f"vec3 {name}(" in text)


def bidirectional(instrument, model, values, L, V):
    """Return f(L, V) [1/sr]; None for L along the horizon."""
    if abs(L[2]) < 1e-6:
        return None
    return _scatter(instrument, model, values, [L], [V])[0] / abs(L[2])


def albedo(instrument, model, values, angles, azimuth=0.0, nodes=None):
    """Return (k, 3) shares of the light from k angles that leave; 0 from below an opaque model.

    What is mirrored is in it: by reciprocity, as much as is mirrored toward those angles.
    """
    transmits = model.transmits
    more = {"nodes": nodes or _nodes(model), "transmits": transmits}
    found = measure.albedo(instrument, model, values, angles, azimuth, **more)[0]
    found = _with_image(found, instrument, model, values, angles, azimuth)
    if not transmits:
        found[np.asarray(angles) > math.pi / 2.0] = 0.0
    return found


def toward(instrument, model, values, V):
    """Return the share of light from all around that is sent toward V, mirror image included.

    The hemispherical-directional reflectance (F. Nicodemus, 1977), and transmittance.
    """
    angle, azimuth = math.acos(max(-1.0, min(V[2], 1.0))), math.atan2(V[1], V[0])
    index, nodes = model.transmits and measure.index_of(values), _nodes(model)
    eye, L, weights = (one[0] for one in measure.albedo_pairs([angle], azimuth, nodes, index))
    weights = weights * abs(eye[0, 2]) / np.maximum(np.abs(L[:, 2]), 1e-12)  # of f, not f |cos|
    found = weights @ _scatter(instrument, model, values, L, eye)
    return _with_image(found[None], instrument, model, values, [angle], azimuth)[0]


def mean(instrument, model, values, sampled):
    """Return the share that leaves of light that is the same all around.

    sampled tells light that a model scatters and mirrors from light that `surround` alone sees.
    """
    x, w = np.polynomial.legendre.leggauss(NODES)
    angles = np.arcsin(np.sqrt(0.5 + 0.5 * x))  # evenly in sin^2, whose derivative is 2 sin cos
    turns = (0.0, math.pi / 2.0) if "tangent" in model.needs else (0.0,)
    found = np.zeros(3)
    for turn in turns:
        more = {"nodes": 4} if sampled else {}  # errors at single angles matter less in a mean
        share = albedo if sampled else surround
        found += 0.5 * w @ share(instrument, model, values, angles, turn, **more)
    return found / len(turns)


def surround(instrument, model, values, angles, azimuth=0.0):
    """Return the radiance (k, 3) toward angles that a model makes of 1 all around, unscattered."""
    if "surround" not in model.defines:
        return np.zeros((len(angles), 3))
    V = measure.polar(angles, azimuth)
    pairs = instrument.pairs(V, V)
    found = instrument.surround(model, values, pairs).astype(np.float64)
    instrument.forget(pairs)
    return found


def _nodes(model):
    """Return how many nodes a panel of the quadrature takes: more where a lobe may be a streak."""
    return 12 if "tangent" in model.needs else 6


def _with_image(scattered, instrument, model, values, angles, azimuth):
    """Return what a model scatters (k, 3) toward angles and the image that it shows there."""
    asked = surroundings(model, values)
    if "environment" not in asked:
        return scattered
    image = surround(instrument, model, values, angles, azimuth)
    return image if "ambience" in asked else scattered + image


def _scatter(instrument, model, values, L, V):
    pairs = instrument.pairs(L, V)
    found = instrument.scatter(model, values, pairs).astype(np.float64)
    instrument.forget(pairs)
    return found
