"""Triangle meshes as arrays: polygons made ready to be lit, with normals and tangents.

Gives up on: textures (only their coordinates count, for tangents) and faces wound against their
neighbours (the mesh then counts as open, and both its sides are lit).
"""

from dataclasses import dataclass, replace

import numpy as np

from .errors import Mistake
from .polygons import Polygons, triangulate

__all__ = [
    "CREASE",
    "Mesh",
    "Polygons",
    "build",
    "corner_normals",
    "is_closed",
    "tangent_frames",
    "weld",
]
FAR = 1000.0  # sizes from the origin; there the steps of a float are 6e-5 of the size
CREASE = 60.0  # degrees between two faces beyond which the edge between them stays sharp
MAX_PAIRS = 1 << 22  # pairs of faces around vertices that are compared at a time


@dataclass(frozen=True)
class Mesh:
    """A triangle mesh with unit normals.

    positions, normals  (V, 3) float64
    triangles           (F, 3) int64, counter-clockwise seen from outside
    closed              whether they bound a solid, so that no back face is ever seen
    uvs                 (V, 2) float64 texture coordinates, or None
    tangents            (V, 4) float64 known exactly, or None: see `tangent_frames`
    notes               what was repaired
    """

    positions: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    closed: bool
    uvs: np.ndarray | None = None
    tangents: np.ndarray | None = None
    notes: tuple[str, ...] = ()


def build(polygons, crease=None, name="mesh"):
    """Return the Mesh of some Polygons.

    The normals of the file are used where it has them and `crease` is None. Otherwise, and where
    they are missing, see `corner_normals`, with `crease` (or CREASE) in degrees. Raises Mistake,
    beginning with `name`, when nothing can be drawn.
    """
    corner, cut = triangulate(polygons, name)
    notes = [*polygons.notes, *cut]
    at = weld(polygons.positions)[polygons.corners][corner]
    solid = (at[:, 0] != at[:, 1]) & (at[:, 1] != at[:, 2]) & (at[:, 2] != at[:, 0])
    if not solid.any():
        raise Mistake(f"{name}: every triangle has two corners in one place; nothing to draw")
    if not solid.all():
        notes.append(f"{np.count_nonzero(~solid)} degenerate triangles left out")
        corner, at = corner[solid], at[solid]
    normals = _own_normals(polygons, corner) if crease is None else None
    p = polygons.positions[polygons.corners[corner]]
    face = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    closed, turn = False, np.zeros(len(at), bool)
    if is_closed(at):  # a solid tells by its volume
        inward = _volumes(p, at, face) < 0.0
        closed = bool(inward.all() or not inward.any())  # or a shell within another: lit as open
        turn |= closed and inward.any()
    if normals is not None:
        agreement = _dot(face, normals.sum(1))
        against = np.count_nonzero(agreement < 0) > np.count_nonzero(agreement > 0)
        if closed and against != turn[0]:
            notes.append("normals turned to the outside")
            normals = -normals
        elif not closed:  # each face as its own normals say
            turn = agreement < 0.0
    if turn.any():
        whole = "" if turn.all() else f"{np.count_nonzero(turn)} "
        notes.append(f"{whole}faces turned to the outside")
        corner, at, p = (
            np.where(turn.reshape(-1, *[1] * (a.ndim - 1)), a[:, ::-1], a) for a in (corner, at, p)
        )
        face = np.where(turn[:, None], -face, face)
        if normals is not None:
            normals = np.where(turn[:, None, None], normals[:, ::-1], normals)
    if normals is None:
        normals = corner_normals(p, at, face, CREASE if crease is None else crease)
    elif (missing := _dot(normals, normals) == 0.0).any():
        notes.append(f"{np.count_nonzero(missing)} missing normals computed")
        normals = np.where(missing[..., None], corner_normals(p, at, face, CREASE), normals)
    uvs = None
    if polygons.uvs is not None:
        uvs = np.where(np.abs(polygons.uvs) < 1e30, polygons.uvs, np.nan)  # or as good as missing
        uvs = np.concatenate([uvs, np.full((1, 2), np.nan)])[polygons.uv_of[corner]]
    first, triangles = _vertices(polygons.corners[corner], normals, uvs)
    uvs = None if uvs is None else uvs.reshape(-1, 2)[first]
    p, normals = p.reshape(-1, 3)[first], normals.reshape(-1, 3)[first]
    return Mesh(p, normals, triangles, closed, uvs, notes=tuple(notes))


