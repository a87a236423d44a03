"""The meshes a scene can name, ready to draw: built-in shapes and files, cached once prepared."""

import contextlib
import os
import struct
import sys
from typing import NamedTuple

from . import cache
from .errors import Mistake, nearest
from .files import ASSETS, read_beside, read_bytes
from .parameter import Parameter

FORMATS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
FILE_LIMIT = 512 << 20  # bytes of a mesh file
TINY = 1e-18  # radius of a mesh whose squares still are normal floats
_FACTS = struct.Struct("=10dQ?")  # low, high, centre, radius; places; closed


def _count(name, default, low, high, text):
    return Parameter(name, "int", default, low=low, high=high, text=text)


def _length(name, default, text):
    return Parameter(name, "float", default, low=1e-6, high=1e6, text=text, unit="m")


SHAPES = {
    "sphere": (
        _count("subdivision", 5, 0, 9, "times each face of an icosahedron is split in four"),
        _length("radius", 1.0, "radius"),
    ),
    "uv_sphere": (
        _count("rings", 64, 2, 2048, "rows from pole to pole"),
        _count("segments", 128, 3, 4096, "columns around the axis"),
        _length("radius", 1.0, "radius"),
    ),
    "torus": (
        _length("major", 1.0, "from the axis to the middle of the tube"),
        _length("minor", 0.4, "radius of the tube"),
        _count("rings", 128, 3, 4096, "steps around the axis"),
        _count("segments", 64, 3, 2048, "steps around the tube"),
    ),
    "torus_knot": (
        _count("p", 2, 1, 16, "turns around the axis"),
        _count("q", 3, 1, 16, "turns around the ring"),
        _length("tube", 0.2, "radius of the tube"),
        _count("rings", 512, 3, 8192, "steps along the knot"),
        _count("segments", 48, 3, 1024, "steps around the tube"),
    ),
    "plane": (
        _length("width", 2.0, "side"),
        _count("segments", 1, 1, 2048, "steps along each side"),
    ),
    "box": (
        _length("width", 2.0, "side"),
        _count("segments", 1, 1, 512, "steps along each side"),
    ),
    "cylinder": (
        _length("radius", 1.0, "radius"),
        _length("height", 2.0, "height"),
        _count("segments", 128, 3, 4096, "steps around the axis"),
    ),
    "teapot": (_count("segments", 16, 1, 128, "steps along each side of a Bézier patch"),),
}


_ENDS = {"subdivision": 7, "p": 8, "q": 8, "rings": 512, "segments": 256}  # of sliders


class Geometry(NamedTuple):
    """A mesh as the graphics card takes it, and what is known of it.

    vertices  bytes: per vertex the position and the unit normal, 6 float32
    tangents  bytes: per vertex the unit tangent and the sign of the bitangent, 4 float32; or empty
    indices   bytes: 3 uint32 per triangle, counter-clockwise seen from outside
    low, high corners of the box around it; centre, radius of a sphere around it
    places    number of distinct positions
    closed    whether back faces can never be seen
    notes     what was repaired
    """

    vertices: object
    tangents: object
    indices: object
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    centre: tuple[float, float, float]
    radius: float
    places: int
    closed: bool
    notes: tuple[str, ...] = ()

    @property
    def triangle_count(self):
        """The number of triangles drawn."""
        return len(self.indices) // 12

    @property
    def vertex_count(self):
        """The number of vertices drawn; a position counts once for each normal that it has."""
        return len(self.vertices) // 24


def shipped():
    """Return the mesh files that come with Lumiar, {name: path}."""
    folder = os.path.join(ASSETS, "meshes")
    files = (f for f in sorted(os.listdir(folder)) if f.endswith(FORMATS))
    return {os.path.splitext(f)[0]: os.path.join(folder, f) for f in files}


def resolve(spec, folder, where=""):
    """Return (shape or None, {parameter: value}, path or None) for what a scene calls a mesh.

    spec is a built-in shape with parameters after colons (`torus:minor=0.3`), the name of a mesh
    that comes with Lumiar, or a path, relative to `folder`. Raises Mistake, beginning with `where`.
    """
    name, *settings = spec.split(":")
    if name in SHAPES:
        return name, _settings(name, settings, where), None
    ours = shipped()
    if spec in ours:
        return None, {}, ours[spec]
    if not spec.lower().endswith(FORMATS):
        advice = f"or a file that ends in {', '.join(FORMATS)}"
        raise Mistake(f"{where}no mesh '{spec}'; {nearest(name, [*SHAPES, *ours])}, {advice}")
    path = os.path.abspath(os.path.join(folder, os.path.expanduser(spec)))
    if not os.path.exists(path):
        raise Mistake(f"{where}no file {path}; name a mesh file, or one of {', '.join(SHAPES)}")
    return None, {}, path


def canonical(spec, folder, where=""):
    """Return the one way to write a mesh down: a file by its full path, the others as they are."""
    shape, _, path = resolve(spec, folder, where)
    return spec if shape or spec in shipped() else path


def _settings(name, settings, where):
    values = {parameter.name: parameter.default for parameter in SHAPES[name]}
    for setting in settings:
        key, _, text = setting.partition("=")
        if key not in values:
            raise Mistake(f"{where}{name} has no parameter '{key}'; {nearest(key, values)}")
        parameter = next(p for p in SHAPES[name] if p.name == key)
        values[key] = parameter.read(text, f"{where}{name}: ")
    return values


def shape(spec):
    """Return {parameter: value} of a built-in shape as a scene calls it; {} of a mesh file."""
    name, *given = spec.split(":")
    return _settings(name, given, "") if name in SHAPES else {}


