"""lumiar.formats.ply: every form of PLY that its description allows, anything less is refused."""

import struct
import time
import tracemalloc

import numpy as np
import pytest

from lumiar.errors import Mistake
from lumiar.formats import ply, text

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
CODES = {
    **{"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I"},
    **{"int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I"},
    **{"float": "f", "float32": "f", "double": "d", "float64": "d"},
}
FORMATS = ("ascii", "binary_little_endian", "binary_big_endian")
XYZ = ("float x", "float y", "float z")
VERTEX = ("vertex", XYZ, SQUARE)
FACE = ("face", ("list uchar int vertex_indices",), [[[0, 1, 2]], [[0, 1, 2, 3]]])


def write(form, *elements, newline="\n"):
    """Return a PLY file of elements (name, properties, rows); a row has a list for a list."""
    header = ["ply", f"format {form} 1.0"]
    body = b""
    order = ">" if form.endswith("big_endian") else "<"
    for name, properties, rows in elements:
        header.append(f"element {name} {len(rows)}")
        header += [f"property {declared}" for declared in properties]
        for row in rows:
            line = []
            for declared, value in zip(properties, row, strict=True):
                types = [CODES[word] for word in declared.split() if word in CODES]
                numbers = [len(value), *value] if len(types) == 2 else [value]
                line += numbers
                if form != "ascii":
                    codes = types[0] + types[-1] * (len(numbers) - 1)
                    body += struct.pack(order + codes, *numbers)
            if form == "ascii":
                body += (" ".join(map(str, line)) + newline).encode()
    return (newline.join([*header, "end_header"]) + newline).encode("latin-1") + body


def strips(*rows):
    return ("tristrips", ("list int int vertex_indices",), [[row] for row in rows])


def moved(*position):
    return ("vertex", XYZ, [SQUARE[0], position, *SQUARE[2:]])


def corners(polygons):
    ends = np.cumsum(polygons.sizes)[:-1]
    return [part.tolist() for part in np.split(polygons.positions[polygons.corners], ends)]


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_a_triangle_and_a_square(form, newline):
    read = ply.read(write(form, VERTEX, FACE, newline=newline), "m.ply")
    assert corners(read) == [SQUARE[:3], SQUARE]
    assert read.notes == ()
    assert read.normals is read.normal_of is read.uvs is read.uv_of is None
    assert read.positions.dtype == np.float64
    assert read.corners.dtype == read.sizes.dtype == np.int64
    for size in (1, 7, 30):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(text, "BLOCK", size)
            again = ply.read(write(form, VERTEX, FACE, newline=newline), "m.ply")
            assert corners(again) == [SQUARE[:3], SQUARE]


def test_a_binary_file_whose_first_value_is_a_line_feed():
    first = ("other", ("uchar n",), [[10], [13]])
    for newline in ("\n", "\r\n", "\r"):
        read = ply.read(
            write("binary_little_endian", first, VERTEX, FACE, newline=newline), "m.ply"
        )
        assert corners(read) == [SQUARE[:3], SQUARE]


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("real", [name for name, code in CODES.items() if code in "fd"])
def test_all_types_of_coordinates(form, real):
    vertices = [[0.5, -0.25, 3], [1e6, 0, 0], [0, 1, 0.125]]
    element = ("vertex", [f"{real} {axis}" for axis in "xyz"], vertices)
    face = ("face", ("list uchar int vertex_index",), [[[0, 1, 2]]])
    assert corners(ply.read(write(form, element, face), "m.ply")) == [vertices]


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("whole", [name for name, code in CODES.items() if code not in "fd"])
def test_all_types_of_counts_and_indices(form, whole):
    vertex = ("vertex", [f"{whole} {axis}" for axis in "xyz"], SQUARE)
    for kinds in (f"{whole} int", f"uchar {whole}", f"{whole} {whole}"):
        face = ("face", (f"list {kinds} vertex_indices",), FACE[2])
        assert corners(ply.read(write(form, vertex, face), "m.ply")) == [SQUARE[:3], SQUARE]


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("uneven", [False, True])
def test_other_properties_and_elements_anywhere_are_passed_over(form, uneven):
    """Of `uneven` lists no two follow one another in the same length."""
    lists = [[5], [1, 2, 3], [], [4]] if uneven else [[1, 2]] * 4
    quads = [[0, 1, 2], [0, 1, 2, 3]] if uneven else [[0, 1, 2, 3]] * 2
    vertex = (
        "vertex",
        (
            "uchar red",
            "float z",
            "list uchar double junk",
            "float x",
            "short s1",
            "double y",
            "int q",
        ),
        [[7, z, lists[i], x, -1, y, 9] for i, (x, y, z) in enumerate(SQUARE)],
    )
    face = (
        "face",
        ("float area", "list ushort uint vertex_indices", "list uint8 int8 flags", "uchar red"),
        [[0.5, quad, [1] * (i if uneven else 1), 255] for i, quad in enumerate(quads)],
    )
    before = ("camera", ("float fx", "list int short distances"), [[1, lists[0]], [2, lists[1]]])
    between = ("material", ("uchar kd",), [[1], [2], [3]])
    after = ("edge", ("int vertex1", "int vertex2"), [[0, 1]])
    empty = ("nothing", ("list int int vertex_indices", "float x"), [])
    read = ply.read(write(form, before, vertex, empty, between, face, after), "m.ply")
    assert corners(read) == [[SQUARE[i] for i in quad] for quad in quads]
    assert read.notes == ()


