"""lumiar.formats.gltf: glTF 2.0 as its specification says, anything less is refused."""

import base64
import json
import struct
import time

import numpy as np
import pytest

from lumiar.errors import Mistake
from lumiar.formats import check, gltf

COMPONENTS = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}
WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
BOX = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
# the vertices of BOX are counted in binary, x first; counter-clockwise seen from outside
BOX_FACES = [
    *([0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]),
    *([2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]),
]


def document(**more):
    """Return a document of one node of one mesh without primitives, and its empty buffer."""
    doc = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": []}],
        "accessors": [],
        "bufferViews": [],
        **more,
    }
    return doc, bytearray()


def view(doc, blob, data, **more):
    """Append bytes to the buffer and return the index of the new bufferView."""
    blob += b"\0" * (-len(blob) % 4)
    doc["bufferViews"].append(
        {"buffer": 0, "byteOffset": len(blob), "byteLength": len(data), **more}
    )
    blob += data
    return len(doc["bufferViews"]) - 1


def accessor(doc, blob, values, code="f", **more):
    """Append (N,) or (N, width) values and return the index of the new accessor."""
    values = np.asarray(values).astype("<" + np.dtype(code).str[1:])
    spec = {
        "bufferView": view(doc, blob, values.tobytes()),
        "componentType": COMPONENTS[code],
        "count": len(values),
        "type": WIDTHS[1 if values.ndim == 1 else values.shape[1]],
        **more,
    }
    doc["accessors"].append(spec)
    return len(doc["accessors"]) - 1


def primitive(doc, blob, positions, indices=None, code="H", mode=None, mesh=0, **attributes):
    """Append a primitive to a mesh and return it."""
    found = {"attributes": {"POSITION": accessor(doc, blob, positions)}}
    for name, values in attributes.items():
        found["attributes"][name] = accessor(doc, blob, values)
    if indices is not None:
        found["indices"] = accessor(doc, blob, np.ravel(indices), code)
    if mode is not None:
        found["mode"] = mode
    doc["meshes"][mesh]["primitives"].append(found)
    return found


def embedded(doc, blob):
    """Return the .gltf file with its buffer in a data: uri."""
    uri = "data:application/octet-stream;base64," + base64.b64encode(blob).decode()
    return json.dumps({**doc, "buffers": [{"byteLength": len(blob), "uri": uri}]}).encode()


