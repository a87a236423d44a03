"""Mesh files: read(path) returns the polygons of an OBJ, PLY, STL, OFF or glTF file."""

import os
import stat
from importlib import import_module

from lumiar.formats import check

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
    return parse(_load(os.path.expanduser(name), name), name)


def parse(data, name):
    """Return the Polygons of `data`, the contents (bytes) of the mesh file `name`; see read."""
    path = os.path.expanduser(name)
    module = _READERS.get(os.path.splitext(path)[1].lower())
    if module is None:
        what = f"no format that is read here; convert it to one of {', '.join(_READERS)}"
        raise check.mistake(name, what)
    if len(data) == 0:
        raise check.mistake(name, "the file is empty; export it again")
    reader = import_module(f"lumiar.formats.{module}")  # one reader takes 5 to 15 ms
    try:
        return reader.read(data, name, *([_siblings(path)] if module == "gltf" else []))
    except MemoryError:
        raise check.mistake(name, "too large for the memory here; simplify the mesh") from None


def _load(path, name, most=LARGEST):
    """Return the bytes of the regular file at `path`, at most `most` of them."""
    try:
        status = os.stat(path)  # before opening: to open a pipe may wait for ever
        if not stat.S_ISREG(status.st_mode):
            raise check.mistake(name, "not a regular file; give the path of a mesh file")
        if status.st_size > most:
            what = f"{status.st_size >> 20} MiB, but at most {most >> 20} MiB are read; simplify it"
            raise check.mistake(name, what)
        with open(path, "rb") as file:
            return file.read(status.st_size)
    except (OSError, ValueError) as error:  # ValueError: a path with a NUL or a lone surrogate
        reason = getattr(error, "strerror", None) or "not a possible path"
        raise check.mistake(name, f"cannot be read ({reason}); check the path") from None


def _siblings(path):
    """Return a function from a relative path to the bytes of that file beside the one at `path`."""
    folder = os.path.realpath(os.path.dirname(path))
    fetched = {}

    def fetch(relative):
        try:
            target = os.path.realpath(os.path.join(folder, relative))
            beside = os.path.commonpath((folder, target)) == folder
        except ValueError:  # a lone surrogate, or another drive
            beside = False
        if not beside:
            raise check.mistake(relative, "not in the folder of the file; put it beside the file")
        if target not in fetched:
            left = LARGEST - sum(map(len, fetched.values()))
            fetched[target] = _load(target, relative, left)
        return fetched[target]

    return fetch
