"""What a mesh file holds, polygons over shared positions, and their cutting into triangles."""

from dataclasses import dataclass

import numpy as np

from .errors import Mistake

MAX_CONCAVE = 512  # corners of a concave polygon; the time to cut it grows with their square


@dataclass(frozen=True)
class Polygons:
    """The contents of a mesh file, in the file's own unit.

    positions  (V, 3) float64
    corners    (C,) int64, the position index of each polygon corner, polygon after polygon
    sizes      (P,) int64, the number of corners of each polygon, every one at least 3
    normals    (N, 3) float64, and normal_of (C,) int64: which one a corner has, -1 for none
    uvs        (U, 2) float64, and uv_of (C,) int64: which texture coordinate it has, -1 for none
    notes      what was repaired while reading, one short phrase each
    """

    positions: np.ndarray
    corners: np.ndarray
    sizes: np.ndarray
    normals: np.ndarray | None = None
    normal_of: np.ndarray | None = None
    uvs: np.ndarray | None = None
    uv_of: np.ndarray | None = None
    notes: tuple[str, ...] = ()


def triangulate(polygons, name="mesh"):
    """Return ((F, 3) indices into the corner arrays, notes): n - 2 triangles for n corners.

    A convex polygon is cut as a fan, a concave one ear by ear. Raises Mistake, beginning with
    `name`, for a concave polygon of more than MAX_CONCAVE corners.
    """
    sizes = polygons.sizes
    if (sizes == 3).all():
        return np.arange(len(polygons.corners)).reshape(-1, 3), ()
    start = np.cumsum(sizes) - sizes
    polygon = np.repeat(np.arange(len(sizes)), sizes - 2)
    first = np.cumsum(sizes - 2) - (sizes - 2)
    step = np.arange(len(polygon)) - first[polygon]
    base = start[polygon]
    corner = np.stack([base, base + step + 1, base + step + 2], axis=1)
    crossed = 0
    for i in np.flatnonzero(_concave(polygons, start)):
        n = int(sizes[i])
        if n > MAX_CONCAVE:
            raise Mistake(f"{name}: polygon {i + 1} is concave with {n} corners; triangulate it")
        own = np.arange(start[i], start[i] + n)
        ears = _ears(polygons.positions[polygons.corners[own]])
        if ears is None:
            crossed += 1
        else:
            corner[first[i] : first[i] + n - 2] = own[ears]
    return corner, (f"{crossed} polygons that cross themselves cut as fans",) if crossed else ()


def _concave(polygons, start):
    """Return (P,) bool: the polygons with a corner that turns against the polygon's own normal."""
    sizes, p = polygons.sizes, polygons.positions[polygons.corners]
    owner = np.repeat(np.arange(len(sizes)), sizes)
    ahead, behind = np.arange(len(p)) + 1, np.arange(len(p)) - 1
    ahead[start + sizes - 1], behind[start] = start, start + sizes - 1
    p = p - p[start][owner]  # near the origin, so that the products keep their digits
    turn = np.cross(p - p[behind], p[ahead] - p)
    newell = np.stack([np.bincount(owner, c, len(sizes)) for c in np.cross(p, p[ahead]).T], axis=1)
    against = (turn * newell[owner]).sum(1)
    size = np.linalg.norm(turn, axis=1) * np.linalg.norm(newell, axis=1)[owner]
    return (np.bincount(owner, against < -1e-9 * size, len(sizes)) > 0) & (sizes > 3)


def _ears(points):
    """Return (n - 2, 3) indices that cut the polygon of (n, 3) points, None if it crosses itself.

    Ear clipping (G. Meisters, "Polygons have ears", 1975) in the plane where the polygon is widest.
    """
    p = points - points[0]
    normal = np.cross(p, np.roll(p, -1, axis=0)).sum(0)
    axis = int(np.argmax(np.abs(normal)))
    flat = p[:, [(axis + 1) % 3, (axis + 2) % 3]]
    if normal[axis] < 0.0:
        flat = flat * [-1.0, 1.0]

    def left(a, b, c):  # > 0 where c lies to the left of the line from a to b
        return (b[0] - a[0]) * (c[..., 1] - a[1]) - (b[1] - a[1]) * (c[..., 0] - a[0])

    ring, cut = list(range(len(points))), []
    while len(ring) > 3:
        for k, middle in enumerate(ring):
            ear = (ring[k - 1], middle, ring[(k + 1) % len(ring)])
            a, b, c = flat[list(ear)]
            rest = flat[[r for r in ring if r not in ear]]
            rest = rest[~(rest[:, None] == [a, b, c]).all(2).any(1)]  # bridges visit a place twice
            inside = (left(a, b, rest) >= 0) & (left(b, c, rest) >= 0) & (left(c, a, rest) >= 0)
            if left(a, b, c) > 0.0 and not inside.any():
                cut.append(ear)
                del ring[k]
                break
        else:
            return None
    return np.array([*cut, tuple(ring)])