def binary(doc, blob, pad=b" ", extra=b""):
    """Return the .glb file."""
    text = json.dumps({"buffers": [{"byteLength": len(blob)}], **doc}).encode()
    text += pad * (-len(text) % 4)
    blob = bytes(blob) + b"\0" * (-len(blob) % 4)
    chunks = struct.pack("<2I", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<2I", len(blob), 0x004E4942) + blob + extra
    return struct.pack("<4s2I", b"glTF", 2, 12 + len(chunks)) + chunks


def load(doc, blob):
    """Return the polygons of the document, read as .glb and as .gltf, which must be the same."""
    read, again = gltf.read(binary(doc, blob), "m.glb"), gltf.read(embedded(doc, blob), "m.gltf")
    assert read.notes == again.notes
    np.testing.assert_array_equal(read.positions, again.positions)
    np.testing.assert_array_equal(read.corners, again.corners)
    return read


def triangles(polygons):
    assert (polygons.sizes == 3).all()
    return polygons.positions[polygons.corners].reshape(-1, 3, 3)


def one(positions=TRIANGLE, indices=None, doc=None, **more):
    """Return the polygons of a document of one primitive."""
    doc, blob = document() if doc is None else doc
    primitive(doc, blob, positions, indices, **more)
    return load(doc, blob)


def box(**node):
    """Return the document and buffer of the box, its node as told."""
    doc, blob = document(nodes=[{"mesh": 0, **node}])
    primitive(doc, blob, BOX, BOX_FACES)
    return doc, blob


def volume(polygons):
    a, b, c = triangles(polygons).transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum() / 6


def test_a_triangle_with_all_that_is_read():
    read = one(NORMAL=[[0, 0, 1]] * 3, TEXCOORD_0=[[0, 0], [1, 0.25], [0.5, 1]], COLOR_0=TRIANGLE)
    assert triangles(read).tolist() == [TRIANGLE]
    assert read.normals[read.normal_of].tolist() == [[0, 0, 1]] * 3
    # glTF has v downwards (3.9.2: the origin is the upper left corner), all else here upwards
    assert read.uvs[read.uv_of].tolist() == [[0, 1], [1, 0.75], [0.5, 0]]
    assert read.notes == ()
    assert read.positions.dtype == np.float64
    assert read.corners.dtype == read.sizes.dtype == np.int64


def test_the_box_is_the_box():
    read = load(*box())
    assert len(read.sizes) == 12
    assert volume(read) == pytest.approx(8)
    assert read.normals is read.normal_of is read.uvs is read.uv_of is None


def test_containers():
    doc, blob = document()
    primitive(doc, blob, TRIANGLE)
    plain = binary(doc, blob)
    third = struct.pack("<2I", 4, 0x12345678) + b"abcd"
    for data, notes in (
        (plain, ()),
        (binary(doc, blob, pad=b"\0"), ()),
        (binary(doc, blob, extra=third), ()),
        (binary(doc, blob, extra=b"\0\0"), ()),
        (plain + b"xyz", ("3 bytes after the end ignored",)),
        (b"\n\t " + embedded(doc, blob), ()),
        (b"\xef\xbb\xbf" + embedded(doc, blob), ("byte-order mark skipped",)),
        (embedded(doc, blob).replace(b"octet-stream;base64", b"gltf-buffer;base64"), ()),
        (embedded(doc, blob).replace(b"application/octet-stream", b""), ()),
    ):
        read = gltf.read(data, "m.glb")
        assert triangles(read).tolist() == [TRIANGLE]
        assert read.notes == notes
    percent = "data:," + "".join(f"%{byte:02x}" for byte in blob)
    doc["buffers"] = [{"byteLength": len(blob), "uri": percent}]
    assert triangles(gltf.read(json.dumps(doc).encode(), "m.gltf")).tolist() == [TRIANGLE]
    doc["buffers"] = [{"byteLength": len(blob), "uri": "a%20b.bin"}]
    asked = []
    read = gltf.read(
        json.dumps(doc).encode(), "m.gltf", lambda path: asked.append(path) or bytes(blob)
    )
    assert triangles(read).tolist() == [TRIANGLE]
    assert asked == ["a b.bin"]


@pytest.mark.parametrize("code", "BHI")
def test_types_of_indices(code):
    doc, blob = document()
    primitive(doc, blob, BOX, BOX_FACES, code)
    assert volume(load(doc, blob)) == pytest.approx(8)


@pytest.mark.parametrize("code", "bBhH")
@pytest.mark.parametrize("normalized", [False, True])
def test_quantized_attributes(code, normalized):
    """KHR_mesh_quantization: c / 127 and so on where normalized (glTF 2.0, 3.6.2.2), else c."""
    info = np.iinfo(code)
    stored = [[info.min, 0, 0], [info.max, 0, 1], [0, info.max, 2]]
    doc, blob = document(extensionsUsed=["KHR_mesh_quantization"])
    doc["extensionsRequired"] = doc["extensionsUsed"]
    padded = np.zeros((3, 4), code)
    padded[:, :3] = stored
    at = accessor(doc, blob, padded, code, normalized=normalized, type="VEC3")
    doc["bufferViews"][-1]["byteStride"] = padded.itemsize * 4
    doc["meshes"][0]["primitives"] = [{"attributes": {"POSITION": at}}]
    expected = np.array(stored, float)
    if normalized:
        expected = np.maximum(expected / info.max, -1)
    np.testing.assert_array_equal(triangles(load(doc, blob))[0], expected)
    del doc["extensionsRequired"], doc["extensionsUsed"]
    assert "POSITION" in refused(binary(doc, blob))


@pytest.mark.parametrize(("code", "largest"), [("B", 255), ("H", 65535)])
def test_whole_texture_coordinates_are_normalized(code, largest):
    doc, blob = document()
    found = primitive(doc, blob, TRIANGLE)
    at = accessor(doc, blob, [[0, 0], [largest, 0], [0, largest]], code, normalized=True)
    found["attributes"]["TEXCOORD_0"] = at
    read = load(doc, blob)
    assert read.uvs[read.uv_of].tolist() == [[0, 1], [1, 1], [0, 0]]
    del doc["accessors"][at]["normalized"]
    assert "TEXCOORD_0" in refused(binary(doc, blob))


def test_interleaved_and_offset_values():
    doc, blob = document()
    rows = np.zeros((3, 9), "<f4")
    rows[:, 1:4], rows[:, 4:7], rows[:, 7:9] = TRIANGLE, [0, 0, 1], [0.5, 0.25]
    both = view(doc, blob, b"pad!" + rows.tobytes(), byteStride=36)
    attributes = {}
    for name, start, kind in (
        ("POSITION", 8, "VEC3"),
        ("NORMAL", 20, "VEC3"),
        ("TEXCOORD_0", 32, "VEC2"),
    ):
        spec = {"bufferView": both, "byteOffset": start, "componentType": 5126, "count": 3}
        doc["accessors"].append({**spec, "type": kind})
        attributes[name] = len(doc["accessors"]) - 1
    doc["meshes"][0]["primitives"] = [{"attributes": attributes}]
    read = load(doc, blob)  # the last row ends exactly at the end of the view
    assert triangles(read).tolist() == [TRIANGLE]
    assert read.normals.tolist() == [[0, 0, 1]] * 3
    assert read.uvs.tolist() == [[0.5, 0.75]] * 3
    doc["bufferViews"][both]["byteLength"] -= 1
    refused(binary(doc, blob))


def sparse(doc, blob, index, at, values, code="f", at_code="H"):
    """Make accessor `index` sparse: the rows `at` are replaced."""
    values = np.asarray(values).astype(code)
    doc["accessors"][index]["sparse"] = {
        "count": len(at),
        "indices": {"bufferView": view(doc, blob, np.array(at, at_code).tobytes()),
                    "componentType": COMPONENTS[at_code]},
        "values": {"bufferView": view(doc, blob, values.tobytes())},
    }  # fmt: skip


@pytest.mark.parametrize("at_code", "BHI")
@pytest.mark.parametrize("unused", [0, 40])
def test_sparse_accessors(at_code, unused):
    doc, blob = document()
    positions = [[9, 9, 9]] * 4 + [[0, 0, 1]] * unused
    found = primitive(
        doc,
        blob,
        positions,
        [0, 1, 3, 3, 1, 0],
        NORMAL=positions,
        TEXCOORD_0=[[0, 1]] * len(positions),
    )
    for name, values in (
        ("POSITION", [TRIANGLE[1], TRIANGLE[2]]),
        ("NORMAL", [[1, 0, 0], [0, 1, 0]]),
        ("TEXCOORD_0", [[1, 1], [2, 1]]),
    ):
        sparse(doc, blob, found["attributes"][name], [1, 3], values, at_code=at_code)
    sparse(doc, blob, found["indices"], [0, 5], [3, 1], "H", at_code)  # 3 1 3 3 1 1
    read = load(doc, blob)
    a, b = TRIANGLE[1:]
    assert triangles(read).tolist() == [[b, a, b], [b, a, a]]
    assert read.normals[read.normal_of, :2].tolist() == [
        [0, 1],
        [1, 0],
        [0, 1],
        [0, 1],
        [1, 0],
        [1, 0],
    ]
    assert read.uvs[read.uv_of, 0].tolist() == [2, 1, 2, 2, 1, 1]


def test_accessors_without_a_view_are_zeros():
    doc, blob = document()
    found = primitive(doc, blob, TRIANGLE, NORMAL=TRIANGLE)
    zeros = doc["accessors"][found["attributes"]["POSITION"]]
    del zeros["bufferView"]
    assert triangles(load(doc, blob)).tolist() == [[[0, 0, 0]] * 3]
    sparse(doc, blob, found["attributes"]["POSITION"], [1, 2], TRIANGLE[1:])
    assert triangles(load(doc, blob)).tolist() == [TRIANGLE]


@pytest.mark.parametrize("indexed", [False, True])
@pytest.mark.parametrize(
    ("mode", "expected"),
    [  # glTF 2.0, 3.7.2.1
        (None, [[0, 1, 2], [3, 4, 5]]),
        (4, [[0, 1, 2], [3, 4, 5]]),
        (5, [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]]),
        (6, [[1, 2, 0], [2, 3, 0], [3, 4, 0], [4, 5, 0]]),
    ],
)
def test_triangles_strips_and_fans(mode, expected, indexed):
    positions = [[i, i * i, 0] for i in range(6)]
    indices = [5, 4, 3, 2, 1, 0] if indexed else None
    read = one(positions[::-1] if indexed else positions, indices, mode=mode)
    assert triangles(read)[:, :, 0].tolist() == expected


