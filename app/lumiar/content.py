"""Which files a scene may open: those in its own folder, and others whose contents it knows."""

import os

from . import geometry
from .errors import Mistake
from .files import read_bytes

LIMIT = 1 << 20  # bytes of a shader or a scene
LARGE = ("mesh", "image")  # what may be larger than that
ENDINGS = {"mesh": geometry.FORMATS, "scene": ("",), "image": (".hdr",)}  # of a path of each kind


def confine(name, kind, folder, known, where):
    """Raise Mistake for a path outside the folder of a scene that does not know what is in it.

    kind is mesh, model, light, image or scene; known maps names to SHA-256; a name that is no path
    is not looked at.
    """
    if "\0" in name:
        raise Mistake(f"{where}{name!r}: no file has such a name")
    if not name.lower().endswith(ENDINGS.get(kind, (".glsl",))):
        return  # the name of something that comes with Lumiar, or a mistake told later
    path = os.path.abspath(os.path.join(folder, os.path.expanduser(name)))
    if inside(path, folder):
        return
    option = "--light environment:image=" if kind == "image" else f"--{kind}"
    advice = f"put it beside the scene, or name it on the command line with {option}"
    if name not in known:
        raise Mistake(f"{where}{name} lies outside the folder of the scene; {advice}")
    if known[name] != digest(path, kind):
        raise Mistake(f"{where}{name} is no longer what this scene was made with; {advice}")


def inside(path, folder):
    """Return whether a path lies in a folder, whatever links there are."""
    return os.path.realpath(path).startswith(os.path.join(os.path.realpath(folder), ""))


def digest(path, kind):
    """Return the SHA-256, in hexadecimal, of what a file and the buffers it names hold."""
    import hashlib

    limit = geometry.FILE_LIMIT if kind in LARGE else LIMIT
    data = read_bytes(path, limit, f"a {kind}" if kind != "image" else "an image")
    return hashlib.sha256(b"".join(geometry.file_parts(path, data))).hexdigest()
