"""glTF's JSON looked up with every type checked, and its buffers and accessors as arrays.

Functions here raise a Mistake that names the place in the document, but not yet the file.
"""

import base64
import json
import re
from functools import cache
from typing import NamedTuple
from urllib.parse import unquote, unquote_to_bytes

import numpy as np

from lumiar.errors import Mistake
from lumiar.formats import check

COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
INDEX_CODES = ("<u1", "<u2", "<u4")
_MOST_ZEROS = 1 << 20  # values that take no bytes of the file
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
_UNUSUAL = re.compile(r"[\x00-\x1f\x7f\\]")


class Accessor(NamedTuple):
    """The (N, width) `values` of type `code`, and the rows `at` that `patches` replace.

    Where nothing is `stored`, the values are zeros.
    """

    label: str
    values: np.ndarray
    code: str
    normalized: bool
    stored: bool
    at: np.ndarray
    patches: np.ndarray


def whole(parent, key, where, default=None):
    """Return the whole number parent[key] from 0 to 2^53, or the default."""
    value = parent.get(key, default)
    if type(value) is not int or not 0 <= value <= 2**53:
        raise Mistake(f"{where}: {key} {shown(parent, key)}; write a whole number from 0")
    return value


def listed(parent, key, where, kind=dict):
    """Return the list parent[key] of values of a `kind`, or an empty list."""
    values = parent.get(key, [])
    if not isinstance(values, list) or not all(type(value) is kind for value in values):
        names = {dict: "objects", int: "whole numbers", str: "strings"}
        raise Mistake(f"{where}: {key} {shown(parent, key)}; write a list of {names[kind]}")
    return values


def child(parent, key, where):
    """Return the object parent[key], or an empty one."""
    value = parent.get(key, {})
    if not isinstance(value, dict):
        raise Mistake(f"{where}: {key} {shown(parent, key)}; write an object {{...}}")
    return value


def entry(document, key, index, where):
    """Return the object number `index` of the document's list `key`."""
    entries = document.get(key, [])
    if not isinstance(entries, list) or not 0 <= index < len(entries):
        count = len(entries) if isinstance(entries, list) else 0
        raise Mistake(f"{where} refers to {key} {index}, but there are {count}; correct it")
    if not isinstance(entries[index], dict):
        raise Mistake(f"{key} {index} is no object; write {{...}}")
    return entries[index]


def numbers(parent, key, size, where, default=None):
    """Return the list parent[key] of `size` finite numbers, as floats, or the default."""
    values = parent.get(key, default)
    good = isinstance(values, list) and len(values) == size
    if not good or not all(type(v) in (int, float) and abs(v) < 1e300 for v in values):
        raise Mistake(f"{where}: {key} {shown(parent, key)}; write {size} finite numbers")
    return [float(value) for value in values]


def shown(parent, key):
    """Return "is ..." with the value of parent[key] in brief, or "is missing"."""
    value = parent.get(key)
    if isinstance(value, dict | list):
        return "is an object" if isinstance(value, dict) else f"is a list of {len(value)}"
    return f"is {json.dumps(value)[:40]}" if key in parent else "is missing"


def buffers(document, blob, fetch):
    """Return a function from a buffer's index to its bytes, as a memoryview of byteLength bytes.

    `blob` is the binary chunk of a .glb or None; fetch(path) reads a file beside this one.
    """

    @cache
    def buffer(index):
        where = f"buffer {index}"
        spec = entry(document, "buffers", index, "a bufferView")
        length = whole(spec, "byteLength", where)
        uri = spec.get("uri")
        if uri is None:
            if index or blob is None:
                raise Mistake(f"{where} has no uri; export the file again, without compression")
            data = blob
        elif not isinstance(uri, str):
            raise Mistake(f"{where}: uri {shown(spec, 'uri')}; write a string")
        elif uri[:5].lower() == "data:":
            data = _embedded(uri, where)
        else:
            path = _relative(uri, where)
            if fetch is None:
                raise Mistake(f"{where} is the file '{path[:60]}'; put it beside this one")
            try:
                data = fetch(path)
            except Mistake as mistake:
                raise Mistake(f"{where}: {mistake}") from None
        if len(data) < length:
            what = f"{where} has {len(data)} bytes, but its byteLength is {length}: cut off"
            raise Mistake(f"{what}; export the file again")
        return memoryview(data)[:length]

    return buffer


def _embedded(uri, where):
    header, comma, body = uri.partition(",")
    try:
        if not comma:
            raise ValueError
        if header.lower().endswith(";base64"):
            return base64.b64decode(unquote(body), validate=True)
        return unquote_to_bytes(body)
    except ValueError:
        raise Mistake(f"{where}: its data: uri is damaged; export the file again") from None


def _relative(uri, where):
    """Return the path that `uri` spells, if it can only be a file in the folder of the document."""
    path = unquote(uri, errors="surrogateescape")
    outside = path.startswith("/") or ".." in path.split("/")
    if outside or _SCHEME.match(path) or _UNUSUAL.search(path):
        raise Mistake(f"{where}: uri '{uri[:60]}' is not read; put a file beside this one, name it")
    return path


