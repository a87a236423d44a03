"""Bytes kept between runs under a key; every entry can be made again, so any may vanish."""

import contextlib
import mmap
import os
import struct
import time

from .files import cache_folder, write_whole

LIMIT = 1 << 30  # bytes; the oldest entries go when the cache grows beyond
_MAGIC = b"LUMIAR\x00\x03"
_SIZES = struct.Struct("=8s8Q")


def get(key):
    """Return the parts stored under `key` as memoryviews of a mapped file, or None."""
    with contextlib.suppress(OSError, ValueError, struct.error):
        with open(_path(key), "rb") as file:
            view = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        magic, *sizes = _SIZES.unpack_from(view)
        starts = [_SIZES.size + sum(sizes[:i]) for i in range(len(sizes))]
        own, *parts = (view[a : a + size] for a, size in zip(starts, sizes, strict=True))
        end = starts[-1] + sizes[-1]
        if magic == _MAGIC and own == repr(key).encode() and view[end:] == _check(view[:end]):
            return parts
    return None


def put(key, parts):
    """Store at most seven parts, bytes each, under `key`; do nothing where the disk refuses."""
    path = _path(key)
    parts = [repr(key).encode(), *parts, *[b""] * (7 - len(parts))]
    with contextlib.suppress(OSError):
        os.makedirs(os.path.dirname(path), exist_ok=True)
        _make_room(os.path.dirname(path))
        parts.insert(0, _SIZES.pack(_MAGIC, *map(len, parts)))
        write_whole(path, (*parts, _check(*parts)))


def fingerprint(data):
    """Return what tells the contents of one file from another's: length, CRC-32 and Adler-32.

    Not proof against malice, which would only spoil its own pictures, but 5 MB take 1 ms, and a
    cryptographic digest 8 ms with the import of its library.
    """
    from isal import isal_zlib

    return f"{len(data):x}-{isal_zlib.crc32(data):08x}{isal_zlib.adler32(data):08x}"


def _check(*parts):
    """Return the 4 bytes behind an entry, by which it is known to be whole: its CRC-32."""
    from isal import isal_zlib

    crc = 0
    for part in parts:
        crc = isal_zlib.crc32(part, crc)
    return crc.to_bytes(4, "little")


def _path(key):
    return os.path.join(cache_folder(), f"{fingerprint(repr(key).encode())}.bin")


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
