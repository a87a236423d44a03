"""Solid angles and form factors of polygons in float64: what all other ways are held against.

A polygon is its corners (n, 3) in order, planar and simple, convex or not, either way round. Every
result comes with an estimate of its own error, absolute.
"""

import math

import numpy as np

EPS = np.finfo(float).eps
APART = 1.5  # how many of its radii a polygon is away where a rule without grading suffices
ORDERS = (16, 12)  # of the rules whose difference is the error
ACCURACY = 1e-14  # of a contour integral, relative, as far as rounding allows
ROUND = 12  # corners from which they are too blunt to crowd points there
HALVINGS, MOST = 50, 1 << 16  # of an interval of a contour; intervals at a time
LEVEL = 1e-9  # of its size, what a polygon may reach below a plane and still be on one side of it


def plane(polygon):
    """Return (unit normal (3,) by the right-hand rule, area) of a polygon (M. Newell)."""
    spokes = polygon[1:] - polygon[0]
    doubled = np.cross(spokes[:-1], spokes[1:]).sum(axis=0)
    length = np.linalg.norm(doubled)
    return (doubled / length if length else doubled), length / 2.0


def clipped(polygon, point, normal):
    """Return the part (k, 3) of a polygon on a plane's front side; k is 0 where there is none.

    I. Sutherland, G. Hodgman, "Reentrant polygon clipping", 1974: the parts of a concave polygon
    stay joined by edges in the plane, there and back, which no contour integral notices.
    """
    height = (polygon - point) @ normal
    if (height >= 0.0).all():
        return polygon
    corners = []
    for i, (a, za) in enumerate(zip(polygon, height, strict=True)):
        b, zb = polygon[i - 1], height[i - 1]
        if za * zb < 0.0:
            corners.append(b + (a - b) * (zb / (zb - za)))
        if za >= 0.0:
            corners.append(a)
    return without_repeats(np.reshape(corners, (-1, 3)))


def without_repeats(corners):
    """Return corners (n, 3) of a polygon without those that equal the one before; or (0, 3)."""
    kept = corners[(corners != np.roll(corners, 1, axis=0)).any(axis=1)]
    return kept if len(kept) > 2 else np.zeros((0, 3))


def inside(points, polygon):
    """Return which of points (m, 3) in a polygon's plane lie in it: an odd number of crossings."""
    drop = np.abs(plane(polygon)[0]).argmax()
    x, y = np.delete(points, drop, axis=1).T
    order = np.argsort(y)
    x, y = x[order], y[order]
    crossed = np.zeros(len(points), bool)
    flat = np.delete(polygon, drop, axis=1)
    for (ax, ay), (bx, by) in zip(flat, np.roll(flat, 1, axis=0), strict=True):
        if ay != by:
            beside = slice(*np.searchsorted(y, sorted((ay, by))))
            crossed[beside] ^= x[beside] < ax + (y[beside] - ay) * ((bx - ax) / (by - ay))
    found = np.empty_like(crossed)
    found[order] = crossed
    return found


def distance(point, polygon):
    """Return how far a point (3,) is from the nearest point of a polygon."""
    normal, _ = plane(polygon)
    height = normal @ (point - polygon[0])
    if inside((point - height * normal)[None], polygon)[0]:
        return abs(height)
    edges = np.roll(polygon, -1, axis=0) - polygon
    along = ((point - polygon) * edges).sum(axis=1) / (edges * edges).sum(axis=1)
    nearest = polygon + np.clip(along, 0.0, 1.0)[:, None] * edges
    return np.linalg.norm(point - nearest, axis=1).min()


def solid_angle(point, polygon):
    """Return (solid angle [sr], error) of a polygon from a point, a horizon or not.

    A. Van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Transactions on
    Biomedical Engineering 30, 1983, eq. 8, per triangle of a fan; their triple product is taken of
    differences of corners, so that small ones keep their digits.
    """
    if len(polygon) < 3:
        return 0.0, 0.0
    p = polygon - point
    r = np.linalg.norm(p, axis=1)
    spokes = polygon - polygon[0]
    triple = np.cross(spokes[1:-1], spokes[2:]) @ p[0]
    a, (b, c), (rb, rc) = p[0], (p[1:-1], p[2:]), (r[1:-1], r[2:])
    below = r[0] * rb * rc + b @ a * rc + c @ a * rb + (b * c).sum(axis=1) * r[0]
    each = 2.0 * np.arctan2(triple, below)
    reach = np.linalg.norm(spokes, axis=1) / r  # on edge, what rounds is still as wide as this
    size = np.abs(each).sum() + (reach[1:-1] * reach[2:]).sum()
    return abs(each.sum()), 8.0 * EPS * size


