"""A light's number in the unit a person has → what its GLSL file takes: watts, in linear sRGB.

Radiance in Lumiar is linear sRGB such that EFFICACY times its Y is luminance [cd/m^2]. White is
D65, so EFFICACY is D65's. W watts of another spectrum S are W K_S lumens, K_S its efficacy, and
enter as its colour with Y = W K_S / EFFICACY: so watts and lumens of one spectrum agree.
"""

import math
import re

from . import spectrum
from .errors import Mistake, nearest

EFFICACY = 176.80388  # of CIE D65, 300 to 830 nm (lm/W)
LUMINANCE = (0.2126729, 0.7151522, 0.0721750)  # Y of linear sRGB, white being D65
_CALIBRATION = (
    1.2  # luminance at EV100 0 that saturates, cd/m^2: ISO 2720, as Lagarde and de Rousiers
)
_BASES = {  # symbol: (watts or lumens, power of m, power of sr)
    "W": ("W", 0, 0),
    "lm": ("lm", 0, 0),
    "cd": ("lm", 0, -1),
    "lx": ("lm", -2, 0),
    "nit": ("lm", -2, -1),
    "m": ("", 1, 0),
    "sr": ("", 0, 1),
}
_WORDS = {
    "watt": "W",
    "lumen": "lm",
    "candela": "cd",
    "lux": "lx",
    "nt": "nit",
    "metre": "m",
    "meter": "m",
    "steradian": "sr",
    **{symbol.lower(): symbol for symbol in _BASES},
}
_UNITS = {  # what a unit measures; "lx" and "lm/m^2" are light that arrives and that leaves
    "W": ("W", 0, 0),
    "W/sr": ("W", 0, -1),
    "W/m^2": ("W", -2, 0),
    "W/m^2/sr": ("W", -2, -1),
    "lm": ("lm", 0, 0),
    "cd": ("lm", 0, -1),
    "lx": ("lm", -2, 0),
    "lm/m^2": ("lm", -2, 0),
    "cd/m^2": ("lm", -2, -1),
}
_SIGNS = str.maketrans("²¹⁻−·⋅*()", "21--     ")
UNIFORM = ("ambient", "furnace")  # kinds of light that are the same all around


def luminance(rgb):
    """Return the luminance [cd/m^2] of a radiance (r, g, b) or an array (..., 3) of them.

    Likewise illuminance [lx] of an irradiance, and so on.
    """
    r, g, b = rgb if isinstance(rgb, (tuple, list)) else (rgb[..., i] for i in range(3))
    return EFFICACY * (LUMINANCE[0] * r + LUMINANCE[1] * g + LUMINANCE[2] * b)


def exposure(ev100):
    """Return the factor on radiance of a camera set to EV100, 1 being the brightest it shows.

    S. Lagarde, C. de Rousiers, "Moving Frostbite to physically based rendering", 2014, sec. 5.1.2.
    """
    return EFFICACY / (_CALIBRATION * 2.0**ev100)


