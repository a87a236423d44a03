"""Pictures as bytes: PNG, Radiance .hdr and .npy, written row by row and read back."""

import os
import struct
import zlib

from .errors import Mistake

ENDINGS = (".png", ".hdr", ".npy")
PIXEL_LIMIT = 40_000_000  # of a picture that is read; a small file can claim to hold billions
FILE_LIMIT = 1 << 30


def ending(path):
    """Return the ending of a picture's path in lower case; raise Mistake if we cannot write it."""
    found = os.path.splitext(path)[1].lower()
    if found not in ENDINGS:
        raise Mistake(f"{path}: a picture ends in {', '.join(ENDINGS)}; write for instance out.png")
    return found


def png(size, strips, chunks=()):
    """Yield the bytes of a PNG; chunks are (type, contents) to put before the pixels.

    strips yields bytes of whole rows, top first, 3 bytes of sRGB per pixel.
    """
    from isal import isal_zlib  # at its fastest, five times as fast as zlib

    width, height = size
    row = 3 * width
    yield b"\x89PNG\r\n\x1a\n"
    yield _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    yield _chunk(b"sRGB", b"\0")
    for kind, contents in chunks:
        yield _chunk(kind, contents)
    packer = isal_zlib.compressobj(1)
    for strip in strips:
        rows = b"".join([b"\0" + strip[i : i + row] for i in range(0, len(strip), row)])
        yield _chunk(b"IDAT", packer.compress(rows))
    yield _chunk(b"IDAT", packer.flush())
    yield _chunk(b"IEND", b"")


def animated(size, frames, rate, chunks=()):
    """Yield the bytes of an animated PNG that runs for ever; see `png` for chunks.

    frames yields bytes of whole pictures, 3 bytes of sRGB per pixel; rate: of them in a second.
    (PNG, third edition, W3C 2025, 11.3.3.)
    """
    from isal import isal_zlib

    (width, height), row, number, packed = size, 3 * size[0], 0, []
    for pixels in frames:
        rows = b"".join([b"\0" + pixels[i : i + row] for i in range(0, len(pixels), row)])
        packed.append(isal_zlib.compress(rows, 3))
    yield b"\x89PNG\r\n\x1a\n"
    yield _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    yield _chunk(b"sRGB", b"\0")
    yield _chunk(b"acTL", struct.pack(">II", len(packed), 0))
    for kind, contents in chunks:
        yield _chunk(kind, contents)
    for i, data in enumerate(packed):
        place = struct.pack(
            ">IIIIIHHBB", number, width, height, 0, 0, 1000, round(1e3 * rate), 0, 0
        )
        yield _chunk(b"fcTL", place)
        yield _chunk(b"fdAT", struct.pack(">I", number + 1) + data) if i else _chunk(b"IDAT", data)
        number += 2 if i else 1
    yield _chunk(b"IEND", b"")


def npy(size, strips):
    """Yield the bytes of a NumPy array (height, width, 3) float32; strips as in `hdr`."""
    shape = f"({size[1]}, {size[0]}, 3)"
    header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    yield b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
    yield from strips


def hdr(size, strips):
    """Yield the bytes of a Radiance picture (G. Ward, "Real pixels", Graphics Gems II, 1991).

    strips yields bytes of whole rows, top first, 3 little-endian float32 of radiance per pixel.
    What its 8 bits of exponent cannot hold is clipped; a NaN becomes magenta.
    """
    import numpy as np

    width, height = size
    yield f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode()
    for strip in strips:
        rgb = np.frombuffer(strip, "<f4").reshape(-1, 3).astype(np.float64)
        rgb = np.where(np.isfinite(rgb).all(1, keepdims=True), rgb, [1.0, 0.0, 1.0])
        rgb = np.clip(rgb, 0.0, 255.0 / 256.0 * 2.0**127)
        largest = rgb.max(1)
        exponent = np.frexp(largest)[1]
        scale = np.where(largest >= 1e-32, np.exp2(8.0 - exponent), 0.0)
        pixels = np.empty((len(rgb), 4), np.uint8)
        pixels[:, :3] = rgb * scale[:, None]
        pixels[:, 3] = np.where(largest >= 1e-32, exponent + 128, 0)
        for row in pixels.reshape(-1, width, 4):
            yield _hdr_row(row)


def webp(pixels, quality):
    """Return the bytes of a WebP of pixels (height, width, 3) uint8 of sRGB; quality up to 100."""
    import io

    from PIL import Image

    data = io.BytesIO()
    Image.fromarray(pixels).save(data, "WEBP", quality=quality, method=6)
    return data.getvalue()


