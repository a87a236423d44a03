"""The values of PLY elements, from text and from bytes, as tables.

A table is {property: (counts, values)}: `counts` is the length of each row's list, and None where
the property is one value a row. Properties that say nothing of the polygons are left out.
"""

import struct
from array import array
from typing import NamedTuple

import numpy as np

from lumiar.errors import Mistake
from lumiar.formats import check, rows, text

FACES = ("face", "tristrips")
INDICES = ("vertex_indices", "vertex_index")
_WANTED = {*INDICES, *"xyzstuv", "nx", "ny", "nz", "texture_u", "texture_v", "texcoord"}
_MOST_LISTS = 10_000_000  # read one by one, some seconds
_STRUCT = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I"}


class Property(NamedTuple):
    """A property: its name, the NumPy type of a value, and that of a list's count, if a list."""

    name: str
    type: str
    count: str | None


class Element(NamedTuple):
    """An element: its name, how many rows of it there are, and the properties of each row."""

    name: str
    rows: int
    properties: list


def from_text(data, name, start, elements, notes):
    """Return ({element: table}, {element: the byte of each row}) of the text from byte `start`.

    Raises a Mistake as name:line for a line that does not fit its element.
    """
    text.opening(data, name)
    stores, places = {}, {}  # as bytes that grow, which need less memory than many small arrays
    counts = [element.rows if element.properties else 0 for element in elements]
    for section, piece in rows.sections(data, name, start, counts):
        if section == len(elements):
            notes.append("text after the last element ignored")
            break
        element = elements[section]
        places.setdefault(element.name, bytearray()).extend(piece.at)
        store = stores.setdefault(element.name, {})
        for key, (lengths, values) in _from_lines(piece, element, name, data).items():
            grown = store.setdefault(key, (bytearray(), bytearray(), values.dtype))
            grown[1].extend(values)
            if lengths is not None:
                grown[0].extend(lengths.astype(np.int32))
                check.limit(name, corners=len(grown[1]) // values.itemsize)
    tables = {
        element: {
            key: (
                np.frombuffer(grown[0], np.int32) if grown[0] else None,
                np.frombuffer(*grown[1:]),
            )
            for key, grown in store.items()
        }
        for element, store in stores.items()
    }
    return tables, {element: np.frombuffer(at, np.int32) for element, at in places.items()}


def _from_lines(piece, element, name, data):
    """Return the table of the lines `piece` of an element."""
    table, at, end = {}, piece.first.copy(), piece.first + piece.count
    for prop in element.properties:
        if prop.count:
            counts, picked = rows.lists(piece, at, name, data)
            if prop.name in INDICES and element.name in FACES:
                table[prop.name] = counts, rows.integers(piece, counts, picked, name, data)
            elif prop.name in _WANTED:
                table[prop.name] = counts, piece.values[picked]
            at += 1 + counts
        else:
            _check_fit(at < end, piece, element, name, data)
            if prop.name in _WANTED:
                table[prop.name] = None, piece.values[at]
            at += 1
    _check_fit(at == end, piece, element, name, data)
    return table


def _check_fit(fits, piece, element, name, data):
    if not fits.all():
        row = int(np.argmin(fits))
        what = f"{piece.count[row]} numbers do not fit element {element.name}; "
        what += f"write {' '.join(prop.name for prop in element.properties)}"
        raise text.fail(name, data, int(piece.at[row]), what)


def from_bytes(data, name, at, elements, order, notes):
    """Return {element: table} of the bytes from `at` on, numbers in byte order `order` (< or >).

    Raises a Mistake, with the byte, if the data end too early or a list has a negative count.
    """
    tables = {}
    for element in elements:
        try:
            tables[element.name], at = _from_bytes(data, at, element, order)
        except (struct.error, EOFError):
            what = f"the {element.rows} rows of element {element.name} need more than the "
            what += f"{len(data) - at} bytes left (byte {at}): cut off; export the file again"
            raise check.mistake(name, what) from None
        except Mistake as mistake:
            raise check.mistake(name, f"element {element.name}: {mistake}") from None
    if at < len(data):
        notes.append(f"{len(data) - at} bytes after the last element ignored")
    return tables


def _from_bytes(data, at, element, order):
    """Return the table of an element whose rows begin at byte `at`, and the byte after them.

    Raises struct.error or EOFError if the data end before that.
    """
    least = sum(np.dtype(prop.count or prop.type).itemsize for prop in element.properties)
    if element.rows * least > len(data) - at:
        raise EOFError
    if element.rows * least == 0:
        return {}, at
    lengths = iter(_walk(data, at, element, order, 1)[2][0].tolist())
    fields = []
    for prop in element.properties:  # as if every list were as long as in the first row
        if prop.count:
            fields.append((f"{prop.name} count", order + prop.count))
        fields.append((prop.name, order + prop.type, (next(lengths),) if prop.count else ()))
    row = np.dtype(fields)
    if element.rows * row.itemsize <= len(data) - at:
        values = np.frombuffer(data, row, element.rows, at)
        lists = [prop for prop in element.properties if prop.count]
        if all((values[f"{p.name} count"] == row[p.name].shape[0]).all() for p in lists):
            table = {}
            for p in element.properties:
                if p.name in _WANTED:
                    counts = values[f"{p.name} count"].astype(np.int32) if p.count else None
                    table[p.name] = counts, values[p.name].ravel()
            return table, at + values.nbytes
    return _from_ragged(data, at, element, order)


def _from_ragged(data, at, element, order):
    """Return what _from_bytes does, where a list differs in length from row to row."""
    if element.rows * sum(prop.count is not None for prop in element.properties) > _MOST_LISTS:
        raise Mistake(f"over {_MOST_LISTS} lists that differ in length; triangulate the mesh")
    at, places, counts, end = _walk(data, at, element, order, element.rows)
    if (counts.sum(axis=0) > check.MOST_CORNERS).any():
        raise Mistake(f"lists of over {check.MOST_CORNERS} values; simplify the mesh")
    table, column = {}, 0
    for prop in element.properties:
        size = np.dtype(prop.type).itemsize
        if prop.count:
            at, count, column = places[:, column], counts[:, column], column + 1
        if prop.name in _WANTED:
            shape = (len(data) - size + 1,)  # a value at every byte, of which a few are taken
            every = np.ndarray(shape, order + prop.type, data, strides=(1,))
            if prop.count:
                table[prop.name] = count, every[rows.spans(at, count, size)]
            else:
                table[prop.name] = None, every[at]
        at = at + (size * count if prop.count else size)
    return table, end


def _walk(data, at, element, order, count):
    """Return the byte (R,) of `count` rows, the bytes and counts (R, L) of their lists, the end."""
    steps, skip = [], 0
    for prop in element.properties:
        size = np.dtype(prop.type).itemsize
        if prop.count:
            steps.append((skip, struct.Struct(order + _STRUCT[prop.count]), size))
        skip = 0 if prop.count else skip + size
    starts, places, counts = array("q"), array("q"), array("q")
    for _ in range(count):
        starts.append(at)
        for before, number, size in steps:
            at += before
            (length,) = number.unpack_from(data, at)
            if length < 0:
                raise Mistake(f"a list of {length} values (byte {at}); export the file again")
            at += number.size
            places.append(at)
            counts.append(length)
            at += length * size
        at += skip
    if at > len(data):
        raise EOFError
    starts, places, counts = (np.frombuffer(found, np.int64) for found in (starts, places, counts))
    shape = (count, len(steps))
    return starts, places.reshape(shape), counts.reshape(shape), at
