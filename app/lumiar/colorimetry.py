"""Colours as the eye tells them apart: sRGB, u'v', CIE Lab, CIEDE2000. Arrays (..., 3), float64."""

import numpy as np

_BENT = 6.0 / 29.0  # below its cube the cube root of Lab is a line: CIE 15:2018, 8.2.1


def srgb(linear):
    """Return shares of white as sRGB in [0, 1] (IEC 61966-2-1); what is beyond white is white."""
    x = np.clip(linear, 0.0, 1.0)
    bent = 1.055 * np.maximum(x, 0.0031308) ** (1.0 / 2.4) - 0.055
    return np.where(x <= 0.0031308, 12.92 * x, bent)


def chromaticity(xyz):
    """Return u'v' (..., 2) of CIE XYZ (..., 3), CIE 1976 UCS; NaN for black."""
    X, Y, Z = np.moveaxis(np.asarray(xyz, np.float64), -1, 0)
    return np.stack([4.0 * X, 9.0 * Y], axis=-1) / (X + 15.0 * Y + 3.0 * Z)[..., None]


def lab(xyz, white):
    """Return L*, a*, b* (..., 3) of CIE XYZ (..., 3) beside a white of XYZ (3,) (CIE 15:2018)."""
    t = np.asarray(xyz, np.float64) / white
    x, y, z = np.moveaxis(np.where(t > _BENT**3, np.cbrt(t), t / (3 * _BENT**2) + 4 / 29), -1, 0)
    return np.stack([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)], axis=-1)


def difference(one, other):
    """Return the CIEDE2000 difference (...) of colours L*, a*, b* (..., 3); 1 is about visible.

    G. Sharma, W. Wu and E. Dalal, "The CIEDE2000 color-difference formula: implementation notes,
    supplementary test data, and mathematical observations", Color Research and Application 30,
    2005; its equation numbers. k_L = k_C = k_H = 1.
    """
    (L1, C1, h1), (L2, C2, h2) = _stretched(np.asarray(one, float), np.asarray(other, float))
    grey = C1 * C2 == 0.0  # without a hue
    turn = np.where(grey, 0.0, (h2 - h1 + 180.0) % 360.0 - 180.0)  # eq. 10
    turn = np.where(h2 - h1 == 180.0, 180.0, turn)
    apart = 2.0 * np.sqrt(C1 * C2) * _sin(turn / 2.0)  # eq. 11
    L, C = (L1 + L2) / 2.0, (C1 + C2) / 2.0
    wrapped = np.abs(h1 - h2) > 180.0
    h = (h1 + h2 + np.where(wrapped, np.where(h1 + h2 < 360.0, 360.0, -360.0), 0.0)) / 2.0
    h = np.where(grey, h1 + h2, h)  # eq. 14
    T = 1.0 - 0.17 * _cos(h - 30.0) + 0.24 * _cos(2.0 * h)  # eq. 15
    T += 0.32 * _cos(3.0 * h + 6.0) - 0.20 * _cos(4.0 * h - 63.0)
    bend = 30.0 * np.exp(-(((h - 275.0) / 25.0) ** 2))  # eq. 16
    off = (L - 50.0) ** 2
    light = (L2 - L1) / (1.0 + 0.015 * off / np.sqrt(20.0 + off))  # eq. 18
    chroma = (C2 - C1) / (1.0 + 0.045 * C)  # eq. 19
    hue = apart / (1.0 + 0.015 * C * T)  # eq. 20
    tilt = -_sin(2.0 * bend) * 2.0 * _share(C)  # eq. 17 and 21
    return np.sqrt(light**2 + chroma**2 + hue**2 + tilt * chroma * hue)


def _stretched(*colours):
    """Return (L, C', h' in degrees) of each of two colours, eq. 2 to 7."""
    mean = sum(np.hypot(one[..., 1], one[..., 2]) for one in colours) / 2.0
    for one in colours:
        L, a, b = np.moveaxis(one, -1, 0)
        a = a * (1.5 - 0.5 * _share(mean))
        yield L, np.hypot(a, b), np.degrees(np.arctan2(b, a)) % 360.0


def _share(C):
    return np.sqrt(C**7 / (C**7 + 25.0**7))


def _sin(degrees):
    return np.sin(np.radians(degrees))


def _cos(degrees):
    return np.cos(np.radians(degrees))