def test_points_lines_and_leftovers_are_noted():
    doc, blob = document()
    primitive(doc, blob, TRIANGLE)
    for mode in range(4):
        primitive(doc, blob, TRIANGLE, mode=mode)
    primitive(doc, blob, [*TRIANGLE, *TRIANGLE[:2]])
    primitive(doc, blob, TRIANGLE[:2])
    primitive(doc, blob, TRIANGLE[:2], mode=5)
    doc["meshes"][0]["primitives"].append({"attributes": {}})
    read = load(doc, blob)
    assert triangles(read).tolist() == [TRIANGLE] * 2
    assert set(read.notes) == {
        "points and lines are not drawn",
        "indices after the last whole triangle ignored",
        "no POSITION: not drawn",
    }


HALF = 0.5**0.5  # the sine and cosine of 45 degrees


@pytest.mark.parametrize(
    ("node", "x", "y", "z", "origin"),
    [  # where the node takes the axes and the origin
        ({}, [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]),
        ({"translation": [1, 2, 3]}, [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 2, 3]),
        ({"scale": [2, 3, 4]}, [2, 0, 0], [0, 3, 0], [0, 0, 4], [0, 0, 0]),
        ({"rotation": [0, 0, HALF, HALF]}, [0, 1, 0], [-1, 0, 0], [0, 0, 1], [0, 0, 0]),
        ({"rotation": [HALF, 0, 0, HALF]}, [1, 0, 0], [0, 0, 1], [0, -1, 0], [0, 0, 0]),
        ({"rotation": [0, HALF, 0, HALF]}, [0, 0, -1], [0, 1, 0], [1, 0, 0], [0, 0, 0]),
        ({"rotation": [0, 0, 7, 7]}, [0, 1, 0], [-1, 0, 0], [0, 0, 1], [0, 0, 0]),
        ({"rotation": [0.5, 0.5, 0.5, 0.5]}, [0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 0, 0]),
        (
            {"translation": [1, 0, 0], "rotation": [0, 0, HALF, HALF], "scale": [2, 3, 1]},
            *([0, 2, 0], [-3, 0, 0], [0, 0, 1], [1, 0, 0]),
        ),
        (
            {"matrix": [0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1]},
            *([0, 2, 0], [-3, 0, 0], [0, 0, 1], [1, 0, 0]),
        ),
        ({"scale": [1, 1, 0]}, [1, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 0]),
        ({"scale": [-1, 1, 1]}, [-1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]),
        ({"scale": [-1, -1, -1]}, [-1, 0, 0], [0, -1, 0], [0, 0, -1], [0, 0, 0]),
    ],
)
def test_a_node_places_its_mesh(node, x, y, z, origin):
    read = load(*box(**node))
    frame = np.array([x, y, z], float)
    expected = np.array(BOX) @ frame + origin
    found = np.unique(np.round(read.positions, 12) + 0.0, axis=0)
    np.testing.assert_allclose(found, np.unique(np.round(expected, 12) + 0.0, axis=0), atol=1e-12)
    # outside stays outside, also where it is mirrored (3.7.4)
    assert volume(read) == pytest.approx(8 * abs(np.linalg.det(frame)))