@pytest.mark.parametrize("form", FORMATS)
def test_long_polygons_of_a_single_byte_count(form):
    ring = [[np.cos(i), np.sin(i), 0] for i in range(255)]
    vertex = ("vertex", ("double x", "double y", "double z"), ring)
    coordinates = [float(i) for i in range(2 * 200)]
    face = (
        "face",
        ("list uchar int vertex_indices", "list ushort float texcoord"),
        [[list(range(200)), coordinates], [list(range(200)), coordinates]],
    )
    read = ply.read(write(form, vertex, face), "m.ply")
    assert read.sizes.tolist() == [200, 200]
    assert read.uvs[read.uv_of].ravel().tolist() == coordinates * 2


@pytest.mark.parametrize("form", FORMATS)
def test_normals_and_texture_coordinates(form):
    names = ("nx", "ny", "nz")
    for pair in (("s", "t"), ("u", "v"), ("texture_u", "texture_v")):
        vertex = (
            "vertex",
            (*XYZ, *(f"float {name}" for name in (*pair, *names))),
            [[*p, i, 0.5, 0, 0, i + 1] for i, p in enumerate(SQUARE)],
        )
        read = ply.read(write(form, vertex, FACE), "m.ply")
        assert read.uvs[read.uv_of].tolist() == [[i, 0.5] for i in (0, 1, 2, 0, 1, 2, 3)]
        assert read.normals[read.normal_of, 2].tolist() == [1, 2, 3, 1, 2, 3, 4]
    vertex = ("vertex", (*XYZ, "float nx", "float s"), [[*p, 1, 1] for p in SQUARE])
    read = ply.read(write(form, vertex, FACE), "m.ply")  # one of several is none
    assert read.normals is read.uvs is None


@pytest.mark.parametrize("form", FORMATS)
def test_texture_coordinates_of_faces(form):
    face = (
        "face",
        ("list uchar int vertex_indices", "list uchar float texcoord"),
        [
            [[0, 1, 2], [0, 0, 1, 0, 1, 1]],
            [[0, 1, 2], []],
            [[0, 1, 2, 3], [0, 0, 1, 0, 1, 1]],
            [[0, 2, 3], [0, 0, 1, 1, 0, 1]],
        ],
    )
    read = ply.read(write(form, VERTEX, face), "m.ply")
    uvs = np.where(read.uv_of[:, None] < 0, np.nan, read.uvs[read.uv_of])
    none = [[np.nan, np.nan]]
    expected = [[0, 0], [1, 0], [1, 1], *none * 7, [0, 0], [1, 1], [0, 1]]
    np.testing.assert_array_equal(uvs, expected)
    assert read.notes == ("texture coordinates of 1 faces do not fit them",)


@pytest.mark.parametrize("form", FORMATS)
def test_triangle_strips_alternate_and_restart(form):
    positions = [[i, i * i, 0] for i in range(9)]
    element = strips([0, 1, 2, 3, 4, -1, 5, 6, 7, -1, -1, 1, 2, -1, 3, 2, 1, 0], [], [4, 5, 6, 7])
    expected = [
        [0, 1, 2],
        [1, 3, 2],
        [2, 3, 4],
        [5, 6, 7],
        [3, 2, 1],
        [2, 0, 1],
        [4, 5, 6],
        [5, 7, 6],
    ]
    read = ply.read(write(form, ("vertex", XYZ, positions), element), "m.ply")
    assert read.corners.reshape(-1, 3).tolist() == expected
    both = ply.read(write(form, ("vertex", XYZ, positions), element, FACE), "m.ply")
    assert both.corners.tolist() == [0, 1, 2, 0, 1, 2, 3, *np.ravel(expected)]


