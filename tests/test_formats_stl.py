"""lumiar.formats.stl: binary and text STL as the format says, anything less is refused."""

import struct
import time

import numpy as np
import pytest

from lumiar.errors import Mistake
from lumiar.formats import stl, text

FACET = b"""\
facet normal 0 0 1
  outer loop
    vertex 0 0 0
    vertex 1 0 0
    vertex 0 1 0
  endloop
endfacet
"""
SOLID = b"solid thing\n" + FACET + b"endsolid thing\n"
TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def binary(triangles, header=b"made by a test", count=None):
    """Return a binary STL of (n, 3, 3) triangles, whose header promises `count` of them."""
    triangles = np.asarray(triangles, "<f4").reshape(-1, 3, 3)
    body = b"".join(struct.pack("<3f", 0, 0, 0) + t.tobytes() + b"\0\0" for t in triangles)
    return (
        header.ljust(80, b"\0")
        + struct.pack("<I", len(triangles) if count is None else count)
        + body
    )


def test_binary_triangles_have_their_own_corners_in_order():
    triangles = np.arange(36).reshape(4, 3, 3) / 8  # exact in float32
    read = stl.read(binary(triangles), "m.stl")
    assert read.positions[read.corners].reshape(4, 3, 3).tolist() == triangles.tolist()
    assert read.sizes.tolist() == [3] * 4
    assert read.notes == ()
    assert read.normals is read.uvs is None
    assert read.positions.dtype == np.float64


def test_a_binary_file_may_begin_with_solid():
    for header in (
        b"solid",
        b"solid made by a CAD program".ljust(80),
        b"solid\nfacet normal 0 0 1",
    ):
        assert len(stl.read(binary([TRIANGLE], header), "m.stl").sizes) == 1


def test_bytes_after_the_triangles_are_noted():
    read = stl.read(binary([TRIANGLE]) + b"extra", "m.stl")
    assert read.notes == ("5 bytes after the last triangle ignored",)
    assert read.positions.tolist() == TRIANGLE


@pytest.mark.parametrize(
    "data",
    [
        SOLID,
        SOLID.replace(b"\n", b"\r\n"),
        SOLID.replace(b"\n", b"\r"),
        SOLID.upper(),
        SOLID.title(),
        SOLID.replace(b"  ", b""),
        SOLID.replace(b" ", b"\t"),
        b"\n\n  " + SOLID.replace(b"\n", b"\n\n").strip(),
        SOLID.replace(b"thing", b""),
        SOLID.replace(b"thing", b"facet vertex endsolid caf\xe9"),
        SOLID.replace(b"0 0 1\n", b"nan nan nan\n"),
        SOLID.replace(b"0 0 1\n", b"-nan(ind) 1.#QNAN inf\n"),
        SOLID.replace(b"1 0 0", b"1e0 0e-3 -0.0"),
        SOLID.replace(b"1 0 0", b"+1. .0 0000"),
        SOLID.replace(b"thing", b"x" * 200),
        b"\xef\xbb\xbf" + SOLID,
    ],
)
def test_every_way_to_write_one_triangle(data):
    read = stl.read(data, "m.stl")
    assert read.positions[read.corners].tolist() == TRIANGLE
    for size in (1, 3, 17):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(text, "BLOCK", size)
            assert stl.read(data, "m.stl").positions.tolist() == TRIANGLE


def test_several_solids_are_one_mesh():
    other = SOLID.replace(b"thing", b"").replace(b"0 1 0", b"0 2 0")
    read = stl.read(SOLID + other + SOLID, "m.stl")
    assert read.positions[:, 1].tolist() == [0, 0, 1, 0, 0, 2, 0, 0, 1]


def edit(old, new, data=SOLID):
    assert data.count(old) == 1
    return data.replace(old, new)