@pytest.mark.parametrize(
    "scale", [[1, 1, 1], [1, 2, 5], [-1, 2, 5], [1e-5, -1e-5, 1e-5], [1e9, 1e9, 1e8]]
)
def test_normals_stay_perpendicular_and_outside(scale):
    doc, blob = document(
        nodes=[
            {"scale": scale, "rotation": [1, 2, 3, 4], "children": [1]},
            {"mesh": 0, "rotation": [4, 3, -2, 1]},
        ]
    )
    flat = np.array(BOX, float)[np.array(BOX_FACES)]
    normals = np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]) / 4
    tips = flat.reshape(-1, 3) * [1, 0.5, 0.25] + 3  # nowhere special
    primitive(doc, blob, tips, NORMAL=np.repeat(normals / [1, 0.5, 0.25], 3, axis=0))
    read = load(doc, blob)
    a, b, c = triangles(read).transpose(1, 0, 2)
    true = np.cross(b - a, c - a)
    true /= np.linalg.norm(true, axis=1, keepdims=True)
    given = read.normals[read.normal_of].reshape(-1, 3, 3)
    given = given / np.linalg.norm(given, axis=2, keepdims=True)
    np.testing.assert_allclose(given, np.repeat(true[:, None], 3, axis=1), atol=1e-6)


