"""Bytes kept between runs under a key; every entry can be made again, so any may vanish."""

import contextlib
import mmap
import os
import struct
import time

from .files import cache_folder, write_whole

LIMIT = 1 << 30  # bytes; the oldest entries go when the cache grows beyond
_MAGIC = b"LUMIAR\x00\x02"
_SIZES = struct.Struct("=8s8Q")


def get(key):
    """Return the parts stored under `key` as memoryviews of a mapped file, or None."""
    with contextlib.suppress(OSError, ValueError, struct.error):
        with open(_path(key), "rb") as file:
            view = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        magic, *sizes = _SIZES.unpack_from(view)
        end = _SIZES.size + sum(sizes)
        if magic == _MAGIC == view[end:]:  # the closing mark stands only in an entry that is whole
            starts = [_SIZES.size + sum(sizes[:i]) for i in range(len(sizes))]
            return [view[a : a + size] for a, size in zip(starts, sizes, strict=True)]
    return None


def put(key, parts):
    """Store at most eight parts, bytes each, under `key`; do nothing where the disk refuses."""
    path = _path(key)
    parts = [*parts, *[b""] * (8 - len(parts))]
    with contextlib.suppress(OSError):
        os.makedirs(os.path.dirname(path), exist_ok=True)
        _make_room(os.path.dirname(path))
        write_whole(path, (_SIZES.pack(_MAGIC, *map(len, parts)), *parts, _MAGIC))


def digest(*parts):
    """Return the SHA-256 of bytes, in hexadecimal."""
    import hashlib

    total = hashlib.sha256()
    for part in parts:
        total.update(part)
    return total.hexdigest()


def _path(key):
    return os.path.join(cache_folder(), f"{digest(repr(key).encode())[:40]}.bin")


def _make_room(folder):
    """Delete what interrupted runs left behind, and the oldest entries beyond LIMIT."""
    entries = []
    for entry in os.scandir(folder):
        with contextlib.suppress(OSError):  # another process may be tidying up too
            status = entry.stat()
            if entry.name.endswith(".tmp") and time.time() - status.st_mtime > 3600:
                os.unlink(entry.path)
            elif entry.name.endswith(".bin"):
                entries.append((status.st_mtime, status.st_size, entry.path))
    total = sum(size for _, size, _ in entries)
    for _, size, path in sorted(entries):
        if total > LIMIT:
            total -= size
            with contextlib.suppress(OSError):
                os.unlink(path)
