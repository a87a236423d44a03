"""Directions to lights and to the eye at a pixel of a picture, in the frame of what is there."""

import math
from typing import NamedTuple

from . import variants


class Facing(NamedTuple):
    """What is at a pixel: the number of its object, from 1, and directions in the local frame.

    V is the direction to the eye; lights maps the number of a light, from 1, to the direction L to
    its middle; those that are all around are left out.
    """

    object: int
    V: tuple
    lights: dict


def seen(scene, at, renderer):
    """Return the Facing at the pixel `at` (x, y) of a scene, None where no object is seen."""
    number = renderer.pixel(variants.shape(scene), *at, shows="object")
    if number is None:
        return None
    lights = enumerate(scene.lights, 1)
    found = ((i, to_light(scene, light, at, renderer)) for i, light in lights)
    return Facing(round(number[0]), to_eye(scene, at, renderer), {i: L for i, L in found if L})


def to_eye(scene, at, renderer):
    """Return the direction to the eye at a pixel where an object is seen."""
    return _unit(renderer.pixel(variants.lit_by(scene, ()), *at, shows="eye"))


def to_light(scene, light, at, renderer):
    """Return the direction to the middle of a Light there, None of one that is all around."""
    middle = variants.middle(light)
    if middle is None:
        return None
    return _unit(renderer.pixel(variants.lit_by(scene, [middle]), *at, shows="toward"))


def theta(w):
    """Return the angle from the normal [degrees] of a direction in the local frame."""
    return math.degrees(math.atan2(math.hypot(w[0], w[1]), w[2]))


def azimuth(w):
    """Return the angle from the tangent [radians] of a direction in the local frame."""
    return math.atan2(w[1], w[0])


def turn(L, V):
    """Return the angle about the normal between two directions, 0 to 180 degrees."""
    return abs(math.remainder(math.degrees(azimuth(V) - azimuth(L)), 360.0))


def halfway(L, V):
    """Return H, the direction halfway between two; the normal where they are opposite."""
    H = tuple(a + b for a, b in zip(L, V, strict=True))
    return _unit(H) if math.hypot(*H) > 1e-6 else (0.0, 0.0, 1.0)


def between(a, b):
    """Return the angle between two unit directions, in degrees (W. Kahan's form, 2006)."""
    return math.degrees(2.0 * math.atan2(math.dist(a, b), math.dist(a, [-x for x in b])))


def _unit(a):
    length = math.hypot(*a)
    return tuple(x / length for x in a)
