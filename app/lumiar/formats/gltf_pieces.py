"""Triangles from the primitives of a glTF document: made from accessors, placed and joined."""

from typing import NamedTuple

import numpy as np

from lumiar.errors import Mistake
from lumiar.formats import check
from lumiar.formats.gltf_data import Accessor, floats, take


class Drawing(NamedTuple):
    """A primitive to draw: where it is, its mode, accessors, and how many corners it will have."""

    where: str
    mode: int
    attributes: dict
    indices: Accessor | None
    corners: int


class Piece(NamedTuple):
    """Triangles: the arrays of Polygons; what a piece has not is empty, and its indices are -1."""

    positions: np.ndarray
    corners: np.ndarray
    normals: np.ndarray
    normal_of: np.ndarray
    uvs: np.ndarray
    uv_of: np.ndarray


def made(drawing, notes):
    """Return the Piece of a Drawing.

    Raises a Mistake for an index out of range and for a used position that is not finite.
    """
    position = drawing.attributes["POSITION"]
    corners = _corners(drawing, len(position.values), notes)
    rows = None
    if len(position.values) > len(corners):  # many primitives may share a long accessor
        rows, corners = np.unique(corners, return_inverse=True)
    positions = take(position, rows)
    if len(corners) and not check.all_near(positions):
        bad = ~check.near(positions)
        vertex = corners[np.argmax(bad[corners])]
        if bad[vertex]:
            vertex = vertex if rows is None else rows[vertex]
            what = f"{drawing.where}: vertex {vertex} of {position.label} is not at finite numbers"
            raise Mistake(f"{what} up to 1e18; repair it")

    def per_vertex(key, width):
        if key not in drawing.attributes:
            return np.empty((0, width)), np.broadcast_to(-1, len(corners))
        attribute = drawing.attributes[key]
        return floats(take(attribute, rows), attribute.normalized), corners

    normals, normal_of = per_vertex("NORMAL", 3)
    uvs, uv_of = per_vertex("TEXCOORD_0", 2)
    uvs[:, 1] = 1 - uvs[:, 1]  # glTF has v downwards
    positions = floats(positions, position.normalized)
    return Piece(positions, corners, normals, normal_of, uvs, uv_of)


def _corners(drawing, count, notes):
    """Return the vertex (3 T,), of `count`, of each corner of the triangles of a Drawing."""
    if drawing.indices is None:
        index = np.arange(count)
    else:
        index = take(drawing.indices)[:, 0]
        label, highest = f"{drawing.where}: {drawing.indices.label}", index.max()
        if highest == np.iinfo(index.dtype).max:
            raise Mistake(f"{label} has index {highest}, a primitive restart; glTF forbids it")
        if highest >= count:
            at = np.argmax(index >= count)
            raise Mistake(f"{label} has index {index[at]} (number {at}) of {count} vertices")
        index = index.astype(np.int64)
    if drawing.mode == 4:
        if drawing.corners < len(index):
            notes.append("indices after the last whole triangle ignored")
        return index[: drawing.corners]
    first = np.arange(len(index) - 2)
    if drawing.mode == 5:
        odd = first % 2
        return np.stack([index[first], index[first + 1 + odd], index[first + 2 - odd]], 1).ravel()
    return np.stack([index[first + 1], index[first + 2], index[first * 0]], 1).ravel()


def placed(piece, matrix):
    """Return the piece transformed; a mirrored one keeps its outside, as its corners turn."""
    if np.array_equal(matrix, np.eye(4)):
        return piece
    normals = piece.normals
    with np.errstate(all="ignore"):  # what overflows is found when all is checked
        positions = piece.positions @ matrix[:3, :3].T + matrix[:3, 3]
        linear = matrix[:3, :3] / (np.abs(matrix[:3, :3]).max() or 1.0)
        mirrored = np.linalg.det(linear) < 0
        if len(normals):
            turn = np.cross(linear[[1, 2, 0]], linear[[2, 0, 1]])  # det * inverse transpose
            normals = normals @ (-turn if mirrored else turn).T
            lengths = np.linalg.norm(normals, axis=1, keepdims=True)
            normals /= np.where(lengths > 0, lengths, 1.0)
    turned = [piece.corners, piece.normal_of, piece.uv_of]
    if mirrored:
        turned = [index.reshape(-1, 3)[:, ::-1].ravel() for index in turned]
    return Piece(positions, turned[0], normals, turned[1], piece.uvs, turned[2])


def joined(pieces):
    """Return one piece of all `pieces`."""
    if len(pieces) == 1:
        return pieces[0]
    found = []
    for at, width in ((0, 3), (2, 3), (4, 2)):  # values, and the indices after them
        values = [np.empty((0, width)), *(piece[at] for piece in pieces)]
        before = np.cumsum([len(part) for part in values])
        moved = [
            np.where(piece[at + 1] < 0, -1, piece[at + 1] + start)
            for piece, start in zip(pieces, before, strict=False)
        ]
        found += [np.concatenate(values), np.concatenate([np.empty(0, np.int64), *moved])]
    return Piece(*found)