def form_factor(point, normal, polygon):
    """Return (F, error) from a patch at a point, with a unit normal, to a polygon.

    The part below the horizon does not count (D. Baum et al., "Improving radiosity solutions
    through the use of analytically determined form-factors", SIGGRAPH 1989).
    """
    above = clipped(polygon, point, normal)
    if len(above) < 3:
        return 0.0, 0.0
    found, size = vector_irradiance(point[None], above, normal)
    cut = (
        np.abs(polygon - point).max() / np.ptp(polygon, axis=0).max()
    )  # rounds corners that it makes
    size = size[0] * (8.0 if above is polygon else 8.0 + cut)
    return abs(found[0]) / (2.0 * math.pi), EPS * size / (2.0 * math.pi)


def vector_irradiance(points, polygon, normal):
    """Return 2 pi F (m,), signed by the way round, at points (m, 3), and the size of its terms.

    J. H. Lambert, "Photometria", 1760: the sum over all edges of the angle that an edge is seen at
    times the unit normal of the plane through it and the point. Written as the sum of u x v over
    all edges, which is that of differences of unit vectors over a fan, plus what an angle exceeds
    its sine by: nothing cancels, however small the polygon.
    """
    p = polygon - points[:, None]
    r = np.linalg.norm(p, axis=2)[..., None]
    spokes, edges = polygon - polygon[0], np.roll(polygon, -1, axis=0) - polygon
    slant = (spokes * (p + p[:, :1])).sum(axis=2, keepdims=True)
    u = spokes / r - p[:, :1] * (slant / (r[:, :1] * r * (r[:, :1] + r)))  # of lengths 1, minus u_0
    fan = np.cross(u[:, 1:-1], u[:, 2:])
    across = np.cross(p, edges)
    length = np.linalg.norm(across, axis=2)
    following = np.roll(p, -1, axis=1)
    angle = np.arctan2(length, (p * following).sum(axis=2))
    bend = (_excess(angle) / np.where(length, length, 1.0))[..., None] * across
    terms = np.concatenate([fan, bend], axis=1)
    reach, bent = np.linalg.norm(u, axis=2), np.linalg.norm(bend, axis=2)
    size = (reach[:, 1:-1] * reach[:, 2:]).sum(axis=1) + bent.sum(axis=1)
    return (terms @ normal).sum(axis=1), size


def _excess(x):
    """Return x - sin x with all its digits."""
    y, series = x * x, 1.0
    for k in (156.0, 110.0, 72.0, 42.0, 20.0):
        series = 1.0 - y / k * series
    return np.where(x < 0.7, x * y / 6.0 * series, x - np.sin(x))


def facing(one, other):
    """Return (normal of one on the side of the other, whether the other lies on both sides).

    Where it does, the front is where the corners of one run counter-clockwise.
    """
    normal, _ = plane(one)
    height = (other - one[0]) @ normal
    low, high = max(0.0, -height.min()), max(0.0, height.max())
    if min(low, high) > LEVEL * np.ptp(other, axis=0).max():
        return normal, True
    return (normal if high >= low else -normal), False


def exchange(one, other):
    """Return (A1 F12 [m^2], error, how it was found) of two polygons that see each other.

    Each is first cut by the other's plane. Where the first is far enough away, the closed form of
    a patch is integrated over it; elsewhere, as where they touch, it is a double contour integral.
    """
    one, other, front, far = seen(one, other)
    if not len(one):
        return 0.0, 0.0, "closed form"
    if _apart(one, other):
        return *_over_area(one, other, front), "integral of closed form"
    if _apart(other, one):
        return *_over_area(other, one, far), "integral of closed form"
    return *_contour(one, other), "contour integral"


def touch(one, other):
    """Return whether the parts of two polygons that see each other have a point in common."""
    one, other, *_ = seen(one, other)
    pairs = [(p, other) for p in one] + [(p, one) for p in other]
    return any(distance(p, polygon) <= 1e-9 * np.ptp(polygon, axis=0).max() for p, polygon in pairs)


def seen(one, other):
    """Return the parts of two polygons in front of each other, and the normals of their fronts.

    The parts are both (0, 3) where one is.
    """
    front, far = facing(one, other)[0], facing(other, one)[0]
    level = np.abs((other - one[0]) @ front).max() <= LEVEL * np.ptp(other, axis=0).max()
    one, other = clipped(one, other[0], far), clipped(other, one[0], front)
    if level or not len(one) or not len(other):
        one, other = one[:0], other[:0]
    return one, other, front, far


