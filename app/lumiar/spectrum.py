"""Spectra → colour and luminous efficacy: black bodies, the CIE's illuminants, the 1931 observer.

Wavelengths are in micrometres, temperatures in kelvin, powers per micrometre. The table of the
observer is that of glsl/lib/cie_1931.glsl, every 5 nm: sums over it give the chromaticity u'v' of a
black body from 1000 to 20000 K within 2e-6 of sums over the 1 nm table.
"""

import functools
import math
import os
import re

from .files import ASSETS, GLSL, read_text

LUMENS = 683.002  # of a watt where the eye is most sensitive, K_m (lm/W); BIPM 2019/05
FIRST, SECOND = 1.1910429723971884e8, 14387.768775039338  # 2hc^2 (W um^4 m^-2 sr^-1), hc/k (um K)
STEFAN_BOLTZMANN = 5.670374419184429e-8  # W m^-2 K^-4
ILLUMINANT_A = 2848.0 * SECOND / 14350.0  # K: named with the hc/k of 1931
_STEP = 0.005  # of all tables (um)
_LIMIT = 1 << 16  # bytes of a table
_FROM_XYZ = (  # linear sRGB, IEC 61966-2-1, white being (0.95047, 1, 1.08883)
    (3.24045416, -1.53713851, -0.49853141),
    (-0.96926603, 1.87601085, 0.04155602),
    (0.05564343, -0.20402591, 1.05722519),
)


def planck(wavelength, temperature):
    """Return the spectral radiance of a black body [W m^-2 sr^-1 um^-1] (M. Planck, 1901)."""
    x = SECOND / (wavelength * temperature)
    return FIRST / wavelength**5 * math.exp(-x) / -math.expm1(-x)


@functools.lru_cache(maxsize=1)
def observer():
    """Return {nm: (x, y, z)} of the CIE 1931 2 degree observer, every 5 nm from 360 to 830."""
    text = read_text(os.path.join(GLSL, "lib", "cie_1931.glsl"), _LIMIT, "a table")
    rows = re.findall(r"\n    vec3\(([^()]*)\)", text)
    return {360 + 5 * i: tuple(map(float, row.split(","))) for i, row in enumerate(rows)}


def xyz(powers):
    """Return the tristimulus values of {nm: power}: the integrals of power times x, y and z.

    A wavelength that is not one of the observer's adds nothing.
    """
    weights = observer()
    pairs = [(weights[nm], power) for nm, power in powers.items() if nm in weights]
    return tuple(_STEP * sum(weight[i] * power for weight, power in pairs) for i in range(3))


def rgb(tristimulus):
    """Return linear sRGB (r, g, b) of CIE XYZ; negative outside the gamut."""
    return tuple(sum(m * v for m, v in zip(row, tristimulus, strict=True)) for row in _FROM_XYZ)


def chromaticity(tristimulus):
    """Return (x, y) of CIE XYZ."""
    whole = sum(tristimulus)
    return tristimulus[0] / whole, tristimulus[1] / whole


def black_body(temperature):
    """Return {nm: spectral radiance} of a black body at the observer's wavelengths."""
    return {nm: planck(nm / 1000.0, temperature) for nm in observer()}


@functools.lru_cache(maxsize=1)
def _tables():
    """Return {name: {nm: relative power}} of the illuminants that have a table."""
    path = os.path.join(ASSETS, "spectra", "illuminants.csv")
    heading, *rows = (row.split(",") for row in read_text(path, _LIMIT, "a table").split())
    columns = zip(*rows, strict=True)
    nm = [int(number) for number in next(columns)]
    return {
        name: {at: float(power) for at, power in zip(nm, column, strict=True) if power}
        for name, column in zip(heading[1:], columns, strict=True)
    }


def names():
    """Return the names of the CIE's illuminants that come with Lumiar."""
    return ["A", *_tables()]


def powers(illuminant):
    """Return {nm: relative power} of a named illuminant, every 5 nm; KeyError if there is none."""
    return black_body(ILLUMINANT_A) if illuminant == "A" else _tables()[illuminant]


def source(temperature=None, illuminant=""):
    """Return ((r, g, b), lumens per watt) of a black body or of a named illuminant.

    r, g, b: linear sRGB with Y = 1, negative outside the gamut. The watts are those of all
    wavelengths where Planck's law has them (illuminant A too), else those of the published table:
    300 to 830 nm for daylight, 360 to 830 for E, 380 to 780 for lamps.
    """
    if illuminant == "A":
        temperature = ILLUMINANT_A
    if temperature:
        table, whole = black_body(temperature), STEFAN_BOLTZMANN * temperature**4 / math.pi
    else:
        table = powers(illuminant)
        whole = _STEP * (sum(table.values()) - (table[min(table)] + table[max(table)]) / 2.0)
    tristimulus = xyz(table)
    color = rgb(tuple(value / tristimulus[1] for value in tristimulus))
    return color, LUMENS * tristimulus[1] / whole
