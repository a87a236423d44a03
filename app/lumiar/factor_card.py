"""Solid angle and form factor of a polygon in float32 on the card, by the text that lights use."""

import numpy as np

from . import compose, factors
from .card import OnCard, compiled
from .errors import Mistake
from .polygons import Polygons, triangulate

ROUNDED = 2.0**-23  # radians, about
MOST = 6  # corners of one convex polygon there
COARSER = np.finfo(np.float32).eps / np.finfo(np.float64).eps


def with_card(found, polygon):
    """Return what factor_table.patch Found of a polygon, with a way more; without OpenGL as it was.

    Errors are those of the closed form in float64 as they would be with float32's digits, and what
    rounding the normal and the corners turns the polygon and the horizon against each other.
    """
    point, normal = (np.array(found.facts["from"][key]) for key in ("point", "normal"))
    try:
        card = OnCard()
    except Mistake:  # no driver here, and all the other ways need none
        return found
    with card:
        F, omega = evaluated(card, polygon - point, normal)
    values = dict(found.values)
    for key, value in (("omega", omega), ("F", F)):
        (exact, error), *_ = values[key].values()
        error32 = error * COARSER + ROUNDED * (omega if key == "F" else exact)
        own = {"closed_form_float32": (value, error32)}
        values[key] = {"closed_form": (exact, error), **own, **values[key]}
    return found._replace(values=values)


def evaluated(card, polygon, normal):
    """Return (F, solid angle [sr]) of a polygon (n, 3) from a patch at the origin, by an OnCard.

    One that is concave or has more than MOST corners is cut into triangles.
    """
    front = factors.facing(polygon, np.zeros((1, 3)))[0]
    if factors.plane(polygon)[0] @ front < 0.0:
        polygon = polygon[::-1]
    total, context = np.zeros(2), card.context
    with context:
        program = compiled(context, compose.screen("factor", {}))
        array = context.vertex_array(program, [])
        target = context.framebuffer([context.texture((1, 1), 4, dtype="f4")])
        target.use()
        for part in _parts(polygon, front):
            corners = (part - part[0])[np.minimum(np.arange(MOST), len(part)) % len(part)]
            height = -front @ part[0]
            values = (normal, front, height, part[0], corners)
            names = ("normal", "front", "height", "origin", "corner")
            for name, value in zip(names, values, strict=True):
                program[f"rig_{name}"].write(np.asarray(value, np.float32).tobytes())
            program["rig_corners"].value = len(part)
            array.render(vertices=3)
            total += np.frombuffer(target.read(components=4, dtype="f4"), np.float32)[:2]
        card.free_framebuffer(target)
        array.release()
        program.release()
    return total[0], total[1]


def _parts(polygon, front):
    sides = np.roll(polygon, -1, axis=0) - polygon
    turns = np.cross(np.roll(sides, 1, axis=0), sides) @ front
    if len(polygon) <= MOST and (turns >= 0.0).all():
        return [polygon]
    n = len(polygon)
    return polygon[triangulate(Polygons(polygon, np.arange(n), np.array([n])))[0]]