def test_a_mesh_may_be_placed_many_times_and_deep():
    nodes = [
        {"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "scale": [2, 2, 2]},
        {"children": [3], "translation": [0, 10, 0]},
        {"mesh": 1},
        {"mesh": 0},
        {"mesh": 1},
    ]
    doc, blob = document(nodes=nodes, meshes=[{"primitives": []}, {"primitives": []}])
    doc["scenes"] = [{"nodes": [4]}, {"nodes": [0, 5]}, {}]
    primitive(doc, blob, TRIANGLE)
    primitive(doc, blob, TRIANGLE, mesh=1, NORMAL=[[0, 0, 1]] * 3)
    primitive(doc, blob, TRIANGLE, mesh=1)
    moved = (np.array(TRIANGLE) * 2 + [10, 0, 0], np.add(TRIANGLE, [10, 10, 0]))
    doc["scene"] = 1
    read = load(doc, blob)
    expected = [moved[0], TRIANGLE, TRIANGLE, moved[1], moved[1]]
    np.testing.assert_array_equal(np.sort(triangles(read), axis=0), np.sort(expected, axis=0))
    with_normal = (read.normal_of.reshape(-1, 3) >= 0).all(axis=1)
    assert with_normal.sum() == 2
    assert (read.normals[read.normal_of][np.repeat(with_normal, 3)] == [0, 0, 1]).all()
    del doc["scene"]  # the first
    assert triangles(load(doc, blob)).tolist() == [TRIANGLE]
    del doc["scenes"]  # all nodes without a parent
    assert len(load(doc, blob).sizes) == 6
    doc["scenes"], doc["scene"] = [{"nodes": [4]}, {}], 1
    assert "no faces" in refused(binary(doc, blob))


def test_a_chain_of_5000_nodes_ends_within_two_seconds():
    count = 5000
    nodes = [{"translation": [1, 0, 0], "children": [i + 1]} for i in range(count)]
    doc, blob = document(nodes=[*nodes, {"mesh": 0}])
    primitive(doc, blob, TRIANGLE)
    data = binary(doc, blob)
    began = time.process_time()
    read = gltf.read(data, "m.glb")
    assert time.process_time() - began < 2
    assert triangles(read).tolist() == [[[count, 0, 0], [count + 1, 0, 0], [count, 1, 0]]]


def test_many_primitives_of_one_long_accessor_are_read_fast():
    doc, blob = document()
    found = primitive(doc, blob, np.tile(TRIANGLE, (50_000, 1)), [0, 1, 2])
    doc["meshes"][0]["primitives"] = [found] * 2000
    data = binary(doc, blob)
    began = time.process_time()
    read = gltf.read(data, "m.glb")
    assert len(read.sizes) == 2000
    assert len(read.positions) == 6000  # the unused ones are left out
    assert time.process_time() - began < 2


def test_what_is_not_used_is_noted():
    doc, blob = document(nodes=[{"mesh": 0, "skin": 0}], skins=[{"joints": [0]}])
    doc["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {}}
    found = primitive(doc, blob, TRIANGLE)
    found["targets"] = [{"POSITION": 0}]
    found["extensions"] = {"KHR_materials_variants": {"mappings": []}}
    doc["meshes"][0]["weights"] = [0.5]
    doc["animations"] = doc["cameras"] = doc["images"] = [{"uri": "https://example.org/x.png"}]
    doc["extensionsUsed"] = ["KHR_draco_mesh_compression", "X_unknown"]
    doc["extensionsRequired"] = [
        "KHR_materials_unlit", "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp",
        "KHR_lights_punctual", "KHR_mesh_quantization", "KHR_materials_variants",
        "KHR_animation_pointer", "KHR_xmp_json_ld",
    ]  # fmt: skip
    read = load(doc, blob)
    assert triangles(read).tolist() == [TRIANGLE]
    assert set(read.notes) == {
        "skeletons are not used: a mesh with a skin is drawn in its bind pose",
        "morph targets are not used",
        "EXT_mesh_gpu_instancing is not read: such a mesh is drawn once",
    }


def test_unused_vertices_may_be_anything():
    doc, blob = document()
    primitive(doc, blob, [*TRIANGLE, [7, 7, 7]], [0, 1, 2, 2, 1, 0], NORMAL=[[7, 7, 7]] * 4)
    signalling = struct.pack("<I", 0x7F800001)  # a NaN that warns where it becomes a float64
    read = load(doc, blob.replace(struct.pack("<f", 7), signalling))
    assert triangles(read).tolist() == [TRIANGLE, TRIANGLE[::-1]]
    assert read.normals is None
    assert read.notes == ("1 unused vertices are not finite", "4 normals are not finite: left out")
    read = one([*TRIANGLE, [np.nan, 0, 0], [0, np.inf, 0]], [0, 1, 2, 2, 1, 0])
    assert np.isfinite(read.positions).all()
    assert read.notes == ("2 unused vertices are not finite",)
    read = one(TRIANGLE, NORMAL=[[0, 0, 1], [np.nan, 0, 0], [0, 0, 1]])
    assert read.normal_of.tolist() == [0, -1, 2]
    assert read.notes == ("1 normals are not finite: left out",)


def refused(data, name="m.glb", line=None, fetch=None):
    with pytest.raises(Mistake) as refusal:
        gltf.read(data, name, fetch)
    message = str(refusal.value)
    assert message.startswith(f"{name}:{line}: " if line else f"{name}: "), message
    assert message.isprintable()
    assert len(message) <= 300
    return message


def rich():
    """Return a document in which all that can be wrong is there, and its buffer."""
    doc, blob = document(
        nodes=[{"mesh": 0, "children": [1]}, {"mesh": 0, "translation": [0, 0, 1]}]
    )
    primitive(doc, blob, TRIANGLE, [0, 1, 2], NORMAL=TRIANGLE, TEXCOORD_0=[[0, 0]] * 3)
    sparse(doc, blob, 0, [1, 2], TRIANGLE[1:])
    return doc, blob


def test_the_rich_document_is_valid():
    assert len(load(*rich()).sizes) == 2


WRONG = [  # where in the rich document, what stands there instead, and words of the refusal
    ("asset", None, "asset.version"),
    ("asset", [], "asset"),
    ("asset version", None, "glTF 2.0"),
    ("asset version", "1.0", "1.0"),
    ("asset version", "3.0", "3.0"),
    ("asset version", 2.0, "2.0"),
    ("asset minVersion", "2.1", "2.1"),
    ("asset minVersion", [], "minVersion"),
    ("asset version", [[[[]]]], "version"),
    ("extensionsRequired", ["KHR_draco_mesh_compression"], "KHR_draco_mesh_compression"),
    ("extensionsRequired", ["EXT_meshopt_compression"], "EXT_meshopt_compression"),
    ("extensionsRequired", ["EXT_mesh_gpu_instancing"], "EXT_mesh_gpu_instancing"),
    ("extensionsRequired", ["X_unknown"], "X_unknown"),
    ("extensionsRequired", "KHR_materials_unlit", "extensionsRequired"),
    ("extensionsRequired", [1], "extensionsRequired"),
    ("extensionsUsed", {}, "extensionsUsed"),
    ("scene", 1, "scenes 1"),
    ("scene", -1, "scene is -1"),
    ("scene", "0", 'scene is "0"'),
    ("scene", 0.0, "scene is 0.0"),
    ("scene", True, "scene is true"),
    ("scene", 0, "scenes 0", "scenes", []),
    ("scenes", {}, "scenes"),
    ("scenes", None, "scenes 0"),
    ("scenes 0", 5, "scenes"),
    ("scenes 0 nodes", [2], "nodes 2"),
    ("scenes 0 nodes", [-1], "nodes -1"),
    ("scenes 0 nodes", ["0"], "nodes"),
    ("scenes 0 nodes", [0, 0], "twice"),
    ("scenes 0 nodes", [1], "node 1"),
    ("scenes 0 nodes", 0, "nodes is 0"),
    ("nodes", None, "nodes 0"),
    ("nodes", {"0": {}}, "nodes"),
    ("nodes 0", [], "nodes"),
    ("nodes 0 children", [0], "node 0"),
    ("nodes 0 children", [1, 1], "node 1"),
    ("nodes 0 children", [2], "nodes 2"),
    ("nodes 0 children", [True], "children"),
    ("nodes 1 children", [0], "node 0"),
    ("nodes 1 children", [1], "node 1"),
    ("nodes 0 mesh", 1, "meshes 1"),
    ("nodes 0 mesh", -1, "mesh is -1"),
    ("nodes 0 mesh", [0], "mesh is a list"),
    ("nodes 1 translation", [0, 0], "2"),
    ("nodes 1 translation", [0, 0, "1"], "translation"),
    ("nodes 1 translation", [0, 0, float("inf")], "JSON"),
    ("nodes 1 translation", [0, 0, None], "translation"),
    ("nodes 1 translation", [0, 0, 10**400], "translation"),
    ("nodes 1 translation", [0, 0, 1e299], "vertex"),
    ("nodes 1 translation", "up", 'translation is "up"'),
    ("nodes 1 scale", [1, 1], "scale"),
    ("nodes 1 scale", [1e250, 1, 1], "vertex", "nodes 0 scale", [1e250, 1, 1]),
    ("nodes 1 rotation", [0, 0, 0, 0], "quaternion"),
    ("nodes 1 rotation", [0, 0, 0], "rotation"),
    ("nodes 1 matrix", [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "matrix and"),
    ("nodes 0 matrix", [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0], "matrix"),
    ("nodes 0 matrix", [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2], "last row"),
    ("nodes 0 matrix", [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "last row"),
    ("meshes", None, "meshes 0"),
    ("meshes 0", "box", "meshes 0"),
    ("meshes 0 primitives", {}, "primitives"),
    ("meshes 0 primitives", [[]], "primitives"),
    ("meshes 0 primitives", [], "no faces"),
    ("meshes 0 primitives 0 mode", 7, "mode is 7"),
    ("meshes 0 primitives 0 mode", "4", "mode"),
    ("meshes 0 primitives 0 mode", 0, "no faces"),
    ("meshes 0 primitives 0 attributes", [], "attributes"),
    ("meshes 0 primitives 0 attributes", {}, "no faces"),
    ("meshes 0 primitives 0 attributes POSITION", 9, "accessors 9"),
    ("meshes 0 primitives 0 attributes POSITION", "0", "POSITION"),
    ("meshes 0 primitives 0 attributes POSITION", 2, "POSITION"),
    ("meshes 0 primitives 0 attributes NORMAL", 2, "NORMAL"),
    ("meshes 0 primitives 0 attributes TEXCOORD_0", 1, "TEXCOORD_0"),
    ("meshes 0 primitives 0 attributes TEXCOORD_0", 3, "TEXCOORD_0"),
    ("meshes 0 primitives 0 indices", 9, "accessors 9"),
    ("meshes 0 primitives 0 indices", 0, "accessor 0"),
    ("meshes 0 primitives 0 indices", 1.5, "indices is 1.5"),
    ("accessors", {}, "accessors"),
    ("accessors 0", None, "accessors 0"),
    ("accessors 0 componentType", None, "componentType is missing"),
    ("accessors 0 componentType", 5124, "5124"),
    ("accessors 0 componentType", 5125, "POSITION"),
    ("accessors 0 componentType", "5126", "componentType"),
    ("accessors 0 type", None, "type is missing"),
    ("accessors 0 type", "VEC2", "POSITION"),
    ("accessors 0 type", "VEC5", "VEC5"),
    ("accessors 0 type", "MAT4", "MAT4"),
    ("accessors 0 type", ["VEC3"], "type"),
    ("accessors 0 count", None, "count is missing"),
    ("accessors 0 count", 0, "count is 0"),
    ("accessors 0 count", -3, "count is -3"),
    ("accessors 0 count", 2, "sparse"),
    ("accessors 0 count", 4, "accessor 0"),
    ("accessors 0 count", 4_000_000_000, "4000000000"),
    ("accessors 0 count", 10**30, "count"),
    ("accessors 1 count", 2, "differ in count"),
    ("accessors 0 normalized", 1, "normalized"),
    ("accessors 0 byteOffset", 4, "accessor 0"),
    ("accessors 0 byteOffset", -4, "byteOffset"),
    ("accessors 0 byteOffset", 2**53, "accessor 0"),
    ("accessors 0 bufferView", 99, "bufferViews 99"),
    ("accessors 0 bufferView", "0", "bufferView"),
    ("accessors 3 componentType", 5120, "accessor 3"),
    ("accessors 3 componentType", 5126, "accessor 3"),
    ("accessors 3 type", "VEC3", "accessor 3"),
    ("accessors 3 type", "VEC2", "accessor 3"),
    ("accessors 0 sparse", [], "sparse"),
    ("accessors 0 sparse count", 0, "count is 0"),
    ("accessors 0 sparse count", 4, "count is 4"),
    ("accessors 0 sparse count", 3, "sparse"),
    ("accessors 0 sparse indices", None, "sparse"),
    ("accessors 0 sparse values", None, "sparse"),
    ("accessors 0 sparse values bufferView", None, "bufferView is missing"),
    ("accessors 0 sparse values byteOffset", 4, "sparse"),
    ("accessors 0 sparse indices componentType", 5126, "5125"),
    ("accessors 0 sparse indices componentType", 7, "5125"),
    ("accessors 0 sparse indices componentType", 5121, "sort them"),
    ("bufferViews 0", [], "bufferViews 0"),
    ("bufferViews 0 buffer", 1, "buffers 1"),
    ("bufferViews 0 buffer", None, "buffer is missing"),
    ("bufferViews 0 byteLength", None, "byteLength is missing"),
    ("bufferViews 0 byteLength", 35, "accessor 0"),
    ("bufferViews 0 byteLength", 100_000, "bufferView 0"),
    ("bufferViews 0 byteOffset", 100_000, "bufferView 0"),
    ("bufferViews 0 byteOffset", -1, "byteOffset is -1"),
    ("bufferViews 0 byteStride", 8, "byteStride is 8"),
    ("bufferViews 0 byteStride", 16, "accessor 0"),
    ("bufferViews 0 byteStride", 256, "byteStride is 256"),
    ("bufferViews 0 byteStride", 2**53, "byteStride is"),
    ("bufferViews 0 byteStride", 0, "byteStride is 0"),
    ("bufferViews 0 buffer", 1, "without compression", "buffers 1", {"byteLength": 99}),
    ("buffers", {}, "buffers 0"),
    ("buffers 0", "x", "buffers 0"),
    ("buffers 0 byteLength", 100_000, "100000"),
    ("buffers 0 byteLength", None, "byteLength"),
    ("buffers 0 byteLength", 4, "bufferView"),
    ("buffers 0 uri", 5, "uri is 5"),
    ("buffers 0 uri", {}, "uri is an object"),
    ("buffers 0 uri", "", "''"),
    ("buffers 0 uri", "data:application/octet-stream;base64,@@@@", "data: uri"),
    ("buffers 0 uri", "data:application/octet-stream;base64,AAA", "data: uri"),
    ("buffers 0 uri", "data:application/octet-stream;base64", "data: uri"),
    ("buffers 0 uri", "data:application/octet-stream;base64,\u00e9AAA", "data: uri"),
    ("buffers 0 uri", "data:application/octet-stream;base64,AAAA", "3 bytes"),
    ("buffers 0 uri", "other.bin", "other.bin"),
    ("buffers 0 uri", "http://example.org/x.bin", "uri"),
    ("buffers 0 uri", "file:///etc/passwd", "uri"),
    ("buffers 0 uri", "C:/x.bin", "uri"),
    ("buffers 0 uri", "/etc/passwd", "uri"),
    ("buffers 0 uri", "//host/x.bin", "uri"),
    ("buffers 0 uri", "../x.bin", "uri"),
    ("buffers 0 uri", "a/../../x.bin", "uri"),
    ("buffers 0 uri", "%2e%2e/x.bin", "uri"),
    ("buffers 0 uri", "%2Fetc/passwd", "uri"),
    ("buffers 0 uri", "a%5Cb.bin", "uri"),
    ("buffers 0 uri", "..\\x.bin", "uri"),
    ("buffers 0 uri", "a%00b.bin", "uri"),
    ("buffers 0 uri", "a\nb.bin", "uri"),
]


@pytest.mark.parametrize("case", WRONG, ids=lambda case: f"{case[0]}={str(case[1])[:30]}")
def test_a_malformed_document_is_refused(case):
    place, value, words, *more = case
    doc, blob = rich()
    put(doc, blob, place, value)
    if more:
        put(doc, blob, *more)
    assert words in refused(binary(doc, blob))


def put(doc, blob, path, value):
    """Replace what stands at `path`, or take it away for None, or for a list's entry put null."""
    doc.setdefault("buffers", [{"byteLength": len(blob)}])
    *above, last = [int(step) if step.isdigit() else step for step in path.split()]
    for step in above:
        doc = doc[step]
    if isinstance(doc, list) and last == len(doc):
        doc.append(value)
    elif value is None and isinstance(doc, dict):
        del doc[last]
    else:
        doc[last] = value


def of(positions=TRIANGLE, indices=None, code="H", **more):
    doc, blob = document()
    primitive(doc, blob, positions, indices, code, **more)
    return binary(doc, blob)


def draco(stored):
    """Return a primitive that is also there as Draco, with or without its plain values."""
    doc, blob = document()
    found = primitive(doc, blob, TRIANGLE)
    found["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}}
    if not stored:
        del doc["accessors"][0]["bufferView"]
    return binary(doc, blob)


def test_draco_beside_plain_values_is_passed_over():
    assert triangles(gltf.read(draco(stored=True), "m.glb")).tolist() == [TRIANGLE]


GLB = of()


@pytest.mark.parametrize(
    ("words", "data"),
    [
        ("Draco", draco(stored=False)),
        ("index 3", of(indices=[0, 1, 3])),
        ("accessor 1", of(indices=[0, 1, 3])),
        ("number 2", of(indices=[0, 1, 3])),
        ("restart", of(indices=[0, 1, 255], code="B")),
        ("restart", of(indices=[0, 1, 65535])),
        ("restart", of(indices=[0, 1, 2**32 - 1], code="I")),
        ("restart", of(positions=TRIANGLE * 100, indices=[0, 1, 255], code="B")),
        ("index 4294967294", of(indices=[0, 1, 2**32 - 2], code="I")),
        ("vertex 1 of accessor 0", of([TRIANGLE[0], [np.nan, 0, 0], TRIANGLE[2]])),
        ("vertex 1 of accessor 0", of([TRIANGLE[0], [0, np.inf, 0], TRIANGLE[2]])),
        ("vertex 4 of accessor 0", of([*TRIANGLE, [0, 0, 0], [0, 2e18, 0]], [0, 1, 4])),
        ("VEC3", of([[0, 0], [1, 0], [0, 1]])),
        ("differ in count", of(NORMAL=TRIANGLE[:2])),
        ("no faces", of(mode=1)),
        ("no faces", of(TRIANGLE[:2])),
        ("cut off", GLB[:-1]),
        ("cut off", GLB[:-40]),
        ("cut off", GLB[:25]),
        ("cut off", GLB[:19]),
        ("cut off", b"glTF"),
        ("version 1", GLB.replace(b"glTF\2", b"glTF\1")),
        ("byte 16", GLB.replace(b"JSON", b"BIN\0")),
        ("cut off", GLB[:12] + b"\xff\xff\xff\xff" + GLB[16:]),
        ("cut off", GLB[:8] + b"\xff\xff\xff\xff" + GLB[12:]),
        ("cut off", GLB.replace(b"\x24\0\0\0BIN\0", b"\x25\0\0\0BIN\0")),
        ("no uri", GLB.replace(b"BIN\0", b"XYZ\0")),
        ("JSON chunk, line 1", GLB.replace(b'"asset"', b"'asset'")),
        ("JSON chunk, line 1", GLB.replace(b'"asset"', b'"ass\xffet')),
    ],
)  # fmt: skip
def test_malformed_bytes_are_refused(words, data):
    assert words in refused(data)


LINES = json.dumps({**rich()[0], "buffers": [{"byteLength": 4}]}, indent=1).encode()


@pytest.mark.parametrize(
    ("line", "data"),
    [
        (3, LINES.replace(b'"version": "2.0"', b'"version": "2.0",,')),
        (3, LINES.replace(b'"version": "2.0"', b"'version': '2.0'")),
        (3, LINES.replace(b'"version": "2.0"', b'"version": NaN')),
        (3, LINES.replace(b'"version": "2.0"', b'"version": -Infinity')),
        (3, LINES.replace(b'"version": "2.0"', b'"version": ' + b"1" * 5000)),
        (3, LINES.replace(b'"version": "2.0"', b'"version": "\xff"')),
        (3, LINES.replace(b'"version": "2.0"', b'"version": "\t"')),
        (3, LINES.replace(b'"version": "2.0"', b'"version": // 2')),
        (3, b"\xef\xbb\xbf" + LINES.replace(b'"version": "2.0"', "é".encode())),
        (1, b"[]"),
        (1, b'"x"'),
        (1, b"null"),
        (1, b"1"),
        (1, b"{"),
        (1, b"glTX" + GLB[4:]),
        (1, b"\0\0\0"),
        (1, b"#!/bin/sh"),
        (1, b"[" * 100_000),
        (1, b'{"a":' * 100_000),
        (None, LINES.replace(b'"version": "2.0"', b'"version": "2.0", "version": "2.0"')),
        (None, LINES),
        (None, b"{}"),
    ],
)  # fmt: skip
def test_malformed_json_is_refused_at_its_line(line, data):
    refused(data, "m.gltf", line)


def test_a_file_beside_this_one_that_is_missing_is_named():
    doc, blob = document()
    primitive(doc, blob, TRIANGLE)
    doc["buffers"] = [{"byteLength": len(blob), "uri": "a%20b.bin"}]
    data = json.dumps(doc).encode()

    def fetch(path):
        raise check.mistake(path, "cannot be read")

    assert "buffer 0: a b.bin: cannot be read" in refused(data, "m.gltf", fetch=fetch)
    assert "36" in refused(data, "m.gltf", fetch=lambda path: b"short")


def bombs():
    """Yield small files that would take much time or memory, and words of their refusal."""
    doc, blob = document()
    primitive(doc, blob, TRIANGLE * 1000, range(3000))
    doc["meshes"][0]["primitives"] *= 100
    assert len(gltf.read(binary(doc, blob), "m.glb").sizes) == 100_000
    doc["nodes"] = [{"mesh": 0}] * 200
    doc["scenes"] = [{"nodes": list(range(200))}]
    yield "face corners", binary(doc, blob)
    doc, blob = document()
    primitive(doc, blob, TRIANGLE * 1000)
    doc["meshes"][0]["primitives"] *= 20_000
    yield "face corners", binary(doc, blob)

    for count in (1 << 21, 10**9):
        doc, blob = document()
        primitive(doc, blob, TRIANGLE)
        del doc["accessors"][0]["bufferView"]
        doc["accessors"][0]["count"] = count
        yield "count", binary(doc, blob)
    doc, blob = document()
    primitive(doc, blob, TRIANGLE)
    doc["accessors"][0]["count"] = 40_000_000
    yield "accessor 0", binary(doc, blob)

    # many accessors, each with the same long list of replacements
    doc, blob = document()
    found = primitive(doc, blob, np.zeros((200_000, 3)), [0, 1, 2])
    sparse(doc, blob, 0, range(200_000), np.zeros((200_000, 3)), at_code="I")
    doc["meshes"][0]["primitives"] = []
    for i in range(2, 2000):
        doc["accessors"].append(doc["accessors"][0])
        doc["meshes"][0]["primitives"].append({**found, "attributes": {"POSITION": i}})
    yield "values replaced", binary(doc, blob)

    yield "64", b"{" + b" " * (65 << 20) + b"}"
    yield "JSON objects", b"[" + b"{}," * 3_000_000 + b"{}]"


def test_bombs_are_refused_in_time_and_memory():
    for words, data in bombs():
        began = time.process_time()
        assert words in refused(data)
        assert time.process_time() - began < 8, words
