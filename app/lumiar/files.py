"""Where Lumiar's files lie, and writing one whole or not at all."""

import contextlib
import itertools
import mmap
import os
import sys

from .errors import Mistake


def _find_root():
    """Return the folder that holds glsl/ and assets/: the installed package, or the checkout."""
    package = os.path.dirname(os.path.abspath(__file__))
    installed = os.path.isdir(os.path.join(package, "glsl"))
    return package if installed else os.path.dirname(os.path.dirname(package))


ROOT = _find_root()
GLSL = os.path.join(ROOT, "glsl")
ASSETS = os.path.join(ROOT, "assets")


def shortened(message):
    """Return a message with the paths of shipped shaders and of this folder made short."""
    for folder in (GLSL, os.getcwd()):
        message = message.replace(folder + os.sep, "")
    return message


def cache_folder():
    """Return the folder for what can be made again at any time; it need not exist yet."""
    if os.name == "nt":
        base = os.environ.get("LOCALAPPDATA") or os.path.expanduser("~")
    elif sys.platform == "darwin":
        base = os.path.expanduser("~/Library/Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return os.path.join(base, "lumiar")


def read_bytes(path, limit, what, mapped=False):
    """Return the bytes of `path`; raise Mistake, naming it, for anything but a file up to `limit`.

    Only a regular file is ever opened, so that a pipe or a device cannot stall the program. `what`
    says what to name instead, as in "a mesh file". If `mapped`, the bytes are a view of the file
    itself, which costs nothing until they are looked at.
    """
    import stat

    try:
        status = os.stat(path)
        if not stat.S_ISREG(status.st_mode):
            raise Mistake(f"{path}: not a regular file; name {what}")
        if status.st_size > limit:
            raise Mistake(f"{path}: {status.st_size} bytes; allowed for {what}: up to {limit}")
        with open(path, "rb") as file:
            if mapped and status.st_size:
                return memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
            return file.read(status.st_size)
    except FileNotFoundError:
        raise Mistake(f"{path}: no such file; name {what}") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise Mistake(f"{path}: cannot be read ({reason}); name {what}") from None


def read_beside(path, relative, limit, what):
    """Return the bytes of the file `relative` to the folder of `path`; see `read_bytes`.

    Raises Mistake for one that lies outside that folder, by `..`, an absolute path or a link.
    """
    folder = os.path.realpath(os.path.dirname(path))
    try:
        target = os.path.realpath(os.path.join(folder, relative))
        beside = os.path.commonpath((folder, target)) == folder
    except ValueError:  # a lone surrogate, or another drive
        beside = False
    if not beside:
        raise Mistake(f"{relative}: not in the folder of the file; put it beside the file")
    return read_bytes(target, limit, what)


def read_text(path, limit, what):
    """Return the text of `path`: UTF-8 without byte-order mark; see `read_bytes`.

    Raises Mistake naming file:line for a NUL byte or bytes that are not UTF-8.
    """
    data = read_bytes(path, limit, what)
    nul = data.find(b"\0")
    if nul >= 0:
        line = data.count(b"\n", 0, nul) + 1
        raise Mistake(f"{path}:{line}: holds a NUL byte; save it as plain UTF-8 text")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise Mistake(f"{path}:{line}: not UTF-8 text; save it with UTF-8 encoding") from None


def unused(stem, ending):
    """Return the first of `stem-001.ending`, `stem-002.ending`, … that is not there yet."""
    paths = (f"{stem}-{i:03}{ending}" for i in itertools.count(1))
    return next(path for path in paths if not os.path.lexists(path))


def write_whole(path, chunks):
    """Write the bytes of `chunks` to `path`, so that the file is there whole or not at all.

    The bytes go to a temporary file beside `path`, which then takes its place in one step; an
    existing file stays untouched until that moment. Raises OSError when the disk refuses.
    """
    folder, name = os.path.split(os.path.abspath(path))
    temporary = os.path.join(folder, f".{name[:200]}.{os.urandom(6).hex()}.tmp")
    announce(temporary)
    try:
        with open(temporary, "xb") as file:
            for chunk in chunks:
                file.write(chunk)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise


def python(*arguments):
    """Return (command, environment) of a Python with Lumiar in a process of its own.

    It takes no module from the folder that happens to be the current one.
    """
    ours = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    paths = os.pathsep.join(filter(None, (ours, os.environ.get("PYTHONPATH"))))
    environment = {key: value for key, value in os.environ.items() if key != "LUMIAR_SUPERVISOR"}
    return [sys.executable, "-P", *arguments], {**environment, "PYTHONPATH": paths}


def announce(message):
    """Tell the supervising process, if there is one, what to clean up should this one be killed."""
    channel = os.environ.get("LUMIAR_SUPERVISOR")
    if channel:
        os.write(int(channel), os.fsencode(message) + b"\0")
