"""PLY (Stanford polygons): a header that describes elements, then the values of each."""

import re

import numpy as np

from lumiar.errors import Mistake, nearest
from lumiar.formats import check, ply_values, text
from lumiar.formats.ply_values import FACES, INDICES, Element, Property

_MARK = b"\xef\xbb\xbf"
_HEADER = 1 << 20  # bytes within which the header must end
_MOST = 1000  # elements, and properties of an element
_LINE = re.compile(rb"([^\r\n]*)(\r\n|\n|\r)")
_ORDER = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
_TYPES = {
    **{"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"},
    **{"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4"},
    **{"float": "f4", "float32": "f4", "double": "f8", "float64": "f8"},
}
_UVS = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))


def read(data, name):
    """Return the Polygons of the PLY file `name` that holds `data` (bytes).

    Reads the elements vertex, face and tristrips. Raises a Mistake, as name:line for the header
    and for text, for malformed or missing data and for an index out of range.
    """
    order, elements, start = _header(data, name)
    notes = ["byte-order mark skipped"] if data.startswith(_MARK) else []
    if order is None:
        tables, places = ply_values.from_text(data, name, start, elements, notes)
    else:
        tables, places = ply_values.from_bytes(data, name, start, elements, order, notes), {}
    vertex, face, strips = (tables.get(key, {}) for key in ("vertex", "face", "tristrips"))

    def columns(*names):
        found = [vertex[key][1] for key in names if key in vertex and vertex[key][0] is None]
        return check.float64(np.stack(found, 1)) if len(found) == len(names) else None

    sizes, corners = _indices(face)
    strip_corners, strip_rows = _triangles(*_indices(strips))
    faces = len(sizes)
    if len(strip_rows):
        corners = np.concatenate([corners, strip_corners])
        sizes = np.concatenate([sizes, np.full(len(strip_rows), 3)])
    positions, normals = columns("x", "y", "z"), columns("nx", "ny", "nz")
    uvs = next((found for found in (columns(*pair) for pair in _UVS) if found is not None), None)
    uv_of = None if uvs is None else corners
    if face.get("texcoord", (None,))[0] is not None:
        uvs, uv_of = _face_uvs(face["texcoord"], sizes[:faces], len(strip_corners), notes)

    def line_of(kind, index):
        if not places:
            return None
        if kind == "face" and index >= faces:
            kind, index = "tristrips", strip_rows[index - faces]
        return text.line(data, int(places[kind][index]))

    return check.polygons(
        name,
        positions,
        corners,
        sizes,
        normals,
        None if normals is None else corners,
        uvs,
        uv_of,
        notes,
        line_of=line_of,
    )


def _header(data, name):
    """Return the byte order (None: text), the Elements and the byte at which their values start."""
    order, elements = "", []
    start = at = len(_MARK) if data.startswith(_MARK) else 0
    newline = b""
    while line := _LINE.match(data, at, _HEADER):  # finditer would try every byte of a long line
        words = line[1].decode("latin-1").split()
        try:
            if at == start:
                if words != ["ply"]:
                    raise Mistake("the first line is not 'ply': no PLY file; export it again")
                newline = line[2]
            elif words[:1] == ["format"]:
                if len(words) != 3 or words[1] not in _ORDER or words[2] != "1.0" or order != "":
                    raise Mistake(f"write once 'format F 1.0', F one of {', '.join(_ORDER)}")
                order = _ORDER[words[1]]
            elif words == ["end_header"]:
                _check(order, elements)
                # after lines that end in "\r", a "\n" is the first byte of the values
                return order, elements, line.end() - (newline == b"\r" and line[2] == b"\r\n")
            elif words and words[0] not in ("comment", "obj_info"):
                _declare(words, elements)
        except Mistake as mistake:
            raise text.fail(name, data, at, str(mistake)) from None
        at = line.end()
    what = "no 'end_header' line in the first MB: cut off, or no PLY; export it again"
    raise text.fail(name, data, at, what)