def brought_near(polygons):
    """Return Polygons, moved to the origin with a note of it if they lie too far from it.

    Surveys lie there: at FAR times its size away a mesh of 32-bit floats shows their steps.
    """
    p = polygons.positions[np.isfinite(polygons.positions).all(axis=1)]
    if not len(p):
        return polygons
    low, high = p.min(0), p.max(0)
    centre, size = (low + high) / 2.0, (high - low).max()
    if np.abs(centre).max() <= FAR * size or size == 0.0:
        return polygons
    moved = ", ".join(f"{0.0 - c:.9g}" for c in centre)
    note = f"moved by ({moved}) to the origin, far from which 32-bit floats cannot hold it"
    return replace(polygons, positions=polygons.positions - centre, notes=(*polygons.notes, note))


def weld(positions):
    """Return (V,) int64: the number of the place of each position; equal positions share one."""
    return _groups(positions)[1]


def is_closed(triangles):
    """Return whether each directed edge of (F, 3) triangles has just one partner the other way."""
    a, b = triangles, np.roll(triangles, -1, axis=1)
    count = int(triangles.max()) + 1
    forth, back = np.sort((a * count + b).ravel()), np.sort((b * count + a).ravel())
    return bool((forth == back).all() and (forth[1:] != forth[:-1]).all())


def _volumes(p, at, face):
    """Return six times the volume of each connected part of a closed mesh, (parts,)."""
    label = np.arange(int(at.max()) + 1)
    one, other = at[:, [0, 1]].T.ravel(), at[:, [1, 2]].T.ravel()
    while True:  # hook the higher of two labels that share an edge to the lower, then shorten
        a, b = label[one], label[other]
        apart = a != b
        if not apart.any():
            break
        one, other, a, b = one[apart], other[apart], a[apart], b[apart]
        np.minimum.at(label, np.maximum(a, b), np.minimum(a, b))
        while (label[label] != label).any():
            label = label[label]
    parts = np.unique(label[at[:, 0]], return_inverse=True)[1].reshape(-1)
    return np.bincount(parts, _dot(p[:, 0] - p.reshape(-1, 3).mean(0), face))


def corner_normals(p, at, face, crease):
    """Return (F, 3, 3) unit normals, one for each corner of each triangle.

    A normal is the mean of the faces around the vertex, weighted by their area times their angle
    there, over the faces within `crease` degrees of the corner's own.

    p     (F, 3, 3) positions of the corners
    at    (F, 3) place of each corner, see `weld`
    face  (F, 3) cross products of two edges, twice the area long
    """
    edges = _unit(np.roll(p, -1, axis=1) - p)
    angles = np.arccos(np.clip(-_dot(edges, np.roll(edges, 1, axis=1)), -1.0, 1.0))
    weighted = (angles[:, :, None] * face[:, None]).reshape(-1, 3)
    at, unit = at.reshape(-1), np.repeat(_unit(face), 3, axis=0)
    total = np.stack([np.bincount(at, w) for w in weighted.T], axis=1)
    normals = _unit(total)[at]
    # Faces within crease / 2 of their mean are within crease of each other: nothing to split
    apart = _dot(normals, unit) < np.cos(np.radians(crease / 2))
    apart &= unit.any(axis=1)
    split = np.isin(at, at[apart]) if apart.any() else apart
    if split.any():
        normals[split] = _creased(at[split], unit[split], weighted[split], crease)
    lost = ~normals.any(axis=1)
    normals[lost] = unit[lost]
    lost &= ~unit.any(axis=1)
    normals[lost] = [0.0, 1.0, 0.0]
    return normals.reshape(p.shape)


def tangent_frames(mesh):
    """Return (V, 4): unit tangents along the texture's u, w the sign of the bitangent.

    Where a mesh has no texture coordinates, or they give no direction, the tangent runs along the
    circle of latitude about the y axis.
    """
    if mesh.tangents is not None:
        return mesh.tangents
    normals, count = mesh.normals, len(mesh.positions)
    along, sign = np.zeros((count, 3)), np.ones(count)
    if mesh.uvs is not None:
        p, t = mesh.positions[mesh.triangles], mesh.uvs[mesh.triangles]
        e1, e2 = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        d1, d2 = t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]
        turn = np.sign(d1[:, :1] * d2[:, 1:] - d1[:, 1:] * d2[:, :1])
        u = _unit(turn * (e1 * d2[:, 1:] - e2 * d1[:, 1:]))
        v = _unit(turn * (e2 * d1[:, :1] - e1 * d2[:, :1]))
        corners = mesh.triangles.ravel()
        known = np.isfinite(t).all(axis=(1, 2))[:, None]  # no texture coordinates here
        u, v = np.where(known, u, 0.0), np.where(known, v, 0.0)
        u, v = (
            np.stack([np.bincount(corners, c, count) for c in np.repeat(w, 3, axis=0).T], axis=1)
            for w in (u, v)
        )
        along = u - normals * (normals * u).sum(1, keepdims=True)
        sign = np.where((np.cross(normals, along) * v).sum(1) < 0.0, -1.0, 1.0)
    lost = ~(np.linalg.norm(along, axis=1) >= 1e-6)
    around = np.stack([normals[:, 2], np.zeros(count), -normals[:, 0]], axis=1)
    around[np.linalg.norm(around, axis=1) < 1e-6] = [1.0, 0.0, 0.0]
    around -= normals * (normals * around).sum(1, keepdims=True)
    along[lost], sign[lost] = around[lost], 1.0
    return np.concatenate([_unit(along), sign[:, None]], axis=1)