@pytest.mark.parametrize("form", FORMATS)
def test_header_comments_and_repairs(form):
    whole = write(form, VERTEX, FACE)
    wordy = b"comment caf\xe9 end_header\nobj_info num_cols 512\ncomment\n\n"
    read = ply.read(whole.replace(b"element vertex", wordy + b"element vertex"), "m.ply")
    assert corners(read) == [SQUARE[:3], SQUARE]
    read = ply.read(b"\xef\xbb\xbf" + whole, "m.ply")
    assert read.notes == ("byte-order mark skipped",)
    kind = "text" if form == "ascii" else "7 bytes"
    assert ply.read(whole + b"\n3 0 a\n", "m.ply").notes == (
        f"{kind} after the last element ignored",
    )
    vertex = ("vertex", XYZ, [*SQUARE, [np.nan, 0, 0], [0, np.inf, 0]])
    read = ply.read(write(form, vertex, FACE), "m.ply")
    assert read.notes == ("2 unused vertices are not finite",)
    assert np.isfinite(read.positions).all()


def test_blank_lines_in_text_are_passed_over():
    data = write("ascii", VERTEX, FACE).replace(b"end_header\n", b"end_header\n\n \t\n")
    assert corners(ply.read(data.replace(b"3 0 1 2\n", b"\n3 0 1 2\n\n"), "m.ply")) == [
        SQUARE[:3],
        SQUARE,
    ]


def refused(data, line):
    with pytest.raises(Mistake) as refusal:
        ply.read(data, "m.ply")
    message = str(refusal.value)
    assert message.startswith(f"m.ply:{line}: " if line else "m.ply: "), message
    assert message.isprintable()
    assert len(message) <= 300
    return message


TEXT = write("ascii", VERTEX, FACE)
BYTES = write("binary_little_endian", VERTEX, FACE)


def edit(old, new, data=TEXT):
    assert data.count(old) == 1, old
    return data.replace(old, new)


@pytest.mark.parametrize("data", [TEXT, BYTES])
@pytest.mark.parametrize(
    ("line", "old", "new"),
    [
        (1, b"ply\n", b"plx\n"),
        (1, b"ply\n", b"ply 1\n"),
        (1, b"ply\n", b"\nply\n"),
        (2, b" 1.0\n", b" 1.1\n"),
        (2, b" 1.0\n", b"\n"),
        (2, b"format ", b"format x"),
        (2, b"format ", b"fmt "),
        (3, b"element vertex 4", b"format ascii 1.0\nelement vertex 4"),
        (3, b"element vertex 4", b"element vertex -4"),
        (3, b"element vertex 4", b"element vertex 4.0"),
        (3, b"element vertex 4", b"element vertex 0x4"),
        (3, b"element vertex 4", b"element vertex 1_0"),
        (3, b"element vertex 4", b"element vertex \xb2"),
        (3, b"element vertex 4", b"element vertex"),
        (3, b"element vertex 4", b"element vertex 4 4"),
        (3, b"element vertex 4", b"element vertex 4000000000"),
        (3, b"element vertex 4", b"element vertex 1" + b"0" * 5000),
        (3, b"element vertex 4", b"elements vertex 4"),
        (3, b"element vertex 4", b"property float w\nelement vertex 4"),
        (4, b"float x", b"flaot x"),
        (4, b"float x", b"float"),
        (4, b"float x", b"float x x"),
        (4, b"float x", b"list float x"),
        (4, b"float x", b"list float float x"),
        (4, b"float x", b"list uchar flaot x"),
        (4, b"property float x", b"propertyfloat x"),
        (5, b"float y", b"float x"),
        (5, b"float y", b"float x y"),
        (7, b"element face 2", b"element vertex 2"),
        (7, b"element face 2", b"element face"),
        (8, b"list uchar int", b"list uchar float"),
        (8, b"list uchar int", b"list float int"),
        (8, b"list uchar int", b"int"),
        (9, b"float y", b"float w"),
        (9, b"float y", b"list uchar float y"),
        (9, b"element vertex", b"element vertices"),
        (9, b"vertex_indices", b"indices"),
        (9, b"format ", b"comment "),
        (None, b"element face 2", b"element face 0"),
        (None, b"element face", b"element faces"),
        (9, b"element vertex 4", b"element vertex 0"),
    ],
)  # fmt: skip
def test_a_malformed_header_is_refused_at_its_line(data, line, old, new):
    refused(edit(old, new, data), line)


