"""Solid angles and form factors by Nusselt's projection and by Monte Carlo, each with its error.

Independent of the closed forms of `factors`: areas of curves drawn on the sphere, and random rays
and points. Polygons as there; all that comes back is (value, error), the error absolute.
"""

import math
from typing import NamedTuple

import numpy as np

from . import factors

ARCS = 512  # points of an edge's arc on the sphere
COARSE, LEAST = 128, 4  # of a whole outline seen from each of many points, and of an edge in it
SHADOWS = (20, 14)  # orders of the rules over a polygon whose difference is the error
BATCH = 1 << 16  # rays at a time
TRICE = 3.0  # hits, or misses, that may be lacking where there is none, with 95 % confidence


class Estimate(NamedTuple):
    """Solid angle [sr], that above the horizon, and form factor, (value, error) each."""

    omega: tuple
    above: tuple
    F: tuple


def frame(normal):
    """Return the rotation (3, 3) whose rows are two unit tangents and a unit normal."""
    other = np.eye(3)[np.abs(normal).argmin()]
    tangent = np.cross(other, normal)
    tangent /= np.linalg.norm(tangent)
    return np.array([tangent, np.cross(normal, tangent), normal])


def arcs(p, count):
    """Return unit vectors (…, n * count, 3) along the arcs of edges between p (…, n, 3)."""
    following = np.roll(p, -1, axis=-2)
    u = p / np.linalg.norm(p, axis=-1, keepdims=True)
    across = np.cross(p, following)
    sine = np.linalg.norm(across, axis=-1)
    ahead = np.cross(across / np.where(sine, sine, 1.0)[..., None], u)
    angle = np.arctan2(sine, (p * following).sum(axis=-1))
    turn = angle[..., None] * (np.arange(count) / count)
    w = u[..., None, :] * np.cos(turn)[..., None] + ahead[..., None, :] * np.sin(turn)[..., None]
    return w.reshape(*p.shape[:-2], -1, 3)


def area(curve):
    """Return the areas (…) within closed curves of points (…, k, 2)."""
    x, y = np.moveaxis(curve - curve[..., :1, :], -1, 0)
    return np.abs((x[..., :-1] * y[..., 1:] - x[..., 1:] * y[..., :-1]).sum(axis=-1)) / 2.0


def _measured(curve):
    """Return (area, error) of a smooth curve, by L. Richardson's extrapolation from its chords.

    Of all chords, of half and of a quarter as many, whose number is then still whole.
    """
    fine, half, quarter = (area(curve[..., ::skip, :]) for skip in (1, 2, 4))
    found, rough = (4.0 * fine - half) / 3.0, (4.0 * half - quarter) / 3.0
    chords = np.diff(curve, axis=-2, append=curve[..., :1, :])
    rounding = factors.EPS * np.linalg.norm(chords, axis=-1).sum(axis=-1)
    return found, np.abs(found - rough) / 8.0 + rounding  # a fifteenth, for ever finer chords


def nusselt(point, normal, polygon):
    """Return the Estimate of a patch by the polygon's figure on the unit sphere and its shadow.

    W. Nusselt, "Graphische Bestimmung des Winkelverhaeltnisses bei der Waermestrahlung",
    Zeitschrift des VDI 72, 1928: F is the area of the shadow on the patch's plane, over pi. The
    figure's own area is measured on a map of equal areas (J. H. Lambert, 1772). The outlines are
    drawn point by point, so the error is what fewer points would change.
    """
    outward = factors.facing(polygon, point[None])[0]
    whole, above = polygon - point, factors.clipped(polygon, point, normal) - point
    F = (0.0, 0.0)
    if len(above) > 2:
        shadow, error = _measured(arcs(above @ frame(normal).T, ARCS)[:, :2])
        F = shadow / math.pi, error / math.pi
    return Estimate(_on_the_sphere(whole, -outward), _on_the_sphere(above, -outward), F)


def _on_the_sphere(p, centre):
    if len(p) < 3:
        return 0.0, 0.0
    w = arcs(p @ frame(centre).T, ARCS)
    return _measured(w[:, :2] * np.sqrt(2.0 / (1.0 + w[:, 2:])))


