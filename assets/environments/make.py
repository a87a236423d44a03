"""Write the .hdr files here from the npm package that SOURCES.md names.

python make.py FOLDER, that of the unpacked package; needs mitsuba, which reads EXR.
"""

import base64
import re
import sys
import tempfile
from pathlib import Path

import mitsuba
import numpy as np

HERE = Path(__file__).parent
NAMES = ("studio", "venice")
WIDTH, HEIGHT = 384, 192


def decoded(path):
    """Return the pixels (height, width, 3) of an EXR file that a JavaScript module holds."""
    text = re.search(r"base64,([A-Za-z0-9+/=]+)", path.read_text()).group(1)
    mitsuba.set_variant("scalar_rgb")
    with tempfile.NamedTemporaryFile(suffix=".exr") as file:
        file.write(base64.b64decode(text))
        file.flush()
        bitmap = mitsuba.Bitmap(file.name)
    form = (mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False)
    return np.array(bitmap.convert(*form)).astype(float)


def smaller(pixels, count, axis):
    """Return means over `count` equal widths along an axis."""
    pixels = np.moveaxis(pixels, axis, 0)
    ends = np.arange(count + 1) * len(pixels) / count
    sums = np.concatenate([pixels[:1] * 0.0, np.cumsum(pixels, 0)])
    whole = np.minimum(ends.astype(int), len(pixels) - 1)
    part = (ends - whole).reshape(-1, *[1] * (pixels.ndim - 1))
    means = np.diff(sums[whole] + part * pixels[whole], axis=0) * (count / len(pixels))
    return np.moveaxis(means, 0, axis)


def rgbe(pixels):
    """Return (height, width, 4) bytes (G. Ward, "Real pixels", Graphics Gems II, 1991), rounded."""
    largest = np.maximum(pixels.max(axis=2), 1e-30)
    exponent = np.frexp(largest * 256.0 / 255.5)[1]  # so that nothing rounds up to 256
    mantissas = np.floor(pixels * np.exp2(8.0 - exponent)[..., None] + 0.5)
    return np.concatenate([mantissas, exponent[..., None] + 128.0], axis=2).astype(np.uint8)


def packed(values):
    """Return bytes in the run-length form of Radiance: a run of at least 4, or literals."""
    runs, start = [], 0
    for i in range(1, len(values) + 1):
        if i == len(values) or values[i] != values[start] or i - start == 127:
            runs.append((values[start], i - start))
            start = i
    out, loose = b"", b""
    for value, count in [*runs, (0, 128)]:
        if count >= 4:
            out += b"".join(
                bytes([len(loose[i : i + 128])]) + loose[i : i + 128]
                for i in range(0, len(loose), 128)
            )
            loose = b""
            out += bytes([128 + count, value]) if count < 128 else b""
        else:
            loose += bytes([value]) * count
    return out


def main(folder):
    """Write the files."""
    for name in NAMES:
        pixels = decoded(folder / "hdri" / f"{name}.exr.js")
        pixels = np.maximum(smaller(smaller(pixels, WIDTH, 1), HEIGHT, 0), 0.0)
        head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode()
        rows = (
            bytes([2, 2, WIDTH >> 8, WIDTH & 255])
            + b"".join(packed(row[:, c].tolist()) for c in range(4))
            for row in rgbe(pixels)
        )
        (HERE / f"{name}.hdr").write_bytes(head + b"".join(rows))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
