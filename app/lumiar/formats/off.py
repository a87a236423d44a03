"""Geomview OFF: counts, then a line for each vertex, then a line for each face."""

import re

import numpy as np

from lumiar.formats import check, rows, text

_HEADER = 1 << 16  # the counts come within so many bytes, comments included
_LINE = re.compile(rb"[^\r\n]+")
_KEYWORD = re.compile(rb"(ST)?(C)?(N)?OFF(\d+)?")  # many files have the first count right after
_BINARY = re.compile(rb"\s*+(\w*OFF[ \t]+BINARY)\b")
_COUNTS = re.compile(rb"(\d{1,15})\s+(\d{1,15})(\s+[+-]?\d+)?")
_PLAIN = "write 'OFF', or with ST (texture coordinates), C (colours) or N (normals) before it"


def read(data, name):
    """Return the Polygons of the OFF text `data` (bytes) of file `name`.

    Reads texture coordinates (ST) and normals (N); colours are not used. Raises a Mistake as
    name:line for a malformed line, a file that is cut off and an index out of range.
    """
    binary = _BINARY.match(data)
    if binary:
        raise text.fail(name, data, binary.start(1), "binary OFF is not read; save it as text OFF")
    start, notes = text.opening(data, name)
    flags, counts, start = _header(data, name, start, notes)
    if 0 in counts:
        raise check.mistake(name, check.NO_FACES)
    check.limit(name, vertices=counts[0])
    positions, normals, uvs, corners, sizes = (bytearray() for _ in range(5))
    places = bytearray(), bytearray()
    for section, piece in rows.sections(data, name, start, counts, comments=True):
        if section == 0:
            if not positions:
                width = int(piece.count[0])
                _check_width(width, flags, name, data, int(piece.at[0]), notes)
            found = _vertices(piece, flags, width, name, data)
            stores = (positions, normals, uvs)
        elif section == 1:
            counted, picked = rows.lists(piece, piece.first, name, data)
            found = rows.integers(piece, counted, picked, name, data), counted.astype(np.int32)
            stores = (corners, sizes)
            check.limit(name, corners=len(corners) // 4)
        else:
            notes.append("text after the last face ignored")
            break
        for store, values in zip((*stores, places[section]), (*found, piece.at), strict=True):
            store.extend(values)
    corners = np.frombuffer(corners, np.int32)
    return check.polygons(
        name,
        np.frombuffer(positions).reshape(-1, 3),
        corners,
        np.frombuffer(sizes, np.int32),
        normals=np.frombuffer(normals).reshape(-1, 3) if normals else None,
        normal_of=corners if normals else None,
        uvs=np.frombuffer(uvs).reshape(-1, 2) if uvs else None,
        uv_of=corners if uvs else None,
        notes=notes,
        line_of=lambda kind, index: text.line(
            data, memoryview(places[kind == "face"]).cast("i")[index]
        ),
    )


def _header(data, name, start, notes):
    """Return (ST?, C?, N?), (vertices, faces) and the byte after the line with the counts."""
    flags = None
    for line in _LINE.finditer(data, start, start + _HEADER):
        words = line[0].split(b"#")[0].split()
        if words and flags is None:
            keyword = _KEYWORD.fullmatch(words[0])
            if keyword:
                *flags, count = keyword.groups()
                words = [count, *words[1:]] if count else words[1:]
            elif len(words) == 3 and all(word.isdigit() for word in words):
                flags = [None, None, None]
                notes.append("the keyword OFF is missing")
            else:
                what = f"'{line[0][:40].decode('latin-1')}' is no OFF header; {_PLAIN}"
                raise text.fail(name, data, line.start(), what)
        if words:
            counts = _COUNTS.fullmatch(b" ".join(words))
            if not counts:
                what = "the counts are 'vertices faces edges', three whole numbers from 0"
                raise text.fail(name, data, line.start(), what)
            return flags, (int(counts[1]), int(counts[2])), line.end()
    end = min(len(data), start + _HEADER)
    raise text.fail(name, data, end, f"no counts in the first 64 kB; {_PLAIN}")


def _vertices(piece, flags, width, name, data):
    """Return positions, normals and uvs, a row for each line of `piece`, without columns if none.

    Raises a Mistake at a line that has not `width` numbers.
    """
    odd = piece.count != width
    if odd.any():
        row = int(np.argmax(odd))
        what = f"{piece.count[row]} numbers, but the first vertex has {width}; write {width}"
        raise text.fail(name, data, int(piece.at[row]), what)
    textured, _, normal = flags
    ranges = (0, 3), (3, 6 if normal else 3), (width - 2 if textured else width, width)
    return tuple(piece.values[piece.first[:, None] + np.arange(*range_)] for range_ in ranges)


def _check_width(width, flags, name, data, at, notes):
    """Raise a Mistake at byte `at` if vertices of `width` numbers are not what the header says."""
    textured, coloured, normal = flags
    front = 6 if normal else 3
    widths = [front + c + (2 if textured else 0) for c in ((3, 4) if coloured else (0,))]
    if width in widths:
        return
    if textured or width < front:
        what = f"a vertex of {width} numbers; for this header write {widths[0]}"
        raise text.fail(name, data, at, what)
    notes.append(f"the first {front} of the {width} numbers of a vertex used")
