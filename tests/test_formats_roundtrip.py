"""All readers: what is written is read back, trimesh reads the same, and no damage ever escapes."""

import io
import json
import struct

import numpy as np
import pytest
import trimesh
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lumiar.errors import Mistake
from lumiar.formats import gltf, obj, off, ply, stl

quick = settings(
    max_examples=60,
    deadline=None,
    database=None,
    derandomize=True,
    suppress_health_check=HealthCheck,
)


def lines(*rows):
    return "\n".join(" ".join(map(str, row)) for row in rows).encode() + b"\n"


def write_obj(positions, polygons):
    return lines(*(("v", *p) for p in positions), *(("f", *(i + 1 for i in f)) for f in polygons))


def write_obj_backwards(positions, polygons):
    """Negative indices, and every second polygon before the vertices."""
    early, late = polygons[::2], polygons[1::2]
    rows = [("f", *(i + 1 for i in f)) for f in early] + [("v", *p) for p in positions]
    return lines(*rows, *(("f", *(i - len(positions) for i in f)) for f in late))


def write_off(positions, polygons):
    counts = (len(positions), len(polygons), 0)
    return lines(("OFF",), counts, *positions, *((len(f), *f) for f in polygons))


def write_ply(positions, polygons, form="ascii", count="uchar", real="double"):
    header = lines(
        *(("ply",), ("format", form, "1.0"), ("element vertex", len(positions))),
        *(("property", real, axis) for axis in "xyz"),
        *(("element face", len(polygons)), ("property list", count, "int vertex_indices")),
        ("end_header",),
    )
    if form == "ascii":
        return header + lines(*positions, *((len(f), *f) for f in polygons))
    order = "<" if form == "binary_little_endian" else ">"
    length, number = {"uchar": "B", "int": "i"}[count], {"double": "d", "float": "f"}[real]
    body = [struct.pack(f"{order}3{number}", *p) for p in positions]
    body += [struct.pack(f"{order}{length}{len(f)}i", len(f), *f) for f in polygons]
    return header + b"".join(body)


def write_ply_little(positions, polygons):
    return write_ply(positions, polygons, "binary_little_endian", "int", "float")


def write_ply_big(positions, polygons):
    return write_ply(positions, polygons, "binary_big_endian")


def write_stl(positions, polygons):
    body = b"".join(
        struct.pack("<12fH", 0, 0, 0, *np.ravel([positions[i] for i in f]), 7) for f in polygons
    )
    return b"solid or not".ljust(80) + struct.pack("<I", len(polygons)) + body


def write_stl_text(positions, polygons):
    rows = [("solid", "x")]
    for face in polygons:
        rows += [("facet normal", 0, 0, 0), ("outer loop",)]
        rows += [("vertex", *positions[i]) for i in face]
        rows += [("endloop",), ("endfacet",)]
    return lines(*rows, ("endsolid",))


def write_glb(positions, polygons):
    indices = np.array(polygons, "<u2").tobytes()
    blob = np.array(positions, "<f4").tobytes() + indices + b"\0" * (-len(indices) % 4)
    view = len(blob) - len(indices) - (-len(indices) % 4)
    scalar = {"componentType": 5123, "count": len(polygons) * 3, "type": "SCALAR"}
    vector = {"componentType": 5126, "count": len(positions), "type": "VEC3"}
    text = json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1]}, {"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}]}],
        "accessors": [{"bufferView": 0, **vector}, {"bufferView": 1, **scalar}],
        "bufferViews": [
            {"buffer": 0, "byteLength": view},
            {"buffer": 0, "byteOffset": view, "byteLength": len(indices)},
        ],
        "buffers": [{"byteLength": len(blob)}],
    }).encode()  # fmt: skip
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<2I", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<2I", len(blob), 0x004E4942) + blob
    return struct.pack("<4s2I", b"glTF", 2, 12 + len(chunks)) + chunks


FORMATS = {  # name: writer, reader, the longest polygon, float32?
    "obj": (write_obj, obj.read, 6, False),
    "backwards.obj": (write_obj_backwards, obj.read, 6, False),
    "off": (write_off, off.read, 6, False),
    "ply": (write_ply, ply.read, 6, False),
    "little.ply": (write_ply_little, ply.read, 6, True),
    "big.ply": (write_ply_big, ply.read, 6, False),
    "stl": (write_stl, stl.read, 3, True),
    "text.stl": (write_stl_text, stl.read, 3, False),
    "glb": (write_glb, gltf.read, 3, True),
}


@st.composite
def meshes(draw, longest, single):
    """Draw (positions, polygons) with some vertices that may be unused or doubled."""
    number = st.floats(-(2.0**59), 2.0**59, width=32 if single else 64)
    positions = draw(st.lists(st.tuples(number, number, number), min_size=1, max_size=8))
    index = st.integers(0, len(positions) - 1)
    polygon = st.lists(index, min_size=3, max_size=longest)
    return positions, draw(st.lists(polygon, min_size=1, max_size=8))


def check_promises(polygons):
    """Check what the Polygons of any reader promise."""
    assert len(polygons.corners) == polygons.sizes.sum()
    assert polygons.sizes.min() >= 3
    assert np.isfinite(polygons.positions).all()
    assert np.abs(polygons.positions[polygons.corners]).max() <= 1e18
    assert polygons.corners.min() >= 0
    assert polygons.corners.max() < len(polygons.positions)
    for values, index, width in (
        (polygons.positions, polygons.corners, 3),
        (polygons.normals, polygons.normal_of, 3),
        (polygons.uvs, polygons.uv_of, 2),
    ):
        if values is None:
            assert index is None
            continue
        assert values.dtype == np.float64
        assert index.dtype == polygons.sizes.dtype == np.int64
        assert values.shape == (len(values), width)
        assert index.shape == polygons.corners.shape
        assert index.min() >= -1
        assert index.max() < len(values)
        assert np.isfinite(values[index[index >= 0]]).all()


