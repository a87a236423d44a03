"""lumiar.formats.off: OFF files as Geomview describes them, anything less is refused."""

import time

import numpy as np
import pytest

from lumiar.errors import Mistake
from lumiar.formats import off, text

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
V = b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
F = b"3 0 1 2\n4 0 1 2 3\n"
WHOLE = b"OFF\n4 2 0\n" + V + F


def corners(polygons):
    ends = np.cumsum(polygons.sizes)[:-1]
    return [part.tolist() for part in np.split(polygons.positions[polygons.corners], ends)]


def with_columns(*columns):
    """Return the four vertex lines with the same further columns at each."""
    return b"".join(line + b" " + b" ".join(columns) + b"\n" for line in V.splitlines())


@pytest.mark.parametrize(
    ("notes", "data"),
    [
        ([], WHOLE),
        ([], WHOLE.rstrip()),
        ([], WHOLE.replace(b"\n", b"\r\n")),
        ([], WHOLE.replace(b"\n", b"\r")),
        ([], WHOLE.replace(b"\n", b"\n\n# comment 1 2 3\n \t\n")),
        ([], WHOLE.replace(b"\n", b" # comment 1 2 3\n")),
        ([], b"# first\n\n  " + WHOLE.replace(b" ", b" \t ")),
        ([], b"OFF 4 2 0\n" + V + F),
        ([], b"OFF # 9 9 9\n4 2 0\n" + V + F),
        ([], b"OFF4 2 0\n" + V + F),
        ([], b" \tOFF4 2 0 # or not\n" + V + F),
        ([], b"OFF\n4 2\n" + V + F),
        ([], b"OFF\n4 2 -1\n" + V + F),
        ([], b"OFF\n4 2 0\n" + V + b"3 0 1 2 255 0 0\n4 0 1 2 3 0.1 0.2 0.3 1.0\n"),
        ([], b"OFF\n4 2 0\n" + V + b"3 0 1 2 7\n4 0 1 2 3\n"),
        ([], b"COFF\n4 2 0\n" + with_columns(b"255 0 0 255") + F),
        ([], b"COFF\n4 2 0\n" + with_columns(b"1 0.5 0") + F),
        ([], b"NOFF\n4 2 0\n" + with_columns(b"0 0 2") + F),
        ([], b"CNOFF\n4 2 0\n" + with_columns(b"0 0 2 1 0 0 1") + F),
        ([], b"STOFF\n4 2 0\n" + with_columns(b"0.25 0.75") + F),
        ([], b"STNOFF\n4 2 0\n" + with_columns(b"0 0 2 .25 .75") + F),
        ([], b"STCOFF\n4 2 0\n" + with_columns(b"1 0 0 1 .25 .75") + F),
        ([], b"STCNOFF\n4 2 0\n" + with_columns(b"0 0 2 1 0 0 1 .25 .75") + F),
        ([], b"STCNOFF\n4 2 0\n" + with_columns(b"0 0 2 1 0 0 .25 .75") + F),
        (["the keyword OFF is missing"], b"4 2 0\n" + V + F),
        (["byte-order mark skipped"], b"\xef\xbb\xbf" + WHOLE),
        (["text after the last face ignored"], WHOLE + b"3 0 1 9\nbye\n"),
        ([], WHOLE + b"# bye\n"),
        (["the first 3 of the 4 numbers of a vertex used"],
         b"COFF\n4 2 0\n" + with_columns(b"7") + F),
        (["the first 3 of the 7 numbers of a vertex used"],
         b"OFF\n4 2 0\n" + with_columns(b"255 0 0 255") + F),
        (["1 unused vertices are not finite"], b"OFF\n5 2 0\n" + V + b"nan inf 0\n" + F),
    ],
)  # fmt: skip
def test_every_way_to_write_a_triangle_and_a_square(notes, data):
    read = off.read(data, "m.off")
    assert corners(read) == [SQUARE[:3], SQUARE]
    assert list(read.notes) == notes
    assert np.isfinite(read.positions).all()
    keyword = data.split()[0].partition(b"OFF")[0]
    for letters, values, index, expected in (
        (b"N", read.normals, read.normal_of, [0, 0, 2]),
        (b"ST", read.uvs, read.uv_of, [0.25, 0.75]),
    ):
        if letters in keyword:
            assert values[index].tolist() == [expected] * 7
        else:
            assert values is index is None
    for size in (1, 4, 13):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(text, "BLOCK", size)
            assert corners(off.read(data, "m.off")) == [SQUARE[:3], SQUARE]