def reshaped(spec, key, value, where=""):
    """Return what a scene calls a built-in shape with one parameter changed; raise Mistake."""
    name, values = spec.partition(":")[0], shape(spec)
    own = _parameter(spec, key)
    check = own.read if isinstance(value, str) else own.check
    values[key] = check(value, f"{where}{name}: ")
    changed = ((p.name, values[p.name]) for p in SHAPES[name] if values[p.name] != p.default)
    return ":".join([name, *(f"{key}={value!r}" for key, value in changed)])


def slider(spec, key):
    """Return the Parameter of a built-in shape over a useful range; typed values may go on."""
    one = _parameter(spec, key)
    if one.type == "int":
        return one._replace(high=min(one.high, _ENDS[key]), open=(False, True))
    return one._replace(low=0.05 * one.default, high=4.0 * one.default, open=(True, True))


def _parameter(spec, key):
    return next(p for p in SHAPES[spec.partition(":")[0]] if p.name == key)


def load(spec, folder="", crease=None, tangents=False, where=""):
    """Return the Geometry of what a scene calls a mesh; see `resolve`.

    crease is the angle in degrees beyond which an edge stays sharp; None keeps the normals that the
    file has. A mesh prepared once comes from the cache, mapped into memory, in a millisecond
    besides the reading of the file. Raises Mistake naming the file and the place in it.
    """
    shape, values, path = resolve(spec, folder, where)
    data = read_bytes(path, FILE_LIMIT, "a mesh file", mapped=True) if path else b""
    contents = [cache.fingerprint(part) for part in file_parts(path, data)] if path else []
    key = (shape, values, path and path[-4:], contents, crease, tangents, _code_version())
    parts = cache.get((*key, sys.byteorder))
    if parts:
        *numbers, places, closed = _FACTS.unpack(parts[3])
        notes = tuple(filter(None, bytes(parts[4]).decode().split("\n")))
        return Geometry(*parts[:3], *_vectors(numbers), places, closed, notes)
    g = prepare(read_mesh(shape, values, path, data, crease), tangents, path or shape)
    facts = _FACTS.pack(*g.low, *g.high, *g.centre, g.radius, g.places, g.closed)
    parts = (g.vertices, g.tangents, g.indices, facts, "\n".join(g.notes).encode())
    cache.put((*key, sys.byteorder), parts)
    return g


def _vectors(numbers):
    return tuple(numbers[:3]), tuple(numbers[3:6]), tuple(numbers[6:9]), numbers[9]


def read_mesh(shape, values, path, data, crease):
    """Return the mesh.Mesh of a built-in shape, or of the contents of a file."""
    from . import formats, mesh, shapes  # and NumPy with them, which a cached mesh does without

    if shape:
        return shapes.make(shape, values)
    return mesh.build(mesh.brought_near(formats.parse(bytes(data), path)), crease, path)


def prepare(mesh, tangents, name):
    """Return the Geometry of a mesh.Mesh, with tangents where wanted."""
    import numpy as np

    from .mesh import tangent_frames, weld

    vertices = np.concatenate([mesh.positions, mesh.normals], axis=1).astype(np.float32)
    if not np.isfinite(vertices).all():
        raise Mistake(f"{name}: positions beyond the range of a 32-bit float; scale the mesh down")
    along = tangent_frames(mesh).astype(np.float32).tobytes() if tangents else b""
    p = vertices[:, :3].astype(np.float64)
    low, high = p.min(0), p.max(0)
    centre = (low + high) / 2.0
    radius = float(np.sqrt(((p - centre) ** 2).sum(1).max()))
    if radius < TINY:
        raise Mistake(f"{name}: smaller than {TINY:g}, the least a 32-bit float resolves; scale up")
    return Geometry(
        vertices.tobytes(),
        along,
        mesh.triangles.astype(np.uint32).tobytes(),
        *_vectors([*low.tolist(), *high.tolist(), *centre.tolist(), radius]),
        int(weld(mesh.positions).max()) + 1,
        mesh.closed,
        mesh.notes,
    )


def file_parts(path, data):
    """Return the bytes that a mesh file consists of: its own, and those of the buffers it names."""
    parts = [data]
    if path.lower().endswith((".gltf", ".glb")):
        from urllib.parse import unquote

        for uri in _buffers(path, data):
            with contextlib.suppress(Mistake):  # the reader will tell what is wrong with it
                name = unquote(uri, errors="surrogateescape")
                parts.append(read_beside(path, name, FILE_LIMIT, "a buffer"))
    return parts


def _buffers(path, data):
    """Return the addresses of the buffers that a glTF file names; none where it is damaged."""
    import json

    if path.lower().endswith(".glb"):  # its first chunk; the rest may be half a gigabyte
        data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    try:
        buffers = json.loads(bytes(data).decode("utf-8-sig"))["buffers"]
        uris = [buffer.get("uri") for buffer in buffers]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return []
    return [uri for uri in uris if isinstance(uri, str) and not uri.startswith("data:")]


def _code_version():
    """Return what changes when the code that prepares meshes does."""
    here = os.path.dirname(os.path.abspath(__file__))
    folder = os.path.join(here, "formats")
    files = [os.path.join(folder, f) for f in sorted(os.listdir(folder)) if f.endswith(".py")]
    files += [os.path.join(here, f"{f}.py") for f in ("geometry", "mesh", "polygons", "shapes")]
    files.append(os.path.join(ASSETS, "meshes", "teapot.patches"))
    return [(status.st_size, status.st_mtime_ns) for status in map(os.stat, files)]
