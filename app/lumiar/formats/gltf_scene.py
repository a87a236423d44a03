"""The scene of a glTF document: which primitives are drawn, and where.

Functions here raise a Mistake that names the place in the document, but not yet the file.
"""

import re

from lumiar.errors import Mistake
from lumiar.formats import check, gltf_nodes
from lumiar.formats.gltf_data import (
    INDEX_CODES,
    accessors,
    buffers,
    child,
    entry,
    listed,
    shown,
    whole,
)
from lumiar.formats.gltf_pieces import Drawing, joined, made, placed

_HARMLESS = re.compile(  # may be required: they leave the shape alone, or are read
    r"(KHR|EXT|ADOBE|MSFT)_(materials|texture|lights|techniques)_\w+|KHR_animation_pointer|KHR_xmp\w*"
    r"|KHR_mesh_quantization"
)
_SHAPES = {  # what is read of a vertex: width, types, and further types with KHR_mesh_quantization
    "POSITION": (3, ("<f4",), ("<i1", "<u1", "<i2", "<u2")),
    "NORMAL": (3, ("<f4",), ("<i1", "<i2")),
    "TEXCOORD_0": (2, ("<f4", "<u1", "<u2"), ("<i1", "<i2")),
}


def read(document, blob, fetch, notes):
    """Return the Piece of all meshes in the scene, each as often and where its nodes put it."""
    quantized = _check_asset(document)
    accessor = accessors(document, buffers(document, blob, fetch))
    drawn, drawings, corners = [], {}, {}
    for node, matrix in gltf_nodes.placed(document):
        spec = document["nodes"][node]
        if "mesh" not in spec:
            continue
        if "skin" in spec:
            notes.append("skeletons are not used: a mesh with a skin is drawn in its bind pose")
        index = whole(spec, "mesh", f"node {node}")
        if "EXT_mesh_gpu_instancing" in child(spec, "extensions", f"node {node}"):
            notes.append("EXT_mesh_gpu_instancing is not read: such a mesh is drawn once")
        drawn.append((index, matrix))
        if index not in drawings:
            mesh, where = entry(document, "meshes", index, f"node {node}"), f"mesh {index}"
            if "weights" in mesh:
                notes.append("morph targets are not used")
            drawings[index] = [
                _drawing(primitive, f"{where}, primitive {i}", accessor, quantized, notes)
                for i, primitive in enumerate(listed(mesh, "primitives", where))
            ]
            corners[index] = sum(drawing.corners for drawing in drawings[index] if drawing)
    # before anything is made: a small file can show a mesh many times
    if sum(corners[index] for index, _ in drawn) > check.MOST_CORNERS:
        what = f"over {check.MOST_CORNERS} face corners, each instance counted; simplify the scene"
        raise Mistake(what)
    meshes = {
        index: joined([made(drawing, notes) for drawing in parts if drawing])
        for index, parts in drawings.items()
    }
    return joined([placed(meshes[index], matrix) for index, matrix in drawn])


def _check_asset(document):
    """Return whether quantized attributes are allowed; raise a Mistake for what is not read."""
    asset = child(document, "asset", "the file")
    for key in ("version", "minVersion"):
        version = asset.get(key, "2.0" if key == "minVersion" else None)
        allowed = r"2\.\d+" if key == "version" else r"2\.0"
        if not isinstance(version, str) or not re.fullmatch(allowed, version):
            raise Mistake(f"asset.{key} {shown(asset, key)}; export it as glTF 2.0")
    required = listed(document, "extensionsRequired", "the file", str)
    for extension in required:
        if not _HARMLESS.fullmatch(extension):
            what = f"needs the extension {extension[:60]}, which is not read; export it without"
            raise Mistake(what + " (no compression, no instancing)")
    used = listed(document, "extensionsUsed", "the file", str)
    return "KHR_mesh_quantization" in used + required


def _drawing(primitive, where, accessor, quantized, notes):
    """Return the Drawing of a primitive, or None if it is not of triangles."""
    mode = whole(primitive, "mode", where, 4)
    attributes = child(primitive, "attributes", where)
    if mode > 6:
        raise Mistake(f"{where}: mode is {mode}; write 4, 5 or 6 for triangles")
    if mode < 4 or "POSITION" not in attributes:
        notes.append("points and lines are not drawn" if mode < 4 else "no POSITION: not drawn")
        return None
    if "targets" in primitive:
        notes.append("morph targets are not used")
    found = {
        key: _attribute(attributes, key, where, accessor, quantized)
        for key in _SHAPES
        if key in attributes
    }
    count = len(found["POSITION"].values)
    if any(len(attribute.values) != count for attribute in found.values()):
        raise Mistake(f"{where}: its attributes differ in count; export the file again")
    indices = None
    if "indices" in primitive:
        indices = accessor(whole(primitive, "indices", where))
        if indices.code not in INDEX_CODES or indices.values.shape[1] != 1:
            what = f"{where}: {indices.label} is no list of indices"
            raise Mistake(f"{what}; write SCALAR of 5121, 5123 or 5125")
        count = len(indices.values)
    draco = "KHR_draco_mesh_compression" in child(primitive, "extensions", where)
    if draco and not all(part.stored for part in (*found.values(), indices or found["POSITION"])):
        raise Mistake(f"{where} is compressed by Draco; export the file without compression")
    corners = count - count % 3 if mode == 4 else 3 * max(count - 2, 0)
    return Drawing(where, mode, found, indices, corners)


def _attribute(attributes, key, where, accessor, quantized):
    """Return the Accessor of an attribute if it is of a type that the attribute may have."""
    found = accessor(whole(attributes, key, where))
    width, plain, short = _SHAPES[key]
    allowed = plain + short if quantized else plain
    loose = key == "POSITION" or (key == "TEXCOORD_0" and quantized)  # need not be normalized
    fits = found.code == "<f4" or found.normalized or loose
    if found.values.shape[1] != width or found.code not in allowed or not fits:
        raise Mistake(f"{where}: {found.label} is no {key}; write VEC{width} of floats")
    return found