def _declare(words, elements):
    """Add what a header line, element or property, declares to `elements`."""
    if words[0] == "element":
        if len(words) != 3 or not (words[2].isascii() and words[2].isdigit()):
            raise Mistake("write 'element NAME COUNT' with a count from 0")
        most = check.MOST_VERTICES if words[1] == "vertex" else check.MOST_CORNERS // 3
        if len(words[2]) > 12 or int(words[2]) > most:
            raise Mistake(f"{words[2][:20]} rows, but at most {most} are read; simplify the mesh")
        if len(elements) == _MOST:
            raise Mistake(f"over {_MOST} elements; write fewer")
        if words[1] in (element.name for element in elements):
            raise Mistake(f"a second element '{words[1]}'; write each element once")
        elements.append(Element(words[1], int(words[2]), []))
        return
    listed = words[1:2] == ["list"]
    types = words[2:4] if listed else words[1:2]
    if words[0] != "property" or len(words) != (5 if listed else 3) or not elements:
        what = f"'{' '.join(words)[:40]}' is no header line; write 'element NAME COUNT', and then "
        raise Mistake(what + "'property TYPE NAME' or 'property list TYPE TYPE NAME'")
    for word in types:
        if word not in _TYPES:
            raise Mistake(f"no type '{word[:40]}'; {nearest(word[:40], _TYPES)}")
    codes = [_TYPES[word] for word in types]
    added = Property(words[-1], codes[-1], codes[0] if listed else None)
    if added.name in (known.name for known in elements[-1].properties):
        raise Mistake(f"a second property '{added.name}'; write each property once")
    if len(elements[-1].properties) == _MOST:
        raise Mistake(f"over {_MOST} properties of one element; write fewer")
    if listed and "f" in codes[0]:
        raise Mistake(f"a list's count cannot be {types[0]}; write uchar or int")
    whole = listed and "f" not in codes[1]
    if added.name in INDICES and elements[-1].name in FACES and not whole:
        raise Mistake(f"'{added.name}' cannot be {types[-1]}; write a list of int")
    elements[-1].properties.append(added)


def _check(order, elements):
    """Raise a Mistake if the header lacks something that a mesh needs."""
    if order == "":
        raise Mistake("no format line before it; write 'format ascii 1.0' or a binary format")
    single = [
        prop.name
        for element in elements
        for prop in element.properties
        if element.name == "vertex" and element.rows and not prop.count
    ]
    if not {"x", "y", "z"}.issubset(single):
        raise Mistake("no vertices with the properties x, y and z before it; write them")
    for element in elements:
        listed = any(prop.name in INDICES for prop in element.properties)
        if element.name in FACES and element.rows and not listed:
            raise Mistake(f"element {element.name} has no list vertex_indices; write it")


def _indices(table):
    """Return (counts, values) of the list of vertex indices in `table`, empty if there is none."""
    none = np.empty(0, np.int32), np.empty(0, np.int32)
    return next((table[key] for key in INDICES if key in table), none)


def _triangles(counts, values):
    """Return the corners (3 T,) of the triangles of the strips, and the strip (T,) of each.

    Strip i is the next counts[i] values; -1 begins another, and every other triangle is turned.
    """
    place = np.arange(len(values))
    begin = np.where(values == -1, place + 1, 0)  # where the strip at each place begins
    first = (np.cumsum(counts) - counts)[counts > 0]
    begin[first] = np.maximum(begin[first], first)
    begin = np.maximum.accumulate(begin)
    at = np.flatnonzero(begin[2:] <= place[:-2])
    odd = (at - begin[at]) % 2
    corners = np.stack([values[at], values[at + 1 + odd], values[at + 2 - odd]], axis=1)
    return corners.ravel(), np.searchsorted(np.cumsum(counts), at, side="right")


def _face_uvs(texcoord, sizes, others, notes):
    """Return uvs and uv_of for the corners of faces, which list them, and `others` without."""
    counts, values = texcoord
    fits = counts == 2 * sizes
    if (~fits & (counts > 0)).any():
        notes.append(f"texture coordinates of {(~fits & (counts > 0)).sum()} faces do not fit them")
    uvs = check.float64(values[np.repeat(fits, counts)].reshape(-1, 2))
    uv_of = np.full(sizes.sum() + others, -1)
    uv_of[: sizes.sum()][np.repeat(fits, sizes)] = np.arange(len(uvs))
    return uvs, uv_of