@pytest.mark.parametrize(
    ("line", "data"),
    [
        (2, edit(b"facet normal 0 0 1", b"facet normal 0 0")),
        (2, edit(b"facet normal 0 0 1", b"facet")),
        (2, edit(b"facet normal 0 0 1\n", b"")),
        (3, edit(b"outer loop", b"outer")),
        (3, edit(b"outer loop", b"loop")),
        (3, edit(b"  outer loop\n", b"")),
        (5, edit(b"vertex 1 0 0", b"vertex 1 0")),
        (5, edit(b"vertex 1 0 0", b"vertex 1 0 0 0")),
        (5, edit(b"vertex 1 0 0", b"vertex 1 0 x")),
        (5, edit(b"vertex 1 0 0", b"vertex 1,0 0 0")),
        (5, edit(b"vertex 1 0 0", b"vertex nan 0 0")),
        (5, edit(b"vertex 1 0 0", b"vertex 1 inf 0")),
        (5, edit(b"vertex 1 0 0", b"vertex 1 1e39 0")),
        (5, edit(b"vertex 1 0 0", b"vertexes 1 0 0")),
        (5, edit(b"vertex 1 0 0", b"vertex1 0 0")),
        (5, edit(b"vertex 1 0 0", b"v 1 0 0")),
        (5, edit(b"vertex 1 0 0", b"1 0 0")),
        (6, edit(b"    vertex 0 1 0\n", b"")),
        (7, edit(b"    vertex 0 1 0\n", b"    vertex 0 1 0\n" * 2)),
        (7, edit(b"endloop", b"end loop")),
        (7, edit(b"  endloop\n", b"")),
        (8, edit(b"endfacet", b"endfacets")),
        (8, edit(b"endfacet\n", b"")),
        (8, edit(b"endfacet", b"endsolid")),
        (9, edit(b"endsolid thing", b"the end")),
        (8, edit(b"endsolid thing\n", b"").rstrip()),
        (5, SOLID[: SOLID.index(b"vertex 0 1")].rstrip()),
        (6, SOLID[: SOLID.index(b"0 1 0")]),
        (1, b"solid x"),
        (5, edit(b"vertex 1 0 0", b"vertex 1 0 x").replace(b"\n", b"\r\n")),
        (5, edit(b"vertex 1 0 0", b"vertex 1 0 x").replace(b"\n", b"\r")),
        (12, SOLID + b"\n\n\0"),
        (None, b"solid x\nendsolid x\n"),
    ],
)  # fmt: skip
def test_malformed_text_is_refused_at_its_line(line, data):
    refused(data, line)


NAN = binary([TRIANGLE, [[0, 0, 0], [1, np.nan, 0], [0, 1, 0]]])


@pytest.mark.parametrize(
    ("words", "data"),
    [
        ("no faces", binary([])),
        ("promises 2 triangles of 50 bytes, but 50 bytes", binary([TRIANGLE], count=2)),
        ("promises 4294967295 triangles", binary([TRIANGLE], count=2**32 - 1)),
        ("but 49 bytes", binary([TRIANGLE])[:-1]),
        ("but 49 bytes", binary([TRIANGLE], b"solid")[:-1]),
        ("cut off", binary([TRIANGLE])[:84]),
        ("cut off", binary([TRIANGLE])[:83]),
        ("cut off", b"\0"),
        ("cut off", b"just some text that is longer than the header of an STL file would be" * 2),
        ("triangle 1", NAN),
        ("byte 134", NAN),
        ("triangle 0", binary([[[0, 0, 0], [np.inf, 0, 0], [0, 1, 0]]])),
        ("triangle 0", binary([[[0, 0, 0], [1e19, 0, 0], [0, 1, 0]]])),
    ],
)
def test_malformed_bytes_are_refused(words, data):
    assert words in refused(data)


def refused(data, line=None):
    """Return the one line that refuses `data` as m.stl at `line`."""
    with pytest.raises(Mistake) as refusal:
        stl.read(data, "m.stl")
    message = str(refusal.value)
    assert message.startswith(f"m.stl:{line}: " if line else "m.stl: "), message
    assert message.isprintable()
    assert len(message) <= 300
    return message


def test_long_files_are_read_fast():
    began = time.perf_counter()
    assert len(stl.read(SOLID * 5_000, "m.stl").sizes) == 5_000
    assert len(stl.read(binary([TRIANGLE] * 20_000), "m.stl").sizes) == 20_000
    refused(b"solid " + b"x" * 50_000_000, 1)
    refused(b"solid\n" + b"vertex 1 2 3\n" * 1_000_000, 2)
    assert time.perf_counter() - began < 8  # 2 s at most here
