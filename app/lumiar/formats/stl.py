"""STL: triangles without shared vertices, binary or as text. Its normals are not used."""

import re

import numpy as np

from lumiar.formats import check, text

_LINE = re.compile(rb"[^\r\n]{0,40}")
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_WORDS = {  # each statement with how many words it has at least and at most
    b"solid": (1, 1 << 30),
    b"endsolid": (1, 1 << 30),
    b"facet": (5, 5),
    b"outer": (2, 2),
    b"vertex": (4, 4),
    b"endloop": (1, 1),
    b"endfacet": (1, 1),
}
_SOLID, _ENDSOLID, _FACET, _OUTER, _VERTEX, _ENDLOOP, _ENDFACET = range(7)
_FACET_LINES = np.array([_FACET, _OUTER, _VERTEX, _VERTEX, _VERTEX, _ENDLOOP, _ENDFACET])
_FORMS = (
    *("facet normal x y z' or 'endsolid", "outer loop"),
    *("vertex x y z", "vertex x y z", "vertex x y z", "endloop", "endfacet"),
)


def read(data, name):
    """Return the Polygons of the STL file `name` that holds `data` (bytes): three corners each.

    Raises a Mistake as name:line for malformed text, as name for a binary file that is cut off.
    """
    promised = int.from_bytes(data[80:84], "little")
    if len(data) < 84 or len(data) != 84 + 50 * promised:
        word = data[:80].removeprefix(b"\xef\xbb\xbf").lstrip()[:5].lower()
        if word == b"solid" and b"\0" not in data[:84]:  # a binary count has zero bytes
            return _text(data, name)
    return _binary(data, name, promised)


def _binary(data, name, promised):
    left = len(data) - 84
    if left < 50 * promised or left < 0:
        what = f"the header promises {promised} triangles of 50 bytes, but {max(left, 0)} bytes "
        raise check.mistake(name, what + "follow it (byte 84): cut off, or no STL; export it again")
    triangles = np.frombuffer(data, _TRIANGLE, promised, 84)["corners"]
    if promised and not check.all_near(triangles):
        bad = int(np.argmin(check.near(triangles.reshape(-1, 9))))
        what = f"triangle {bad} has a corner that is not a finite number up to 1e18; repair it"
        raise check.mistake(name, f"{what} (byte {84 + 50 * bad})")
    extra = left - 50 * promised
    notes = [f"{extra} bytes after the last triangle ignored"] if extra else []
    return _soup(name, check.float64(triangles).reshape(-1, 3), notes)


def _soup(name, positions, notes, line_of=lambda kind, index: None):
    sizes = np.full(len(positions) // 3, 3)
    return check.polygons(
        name, positions, np.arange(len(positions)), sizes, notes=notes, line_of=line_of
    )


def _text(data, name):
    start, notes = text.opening(data, name)
    positions, vertex_at = bytearray(), bytearray()
    turn, last = 0, _SOLID  # the line of a facet that is due, and the last statement
    for at, buffer in text.blocks(data, name, start):
        starts, stops, first, count = text.words(buffer)
        if len(first) == 0:
            continue
        kind = _kinds(buffer, starts[first], stops[first])
        inside = kind >= _FACET
        turns = (turn + np.cumsum(inside) - inside) % len(_FACET_LINES)
        least, most = np.array([(1, 0), *_WORDS.values()])[kind + 1].T
        right = np.where(inside, kind == _FACET_LINES[turns], turns == 0)
        right &= (count >= least) & (count <= most)
        if not right.all():
            line = int(np.argmin(right))
            place = at + int(starts[first[line]])
            found = _LINE.match(data, place)[0].decode("latin-1")
            what = f"'{found}' where '{_FORMS[turns[line]]}' belongs; export the file again"
            raise text.fail(name, data, place, what)
        turn, last = (turns[-1] + inside[-1]) % len(_FACET_LINES), kind[-1]

        number = np.repeat(kind == _VERTEX, count)  # for each word, and none of the keywords
        number[first] = False
        keep = np.zeros(len(buffer), bool)
        keep[starts[0] :] = np.repeat(number, np.diff(starts, append=len(buffer)))
        only = text.only(buffer, keep)
        values = text.numbers(only, int(number.sum()), float, name, data, at)
        positions.extend(values)
        vertex_at.extend((starts[first[kind == _VERTEX]] + at).astype(np.int32))
    if last != _ENDSOLID:
        what = "the file ends without 'endsolid': it is cut off; export it again"
        raise text.fail(name, data, len(data), what)

    def line_of(_, vertex):
        return text.line(data, memoryview(vertex_at).cast("i")[vertex])

    return _soup(name, np.frombuffer(positions).reshape(-1, 3), notes, line_of)


def _kinds(buffer, starts, stops):
    """Return the index in _WORDS of each word buffer[start:stop] in any capitals, -1 for none."""
    letters = buffer[np.minimum(starts[:, None] + np.arange(9), len(buffer) - 1)] | np.uint8(32)
    letters[np.arange(9) >= (stops - starts)[:, None]] = 0
    words = letters.view("S9")[:, 0]
    kind = np.full(len(starts), -1, np.int8)
    for index, word in enumerate(_WORDS):
        kind[words == word] = index
    return kind
