"""glTF 2.0, .gltf and .glb: the triangles of the default scene."""

import json
import re
import struct
from collections import Counter

import numpy as np

from lumiar.errors import Mistake
from lumiar.formats import check, gltf_scene, text

_LARGEST_JSON = 64 << 20  # bytes
_MOST_OBJECTS = 2_000_000  # objects and lists of the JSON: each takes some 200 bytes as Python's
_JSON, _BIN = 0x4E4F534A, 0x004E4942


def read(data, name, fetch=None):
    """Return the Polygons of the glTF file `name`, JSON or binary, that holds `data` (bytes).

    fetch(path) returns the bytes of a file in the same folder. Texture coordinates are turned to
    have v upwards, as in the other formats. Raises a Mistake for a file that is not complete, or
    needs what is not read here.
    """
    notes = []
    raw, blob = _chunks(data, name, notes) if data.startswith(b"glTF") else (data, None)
    document = _document(raw, name, notes, binary=raw is not data)
    try:
        piece = gltf_scene.read(document, blob, fetch, notes)
    except Mistake as mistake:
        raise check.mistake(name, str(mistake)) from None
    sizes = np.full(len(piece.corners) // 3, 3)
    notes = list(dict.fromkeys(notes))
    return check.polygons(
        name,
        piece.positions,
        piece.corners,
        sizes,
        piece.normals,
        piece.normal_of,
        piece.uvs,
        piece.uv_of,
        notes,
    )


def _chunks(data, name, notes):
    """Return the JSON bytes and the binary chunk (or None) of a .glb."""
    if len(data) < 20:
        raise check.mistake(name, f"cut off after {len(data)} bytes; export the file again")
    version, length, size, kind = struct.unpack_from("<4I", data, 4)
    if version != 2:
        raise check.mistake(name, f"binary glTF version {version} (byte 4); export it as glTF 2.0")
    if length > len(data) or 20 + size > length:
        what = f"cut off: {len(data)} bytes of {max(length, 20 + size)}; export the file again"
        raise check.mistake(name, what)
    _check_size(size, name)
    if kind != _JSON:
        raise check.mistake(name, "the first chunk is not JSON (byte 16); export the file again")
    if length < len(data):
        notes.append(f"{len(data) - length} bytes after the end ignored")
    raw, at, blob = data[20 : 20 + size], 20 + size, None
    if at + 8 <= length:
        size, kind = struct.unpack_from("<2I", data, at)
        if at + 8 + size > length:
            what = f"the chunk at byte {at} has {length - at - 8} bytes of {size}: cut off"
            raise check.mistake(name, f"{what}; export the file again")
        if kind == _BIN:
            blob = memoryview(data)[at + 8 : at + 8 + size]
    return raw.rstrip(b"\0"), blob


def _check_size(size, name):
    if size > _LARGEST_JSON:
        what = f"{size >> 20} MiB of JSON, but at most {_LARGEST_JSON >> 20} are read"
        raise check.mistake(name, f"{what}; export as .glb, with a binary buffer")


def _document(raw, name, notes, binary):
    """Return the JSON object that `raw` spells."""

    def fail(at, what):
        if binary:
            return check.mistake(name, f"JSON chunk, line {text.line(raw, at)}: {what}")
        return text.fail(name, raw, at, what)

    _check_size(len(raw), name)
    if raw.count(b"{") + raw.count(b"[") > _MOST_OBJECTS:
        raise check.mistake(name, f"over {_MOST_OBJECTS} JSON objects and lists; simplify the file")
    mark = raw.startswith(b"\xef\xbb\xbf")
    if mark:
        notes.append("byte-order mark skipped")
    try:
        spelled = raw[3 * mark :].decode("utf-8")
        document = json.loads(spelled, parse_constant=_refuse, object_pairs_hook=_object)
    except UnicodeDecodeError as error:
        raise fail(3 * mark + error.start, "not UTF-8 text; export the file again") from None
    except json.JSONDecodeError as error:
        at = 3 * mark + len(spelled[: error.pos].encode())
        raise fail(at, f"JSON: {error.msg}; correct it or export the file again") from None
    except RecursionError:
        raise fail(0, "JSON nested too deeply; export the file again") from None
    except Mistake as mistake:
        raise check.mistake(name, str(mistake)) from None
    except ValueError:  # _refuse, or Python's own of a number of thousands of digits
        odd = re.search(rb"(?<![\w\"])(?:-?Infinity|NaN|-?\d{4300})", raw)
        what = "JSON: NaN, Infinity or thousands of digits; write a finite number"
        raise fail(odd.start() if odd else 0, what) from None
    if not isinstance(document, dict):
        raise fail(0, "JSON, but no object {...}; export the file again")
    return document


def _refuse(constant):
    raise ValueError(constant)


def _object(pairs):
    found = dict(pairs)
    if len(found) < len(pairs):
        twice = Counter(key for key, _ in pairs).most_common(1)[0][0]
        raise Mistake(f"JSON: the key '{twice[:40]}' twice in one object; keep one of them")
    return found
