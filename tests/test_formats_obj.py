"""lumiar.formats.obj: what is valid is read as the OBJ specification says, the rest is refused."""

import time
from itertools import pairwise

import numpy as np
import pytest

from lumiar.errors import Mistake
from lumiar.formats import obj, text

CUBE = b"""\
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""
V = b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"
F = b"f 1 2 3\n"
TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def corners(polygons):
    """Return the positions of each polygon's corners as lists."""
    ends = np.cumsum(polygons.sizes)[:-1]
    return [part.tolist() for part in np.split(polygons.positions[polygons.corners], ends)]


def volume(polygons):
    """Return the volume that the polygons enclose, positive if they are wound counter-clockwise."""
    fans = ((a, b, c) for a, *rest in corners(polygons) for b, c in pairwise(rest))
    return sum(np.dot(a, np.cross(b, c)) for a, b, c in fans) / 6


def test_cube_has_six_squares_its_box_and_its_volume():
    cube = obj.read(CUBE, "cube.obj")
    assert cube.sizes.tolist() == [4] * 6
    assert cube.positions.min(0).tolist() == [-1, -1, -1]
    assert cube.positions.max(0).tolist() == [1, 1, 1]
    assert volume(cube) == pytest.approx(8)
    assert cube.normals is cube.normal_of is cube.uvs is cube.uv_of is None
    assert cube.notes == ()
    assert cube.positions.dtype == np.float64
    assert cube.corners.dtype == cube.sizes.dtype == np.int64


@pytest.mark.parametrize(
    "data",
    [
        V + F,
        (V + F).replace(b"\n", b"\r\n"),
        (V + F).replace(b"\n", b"\r"),
        (V + F).rstrip(),
        b"\n\n \t\n" + V.replace(b"\n", b"\n\n") + F,
        (V + F).replace(b" ", b"\t"),
        (V + F).replace(b" ", b"  \t "),
        b"   " + V.replace(b"\n", b" \n\t ") + F,
        b"# made by hand # twice\n" + V.replace(b"\n", b" # a corner v 9 9 9\n") + b"f 1 2 3# end",
        b"#\n#\n" + V + b"# f 1 2 9\n" + F,
        b"# C:\\models\\\n" + V + F,
        b"v 0 \\\n0 0\nv \\\n 1 \\\n 0 0\nv 0 1 0\nf 1 \\\n2 3\n",
        b"v 0 \\\r\n0 0\r\nv \\\r\n 1 0 0\r\nv 0 1 0\r\nf 1 2 \\\r\n3\r\n",
        b"v 0 \\\r0 0\rv 1 0 0\rv 0 1 0\rf 1 2 \\\r3\r",
        V + F + b"\\",
        b"v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 1\n" + F,
        b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 .5 .5 .5\n" + F,
        b"v 0 0 0 1 0 0 1\nv 1 0 0 0 1 0 1\nv 0 1 0 .5 .5 .5 1\n" + F,
        b"v 0 0 0\nv 1 0 0 .1 .2 .3\nv 0 1 0 2\n" + F,
        b"v 0e5 -0.0 .0\nv +1 0. 0\nv 0 10E-1 00\n" + F,
        b"v 0 0 0\nv 1.0e+0 0 0\nv 0 0.1e1 0\n" + F,
        V + b"f -3 -2 -1\n",
        V + b"f 1 -2 3\n",
        V + b"f +1 +2 03\n",
        V + b"f 1/ 2/ 3/\n",
        V + b"f 1// 2// 3//",
        V + b"fo 1 2 3\n",
        F + V,
        b"o caf\xe9 \xff\xfe\ng a b c\nusemtl \xe6\x97\xa5\ns off\n" + V + F,
        b"mtllib /etc/passwd ../x.mtl\nusemtl none\n" + V + F,
        V + b"vp 0 0\np 1\nl 1 2 3\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3\nend\n" + F,
        V + b"V 9 9 9\nvx 1\nfoo bar\nfff 1 2 9\nvnn 1\nf_ 1\n\x01\x02\n" + F,
        V + b"v nan inf -inf\nv 1e30 0 0\nv 1e999 0 0\n" + F,
    ],
)  # fmt: skip
def test_every_way_to_write_one_triangle(data):
    triangle = obj.read(data, "triangle.obj")
    assert corners(triangle) == [TRIANGLE]
    for size in (1, 2, 5, 11):  # and wherever a block may end
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(text, "BLOCK", size)
            assert corners(obj.read(data, "triangle.obj")) == [TRIANGLE]


def test_what_was_repaired_is_noted():
    assert obj.read(b"\xef\xbb\xbf" + V + F, "m.obj").notes == ("byte-order mark skipped",)
    bad = obj.read(V + b"v nan 0 0\nv 0 0 1e19\n" + F, "m.obj")
    assert bad.notes == ("2 unused vertices are not finite",)
    assert np.isfinite(bad.positions).all()
    assert bad.positions.max() == 1  # a repaired vertex does not widen the box
    bad = obj.read(V + b"vn 0 0 inf\nvn 0 0 1\nvt nan 0\nf 1/1/1 2/1/2 3/1/2\n", "m.obj")
    assert bad.normal_of.tolist() == [-1, 1, 1]
    assert bad.uvs is bad.uv_of is None
    assert len(bad.notes) == 2


