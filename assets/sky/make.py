"""Write sky.f64 and sun.f32 from the packages that SOURCES.md names.

python make.py sky_model_data.h sunsky_datasets.bin
"""

import re
import struct
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent


def doubles(text, name):
    """Return the array of that name in a C header, float64."""
    body = text[text.index(f"double {name}[] = {{") :]
    body = re.sub(r"/\*.*?\*/|//[^\n]*", "", body[body.index("{") + 1 : body.index("};")])
    return np.array([float(x) for x in body.split(",") if x.strip()])


def sky(text):
    """Return the data of the skylight model, float64.

    Shape (XYZ, albedo 0 and 1, turbidity 1 to 10, 6 points of the solar height, 10): the nine
    coefficients and the radiance [W m^-2 sr^-1].
    """
    shape = (3, 2, 10, 6)
    coefficients = [doubles(text, f"datasetXYZ{i}") for i in (1, 2, 3)]
    radiances = [doubles(text, f"datasetXYZRad{i}") for i in (1, 2, 3)]
    return np.concatenate(
        [np.reshape(coefficients, (*shape, 9)), np.reshape(radiances, (*shape, 1))], axis=-1
    )


def tensors(data):
    """Return {name: array} of a Mitsuba tensor file."""
    (count,), at, found = struct.unpack_from("<I", data, 14), 18, {}
    for _ in range(count):
        (length,) = struct.unpack_from("<H", data, at)
        name = data[at + 2 : at + 2 + length].decode()
        at += 2 + length
        rank, kind, start = struct.unpack_from("<HBQ", data, at)
        shape = struct.unpack_from(f"<{rank}Q", data, at + 11)
        at += 11 + 8 * rank
        kind = {10: "<f4", 11: "<f8"}[kind]
        found[name] = np.frombuffer(data, kind, int(np.prod(shape)), start).reshape(shape)
    return found


def sun(data):
    """Return the solar radiance, then the limb darkening, as one row, float64.

    Radiance: (turbidity 1 to 10, 45 pieces of the solar height, 11 wavelengths from 320 to 720 nm,
    4 coefficients of a cubic, constant first) [W m^-2 sr^-1 nm^-1]. Limb: (the same wavelengths, 6
    coefficients in the cosine, constant first).
    """
    found = tensors(data)
    return np.concatenate([found["sun_rad_spec"].ravel(), found["sun_ld_spec"].ravel()])


if __name__ == "__main__":
    header, datasets = map(Path, sys.argv[1:])
    (HERE / "sky.f64").write_bytes(sky(header.read_text()).astype("<f8").tobytes())
    (HERE / "sun.f32").write_bytes(sun(datasets.read_bytes()).astype("<f4").tobytes())