def _own_normals(polygons, corner):
    """Return (F, 3, 3) unit normals as the file gives them, zero where it gives none, or None."""
    if polygons.normals is None:
        return None
    finite = np.isfinite(polygons.normals).all(axis=1, keepdims=True)
    unit = _unit(np.where(finite, polygons.normals, 0.0))
    own = np.concatenate([unit, np.zeros((1, 3))])[polygons.normal_of[corner]]
    return own if own.any() else None


def _creased(at, unit, weighted, crease):
    """Return (C, 3) unit normals: for a corner, the sum over those at its place within `crease`."""
    order = np.argsort(at, kind="stable")
    _, start, size = np.unique(at[order], return_index=True, return_counts=True)
    normals = np.zeros_like(unit)
    limit = np.cos(np.radians(crease)) - 1e-9
    group = 0
    while group < len(size):
        end = group + 1
        pairs = int(size[group]) ** 2
        while end < len(size) and pairs + int(size[end]) ** 2 <= MAX_PAIRS:
            pairs += int(size[end]) ** 2
            end += 1
        n = size[group:end]
        if pairs > MAX_PAIRS:  # thousands of faces meet in one vertex: each keeps its own normal
            corners = order[start[group] : start[group] + n[0]]
            normals[corners] = unit[corners]
        else:
            of = np.repeat(np.arange(end - group), n**2)
            k = np.arange(pairs) - np.repeat(np.cumsum(n**2) - n**2, n**2)
            one = order[start[group:end][of] + k // n[of]]
            other = order[start[group:end][of] + k % n[of]]
            near = _dot(unit[one], unit[other]) >= limit
            for axis in range(3):
                sums = np.bincount(one[near], weighted[other[near], axis], len(at))
                normals[:, axis] += sums
        group = end
    return _unit(normals)


def _vertices(corners, normals, uvs):
    """Return (indices of the first corner of each vertex, (F, 3) vertex indices).

    A vertex is a position index with one normal and one texture coordinate.
    """
    index = corners.ravel()
    rows = normals.reshape(len(index), 3)
    if uvs is not None:
        rows = np.concatenate([rows, np.nan_to_num(uvs.reshape(len(index), 2))], axis=1)
    rows = rows.astype(np.float32)  # as drawn, so that the same sum in another order is the same
    last = np.full(int(index.max()) + 1, -1)
    last[index] = np.arange(len(index))
    if (rows[last[index]] == rows).all():  # each position has one normal, as in most files
        used = last >= 0
        first, triangles = last[used], (np.cumsum(used) - 1)[index]
    else:
        first, triangles = _groups(np.concatenate([index[:, None], rows], axis=1))
    return first, triangles.reshape(corners.shape)


def _groups(rows):
    """Return (index of the first row of each kind, (N,) which kind each row is), by equality."""
    rows = np.ascontiguousarray(rows, np.float64) + 0.0  # makes -0.0 into 0.0
    hashes = np.zeros(len(rows), np.uint64)
    for column in rows.view(np.uint64).T:
        hashes = (hashes ^ column) * np.uint64(0x9E3779B97F4A7C15)
        hashes ^= hashes >> np.uint64(32)
    _, first, kind = np.unique(hashes, return_index=True, return_inverse=True)
    if (rows[first[kind]] != rows).any():  # two rows met in one hash
        _, first, kind = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return first, kind.reshape(-1)


def _dot(a, b):
    return np.einsum("...i,...i->...", a, b)


def _unit(vectors):
    """Return vectors of length 1 along the last axis; zero stays zero."""
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    scaled = vectors / np.where(largest > 0.0, largest, 1.0)
    length = np.sqrt(_dot(scaled, scaled))[..., None]
    return scaled / np.where(length > 0.0, length, 1.0)