def test_normals_and_texture_coordinates_go_with_their_corner():
    data = V + b"v 5 5 5\nvt 0.25\nvt 0.5 0.75\nvt 1 2 3\nvn 0 0 1\nvn 1 0 0\n"
    mixed = obj.read(data + b"f 1 2/1 3//1 4/2/2\nf 1/3 2/2 3//2\n", "m.obj")
    assert mixed.sizes.tolist() == [4, 3]
    assert mixed.corners.tolist() == [0, 1, 2, 3, 0, 1, 2]
    assert mixed.uv_of.tolist() == [-1, 0, -1, 1, 2, 1, -1]
    assert mixed.normal_of.tolist() == [-1, -1, 0, 1, -1, -1, 1]
    assert mixed.uvs.tolist() == [[0.25, 0], [0.5, 0.75], [1, 2]]
    assert mixed.normals.tolist() == [[0, 0, 1], [1, 0, 0]]


@pytest.mark.parametrize("size", [1, 10, 40, 1000])
def test_indices_that_only_some_faces_have(size, monkeypatch):
    """Wherever a block ends, faces before and after the first that has them have none."""
    monkeypatch.setattr(text, "BLOCK", size)
    data = V + F + F + b"vt 0 1\nf 1/1 2 3\n" + F + b"vn 0 0 1\nf 1 2 3//1\nf 3/-1 2 1//-1\n" + F
    mixed = obj.read(data, "m.obj")
    assert mixed.corners.reshape(-1, 3).tolist() == [[0, 1, 2]] * 5 + [[2, 1, 0], [0, 1, 2]]
    none = [-1, -1, -1]
    uv_of, normal_of = mixed.uv_of.reshape(-1, 3).tolist(), mixed.normal_of.reshape(-1, 3).tolist()
    assert uv_of == [none, none, [0, -1, -1], none, none, [0, -1, -1], none]
    assert normal_of == [none, none, none, none, [-1, -1, 0], [-1, -1, 0], none]


def test_negative_indices_count_back_from_their_own_line():
    square = (
        b"v 0 0 %d\nv 1 0 %d\nv 1 1 %d\nv 0 1 %d\nvt %d 0\nvn 0 0 %d\nf -4/-1/-1 -3//-1 -2/-1 -1\n"
    )
    data = b"".join(square.replace(b"%d", b"%d" % z) for z in range(50))
    squares = obj.read(data, "m.obj")
    assert corners(squares) == [[[0, 0, z], [1, 0, z], [1, 1, z], [0, 1, z]] for z in range(50)]
    assert squares.uv_of.reshape(-1, 4)[:, 0].tolist() == list(range(50))
    assert squares.normals[squares.normal_of[0::4], 2].tolist() == list(range(50))


def test_positions_keep_every_digit():
    written = ["0.1", "3.141592653589793", "-1.7976931348623157e17", "5e-324", "1e-400"]
    data = "".join(f"v {x} 0 0\n" for x in written) + "f 1 2 3 4 5\n"
    assert obj.read(data.encode(), "m.obj").positions[:, 0].tolist() == [float(x) for x in written]