def accessors(document, buffer):
    """Return a function from an accessor's index to its Accessor; `buffer` is as from buffers()."""
    patched = 0

    @cache
    def accessor(index):
        nonlocal patched
        where = f"accessor {index}"
        spec = entry(document, "accessors", index, "a primitive")
        component = whole(spec, "componentType", where)
        kind, normalized = spec.get("type"), spec.get("normalized", False)
        if component not in COMPONENTS:
            known = ", ".join(map(str, COMPONENTS))
            raise Mistake(f"{where}: componentType is {component}; write one of {known}")
        if not isinstance(kind, str) or kind not in _WIDTHS:
            known = ", ".join(_WIDTHS)
            raise Mistake(f"{where}: type {shown(spec, 'type')}; write one of {known}")
        if not isinstance(normalized, bool):
            raise Mistake(f"{where}: normalized {shown(spec, 'normalized')}; write true or false")
        code, width, stored = COMPONENTS[component], _WIDTHS[kind], "bufferView" in spec
        count, most = whole(spec, "count", where), check.MOST_CORNERS if stored else _MOST_ZEROS
        if not 1 <= count <= most:
            raise Mistake(f"{where}: count is {count}; write 1 to {most}")
        if stored:
            values = _view(document, buffer, spec, count, code, width, where)
        else:
            values = np.broadcast_to(np.zeros((), code), (count, width))  # takes no memory
        at, patches = np.empty(0, np.int64), values[:0]
        if "sparse" in spec:
            sparse, where = child(spec, "sparse", where), f"{where}, sparse"
            replaced = whole(sparse, "count", where)
            if not 1 <= replaced <= count:
                raise Mistake(f"{where}: count is {replaced}; write 1 to {count}")
            patched += replaced
            if patched > check.MOST_CORNERS:  # small files can have many that share their bytes
                raise Mistake(f"{where}: over {check.MOST_CORNERS} values replaced; simplify it")
            at = _increasing(document, buffer, sparse, replaced, count, where)
            patches = child(sparse, "values", where)
            patches = _view(document, buffer, patches, replaced, code, width, where)
        return Accessor(f"accessor {index}", values, code, normalized, stored, at, patches)

    return accessor


def _increasing(document, buffer, sparse, replaced, count, where):
    """Return the (replaced,) int64 rows, from 0 to count - 1, that a sparse accessor replaces."""
    spec = child(sparse, "indices", where)
    code = COMPONENTS.get(whole(spec, "componentType", where))
    if code not in INDEX_CODES:
        raise Mistake(f"{where}: componentType of indices; write 5121, 5123 or 5125")
    at = _view(document, buffer, spec, replaced, code, 1, where)[:, 0].astype(np.int64)
    if at[-1] >= count or (np.diff(at) <= 0).any():
        raise Mistake(f"{where}: indices do not increase from 0 up to {count - 1}; sort them")
    return at


def _view(document, buffer, spec, count, code, width, where):
    """Return the (count, width) array, without a copy, that `spec` finds in its bufferView."""
    index = whole(spec, "bufferView", where)
    view, label = entry(document, "bufferViews", index, where), f"bufferView {index}"
    start, length = whole(view, "byteOffset", label, 0), whole(view, "byteLength", label)
    data = buffer(whole(view, "buffer", label))
    if start + length > len(data):
        what = f"{label} ends at byte {start + length} of a buffer of {len(data)} bytes"
        raise Mistake(f"{what}; export the file again")
    size = np.dtype(code).itemsize
    step = whole(view, "byteStride", label, size * width)
    if not size * width <= step <= 252:  # the most that glTF allows
        raise Mistake(f"{label}: byteStride is {step}; write {size * width} to 252")
    offset = whole(spec, "byteOffset", where, 0)
    end = offset + step * (count - 1) + size * width
    if end > length:
        what = f"{where}: {count} values end at byte {end} of the {length} of {label}"
        raise Mistake(f"{what}; export the file again")
    return np.ndarray((count, width), code, data, start + offset, (step, size))


def take(accessor, rows=None):
    """Return rows (or all) of an accessor as an array of its own, in the stored type."""
    if rows is None:
        taken = accessor.values.copy()
        taken[accessor.at] = accessor.patches
    else:
        taken = accessor.values[rows]
        if len(accessor.at):
            near = np.minimum(np.searchsorted(accessor.at, rows), len(accessor.at) - 1)
            hit = accessor.at[near] == rows
            taken[hit] = accessor.patches[near[hit]]
    return taken


def floats(taken, normalized):
    """Return stored values as float64; whole numbers that are normalized become -1 to 1."""
    values = check.float64(taken)
    if normalized and taken.dtype.kind != "f":
        values = np.maximum(values / np.iinfo(taken.dtype).max, -1.0)
    return values
