"""Mesh files: read(path) returns the polygons of an OBJ, PLY, STL, OFF or glTF file."""

import os
from importlib import import_module

from lumiar.errors import Mistake
from lumiar.files import read_beside, read_bytes

LARGEST = 512 << 20  # bytes of a file, or of all the files beside a .gltf
_READERS = {
    ".obj": "obj",
    ".ply": "ply",
    ".stl": "stl",
    ".off": "off",
    ".gltf": "gltf",
    ".glb": "gltf",
}


def read(path):
    """Return the Polygons of the mesh file at `path`, read by the reader for its extension.

    Raises a Mistake, one line that names the file, for all that is not a complete mesh.
    """
    name = os.fsdecode(path)
    return parse(read_bytes(os.path.expanduser(name), LARGEST, "a mesh file"), name)


def parse(data, name):
    """Return the Polygons of `data`, the contents (bytes) of the mesh file `name`; see read."""
    path = os.path.expanduser(name)
    module = _READERS.get(os.path.splitext(path)[1].lower())
    if module is None:
        formats = ", ".join(_READERS)
        raise Mistake(f"{name}: no format that is read here; convert it to one of {formats}")
    if len(data) == 0:
        raise Mistake(f"{name}: the file is empty; export it again")
    reader = import_module(f"lumiar.formats.{module}")  # one reader takes 5 to 15 ms
    try:
        return reader.read(data, name, *([_siblings(path)] if module == "gltf" else []))
    except MemoryError:
        raise Mistake(f"{name}: too large for the memory here; simplify the mesh") from None


def _siblings(path):
    """Return a function from a relative path to the bytes of that file beside the one at `path`."""
    fetched = {}

    def fetch(relative):
        relative = os.path.normpath(relative)
        if relative not in fetched:
            left = LARGEST - sum(map(len, fetched.values()))
            fetched[relative] = read_beside(path, relative, left, "a buffer")
        return fetched[relative]

    return fetch