def nusselt_mean(one, other):
    """Return (F12, error) of polygons: the mean of Nusselt's shadows over points of the first."""
    whole = factors.plane(one)[1]
    one, other, normal, _ = factors.seen(one, other)
    if not len(one):
        return 0.0, 0.0
    turn, found = frame(normal).T, []
    fine = max(LEAST, 4 * round(COARSE / 4 / len(other)))
    for order in SHADOWS:
        points, weights = factors.cubature(
            one, order, lambda t: (t * t * (3 - 2 * t), 6 * t - 6 * t * t)
        )
        parts = np.array_split(points, -(-points.size * len(other) * fine // 6_000_000))
        shadows = [_measured(arcs((other - part[:, None]) @ turn, fine)[..., :2]) for part in parts]
        areas, errors = (np.concatenate(each) for each in zip(*shadows, strict=True))
        found.append((abs(weights @ areas), np.abs(weights) @ errors))
    error = abs(found[0][0] - found[1][0]) + found[0][1]
    return found[0][0] / (math.pi * whole), error / (math.pi * whole)


def rays(point, normal, polygon, count, seed):
    """Return the Estimate of a patch by random rays: how many of them hit the polygon.

    Uniform over the sphere for solid angles, by the cosine to the normal for F. The error is a
    standard error; where none or all hit, what then is excluded with 95 % confidence.
    """
    rng, (tangent, across, _) = np.random.default_rng(seed), frame(normal)
    hits = np.zeros(3)
    for n in _batches(count):
        z, turn = rng.uniform(-1.0, 1.0, n), rng.uniform(0.0, 2.0 * math.pi, n)
        flat = np.cos(turn)[:, None] * tangent + np.sin(turn)[:, None] * across
        struck = _hit(point, np.sqrt(1.0 - z * z)[:, None] * flat + z[:, None] * normal, polygon)
        hits[:2] += struck.sum(), (struck & (z > 0.0)).sum()
        high = rng.uniform(0.0, 1.0, n)
        lobe = np.sqrt(high)[:, None] * flat + np.sqrt(1.0 - high)[:, None] * normal
        hits[2] += _hit(point, lobe, polygon).sum()
    return Estimate(
        *(_share(h, count, full) for h, full in zip(hits, (4 * math.pi,) * 2 + (1.0,), strict=True))
    )


def _batches(count):
    return [min(BATCH, count - done) for done in range(0, count, BATCH)]


def _share(hits, count, full):
    share = hits / count
    if hits in (0, count):
        return full * share, full * min(1.0, TRICE / count)
    return full * share, full * math.sqrt(share * (1.0 - share) / count)


def _hit(origin, direction, polygon):
    """Return which of rays (m, 3), from one point or (m, 3), meet a polygon."""
    normal, _ = factors.plane(polygon)
    with np.errstate(divide="ignore", invalid="ignore"):
        far = ((polygon[0] - origin) @ normal) / (direction @ normal)
        struck = (far > 0.0) & np.isfinite(far)
        struck[struck] = factors.inside(
            _at(origin, struck) + far[struck, None] * direction[struck], polygon
        )
    return struck


def _at(origin, chosen):
    return origin if origin.ndim == 1 else origin[chosen]


def rays_between(one, other, count, seed):
    """Return (F12, error) of polygons by cosine rays from random points of the first."""
    rng, normal, far = (
        np.random.default_rng(seed),
        factors.facing(one, other)[0],
        factors.facing(other, one)[0],
    )
    tangent, across, _ = frame(normal)
    values = []
    for n in _batches(count):
        points, signs = scattered(one, n, rng)
        turn, high = rng.uniform(0.0, 2.0 * math.pi, n), rng.uniform(0.0, 1.0, n)
        flat = np.cos(turn)[:, None] * tangent + np.sin(turn)[:, None] * across
        lobe = np.sqrt(high)[:, None] * flat + np.sqrt(1.0 - high)[:, None] * normal
        values.append(signs * (_hit(points, lobe, other) & (lobe @ far < 0.0)))
    mean, error = _mean(np.concatenate(values))
    return (mean, error) if error else (mean, TRICE / count)


def _mean(values):
    return values.mean(), values.std(ddof=1) / math.sqrt(len(values))


def scattered(polygon, count, rng):
    """Return random points (m, 3), uniform over a polygon, and their weights (m,), of mean 1.

    Of a fan of triangles; those that a concave polygon's fan covers in excess have weights below 0.
    """
    normal, whole = factors.plane(polygon)
    spokes = polygon - polygon[0]
    signed = np.cross(spokes[1:-1], spokes[2:]) @ normal / 2.0
    total = np.abs(signed).sum()
    chosen = rng.choice(len(signed), count, p=np.abs(signed) / total)
    u, v = np.sqrt(rng.uniform(0.0, 1.0, count)), rng.uniform(0.0, 1.0, count)
    points = (
        polygon[0]
        + (u * (1.0 - v))[:, None] * spokes[chosen + 1]
        + (u * v)[:, None] * spokes[chosen + 2]
    )
    return points, np.sign(signed[chosen]) * (total / whole)


def points(point, normal, polygon, count, seed):
    """Return the Estimate of a patch by random points of the polygon, each a small area there."""
    rng, (far, whole) = np.random.default_rng(seed), factors.plane(polygon)
    found = []
    for n in _batches(count):
        places, weights = scattered(polygon, n, rng)
        way = places - point
        square = (way * way).sum(axis=1)
        omega = weights * whole * np.abs(way @ far) / (square * np.sqrt(square))
        up = way @ normal / np.sqrt(square)
        found.append([omega, omega * (up > 0.0), omega * np.maximum(up, 0.0) / math.pi])
    return Estimate(*(_mean(np.concatenate(each)) for each in zip(*found, strict=True)))


def points_between(one, other, count, seed):
    """Return (F12, error) of polygons by random pairs of points, one on each."""
    rng, whole = np.random.default_rng(seed), factors.plane(other)[1]
    normal, far = factors.facing(one, other)[0], factors.facing(other, one)[0]
    values = []
    for n in _batches(count):
        (here, some), (there, more) = scattered(one, n, rng), scattered(other, n, rng)
        way = there - here
        square = (way * way).sum(axis=1)
        leaving, coming = np.maximum(way @ normal, 0.0), np.maximum(-(way @ far), 0.0)
        values.append(some * more * whole * leaving * coming / (math.pi * square * square))
    return _mean(np.concatenate(values))
