"""Triangles that hide lights → a bounding volume hierarchy that shadow rays walk on a card."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from .errors import Mistake

WIDTH = 4096  # texels in a row of the textures; glsl/rigs/occlusion.glsl knows it too
ROWS = 8192  # that every driver takes
LEAF = 4  # triangles in a leaf at most
RADIUS = 8  # neighbours on either side that a cluster chooses from
TEST = 2.0  # cost of a ray against a triangle, that against a box being 1
BLOCK = 1 << 14  # clusters looked at together: their boxes stay in the processor's cache


class Occluders(NamedTuple):
    """A hierarchy as two textures of four float32 per texel; rows are WIDTH texels.

    nodes     depth first, two texels each: (low corner, link) and (high corner, count). Where the
              count is 0 the link is the node to go on with if the box is missed; else the node is a
              leaf, and the link the first of its count triangles
    corners   three texels per triangle: its corners, in the fourth places its unit normal
    triangles how many there are
    """

    nodes: bytes
    corners: bytes
    triangles: int

    @property
    def sizes(self):
        """Return the sizes ((width, height), (width, height)) of the two textures."""
        return tuple((WIDTH, len(data) // (16 * WIDTH)) for data in (self.nodes, self.corners))


def build(triangles):
    """Return the Occluders of triangles (n, 3, 3), world space, in the precision of float32.

    What no ray can hit, without area or not finite, is left out. Clusters grow from neighbours
    along a Morton curve as in D. Meister and J. Bittner, "Parallel locally-ordered clustering for
    bounding volume hierarchy construction", 2018; the surface area heuristic then chooses the
    leaves. Raises Mistake for more than the textures hold.
    """
    p = np.asarray(triangles, np.float32).reshape(-1, 3, 3).transpose(1, 2, 0)
    p, normals = _solid(np.ascontiguousarray(p))
    n = p.shape[2]
    most = WIDTH * ROWS // 3
    if n > most:
        raise Mistake(f"shadows = true with {n} triangles in the scene; allowed: up to {most}")
    if not n:
        return Occluders(_texels(_empty()), _texels(np.zeros((1, 4), np.float32)), 0)
    low, high = p.min(axis=0), p.max(axis=0)
    order = np.argsort(_morton(low, high), kind="stable")
    with np.errstate(over="ignore"):  # of areas: clusters then join in order
        nodes, places = _laid_out(*_cluster(low[:, order], high[:, order]))
    where = np.empty(n, np.int64)
    where[places] = order
    corners = np.empty((n, 3, 4), np.float32)
    corners[:, :, :3] = p[:, :, where].transpose(2, 0, 1)
    corners[:, :, 3] = normals[:, where].T
    return Occluders(_texels(nodes), _texels(corners), n)


def _solid(p):
    """Return those of triangles (corner, axis, n) that have an area, and their unit normals."""
    with np.errstate(invalid="ignore", over="ignore"):
        a, b = p[1:].astype(np.float64) - p[0]
        x = a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
        normals, area = np.stack(x), np.sqrt(x[0] ** 2 + x[1] ** 2 + x[2] ** 2)
        kept = area > 1e-13 * ((a * a).sum(0) + (b * b).sum(0))
    if not kept.all():
        p, normals, area = p[:, :, kept], normals[:, kept], area[kept]
    return p, (normals / area).astype(np.float32)


def _texels(values):
    """Return the bytes of texels (…, 4), filled up to whole rows."""
    flat = values.reshape(-1, 4)
    rows = np.zeros((-(-len(flat) // WIDTH) * WIDTH, 4), np.float32)
    rows[: len(flat)] = flat
    return rows.tobytes()


def _empty():
    """Return the one node of a tree without triangles: behind it the nodes end."""
    return np.array([[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0]], np.float32)


def _morton(low, high):
    """Return the places of boxes (3, n) along a Morton curve of 21 bits an axis, uint64."""
    middle = (low.astype(np.float64) + high) / 2.0
    start = middle.min(axis=1, keepdims=True)
    extent = (middle - start).max() or 1.0
    cells = ((middle - start) * ((2**21 - 1) / extent)).astype(np.uint64)
    code = np.zeros(cells.shape[1], np.uint64)
    steps = (
        (32, 0x1F00000000FFFF),
        (16, 0x1F0000FF0000FF),
        (8, 0x100F00F00F00F00F),
        (4, 0x10C30C30C30C30C3),
        (2, 0x1249249249249249),
    )
    for axis, cell in enumerate(cells):
        for shift, mask in steps:
            cell = (cell | cell << np.uint64(shift)) & np.uint64(mask)
        code |= cell << np.uint64(axis)
    return code


def _half_area(low, high):
    """Return half the surface of boxes (3, n)."""
    x, y, z = high - low
    return x * (y + z) + y * z


def _cluster(low, high):
    """Return (low, high (3, 2n - 1), children (n - 1, 2), ends) of the tree over n boxes.

    Nodes from n on have children; ends are the numbers of nodes there were after each round, so
    that a node's children are of earlier rounds.
    """
    n = low.shape[1]
    lows, highs = (
        np.concatenate([a, np.empty((3, n - 1), np.float32)], axis=1) for a in (low, high)
    )
    children = np.empty((n - 1, 2), np.int64)
    ids, made, ends = np.arange(n), n, [n]
    while len(ids) > 1:
        nearest, index = _nearest(low, high), np.arange(len(ids))
        left = np.flatnonzero((nearest[nearest] == index) & (index < nearest))
        if len(left) * 16 < len(ids):  # as where every box lies in the next: join them in order
            left = index[:-1:2]
            nearest = index + 1
        right = nearest[left]
        new = np.arange(made, made + len(left))
        children[new - n] = np.stack([ids[left], ids[right]], axis=1)
        low[:, left] = np.minimum(low[:, left], low[:, right])
        high[:, left] = np.maximum(high[:, left], high[:, right])
        lows[:, new], highs[:, new] = low[:, left], high[:, left]
        ids[left] = new
        kept = np.ones(len(ids), bool)
        kept[right] = False
        low, high, ids = low[:, kept], high[:, kept], ids[kept]
        made += len(left)
        ends.append(made)
    return lows, highs, children, ends


def _nearest(low, high):
    """Return for each of boxes (3, n) which other, at most RADIUS places away, it joins best."""
    n = low.shape[1]
    found = np.empty(n, np.int64)
    for start in range(0, n, BLOCK):
        first, last = max(0, start - RADIUS), min(n, start + BLOCK + RADIUS)
        best = first + _nearest_of(low[:, first:last], high[:, first:last])
        found[start : start + BLOCK] = best[start - first : start - first + BLOCK]
    return found


def _nearest_of(low, high):
    """Return the same for boxes looked at all at once."""
    n = low.shape[1]
    least, which, index = np.full(n, np.inf, np.float32), np.arange(n), np.arange(n)
    for d in range(1, min(RADIUS, n - 1) + 1):
        area = _half_area(
            np.minimum(low[:, d:], low[:, :-d]), np.maximum(high[:, d:], high[:, :-d])
        )
        for part, other in ((slice(n - d), index[d:]), (slice(d, n), index[:-d])):
            nearer = area < least[part]
            np.copyto(least[part], area, where=nearer)
            np.copyto(which[part], other, where=nearer)
    return which


def _laid_out(low, high, children, ends):
    """Return nodes (m, 2, 4) depth first, and the place (n,) of each triangle in the leaves."""
    n, total = len(children) + 1, 2 * len(children) + 1
    area = _half_area(low, high)
    count, cost = np.ones(total, np.int64), area * TEST
    size, leaf = np.ones(total, np.int64), np.ones(total, bool)
    rounds = [slice(*pair) for pair in pairwise(ends)]
    for new in rounds:
        a, b = children[new.start - n : new.stop - n].T
        count[new] = count[a] + count[b]
        split, whole = 2.0 * area[new] + cost[a] + cost[b], area[new] * count[new] * TEST
        leaf[new] = (count[new] <= LEAF) & (whole <= split)
        cost[new] = np.where(leaf[new], whole, split)
        size[new] = np.where(leaf[new], 1, 1 + size[a] + size[b])
    place, start = np.zeros(total, np.int64), np.zeros(total, np.int64)
    alive = np.ones(total, bool)
    for new in reversed(rounds):
        a, b = children[new.start - n : new.stop - n].T
        alive[a] = alive[b] = alive[new] & ~leaf[new]
        place[a] = place[new] + 1
        place[b] = place[a] + size[a]
        start[a] = start[new]
        start[b] = start[a] + count[a]
    nodes = np.empty((size[-1], 2, 4), np.float32)
    at = place[alive]
    nodes[at, 0, :3], nodes[at, 1, :3] = low[:, alive].T, high[:, alive].T
    nodes[at, 0, 3] = np.where(leaf, start, place + size)[alive]
    nodes[at, 1, 3] = np.where(leaf, count, 0)[alive]
    if leaf[-1]:  # the root says where the nodes end
        root = nodes[0].copy()
        root[:, 3] = 2.0, 0.0
        nodes = np.concatenate([root[None], nodes])
    return nodes, start[:n]