@pytest.mark.parametrize("name", FORMATS)
@given(data=st.data())
@quick
def test_what_is_written_is_read(name, data):
    write, read, longest, single = FORMATS[name]
    positions, polygons = data.draw(meshes(longest, single))
    found = read(write(positions, polygons), name)
    check_promises(found)
    if name == "backwards.obj":
        polygons = polygons[::2] + polygons[1::2]
    assert found.sizes.tolist() == [len(polygon) for polygon in polygons]
    expected = [positions[i] for polygon in polygons for i in polygon]
    np.testing.assert_array_equal(found.positions[found.corners], expected)
    assert found.notes == ()


CUBE = [[x, y, z] for x in (-1.5, 1.5) for y in (-1.5, 1.5) for z in (-1.5, 1.5)]
SIDES = [[0, 1, 3], [4, 6, 7], [0, 4, 5], [2, 3, 7], [0, 2, 6], [1, 5, 7]]


TELLING = [
    b"\n",
    b" ",
    b"-",
    b"/",
    b"#",
    b"{",
    b'"',
    b"\\\n",
    b"nan",
    b"1e999",
    b"9" * 30,
    b"\xff" * 4,
]


@pytest.mark.parametrize("name", FORMATS)
@given(data=st.data())
@settings(quick, max_examples=150)
def test_damage_is_read_or_refused_in_one_line(name, data):
    write, read, _, _ = FORMATS[name]
    file = bytearray(write(CUBE, SIDES))
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(file)))
        kind = data.draw(st.sampled_from(["put", "cut", "add", "end", "copy", "swap"]))
        some = data.draw(st.binary(min_size=1, max_size=8) | st.sampled_from(TELLING))
        if kind == "put":
            file[at : at + len(some)] = some
        elif kind == "add":
            file[at:at] = some
        elif kind == "cut":
            del file[at : at + data.draw(st.integers(1, 40))]
        elif kind == "end":
            del file[at:]
        elif kind == "copy":
            file[at:at] = file[data.draw(st.integers(0, len(file))) :][:60]
        else:
            file[at : at + 2] = reversed(file[at : at + 2])
    try:
        check_promises(read(bytes(file), f"some {name}"))
    except Mistake as refusal:
        message = str(refusal)
        assert message.startswith(f"some {name}:")
        assert message.isprintable()
        assert len(message) <= 300


@pytest.mark.parametrize("name", FORMATS)
def test_a_file_cut_off_anywhere_is_read_or_refused(name):
    write, read, _, _ = FORMATS[name]
    file = write(CUBE, SIDES)
    for end in range(len(file)):
        try:
            polygons = read(file[:end], name)
        except Mistake as refusal:
            assert str(refusal).startswith(f"{name}:")
        else:  # an OBJ does not say how long it is, the others miss at most the last line's end
            check_promises(polygons)
            assert "obj" in name or end == len(file) - 1


@given(data=st.binary(max_size=200))
@quick
def test_noise_is_refused_in_one_line(data):
    for head in (b"", b"ply\n", b"solid ", b"OFF\n", b"glTF\2\0\0\0", b"{", b"v 0 0 0\nf "):
        for read in (obj.read, off.read, ply.read, stl.read, gltf.read):
            try:
                check_promises(read(head + data, "noise"))
            except Mistake as refusal:
                assert str(refusal).startswith("noise:")


SHAPES = {
    "box": trimesh.creation.box((1, 2, 3)),
    "ball": trimesh.creation.icosphere(subdivisions=3, radius=2),
    "ring": trimesh.creation.torus(2, 0.5),
    "can": trimesh.creation.capsule(2, 0.5),
}


def triangles(polygons):
    """Return (T, 9), the corners of the triangles of polygons cut as fans, in order."""
    starts = np.cumsum(polygons.sizes) - polygons.sizes
    fans = [
        [s, s + i, s + i + 1]
        for s, n in zip(starts, polygons.sizes, strict=True)
        for i in range(1, n - 1)
    ]
    return polygons.positions[polygons.corners][np.array(fans)].reshape(-1, 9)


def in_order(rows):
    rows = np.round(np.reshape(rows, (-1, 9)), 6) + 0.0
    return rows[np.lexsort(rows.T)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(
    ("form", "options", "read"),
    [
        ("obj", {}, obj.read),
        ("off", {}, off.read),
        ("ply", {"encoding": "ascii"}, ply.read),
        ("ply", {"encoding": "binary"}, ply.read),
        ("stl", {}, stl.read),
        ("stl_ascii", {}, stl.read),
        ("glb", {}, gltf.read),
    ],
)
def test_what_trimesh_writes_is_read(shape, form, options, read):
    mesh = SHAPES[shape]
    data = mesh.export(file_type=form, **options)
    found = read(data.encode() if isinstance(data, str) else data, f"m.{form}")
    check_promises(found)
    assert found.notes == ()
    np.testing.assert_allclose(in_order(triangles(found)), in_order(mesh.triangles), atol=1e-5)


@pytest.mark.parametrize("name", [name for name in FORMATS if name != "backwards.obj"])
def test_trimesh_reads_the_same(name):
    write, read, _, _ = FORMATS[name]
    file = write(CUBE, SIDES)
    theirs = trimesh.load_mesh(io.BytesIO(file), file_type=name.split(".")[-1], process=False)
    ours = triangles(read(file, name))
    np.testing.assert_allclose(in_order(ours), in_order(theirs.triangles), atol=1e-6)