@pytest.mark.parametrize(
    ("line", "data"),
    [
        (11, edit(b"\n1 0 0", b"\n1 0")),
        (11, edit(b"\n1 0 0", b"\n1 0 0 0")),
        (11, edit(b"\n1 0 0", b"\n1 0 x")),
        (11, edit(b"\n1 0 0", b"\n1,0 0 0")),
        (11, edit(b"\n1 0 0", b"\nnan 0 0")),
        (11, edit(b"\n1 0 0", b"\n1 1e39 0")),
        (14, edit(b"3 0 1 2\n", b"2 0 1\n")),
        (14, edit(b"3 0 1 2\n", b"0\n")),
        (14, edit(b"3 0 1 2\n", b"-1\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 2 3\n")),
        (14, edit(b"3 0 1 2\n", b"2.5 0 1 2\n")),
        (14, edit(b"3 0 1 2\n", b"nan 0 1 2\n")),
        (14, edit(b"3 0 1 2\n", b"inf 0 1 2\n")),
        (14, edit(b"3 0 1 2\n", b"1e300 0 1 2\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 4\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 -1\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 1.5\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 nan\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 1e300\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 two\n")),
        (15, edit(b"3 0 1 2\n", b"\n3 0 1 two\n")),
        (14, edit(b"3 0 1 2\n", b"comment\n3 0 1 2\n")),
        (15, TEXT[: TEXT.index(b"4 0 1 2 3")]),
        (15, TEXT[: TEXT.index(b" 3\n")]),
        (12, TEXT[: TEXT.index(b"1 1 0")]),
        (9, TEXT[: TEXT.index(b"end_header") + 5]),
        (9, TEXT[: TEXT.index(b"end_header") + 10]),
        (3, TEXT[: TEXT.index(b"element")]),
        (13, edit(b"element vertex 4", b"element vertex 3")),
        (13, edit(b"element vertex 4", b"element vertex 3").replace(b"0 1 0\n", b"0 1 0 0\n")),
        (14, edit(b"element vertex 4", b"element vertex 5")),
        (16, edit(b"element face 2", b"element face 3")),
        (16, edit(b"element face 2", b"element face 16000000")),
        (12, edit(b"\n1 1 0", b"\n1 \0 0")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 4\n").replace(b"\n", b"\r\n")),
        (14, edit(b"3 0 1 2\n", b"3 0 1 4\n").replace(b"\n", b"\r")),
        (16, write("ascii", VERTEX, strips([0, 1, 2], [1, 2], [0, 1, 4]))),
        (14, write("ascii", VERTEX, strips([0, 1, -2]))),
    ],
)  # fmt: skip
def test_malformed_text_is_refused_at_its_line(line, data):
    refused(data, line)


def packed(count="B", index="i", rows=((0, 1, 2),)):
    """Return a binary PLY of the square with faces that are packed as told, right or wrong."""
    types = {code: name for name, code in CODES.items()}
    kinds = f"list {types[count]} {types[index]} vertex_indices"
    data = write("binary_little_endian", VERTEX, ("face", (kinds,), []))
    body = b"".join(struct.pack(f"<{count}{len(row)}{index}", len(row), *row) for row in rows)
    return data.replace(b"face 0", b"face %d" % len(rows)) + body


@pytest.mark.parametrize(
    ("words", "data"),
    [
        ("vertex 4 of 4", packed(rows=[(0, 1, 4)])),
        ("vertex -1 of 4", packed(rows=[(0, 1, 2), (0, 1, -1)])),
        ("face 1", packed(rows=[(0, 1, 2), (0, 1, -1)])),
        ("vertex 4294967295", packed(index="I", rows=[(0, 1, 2**32 - 1)])),
        ("2 corners", packed(rows=[(0, 1, 2), (0, 1)])),
        ("0 corners", packed(rows=[()])),
        ("face 2 has 1 corners", packed(rows=[(0, 1, 2), (0, 1, 2, 3), (1,)])),
        ("cut off", packed()[:-1]),
        ("cut off", packed(rows=[(0, 1, 2), (0, 1, 2, 3)])[:-1]),
        ("cut off", packed(rows=[(0, 1, 2, 3), (0, 1, 2)])[:-12]),
        ("cut off", packed()[:-13]),
        ("2 rows of element face", packed().replace(b"face 1", b"face 2")),
        ("0 corners", packed().replace(b"vertex 4", b"vertex 5")),
        ("cut off", packed().replace(b"vertex 4", b"vertex 10000000")),
        ("cut off", packed().replace(b"face 1", b"face 16000000")),
        ("cut off", packed().replace(b"\x03\0\0\0\0", b"\xff\0\0\0\0")),
        ("list of -1", packed(count="b").replace(b"\x03\0\0\0\0", b"\xff\0\0\0\0")),
        ("list of -1", packed(count="i").replace(b"\3\0\0\0\0\0\0\0", b"\xff\xff\xff\xff\0\0\0\0")),
        ("cut off", packed(count="I").replace(b"\3\0\0\0\0\0\0\0", b"\xff\xff\xff\xff\0\0\0\0")),
        ("list of -2", packed(count="b", rows=[(0, 1, 2), (0, 1, 2)])[:-13] + b"\xfe" + b"\0" * 12),
        ("vertex 1 is at (nan", write("binary_big_endian", moved(np.nan, 0, 0), FACE)),
        ("vertex 1 is at (1, inf", write("binary_big_endian", moved(1, np.inf, 0), FACE)),
        ("no faces", write("binary_big_endian", VERTEX)),
        ("no faces", write("binary_big_endian", VERTEX, ("edge", ("int a", "int b"), [[0, 1]]))),
        ("no faces", write("ascii", VERTEX, ("face", ("list uchar int vertex_indices",), []))),
        ("no faces", write("ascii", VERTEX, strips([0, 1]))),
    ],
)  # fmt: skip
def test_malformed_bytes_are_refused(words, data):
    assert words in refused(data, None)


def test_hostile_files_take_neither_time_nor_memory():
    began = time.process_time()
    tracemalloc.start()
    refused(b"ply\nformat ascii 1.0\n" + b"comment\n" * 5_000_000, 2 + (2**20 - 21) // 8 + 1)
    refused(b"ply\nformat ascii 1.0\ncomment " + b"x" * 50_000_000, 3)
    header = b"ply\nformat binary_little_endian 1.0\nelement vertex 9999999\n"
    header += b"property double x\n" + b"property double y\nproperty double z\n"
    refused(
        header + b"element face 1\nproperty list int int vertex_index\nend_header\n" + b"0" * 1000,
        None,
    )
    for declared, line in (
        (b"element e%d 0\n", 1006),
        (b"property char p%d\n", 1004),
        (b"property list char char p%d\n", 1004),
    ):
        many = b"".join(declared % i for i in range(30_000))
        refused(BYTES.replace(b"element face", many + b"element face"), line)
    many = b"".join(b"element e%d 16000000\n" % i for i in range(900))
    read = ply.read(BYTES.replace(b"element vertex", many + b"element vertex"), "m.ply")
    assert len(read.sizes) == 2
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 250e6
    assert time.process_time() - began < 8  # 2 s at most here


def test_polygons_of_changing_size_are_read_fast():
    began = time.process_time()
    rows = [(0, 1, 2), (0, 1, 2, 3)] * 50_000
    assert ply.read(packed(rows=rows), "m.ply").sizes.tolist() == [3, 4] * 50_000
    assert time.process_time() - began < 8  # 2 s at most here


@pytest.mark.parametrize("form", FORMATS[1:])
@pytest.mark.parametrize("index", ["uchar", "int", "uint"])
def test_signalling_nan_is_as_any_other(form, index):
    """Bits that warn where they are turned into float64, written as whole numbers."""
    nan, names = 0x7F800001, ("nx", "ny", "nz", "s", "t")
    rows = [[*position, *[nan] * len(names)] for position in SQUARE]
    vertex = ("vertex", (*XYZ, *(f"uint32 {name}" for name in names)), rows)
    lists = (f"list uchar {index} vertex_indices", "list uchar uint32 texcoord")
    face = ("face", lists, [[[0, 1, 2], [nan] * 6]])
    read = ply.read(write(form, vertex, face).replace(b"uint32", b"float32"), "m.ply")
    assert read.corners.tolist() == [0, 1, 2]
    assert read.normals is read.uvs is None
    assert len(read.notes) == 2
    rows = [[0x80000000] * 3, [nan] * 3, [1] * 3, [2] * 3]  # -0, and two of nearly 0
    vertex = ("vertex", [f"uint32 {axis}" for axis in "xyz"], rows)
    data = write(form, vertex, ("face", lists[:1], [[[0, 2, 3]]]))
    read = ply.read(data.replace(b"uint32", b"float32"), "m.ply")
    assert read.notes == ("1 unused vertices are not finite",)
    assert np.isfinite(read.positions).all()
