"""The pictures of a report of `lumiar bench`, to stand in its page: drawings, maps of errors."""

import base64
import os
from typing import NamedTuple

import numpy as np

from . import image, scale

QUALITY = 70  # of WebP


class Plate(NamedTuple):
    """A picture: an address that holds it, (width, height), the scale.Scale of a map of errors."""

    address: str
    size: tuple
    ruler: object = None


def drawn(studies, folder):
    """Return {file: Plate} of all that studies of a report in a folder name; see `ledger`.

    The errors of one case are on one scale, so that its variants can be compared. A picture that
    is no longer there is left out.
    """
    found = {}
    for one in studies:
        maps = {}
        for row in one["pictures"]:
            names = [row[key] for key in ("file", "error_file") if key in row]
            if not all(os.path.exists(os.path.join(folder, name)) for name in names):
                continue
            pixels, _ = image.read(os.path.join(folder, row["file"]))
            found[row["file"]] = _plate(np.rint(pixels * 255.0))
            if "error_file" in row:
                grey, _ = image.read(os.path.join(folder, row["error_file"]))
                errors = grey[..., 0].astype(np.float64) ** 2 * row["white"]  # grey is their root
                maps.setdefault(row["case"], {})[row["error_file"]] = errors
        for errors in maps.values():
            ruler = scale.fitting(np.concatenate([each.ravel() for each in errors.values()]))
            for name, each in errors.items():
                painted = scale.colours(each, ruler, np.ones(each.shape, bool))
                found[name] = _plate(painted, ruler)
    return found


def ramp(count=9):
    """Return the colours of the maps from no error on, as a page of HTML names them."""
    colours = scale.ramp(count).hex()
    return [f"#{colours[i : i + 6]}" for i in range(0, len(colours), 6)]


def _plate(pixels, ruler=None):
    data = base64.b64encode(image.webp(pixels.astype(np.uint8), QUALITY)).decode()
    return Plate(f"data:image/webp;base64,{data}", pixels.shape[1::-1], ruler)
