"""Wavefront OBJ: polygons written as text, one statement per line."""

import re

import numpy as np

from lumiar.formats import check, text

_OTHER, _V, _VT, _VN, _F = range(5)
_VECTORS = (_V, _VT, _VN)
_WIDTH = {_V: 3, _VT: 2, _VN: 3}
_NAME = {_V: "vertices", _VT: "texture coordinates", _VN: "normals"}

# how many words may follow each keyword; more than 7 count as 8
_ALLOWED = np.zeros((5, 9), bool)
_ALLOWED[_OTHER] = True
_ALLOWED[_V, [3, 4, 6, 7]] = True  # x y z, then a weight or a colour: neither is used
_ALLOWED[_VT, 1:4] = True
_ALLOWED[_VN, 3] = True
_ALLOWED[_F, 3:] = True
_SLASHES = "slashes are misplaced; write v, v/vt, v//vn or v/vt/vn"
_SHAPE = {
    _V: "a vertex is 'v x y z'",
    _VT: "texture coordinates are 'vt u v'",
    _VN: "a normal is 'vn x y z'",
    _F: "a face is 'f a b c ...' with at least 3 corners",
}


def read(data, name):
    """Return the Polygons of the OBJ text `data` (bytes) of file `name`.

    Reads v, vt, vn and f; no other statement says anything of the polygons. Raises a Mistake as
    name:line for a malformed statement and for an index that is 0 or out of range.
    """
    start, notes = text.opening(data, name)
    total = dict.fromkeys(_VECTORS, 0)
    # bytes that grow need half the memory of many small arrays, joined in the end
    vectors = {kind: bytearray() for kind in _VECTORS}
    indices = {kind: bytearray() for kind in _VECTORS}
    sizes, vertex_at, face_at = bytearray(), bytearray(), bytearray()
    for at, buffer in text.blocks(data, name, start, comments=True, continued=True):
        starts, stops, first, count = text.words(buffer)
        if len(first) == 0:
            continue
        heads, words = starts[first], count - 1
        kind = _kinds(buffer, heads, stops[first])
        wrong = ~_ALLOWED[kind, np.minimum(words, 8)]
        if wrong.any():
            line = np.argmax(wrong)
            what = f"{_SHAPE[int(kind[line])]}, not {words[line]} words after the keyword"
            raise text.fail(name, data, at + int(heads[line]), what)
        for letter in (heads, stops[first] - 1):  # a keyword has one letter or two
            buffer[letter[kind != _OTHER]] = text.SPACE
        of_byte = np.zeros(len(buffer), np.uint8)
        of_byte[heads[0] :] = np.repeat(kind, np.diff(heads, append=len(buffer)))

        is_face = kind == _F
        is_vector = (kind != _OTHER) & ~is_face
        only = text.only(buffer, (of_byte != _OTHER) & (of_byte != _F))
        found = _vectors(only, kind[is_vector], words[is_vector], name, data, at)
        if is_face.any():
            only = text.only(buffer, of_byte == _F)
            corners = _corners(only, kind, words[is_face], total, name, data, at)
            before = len(indices[_V])
            for k in corners:
                _lengthen(indices[k], before)
                indices[k].extend(corners[k])
            sizes.extend(words[is_face].astype(np.int32))
            face_at.extend((heads[is_face] + at).astype(np.int32))
        for k in _VECTORS:
            vectors[k].extend(found[k])
            total[k] += len(found[k])
        check.limit(name, max(total.values()), len(indices[_V]) // 4)
        vertex_at.extend((heads[kind == _V] + at).astype(np.int32))

    places = {"vertex": vertex_at, "face": face_at}
    vectors = {k: np.frombuffer(vectors[k]).reshape(-1, _WIDTH[k]) for k in _VECTORS}
    for k in (_VT, _VN):
        if indices[k]:
            _lengthen(indices[k], len(indices[_V]))
    indices = {k: np.frombuffer(indices[k], np.int32) if indices[k] else None for k in _VECTORS}
    return check.polygons(
        name,
        vectors[_V],
        indices[_V],
        np.frombuffer(sizes, np.int32),
        vectors[_VN],
        indices[_VN],
        vectors[_VT],
        indices[_VT],
        notes,
        first=1,
        line_of=lambda kind, index: text.line(data, memoryview(places[kind]).cast("i")[index]),
    )


def _lengthen(indices, length):
    """Append -1 to a bytearray of int32 until it has `length` bytes: corners without an index."""
    indices.extend(b"\xff" * (length - len(indices)))


def _kinds(buffer, starts, stops):
    """Return the kind of statement that each keyword buffer[start:stop] begins."""
    one, two = stops - starts == 1, stops - starts == 2
    letter, second = buffer[starts], buffer[starts + 1]
    kind = np.zeros(len(starts), np.uint8)
    kind[one & (letter == ord("v"))] = _V
    kind[two & (letter == ord("v")) & (second == ord("t"))] = _VT
    kind[two & (letter == ord("v")) & (second == ord("n"))] = _VN
    kind[(letter == ord("f")) & (one | (two & (second == ord("o"))))] = _F  # fo: the old face
    return kind


def _vectors(buffer, kind, words, name, data, at):
    """Return {kind: (n, width) float64} of the vectors in `buffer`; what is not written is 0."""
    values = text.numbers(buffer, int(words.sum()), float, name, data, at)
    values = np.append(values, 0.0)
    begin = np.cumsum(words) - words
    found = {}
    for k in _VECTORS:
        column = np.arange(_WIDTH[k])
        written = column < words[kind == k, None]
        found[k] = values[np.where(written, begin[kind == k, None] + column, -1)]
    return found


def _corners(buffer, kind, sizes, total, name, data, at):
    """Return {kind: (C,) int32}, the indices from 0 of the face corners in `buffer`, -1 for none.

    A kind that no corner has is left out. `kind` are the statements, `sizes` the corners of each
    face, total[kind] the vectors before.
    """
    slash, blank = buffer == ord("/"), buffer <= text.SPACE
    if (slash[:-1] & blank[1:]).any():  # some programs write 1// for 1
        tidy = re.sub(rb"(?<=\d)//?(?=\s)", lambda end: b" " * len(end[0]), buffer.tobytes())
        buffer = np.frombuffer(tidy, np.uint8)
        slash, blank = buffer == ord("/"), buffer <= text.SPACE
    odd = slash[1:-1] & (blank[:-2] | blank[2:] | (slash[:-2] & slash[2:]))
    if odd.any():
        raise text.fail(name, data, at + int(np.argmax(odd)) + 1, _SLASHES)
    digit = ~(blank | slash)
    run = np.flatnonzero(digit[1:] > digit[:-1]) + 1  # where each index begins
    gap = slash[run - 1].view(np.uint8) + (slash[run - 1] & slash[run - 2])  # slashes before it
    head = gap == 0
    corner, passed = np.cumsum(head) - 1, np.cumsum(gap, dtype=np.int64)
    field = passed - passed[head][corner]
    if field.max() > 2:
        raise text.fail(name, data, at + int(run[np.argmax(field > 2)]), _SLASHES)
    values = text.numbers(text.only(buffer, ~slash), len(run), int, name, data, at)

    found = {}
    for k, mine in zip(_VECTORS, (head, field == 1, field == 2), strict=True):
        index = values[mine]
        if len(index) == 0:
            continue
        if index.min() < 1 or index.max() > check.MOST_VERTICES:
            known = (total[k] + np.cumsum(kind == k))[kind == _F]  # vectors before each face
            known = np.repeat(known, sizes)[corner[mine]]
            back = np.where(index < 0, index + known + 1, index)
            wrong = (back < 1) | (back > check.MOST_VERTICES)
            if wrong.any():
                i = int(np.argmax(wrong))
                what = f"index {index[i]}, with {known[i]} {_NAME[k]} before it; "
                what += "count from 1, or back from -1, the last one"
                raise text.fail(name, data, at + int(run[mine][i]), what)
            index = back
        found[k] = np.full(sizes.sum(), -1, np.int32)
        found[k][slice(None) if len(index) == len(found[k]) else corner[mine]] = index - 1
    return found