def split(text, where=""):
    """Return (number, unit) of a text such as "800 lm", the unit "" where there is none.

    Raises Mistake, beginning with `where`, for what is no number and for an unknown unit.
    """
    found = re.fullmatch(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*", text)
    if not found:
        raise Mistake(f'{where}"{text}" is no number with a unit; write for example "800 lm"')
    return float(found[1]), unit(found[2], where) if found[2] else ""


def unit(text, where=""):
    """Return a unit as Lumiar spells it, of any common spelling: "W/(m² sr)" is "W/m^2/sr".

    Raises Mistake with the nearest unit that a light may be given in.
    """
    base, metres, steradians, below, symbols = "", 0, 0, False, []
    plain = re.sub(r"\bper\b", "/", text.translate(_SIGNS).lower())
    for slash, word, power in re.findall(r"(/)|([a-z]+|[^\s/])(?:\^?(-?\d+))?", plain):
        below = below or bool(slash)  # all that follows a slash divides, in brackets or not
        if slash:
            continue
        symbol = _WORDS.get(word, _WORDS.get(word.removesuffix("s")))
        power = -abs(int(power or 1)) if below else int(power or 1)
        if symbol is None or (_BASES[symbol][0] and (base or power != 1)):
            break
        symbols.append(symbol)
        base = base or _BASES[symbol][0]
        metres += _BASES[symbol][1] * power
        steradians += _BASES[symbol][2] * power
    else:
        known = [name for name, its in _UNITS.items() if its == (base, metres, steradians)]
        if known:
            return known[0 if "lx" in symbols else -1]
    raise Mistake(f"{where}no unit '{text}' of a light; {nearest(text, _UNITS)}")


def allowed(native, kind):
    """Return the units that a light may be given in, its own first.

    native is the unit of its tinted value as its GLSL file annotates it, kind the light's name, by
    which its shape is known.
    """
    try:
        native = unit(native)
    except Mistake:
        return ()
    if native == "W/sr":
        return native, "cd", *(("W", "lm") if kind in _SOLID_ANGLES else ())
    if native == "W/m^2":
        return native, "lx"
    area, uniform = kind in _AREAS, kind in UNIFORM
    more = ("W", "lm", "W/m^2", "lm/m^2") if area else ("W/m^2", "lx") if uniform else ()
    return native, "cd/m^2", *more


def tint(kind, native, number, given, values, color, temperature=None, illuminant="", where=""):
    """Return (r, g, b) in the native unit of a light's file for a number in a given unit.

    given is one of `allowed`; values are the light's parameters (m, degrees); color is a filter
    (r, g, b) before it. The spectrum is a black body's (K) or a named illuminant's, else white D65.
    Watts are those before the filter, lumens those behind it: then EFFICACY Y of the result is the
    number given. Raises Mistake where what is black is to have lumens, or has no extent.
    """
    given, native = unit(given, where), unit(native, where)
    white, efficacy = (1.0, 1.0, 1.0), EFFICACY
    if temperature or illuminant:
        white, efficacy = spectrum.source(temperature, illuminant)
    shape = _shape(kind, native, given, values)
    if not shape > 0.0:
        raise Mistake(f"{where}a {kind} of no extent cannot be given in {given}; make it larger")
    filtered = tuple(w * c for w, c in zip(white, color, strict=True))
    if _UNITS[given][0] == "W":
        scale = number * efficacy / EFFICACY / shape
    else:
        brightness = luminance(filtered)
        if not brightness > 0.0:
            raise Mistake(
                f"{where}a black light cannot have {number:g} {given}; brighten its color"
            )
        scale = number / brightness / shape
    return tuple(scale * channel for channel in filtered)


def radiant(light, where=""):
    """Return `tint` of a light: its unit, its values, its spectrum, as `parts.Light` has them."""
    tinted = light.kind.tinted
    return tint(
        light.kind.name,
        tinted.unit,
        light.values[tinted.name],
        light.unit or tinted.unit,
        light.values,
        light.values["color"],
        light.temperature,
        light.illuminant,
        where,
    )


def _shape(kind, native, given, values):
    """Return how many of the given unit make one of the native unit, watts and lumens aside."""
    here, there = _UNITS[given][1:], _UNITS[native][1:]
    if here == there:
        return 1.0
    if here == (-2, 0):
        return math.pi  # of a radiance that is the same all around
    return _SOLID_ANGLES[kind](values) if there == (0, -1) else math.pi * _AREAS[kind](values)


def _cone(values):
    """Return the solid angle of a spot, what it lights dimly counted in part [sr].

    Its strength falls by a smoothstep in 1 - cos from that of the inner to that of the outer angle.
    """
    inner, outer = (2.0 * math.sin(math.radians(values[k]) / 2.0) ** 2 for k in ("inner", "outer"))
    return math.pi * (min(inner, outer) + outer)


def corners(values):
    """Return the corners [m], (x, y, z) each, of a polygon light with such values."""
    return [values[name] for name in "abcdef"[: _CORNERS[values["corners"]]]]


def _polygon(values):
    """Return the area of the flat polygon of corners a, b, c … [m^2], half of |sum of p x q|."""
    around = corners(values)
    total = [0.0, 0.0, 0.0]
    for p, q in zip(around, around[1:] + around[:1], strict=True):
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            total[i] += (p[j] * q[k] - p[k] * q[j]) / 2.0
    return math.hypot(*total)


_CORNERS = {"three": 3, "four": 4, "five": 5, "six": 6}
_SOLID_ANGLES = {"point": lambda values: 4.0 * math.pi, "spot": _cone}
_AREAS = {  # m^2 of what shines
    "sphere": lambda values: 4.0 * math.pi * values["radius"] ** 2,
    "disk": lambda values: math.pi * values["radius"] ** 2,
    "quad": lambda values: values["width"] * values["height"],
    "polygon": _polygon,
}
