"""How two pictures differ, in numbers and as a picture."""

import math

import numpy as np

from .errors import Mistake

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # of linear red, green and blue: ITU-R BT.709


def measure(a, b, threshold=0.0):
    """Return {name: value} for two pictures (height, width, 3) of the same shape.

    rmse       root of the mean square difference over all channels
    max        largest difference of a channel
    share      share of the pixels with a channel that differs by more than `threshold`
    not_finite number of pixels with a NaN or infinite channel in either; they count in `share`, and
               rmse and max are over the others
    """
    with np.errstate(invalid="ignore"):
        difference = np.abs(a.astype(np.float64) - b.astype(np.float64))
    finite = np.isfinite(a).all(2) & np.isfinite(b).all(2)
    good = difference[finite]
    return {
        "rmse": float(np.sqrt(np.mean(good**2))) if good.size else 0.0,
        "max": float(good.max()) if good.size else 0.0,
        "share": float(np.mean(~finite | (difference > threshold).any(2))),
        "not_finite": int(np.count_nonzero(~finite)),
    }


def levels(a, b):
    """Return what `measure` does for two pictures (height, width, 3) of 8 bits of sRGB, sooner."""
    apart = np.abs(a.astype(np.int16) - b)
    counts = np.bincount(apart.ravel(), minlength=256)
    mean = float(counts @ np.arange(256.0) ** 2) / apart.size
    return {
        "rmse": math.sqrt(mean) / 255.0,
        "max": int(np.flatnonzero(counts)[-1]) / 255.0,
        "share": float(np.mean(apart.any(2))),
        "not_finite": 0,
    }


def flip(a, b, linear):
    """Return the mean FLIP error of picture b against reference a, in [0, 1].

    P. Andersson et al., "FLIP: a difference evaluator for alternating images", HPG 2020; for linear
    radiance HDR-FLIP, 2021. None where it is not defined: HDR-FLIP of a reference that is black, or
    darker than 1e-7 everywhere. Raises ImportError where its package has no build for this Python.
    """
    import flip_evaluator

    if linear:
        a, b = (np.maximum(np.nan_to_num(one, posinf=0.0, neginf=0.0), 0.0) for one in (a, b))
    if np.array_equal(a, b):
        return 0.0
    if linear and (a @ LUMINANCE).max() <= np.finfo(np.float32).eps:
        return None  # the package finds no exposure, and would end the whole process
    kind = "HDR" if linear else "LDR"
    images = (np.ascontiguousarray(a), np.ascontiguousarray(b))
    return float(flip_evaluator.evaluate(*images, kind, applyMagma=False)[1])


def picture(a, b):
    """Return (bytes of sRGB, difference that is shown as white) of where two pictures differ.

    Grey shows the largest difference of a pixel's channels, its root so that small ones show too;
    magenta a pixel that is not finite.
    """
    with np.errstate(invalid="ignore"):
        largest = np.abs(a.astype(np.float64) - b.astype(np.float64)).max(2)
    finite = np.isfinite(largest)
    white = float(largest[finite].max()) if finite.any() else 0.0
    grey = np.sqrt(np.where(finite, largest, 0.0) / (white or 1.0))
    pixels = np.repeat(grey[..., None], 3, axis=2)
    pixels[~finite] = [1.0, 0.0, 1.0]
    return (pixels * 255.0 + 0.5).astype(np.uint8).tobytes(), white


def check_alike(a, b, names):
    """Raise Mistake unless two (array, whether linear) pictures can be compared."""
    (one, linear), (other, other_linear) = a, b
    if linear != other_linear:
        raise Mistake(f"{names[0]} and {names[1]}: one is 8-bit sRGB, the other linear radiance")
    if one.shape != other.shape:
        sizes = " and ".join(f"{p.shape[1]}x{p.shape[0]}" for p in (one, other))
        raise Mistake(f"{names[0]} and {names[1]} differ in size: {sizes}; make them alike")