@pytest.mark.parametrize(
    ("line", "data"),
    [
        (4, V + b"f 1 2 4\n"),
        (4, V + b"f 1 2 0\n"),
        (4, V + b"f 1 2 -4\n"),
        (5, V + F + b"f 1 2 -4\nv 0 0 0\n"),
        (4, V + b"f 1 2 99999999999999999999\n"),
        (4, V + b"f 1 2 3000000000\n"),
        (4, V + b"f 1 2 -9223372036854775808\n"),
        (4, V + b"f 1 2\n"),
        (4, V + b"f 1\n"),
        (4, V + b"f\n"),
        (5, V + F + b"f\n"),
        (4, V + b"f 1 2 x\n"),
        (4, V + b"f 1 2 3.0\n"),
        (4, V + b"f 1 2 3e0\n"),
        (4, V + b"f 1, 2, 3\n"),
        (4, V + b"f 1,2,3 2 3\n"),
        (4, V + b"f 1 2 3 -\n"),
        (4, V + b"f 1 2 3 +\n"),
        (4, V + b"f 1 2 3 - 1\n"),
        (4, V + b"f 1-2 2 3\n"),
        (4, V + b"f 1 2 3 \xc2\xb2\n"),
        (4, V + b"f 1 2 3 /1\n"),
        (4, V + b"f 1 2 3 /\n"),
        (4, V + b"f 1 2 3 //\n"),
        (4, V + b"f //1 2 3\n"),
        (4, V + b"f 1///1 2 3\n"),
        (4, V + b"f 1/// 2 3\n"),
        (5, V + b"vt 0 0\nf 1/1//1 2 3\n"),
        (5, V + b"vn 0 0 1\nf 1//1/1 2 3\n"),
        (4, V + b"f 1/1/1/1 2 3\n"),
        (4, V + b"f 1/1 2/1 3/1\n"),
        (5, V + b"vt 0 0\nf 1/2 2/1 3/1\n"),
        (5, V + b"vt 0 0\nf 1/0 2/1 3/1\n"),
        (5, V + b"vt 0 0\nf 1/-2 2/1 3/1\n"),
        (5, V + b"vn 0 0 1\nf 1//1 2//1 3//2\n"),
        (5, V + b"vn 0 0 1\nf 1//1 2//1 3//-2\n"),
        (5, V + b"vn 0 0 1\nf 1//1 2//1 3//0\n"),
        (1, b"v 0 0\n" + V + F),
        (1, b"v\n" + V + F),
        (1, b"v 0 0 0 0 0\n" + V + F),
        (1, b"v 0 0 0 0 0 0 0 0\n" + V + F),
        (2, b"v 0 0 0\nv 1 O 0\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1,5 0 0\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0x0 0\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 0_0\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 1e\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 1.2.3\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 --1\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 .\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 \xef\xbc\x90\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 1d0\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 1\x1f2\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 1 0 0 \\ \nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv nan 0 0\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 0 inf 0\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 0 0 -1e999\nv 0 1 0\n" + F),
        (2, b"v 0 0 0\nv 0 0 2e18\nv 0 1 0\n" + F),
        (3, b"v 0 0 0\nv \\\n0 0 x\nv 0 1 0\n" + F),
        (4, V + b"vt\n" + F),
        (4, V + b"vt 0 0 0 0\n" + F),
        (4, V + b"vt a b\n" + F),
        (4, V + b"vn 0 0\n" + F),
        (4, V + b"vn 0 0 1 0\n" + F),
        (4, V + b"vn 0 0 z\n" + F),
        (2, b"v 0 0 0\nv 1 \x000 0\nv 0 1 0\n" + F),
        (1, (V + F).decode().encode("utf-16")),
        (8, CUBE.replace(b"v -1 1 1\n", b"v -1 1 l\n")),
        (8, CUBE.replace(b"v -1 1 1\n", b"v -1 1 l\n").replace(b"\n", b"\r\n")),
        (8, CUBE.replace(b"v -1 1 1\n", b"v -1 1 l\n").replace(b"\n", b"\r")),
        (14, CUBE.replace(b"f 4 1 5 8", b"f 4 1 5 9")),
        (None, b"\n"),
        (None, V),
        (None, b"# f 1 2 3\n"),
        (None, V + b"p 1 2 3\nl 1 2\n"),
        (None, V + b"cstype bspline\ndeg 3 3\nsurf 0 1 0 1 1 2 3\nend\n"),
        (None, b"\x89PNG\r\n\x1a\nIHDR"),
    ],
)  # fmt: skip
def test_a_malformed_file_is_refused_at_its_line(line, data):
    with pytest.raises(Mistake) as refusal:
        obj.read(data, "some/bad.obj")
    message = str(refusal.value)
    assert message.startswith(f"some/bad.obj:{line}: " if line else "some/bad.obj: ")
    assert message.isprintable()
    assert len(message) <= 300


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (V + b"f 1 2 4\n", ["4", "of 3"]),
        (V + b"f 1 2 0\n", ["0", "from 1"]),
        (V + b"f 1 2 -4\n", ["-4", "3 vertices"]),
        (V + b"f 1 2 3000000000\n", ["3000000000", "3 vertices"]),
        (b"v 1,5 0 0\n", ["'1,5'", "decimal point"]),
        (b"v 1 2\n", ["v x y z"]),
        (V + b"f 1 2\n", ["at least 3"]),
        (V + b"f 1/2/3/4 2 3\n", ["v/vt/vn"]),
        (V, ["no faces"]),
    ],
)
def test_a_refusal_says_what_to_write(data, words):
    with pytest.raises(Mistake) as refusal:
        obj.read(data, "bad.obj")
    assert all(word in str(refusal.value) for word in words), str(refusal.value)


def test_many_small_statements_and_long_lines_are_read_fast():
    groups = b"".join(
        b"o part%d\ng group%d\nusemtl m%d\nf -3 -2 -1\n" % (i, i, i) for i in range(20_000)
    )
    fan = b"f" + b" 1 2 3" * 100_000  # one polygon of 300 000 corners
    spaces = b"v 0 0" + b" " * 2_000_000 + b" 0\n"
    began = time.process_time()
    assert len(obj.read(V + groups, "m.obj").sizes) == 20_000
    assert obj.read(V + fan, "m.obj").sizes.tolist() == [300_000]
    assert len(obj.read(V + spaces + F, "m.obj").positions) == 4
    for endless in (b"v " + b"9" * 50_000_000, b"1 " * 25_000_000, b"\\\n" * 25_000_000):
        with pytest.raises(Mistake):
            obj.read(endless, "m.obj")
    assert obj.read(b"#" * 7_000_000 + b"\n" + V + F, "m.obj").sizes.tolist() == [3]
    assert time.process_time() - began < 8  # 2 s at most here