def _apart(one, other):
    middle = one.mean(axis=0)
    return distance(middle, other) > (1 + APART) * np.linalg.norm(one - middle, axis=1).max()


def _even(t):
    return t, 1.0


def cubature(polygon, order, grade=_even):
    """Return points (k, 3) and signed weights (k,) of a rule that integrates over a polygon.

    Gauss and Legendre's over triangles from its middle to its edges; grade maps t in (0, 1) to
    (s, ds/dt), to crowd the points where the integrand is steep.
    """
    normal, _ = plane(polygon)
    u, wu = _gauss(order, grade)
    slices = max(2 + order // 8, math.ceil(order * min(1.0, 6.0 / len(polygon))))
    v, wv = _gauss(slices, grade if len(polygon) <= ROUND else _even)
    middle = polygon.mean(axis=0)
    a, b = polygon - middle, np.roll(polygon, -1, axis=0) - middle
    side = a[:, None] + v[:, None] * (b - a)[:, None]
    points = middle + u[:, None, None] * side[:, None]
    weights = (np.cross(a, b) @ normal)[:, None, None] * (u * wu)[:, None] * wv
    return points.reshape(-1, 3), weights.ravel()


def _gauss(order, grade):
    x, w = np.polynomial.legendre.leggauss(order)
    s, slope = grade((x + 1.0) / 2.0)
    return s, w / 2.0 * slope


def _over_area(one, other, normal):
    found = []
    for order in ORDERS:
        points, weights = cubature(one, order)
        parts = np.array_split(points, -(-points.size * len(other) // 500_000))
        each = np.concatenate([vector_irradiance(part, other, normal)[0] for part in parts])
        found.append(abs(weights @ each) / (2.0 * math.pi))
    return found[0], abs(found[0] - found[1]) + 16.0 * EPS * found[0]


def _contour(one, other):
    """Return (A1 F12, error) by the integral of ln r ds1.ds2 / 2 pi over both contours.

    E. Sparrow, "A new and simpler formulation for radiative angle factors", Journal of Heat
    Transfer 85, 1963. The inner one in closed form, the outer one by rules of two orders on
    intervals that are halved where the two disagree.
    """
    scale = np.ptp(np.vstack([one, other]), axis=0).max()
    a, b = one / scale, np.roll(one, -1, axis=0) / scale
    total, error, noise = 0.0, 0.0, 0.0
    for level in range(HALVINGS):
        (value, size), (rough, _) = (_rule(a, b, other / scale, order) for order in ORDERS)
        off, rounding = np.abs(value - rough), 4.0 * EPS * size
        target = ACCURACY * abs(total + value.sum())
        done = off <= np.maximum(target, rounding)
        if level == HALVINGS - 1 or len(a) > MOST:
            done[:] = True
        total, error = total + value[done].sum(), error + off[done].sum()
        noise += rounding[done].sum()
        if done.all():
            break
        a, b, middle = a[~done], b[~done], (a[~done] + b[~done]) / 2.0
        a, b = np.concatenate([a, middle]), np.concatenate([middle, b])
    return tuple(x * scale**2 / (2.0 * math.pi) for x in (abs(total), error + noise))


def _rule(a, b, other, order):
    """Return the integral (k,) from a to b (k, 3) of ln r ds.ds2 around a polygon, and its size."""
    x, w = _gauss(order, _even)
    p = a[:, None] + x[:, None] * (b - a)[:, None]
    total, size = np.zeros(p.shape[:2]), np.zeros(p.shape[:2])
    for start, end in zip(other, np.roll(other, -1, axis=0), strict=True):
        length = np.linalg.norm(end - start)
        t = (end - start) / length
        beside = np.linalg.norm(np.cross(p - start, t), axis=2)
        low = (start - p) @ t
        high, low = _antiderivative(low + length, beside), _antiderivative(low, beside)
        along = ((b - a) @ t)[:, None]
        total = total + along * (high - low)
        size = size + np.abs(along) * (np.abs(high) + np.abs(low) + length)
    return total @ w, size @ w


def _antiderivative(s, h):
    """Return the integral over s of ln sqrt(s^2 + h^2), plus s: whose sum around is nothing."""
    square = s * s + h * h
    return 0.5 * s * np.log(np.where(square, square, 1.0)) + h * np.arctan2(s, h)
