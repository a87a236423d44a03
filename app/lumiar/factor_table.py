"""What `lumiar formfactor` tells: solid angles and form factors by every way, side by side."""

import json
import math
from typing import NamedTuple

import numpy as np

from . import estimates, factors
from .errors import Mistake

CORNERS = 256
FLAT = 1e-5  # how far from a plane corners may lie, relative to the polygon's size
EMPTY = 1e-10  # area over size squared from which a polygon is none
FAR = 1e9  # m
NAMES = {
    "closed_form": "closed form",
    "closed_form_float32": "closed form, float32 on the card",
    "nusselt": "Nusselt's projection",
    "monte_carlo_rays": "Monte Carlo, {} rays",
    "monte_carlo_points": "Monte Carlo, {} points",
}
QUANTITIES = {
    "omega": "solid angle (sr)",
    "omega_above": "solid angle above the horizon (sr)",
    "F": "form factor F, from the patch to the polygon",
    "F12": "form factor F12, from polygon 1 to polygon 2",
    "F21": "form factor F21, from polygon 2 to polygon 1",
}


class Found(NamedTuple):
    """What was asked, as facts for a reader, and {quantity: {way: (value, error)}}."""

    facts: dict
    values: dict
    samples: int


def corners(text, where):
    """Return the corners (n, 3) of a text "x,y,z x,y,z …"; raise Mistake for what is no number."""
    found = [vector(part, where) for part in text.split()]
    if not found:
        raise Mistake(f"{where}: nothing; write corners as in '0,0,1 1,0,1 1,1,1'")
    return np.array(found)


def vector(text, where):
    """Return [x, y, z] of a text "x,y,z"; raise Mistake."""
    try:
        x, y, z = map(float, text.split(","))
    except ValueError:
        raise Mistake(f"{where}: '{text}' is no x,y,z; write three numbers, as in 0,0,1") from None
    if not all(math.isfinite(v) and abs(v) <= FAR for v in (x, y, z)):
        raise Mistake(
            f"{where}: '{text}' is not finite, or beyond {FAR:g} m; write smaller numbers"
        )
    return [x, y, z]


def polygon(points, where):
    """Return the corners (n, 3) of a polygon, none twice in a row; raise Mistake if it is none."""
    given = len(points)
    points = factors.without_repeats(points)
    if len(points) < 3:
        raise Mistake(
            f"{where}: {given} corners, fewer than 3 of them different; write a polygon's"
        )
    if len(points) > CORNERS:
        raise Mistake(f"{where}: {len(points)} corners; allowed: up to {CORNERS}")
    size = np.ptp(points, axis=0).max()
    normal, area = factors.plane((points - points[0]) / size)
    if area < EMPTY:
        raise Mistake(f"{where}: the polygon has no area; write corners that are not in one line")
    off = np.abs((points - points.mean(axis=0)) @ normal).max() / size
    if off > FLAT:
        said = f"its corners lie off a plane by {off:.1e} of its size; allowed: {FLAT:g}"
        raise Mistake(f"{where}: {said}; split it into triangles")
    crossing = _crossing(points, normal)
    if crossing:
        raise Mistake(
            f"{where}: its edges {crossing[0]} and {crossing[1]} cross; reorder its corners"
        )
    return points


def _crossing(points, normal):
    """Return the numbers, from 1, of two edges of a flat polygon that cross, or None."""
    a = (points - points[0]) @ estimates.frame(normal)[:2].T
    b = np.roll(a, -1, axis=0)

    def side(p):  # of edge i on which point j lies
        d = p[None] - a[:, None]
        return np.sign((b - a)[:, None, 0] * d[..., 1] - (b - a)[:, None, 1] * d[..., 0])

    apart = side(a) * side(b) < 0.0
    found = np.argwhere(apart & apart.T)
    return tuple(found[0] + 1) if len(found) else None


def patch(point, normal, target, samples, seed):
    """Return what is Found for a patch at a point (3,), with any normal, and a checked polygon."""
    length = np.linalg.norm(normal)
    if not length:
        raise Mistake("--normal: has no length; write a direction, as in 0,0,1")
    normal = normal / length
    if factors.distance(point, target) <= 1e-9 * np.ptp(target, axis=0).max():
        raise Mistake("--from: the point lies on the polygon; move it off")
    above = factors.clipped(target, point, normal)
    ways = {
        "closed_form": estimates.Estimate(
            factors.solid_angle(point, target),
            factors.solid_angle(point, above),
            factors.form_factor(point, normal, target),
        ),
        "nusselt": estimates.nusselt(point, normal, target),
        "monte_carlo_rays": estimates.rays(point, normal, target, samples, (seed, 1)),
        "monte_carlo_points": estimates.points(point, normal, target, samples, (seed, 2)),
    }
    values = {
        key: {way: found[i] for way, found in ways.items()}
        for i, key in enumerate(("omega", "omega_above", "F"))
    }
    facts = {"from": {"point": point.tolist(), "normal": normal.tolist()}, "to": _described(target)}
    facts["illuminance_of_1_cd_m2"] = math.pi * values["F"]["closed_form"][0]
    return Found(facts, values, samples)


