"""The scene of a glTF document: its meshes made into triangles and put in their places.

Functions here raise a Mistake that names the place in the document, but not yet the file.
"""

import re
from typing import NamedTuple

import numpy as np

from lumiar.errors import Mistake
from lumiar.formats import check, gltf_nodes
from lumiar.formats.gltf_data import (
    INDEX_CODES,
    accessors,
    buffers,
    child,
    entry,
    floats,
    listed,
    take,
    whole,
)

_HARMLESS = re.compile(  # may be required: they leave the shape alone, or are read
    r"(KHR|EXT|ADOBE|MSFT)_(materials|texture|lights|techniques)_\w+|KHR_animation_pointer|KHR_xmp\w*"
    r"|KHR_mesh_quantization"
)
_SHAPES = {  # what is read of a vertex: width, types, and further types with KHR_mesh_quantization
    "POSITION": (3, ("<f4",), ("<i1", "<u1", "<i2", "<u2")),
    "NORMAL": (3, ("<f4",), ("<i1", "<i2")),
    "TEXCOORD_0": (2, ("<f4", "<u1", "<u2"), ("<i1", "<i2")),
}


class Piece(NamedTuple):
    """Triangles: the arrays of Polygons; what a piece has not is empty, and its indices are -1."""

    positions: np.ndarray
    corners: np.ndarray
    normals: np.ndarray
    normal_of: np.ndarray
    uvs: np.ndarray
    uv_of: np.ndarray


def read(document, blob, fetch, notes):
    """Return the Piece of all meshes in the scene, each as often and where its nodes put it."""
    quantized = _check_asset(document)
    accessor = accessors(document, buffers(document, blob, fetch))
    meshes, pieces, room = {}, [], check.MOST_CORNERS
    for node, matrix in gltf_nodes.placed(document):
        where = f"node {node}"
        spec = document["nodes"][node]
        if "mesh" not in spec:
            continue
        if "skin" in spec:
            notes.append("skeletons are not used: a mesh with a skin is drawn in its bind pose")
        index = whole(spec, "mesh", where)
        if index not in meshes:
            mesh = entry(document, "meshes", index, where)
            meshes[index] = _mesh(mesh, f"mesh {index}", accessor, quantized, room, notes)
        room -= len(meshes[index].corners)
        _check_room(room)
        pieces.append(_place(meshes[index], matrix))
    return _join(pieces)


def _check_room(room):
    if room < 0:
        raise Mistake(f"over {check.MOST_CORNERS} face corners, instances counted; simplify it")


def _check_asset(document):
    """Return whether quantized attributes are allowed; raise a Mistake for what is not read."""
    asset = child(document, "asset", "the file")
    for key in ("version", "minVersion"):
        version = asset.get(key, "2.0" if key == "minVersion" else None)
        if not isinstance(version, str) or not re.fullmatch(r"2\.\d+", version):
            raise Mistake(f"asset.{key} is {str(version)[:20]}, not 2.0; export it as glTF 2.0")
    if asset.get("minVersion", "2.0") != "2.0":
        raise Mistake(f"needs glTF {asset['minVersion']}; export it as glTF 2.0")
    for extension in listed(document, "extensionsRequired", "the file", str):
        if not _HARMLESS.fullmatch(extension):
            what = f"needs the extension {extension[:60]}, which is not read; export it without"
            raise Mistake(what + " (no compression, no instancing)")
    used = listed(document, "extensionsUsed", "the file", str)
    return "KHR_mesh_quantization" in used + document.get("extensionsRequired", [])


def _mesh(mesh, where, accessor, quantized, room, notes):
    """Return the Piece of all primitives of a mesh, of at most `room` corners."""
    if "weights" in mesh:
        notes.append("morph targets are not used")
    pieces = []
    for i, primitive in enumerate(listed(mesh, "primitives", where)):
        piece = _primitive(primitive, f"{where}, primitive {i}", accessor, quantized, room, notes)
        pieces.append(piece)
        room -= len(piece.corners)
    return _join(pieces)