def read(path):
    """Return (array (height, width, 3) float32, whether it is linear radiance) of a picture.

    An 8-bit PNG or JPEG gives sRGB values in [0, 1]; .hdr and .npy give radiance. Raises Mistake
    for what is no picture, too large, or damaged.
    """
    import numpy as np

    from .files import read_bytes

    data = read_bytes(path, FILE_LIMIT, "a picture")
    kind = os.path.splitext(path)[1].lower()
    try:
        if kind == ".npy":
            pixels = _read_npy(data)
        elif kind == ".hdr":
            pixels = _read_hdr(data)
        else:
            pixels = _read_display(data, path)
    except (ValueError, IndexError, SyntaxError, struct.error, zlib.error, OSError) as error:
        raise Mistake(f"{path}: not a picture that can be read: {error}") from None
    if pixels.ndim != 3 or pixels.shape[2] != 3:
        raise Mistake(f"{path}: shape {pixels.shape}; a picture is (height, width, 3)")
    with np.errstate(over="ignore"):  # beyond float32 is infinite, and told as such
        return pixels.astype(np.float32), kind in (".npy", ".hdr")


def _chunk(kind, contents):
    check = zlib.crc32(contents, zlib.crc32(kind))
    return struct.pack(">I", len(contents)) + kind + contents + struct.pack(">I", check)


def _hdr_row(row):
    """Return one row of (width, 4) bytes: the run-length form with runs of literals only."""
    width = len(row)
    if not 8 <= width <= 32767:  # the run-length form cannot say these widths
        return row.tobytes()
    out = [struct.pack(">BBH", 2, 2, width)]
    for channel in row.T:
        for start in range(0, width, 128):
            run = channel[start : start + 128].tobytes()
            out.append(bytes([len(run)]) + run)
    return b"".join(out)


def _read_npy(data):
    import io
    import warnings

    import numpy as np

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            array = np.load(io.BytesIO(data), allow_pickle=False)
        except Exception:  # of a damaged header it raises whatever its parser raised
            raise ValueError("damaged, or no .npy at all") from None
    if not isinstance(array, np.ndarray):
        raise ValueError("it is an .npz, of several arrays; save the picture alone, as .npy")
    if array.dtype.kind not in "fiu":
        raise ValueError(f"it holds {array.dtype}, not numbers")
    return array


def _read_hdr(data):
    import numpy as np

    head, _, body = data.partition(b"\n\n")
    size, _, body = body.partition(b"\n")
    words = size.split()
    if not head.startswith(b"#?") or len(words) != 4 or (words[0], words[2]) != (b"-Y", b"+X"):
        raise ValueError("not a Radiance file with rows from the top")
    height, width = int(words[1]), int(words[3])
    exposure = _hdr_exposure(head)
    if not 0 < height * width <= PIXEL_LIMIT:
        raise ValueError(f"{width} x {height} pixels; allowed: up to {PIXEL_LIMIT} in all")
    pixels, at = np.empty((height, width, 4), np.uint8), 0
    for y in range(height):
        if not 8 <= width <= 32767 or body[at : at + 2] != b"\x02\x02":
            pixels[y] = np.frombuffer(body, np.uint8, 4 * width, at).reshape(width, 4)
            at += 4 * width
            continue
        at += 4
        for channel in range(4):
            x = 0
            while x < width:
                count = body[at]
                run = count - 128 if count > 128 else count
                values = body[at + 1 : at + 2] if count > 128 else body[at + 1 : at + 1 + run]
                if not 0 < run <= width - x or not values:
                    raise ValueError(f"row {y + 1} is damaged")
                pixels[y, x : x + run, channel] = np.frombuffer(values, np.uint8)
                at += 1 + len(values)
                x += run
    scale = np.where(pixels[..., 3] > 0, np.exp2(pixels[..., 3].astype(np.float64) - 136.0), 0.0)
    return pixels[..., :3] * (scale / exposure)[..., None]


def _hdr_exposure(head):
    """Return the factor that the values of a Radiance picture were multiplied by, by its header."""
    said = [line.split(b"=", 1) for line in head.split(b"\n") if b"=" in line]
    said = [(key.strip(), value.strip()) for key, value in said]
    form = next((value for key, value in said if key == b"FORMAT"), b"32-bit_rle_rgbe")
    if form != b"32-bit_rle_rgbe":
        raise ValueError(f"holds {form.decode(errors='replace')}; convert it to 32-bit_rle_rgbe")
    exposure = 1.0
    for key, value in said:
        exposure *= float(value) if key == b"EXPOSURE" else 1.0
    if not 1e-30 < exposure < 1e30:
        raise ValueError(f"EXPOSURE={exposure:g} is no factor")
    return exposure


def _read_display(data, path):
    import io
    import warnings

    import numpy as np
    from PIL import Image, UnidentifiedImageError

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        try:
            picture = Image.open(io.BytesIO(data), formats=["PNG", "JPEG"])
        except UnidentifiedImageError:
            raise ValueError("neither PNG nor JPEG, .hdr nor .npy") from None
        except Image.DecompressionBombError:
            raise ValueError(f"more than {PIXEL_LIMIT} pixels") from None
        if picture.width * picture.height > PIXEL_LIMIT:
            size = f"{picture.width} x {picture.height}"
            raise Mistake(f"{path}: {size} pixels; allowed: up to {PIXEL_LIMIT} in all")
        if picture.mode.startswith("I"):  # 16 bits of grey, which Pillow would cut off at 255
            grey = np.asarray(picture, np.float32) / 65535.0
            return np.repeat(grey[..., None], 3, axis=2)
        return np.asarray(picture.convert("RGB"), np.float32) / 255.0