def polygons(one, other, samples, seed):
    """Return what is Found for two checked polygons."""
    values, how, flux = {}, {}, {}
    touching = factors.touch(one, other)
    for way, key, a, b in ((1, "F12", one, other), (2, "F21", other, one)):
        area = factors.plane(a)[1]
        flux[key], error, how[key] = factors.exchange(a, b)
        values[key] = {
            "closed_form": (flux[key] / area, error / area),
            "nusselt": estimates.nusselt_mean(a, b),
            "monte_carlo_rays": estimates.rays_between(a, b, samples, (seed, way, 0)),
        }
        if not touching:  # the variance has no bound where points can be arbitrarily close
            by_points = estimates.points_between(a, b, samples, (seed, way, 1))
            values[key]["monte_carlo_points"] = by_points
    facts = {"from": _described(one, other), "to": _described(other, one), "how": how}
    facts["A1_F12"], facts["A2_F21"] = flux["F12"], flux["F21"]
    return Found(facts, values, samples)


def _described(one, other=None):
    told = {"corners": one.tolist(), "area": factors.plane(one)[1]}
    if other is not None:
        front, both = factors.facing(one, other)
        told |= {"front": (front + 0.0).tolist(), "other_on_both_sides": both}
    return told


def as_json(found):
    """Return what was Found as JSON text; relative is the difference to the closed form."""
    told = dict(found.facts)
    for key, ways in found.values.items():
        exact = ways["closed_form"][0]
        told[key] = {
            way: {"value": float(value), "error": float(error), "relative": _off(value, exact)}
            for way, (value, error) in ways.items()
        }
    return json.dumps(told, indent=2, allow_nan=False)


def _off(value, exact):
    return float(value / exact - 1.0) if exact else (0.0 if value == exact else None)


def as_text(found):
    """Return what was Found as lines for a reader."""
    lines = [*_heading(found.facts), ""]
    for key, ways in found.values.items():
        if key == "omega_above" and ways["closed_form"] == found.values["omega"]["closed_form"]:
            continue
        lines.append(f"{QUANTITIES[key]:46} {'value':>19} {'its error':>11} {'off exact':>11}")
        exact = ways["closed_form"][0]
        for way, (value, error) in ways.items():
            name = NAMES[way].format(found.samples)
            if way == "closed_form" and "how" in found.facts:
                name = found.facts["how"][key]
            off = "" if way == "closed_form" else _relative(_off(value, exact))
            lines.append(f"  {name:44} {value:19.13g} {error:11.1e} {off:>11}".rstrip())
        lines.append("")
    return "\n".join([*lines, *_ending(found)])


def _relative(off):
    return "-" if off is None else f"{off:+.1e}"


def _heading(facts):
    if "point" in facts["from"]:
        where, normal = (_numbers(facts["from"][key]) for key in ("point", "normal"))
        yield f"patch    at {where}, normal {normal}"
        yield f"polygon  {_polygon(facts['to'])}"
    else:
        for i, key in ((1, "from"), (2, "to")):
            one = facts[key]
            sides = "; by the order of its corners, as the other lies on both sides of it"
            front = f", front {_numbers(one['front'])}{sides * one['other_on_both_sides']}"
            yield f"polygon {i}  {_polygon(one)}{front}"


def _polygon(one):
    return f"{len(one['corners'])} corners, {one['area']:.7g} m²"


def _numbers(vector):
    return ", ".join(f"{v:.6g}" for v in vector)


def _ending(found):
    facts = found.facts
    yield "errors: Monte Carlo, one standard error (no or all hits: what 95 % confidence leaves);"
    yield "of Nusselt's, what fewer points would change; of the closed form, estimated rounding"
    if "illuminance_of_1_cd_m2" in facts:
        lux = facts["illuminance_of_1_cd_m2"]
        yield f"the patch receives pi F = {lux:.7g} lx of a luminance of 1 cd/m², F lx of 1 lm/m²"
    else:
        yield f"reciprocity: A1 F12 = {facts['A1_F12']:.15g} m², A2 F21 = {facts['A2_F21']:.15g} m²"
