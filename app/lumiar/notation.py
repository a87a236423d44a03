"""How the window writes things: symbols as in papers, units, colours on a screen, directions."""

import functools
import math
import re

_LETTERS = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "eta": "η",
    "theta": "θ",
    "kappa": "κ",
    "lambda": "λ",
    "mu": "μ",
    "nu": "ν",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "phi": "φ",
    "psi": "ψ",
    "omega": "ω",
}
_SIGN = re.compile(rf"({'|'.join(_LETTERS)}|[A-Za-z])(?:_(\w+)|(\d+))?('?)(?=,| of | on |$)")
_POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@functools.lru_cache(maxsize=256)
def symbol(name, text):
    """Return (letter, subscript) of a parameter as papers write it, ("", "") where none is known.

    The text of an annotation begins with it, "rho_d, diffuse share"; or the name itself is one.
    """
    short = re.fullmatch(r"(k)([ads])", name)
    if short and not _SIGN.match(text):
        return short.groups()
    found = _SIGN.match(text) or _SIGN.fullmatch(name)
    if not found:
        return "", ""
    letter, below, number, prime = found.groups()
    below = _LETTERS.get(below, below) or number or ""
    return _LETTERS.get(letter, letter) + prime.replace("'", "′"), below


@functools.lru_cache(maxsize=64)
def unit(text):
    """Return a unit as it is printed: "W m^-2 sr^-1" with raised digits; "unitless" is nothing."""
    text = re.sub(r"\^(-?\d+)", lambda power: power[1].translate(_POWERS), text)
    return {"unitless": "", "degrees": "°"}.get(text, text)


def domain(one):
    """Return the values that a Parameter takes, written as in GLSL files: "[1, 1000 ..] log"."""
    if one.widget not in ("slider", "color"):
        return ", ".join(one.choices)
    low, high = (f"{end:g}" for end in (one.low, one.high))
    low, high = ".. " * one.open[0] + low, high + " .." * one.open[1]
    return f"[{low}, {high}]" + " log" * one.log


def shown(value):
    """Return a value as the panel writes it."""
    if isinstance(value, (tuple, list)):
        return ", ".join(map(shown, value))
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def number(value, digits=3, lang="en"):
    """Return a number rounded to so many digits as people write it: 0.036, 300, 1.6·10⁻⁵."""
    if not math.isfinite(value):
        return "∞" if value > 0.0 else str(value)
    share, power = f"{value:.{digits - 1}e}".split("e")
    if -4 < int(power) < 4:
        text = f"{float(share + 'e' + power):g}"
    else:
        share = f"{float(share):g}"
        text = ("" if share == "1" else f"{share}·") + "10" + str(int(power)).translate(_POWERS)
    return text.replace(".", ",") if lang == "pt" else text


def encoded(channel):
    """Return a linear channel as a screen takes it (sRGB, IEC 61966-2-1), within [0, 1]."""
    channel = max(0.0, min(1.0, channel))
    return 12.92 * channel if channel <= 0.0031308 else 1.055 * channel ** (1.0 / 2.4) - 0.055


def decoded(channel):
    """Return the linear channel of an encoded one."""
    return channel / 12.92 if channel <= 0.04045 else ((channel + 0.055) / 1.055) ** 2.4


def angles(direction):
    """Return (azimuth about y from +z toward +x, elevation) of a direction, in degrees."""
    x, y, z = direction
    return math.degrees(math.atan2(x, z)), math.degrees(math.atan2(y, math.hypot(x, z)))


def toward(azimuth, elevation, length=1.0):
    """Return the direction of such angles, see `angles`, to 7 digits."""
    a, e = math.radians(azimuth), math.radians(elevation)
    found = (math.cos(e) * math.sin(a), math.sin(e), math.cos(e) * math.cos(a))
    return tuple(float(f"{round(number, 7) * length:.7g}") for number in found)