@pytest.mark.parametrize(
    ("line", "data"),
    [
        (1, b"OF\n4 2 0\n" + V + F),
        (1, b"off\n4 2 0\n" + V + F),
        (1, b"4OFF\n4 2 0\n" + V + F),
        (1, b"nOFF 3\n4 2 0\n" + V + F),
        (1, b"OFF BINARY\n\0\0\0\4"),
        (1, b"OFF BINARY\n4 2 0\n" + V + F),
        (1, b"NCOFF\n4 2 0\n" + V + F),
        (1, b"OFF4.0 2 0\n" + V + F),
        (1, b"ply\n4 2 0\n" + V + F),
        (1, b"4 2\n" + V + F),
        (3, b"\n# none\nhello\n" + WHOLE),
        (2, b"OFF\n4\n" + V + F),
        (2, b"OFF\n4 -2 0\n" + V + F),
        (2, b"OFF\n4.0 2 0\n" + V + F),
        (2, b"OFF\n4 two 0\n" + V + F),
        (2, b"OFF\n4 2 0 0\n" + V + F),
        (2, b"OFF\n4 99999999999999999999 0\n" + V + F),
        (1, b"OFF 4 x 0\n" + V + F),
        (4, WHOLE.replace(b"1 0 0", b"1 0")),
        (4, WHOLE.replace(b"1 0 0", b"1 0 x")),
        (4, WHOLE.replace(b"1 0 0", b"1,0 0 0")),
        (4, WHOLE.replace(b"1 0 0", b"nan 0 0")),
        (4, WHOLE.replace(b"1 0 0", b"1e300 0 0")),
        (7, WHOLE.replace(b"3 0 1 2", b"2 0 1")),
        (7, WHOLE.replace(b"3 0 1 2", b"0")),
        (7, WHOLE.replace(b"3 0 1 2", b"-3 0 1 2")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1")),
        (7, WHOLE.replace(b"3 0 1 2", b"3.5 0 1 2 3")),
        (7, WHOLE.replace(b"3 0 1 2", b"nan 0 1 2")),
        (7, WHOLE.replace(b"3 0 1 2", b"inf 0 1 2")),
        (7, WHOLE.replace(b"3 0 1 2", b"4000000000 0 1 2")),
        (7, WHOLE.replace(b"3 0 1 2", b"1e300 0 1 2")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 4")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 -1")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 1.5")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 nan")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 inf")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 1e300")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 two")),
        (8, WHOLE.replace(b"4 0 1 2 3", b"4 0 1 2")),
        (8, WHOLE[: WHOLE.index(b"4 0 1 2 3")]),
        (5, WHOLE[: WHOLE.index(b"1 1 0")]),
        (7, WHOLE.replace(b"4 2 0", b"5 2 0")),
        (7, WHOLE.replace(b"4 2 0", b"5 1 0")),
        (9, WHOLE.replace(b"4 2 0", b"4 3 0")),
        (9, WHOLE.replace(b"4 2 0", b"4 4000000000 0")),
        (4, b"COFF\n4 2 0\n" + b"0 0 0 1 1 1\n" + V + F),
        (4, b"COFF\n4 2 0\n" + b"0 0 0 1 1 1\n0 1 0 1 1 1 1\n" + V + F),
        (3, b"NOFF\n4 2 0\n" + V + F),
        (4, b"NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0\n" + V + F),
        (3, b"STOFF\n4 2 0\n" + V + F),
        (3, b"STOFF\n4 2 0\n" + with_columns(b"1 0 0") + F),
        (4, b"OFF\n4 2 0\n0 0 0\n1 \0 0\n" + F),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 4").replace(b"\n", b"\r\n")),
        (7, WHOLE.replace(b"3 0 1 2", b"3 0 1 4").replace(b"\n", b"\r")),
        (11, b"# a\n\n# b\n\n" + WHOLE.replace(b"3 0 1 2", b"3 0 1 4")),
        (2, b"OFF\n"),
        (1, b"OFF"),
        (None, b"OFF\n4 0 0\n" + V),
        (None, b"OFF\n0 0 0\n"),
        (None, b"OFF\n4000000000 2 0\n" + V + F),
    ],
)  # fmt: skip
def test_a_malformed_file_is_refused_at_its_line(line, data):
    with pytest.raises(Mistake) as refusal:
        off.read(data, "m.off")
    message = str(refusal.value)
    assert message.startswith(f"m.off:{line}: " if line else "m.off: "), message
    assert message.isprintable()
    assert len(message) <= 300


def test_long_files_end_fast():
    began = time.process_time()
    lines = b"".join(b"%d 0 0\n" % i for i in range(50_000))
    assert len(off.read(b"OFF\n50000 1 0\n" + lines + b"3 0 1 2\n", "m.off").positions) == 50_000
    for endless in (b"OFF " + b"4 " * 25_000_000, b"\n" * 25_000_000, b"#\n" * 25_000_000,
                    b"OFF\n4 2 0\n" + b"1 " * 25_000_000):  # fmt: skip
        with pytest.raises(Mistake):
            off.read(endless, "m.off")
    assert time.process_time() - began < 8  # 2 s at most here