def _primitive(primitive, where, accessor, quantized, room, notes):
    """Return the Piece of the triangles of a primitive, of at most `room` corners."""
    mode = whole(primitive, "mode", where, 4)
    attributes = child(primitive, "attributes", where)
    if mode > 6:
        raise Mistake(f"{where}: mode is {mode}; write 4, 5 or 6 for triangles")
    if mode < 4 or "POSITION" not in attributes:
        notes.append("points and lines are not drawn" if mode < 4 else "no POSITION: not drawn")
        return _join([])
    if "targets" in primitive:
        notes.append("morph targets are not used")
    found = {
        key: _attribute(attributes, key, where, accessor, quantized)
        for key in _SHAPES
        if key in attributes
    }
    position = found["POSITION"]
    count = len(position.values)
    if any(len(attribute.values) != count for attribute in found.values()):
        raise Mistake(f"{where}: its attributes differ in count; export the file again")
    draco = "KHR_draco_mesh_compression" in child(primitive, "extensions", where)
    if draco and not position.stored:
        raise Mistake(f"{where} is compressed by Draco; export the file without compression")
    corners = _corners(primitive, where, mode, accessor, count, room, notes)

    # vertices that no corner uses are left out, so that many primitives may share a long accessor
    rows, positions = None, take(position) if count <= len(corners) else None
    if positions is None or not check.all_near(positions):
        rows, corners = np.unique(corners, return_inverse=True)
        every, positions = positions, take(position, rows)
        good = check.near(positions)
        if not good.all():
            vertex = rows[np.argmin(good)]
            what = f"{where}: vertex {vertex} (accessor {attributes['POSITION']})"
            raise Mistake(what + " is not at finite numbers up to 1e18; repair it")
        if every is not None:
            notes.append(f"{(~check.near(every)).sum()} unused vertices are not finite")

    def per_vertex(key, width):
        if key not in found:
            return np.empty((0, width)), np.full(len(corners), -1)
        return floats(take(found[key], rows), found[key].normalized), corners

    normals, normal_of = per_vertex("NORMAL", 3)
    uvs, uv_of = per_vertex("TEXCOORD_0", 2)
    uvs[:, 1] = 1 - uvs[:, 1]  # glTF has v downwards
    positions = floats(positions, position.normalized)
    return Piece(positions, corners, normals, normal_of, uvs, uv_of)


def _attribute(attributes, key, where, accessor, quantized):
    """Return the Accessor of an attribute if it is of a type that the attribute may have."""
    found = accessor(whole(attributes, key, where))
    width, plain, short = _SHAPES[key]
    allowed = plain + short if quantized else plain
    loose = key == "POSITION" or (key == "TEXCOORD_0" and quantized)  # need not be normalized
    if (
        found.values.shape[1] != width
        or found.code not in allowed
        or not (found.code == "<f4" or found.normalized or loose)
    ):
        what = f"{where}: accessor {attributes[key]} is no {key}; write VEC{width} of floats"
        raise Mistake(what)
    return found


def _corners(primitive, where, mode, accessor, count, room, notes):
    """Return the vertices (3 T,) of the triangles of a primitive with `count` vertices."""
    if "indices" in primitive:
        indices = accessor(whole(primitive, "indices", where))
        label = f"{where}: accessor {primitive['indices']}"
        if indices.code not in INDEX_CODES or indices.values.shape[1] != 1:
            raise Mistake(f"{label} is no list of indices; write SCALAR of 5121, 5123 or 5125")
        _check_room(room - len(indices.values))
        index = take(indices)[:, 0]
        highest = index.max()
        if highest == np.iinfo(index.dtype).max:
            raise Mistake(f"{label} has index {highest}, a primitive restart; glTF forbids it")
        if highest >= count:
            at = np.argmax(index >= count)
            raise Mistake(f"{label} has index {index[at]} (number {at}) of {count} vertices")
        index = index.astype(np.int64)
    else:
        _check_room(room - count)
        index = np.arange(count)
    if mode == 4:
        if len(index) % 3:
            notes.append("indices after the last whole triangle ignored")
        return index[: len(index) - len(index) % 3]
    first = np.arange(len(index) - 2)
    if mode == 5:
        odd = first % 2
        return np.stack([index[first], index[first + 1 + odd], index[first + 2 - odd]], 1).ravel()
    return np.stack([index[first + 1], index[first + 2], index[first * 0]], 1).ravel()


def _place(piece, matrix):
    """Return the piece transformed; a mirrored one keeps its outside, as its corners turn."""
    if np.array_equal(matrix, np.eye(4)):
        return piece
    with np.errstate(all="ignore"):  # what overflows is found when all is checked
        positions = piece.positions @ matrix[:3, :3].T + matrix[:3, 3]
        linear = matrix[:3, :3] / (np.abs(matrix[:3, :3]).max() or 1.0)
        cofactors = np.cross(linear[[1, 2, 0]], linear[[2, 0, 1]])  # det * inverse transpose
        mirrored = bool(linear[0] @ cofactors[0] < 0)
        normals = piece.normals @ (-cofactors if mirrored else cofactors).T
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        normals /= np.where(lengths > 0, lengths, 1.0)
    turned = [
        indices.reshape(-1, 3)[:, :: -1 if mirrored else 1].ravel()
        for indices in (piece.corners, piece.normal_of, piece.uv_of)
    ]
    return Piece(positions, turned[0], normals, turned[1], piece.uvs, turned[2])


def _join(pieces):
    """Return one piece of all `pieces`."""
    if len(pieces) == 1:
        return pieces[0]
    joined = []
    for at, width in ((0, 3), (2, 3), (4, 2)):  # values, and the indices after them
        values = [np.empty((0, width)), *(piece[at] for piece in pieces)]
        before = np.cumsum([len(part) for part in values])
        moved = [
            np.where(piece[at + 1] < 0, -1, piece[at + 1] + start)
            for piece, start in zip(pieces, before, strict=False)
        ]
        joined += [np.concatenate(values), np.concatenate([np.empty(0, np.int64), *moved])]
    return Piece(*joined)
