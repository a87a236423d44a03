"""One adjustable value: its type, its domain, and how it is declared in one line of GLSL."""

import math
import re
from typing import NamedTuple

from .errors import Mistake

SIZES = {"float": 1, "int": 1, "bool": 1, "ivec2": 2, "vec2": 2, "vec3": 3, "vec4": 4}
EXAMPLE = "uniform float k = 0.7;  // [0, 1]: what it is (unit)"
_COUNTS = ("", "", "two numbers, each ", "three numbers, each ", "four numbers, each ")
TINT = "color"  # the parameter that colours the tinted ones of a file
_WORDS = {"log", "degrees", "tinted"}
_APART = str.maketrans(",x", "  ")
_LARGEST = 1e30  # beyond this, squares and products leave the range of a 32-bit float
_LARGEST_INT = 2**31 - 1
_UNIFORM = re.compile(r"\s*uniform\s+(\w+)\s+(\w+)\s*(?:=\s*([^;]*\S)\s*)?;\s*(?://\s*(.*?)\s*)?$")


class Parameter(NamedTuple):
    """A value with a name, a type and a domain.

    type is float, int, bool, ivec2, vec2, vec3 or vec4; widget is slider, color, direction, toggle,
    choice or time. low and high bound the slider and, unless that side is open, the value. An angle
    in degrees here is in radians in the shader. A tinted one is a number here and, times the value
    of TINT, a vec3 in the shader. line is where a GLSL file declares it.
    """

    name: str
    type: str
    default: object
    widget: str = "slider"
    low: float = -math.inf
    high: float = math.inf
    open: tuple[bool, bool] = (False, False)
    log: bool = False
    degrees: bool = False
    tinted: bool = False
    choices: tuple[str, ...] = ()
    text: str = ""
    unit: str = ""
    line: int = 0

    @property
    def constant(self):
        """Whether the value is compiled in rather than set while running."""
        return self.widget in ("choice", "toggle")

    @property
    def logarithmic(self):
        """Whether its slider goes by equal factors: it says so, or spans three decades."""
        return self.log or (self.low > 0.0 and self.high / self.low >= 1e3)

    def allowed(self):
        """Return in words which values this parameter takes."""
        if self.widget == "choice":
            return "one of " + ", ".join(self.choices)
        if self.widget == "toggle":
            return "true or false"
        if self.widget == "direction":
            return "three numbers, not all zero"
        low = "" if self.open[0] or math.isinf(self.low) else f"{self.low:g}"
        high = "" if self.open[1] or math.isinf(self.high) else f"{self.high:g}"
        if low and high:
            limits = f"{low} to {high}"
        else:
            limits = f"{low} or more" if low else f"up to {high}" if high else "any finite value"
        bits = " of 32 bits" if any(self.open) else ""
        whole = f"a whole number{bits}, " if self.type == "int" else ""
        unit = " (degrees)" if self.degrees else ""
        return _COUNTS[SIZES[self.type]] + whole + limits + unit

    def check(self, value, where=""):
        """Return `value` as a Scene holds it: float, int, bool, str (choice) or tuple of numbers.

        One number given for a vector stands for all its components. Raises Mistake, its line
        beginning with `where`, for a wrong type or a value out of the domain.
        """
        if self.widget == "choice":
            good = isinstance(value, str) and value in self.choices
            return value if good else self._refuse(value, where)
        if self.widget == "toggle":
            return value if isinstance(value, bool) else self._refuse(value, where)
        size = SIZES[self.type]
        values = value if isinstance(value, (list, tuple)) else [value] * size
        whole = self.type in ("int", "ivec2")
        largest = _LARGEST_INT if whole else _LARGEST
        low = -largest if self.open[0] else max(self.low, -largest)
        high = largest if self.open[1] else min(self.high, largest)
        good = len(values) == size and all(
            isinstance(v, (int, float)) and not isinstance(v, bool) and low <= v <= high
            for v in values
        )
        if not good or (whole and any(v != int(v) for v in values)):
            self._refuse(value, where)
        if self.widget == "direction" and not any(values):
            self._refuse(value, where)
        numbers = tuple(int(v) if whole else float(v) for v in values)
        return numbers if size > 1 else numbers[0]

    def read(self, text, where=""):
        """Return the value that `text`, as typed on a command line, stands for; see `check`."""
        if self.widget == "choice":
            return self.check(text.strip(), where)
        if self.widget == "toggle":
            truth = {"true": True, "on": True, "yes": True, "false": False, "off": False}
            return self.check(truth.get(text.strip().lower(), text), where)
        try:
            numbers = [float(part) for part in text.strip("[]() ").translate(_APART).split()]
        except ValueError:
            numbers = []
        if not numbers:
            self._refuse(text, where)
        return self.check(numbers[0] if len(numbers) == 1 else numbers, where)

    def refuse_time(self, where=""):
        """Raise Mistake: this value follows the scene's time."""
        raise Mistake(f"{where}{self.name} follows the time of the scene; set time instead")

    def _refuse(self, value, where):
        shown = f'"{value}"' if isinstance(value, str) else repr(value).lower()
        raise Mistake(f"{where}{self.name} = {shown} is not possible; allowed: {self.allowed()}")


def parse_uniform(line, number, path):
    """Return the Parameter that one line of GLSL declares; raise Mistake naming path:number."""
    where = f"{path}:{number}: "
    found = _UNIFORM.match(line)
    if not found:
        raise Mistake(f"{where}a parameter is one line such as: {EXAMPLE}")
    kind, name, initial, note = found.groups()
    where = f"{where}uniform '{name}': "
    if kind not in SIZES or kind == "ivec2":
        raise Mistake(f"{where}a {kind} cannot be a parameter; write {EXAMPLE}")
    if not note:
        raise Mistake(f"{where}no annotation; write {EXAMPLE}")
    if initial is None:
        raise Mistake(f"{where}no default; write {EXAMPLE}")
    form, _, text = note.partition(":")
    text, bracket, unit = text.strip().rpartition("(") if text.endswith(")") else (text, "", "")
    text, unit = (text.strip(), unit[:-1]) if bracket else (text.strip() + unit.strip(), "")
    fields = _widget(form.strip(), kind, where)
    kind = "float" if fields.get("tinted") else kind
    bare = Parameter(name, kind, None, text=text, unit=unit, line=number, **fields)
    default = bare.check(_default(initial, bare, where), where + "the default ")
    return bare._replace(default=default)


def _widget(form, kind, where):
    """Return the Parameter fields that the form of an annotation stands for."""
    if form.startswith("[") and "]" in form and kind != "bool":
        ends, _, words = form[1:].partition("]")
        low, _, high = (end.strip() for end in ends.partition(","))
        opened, words = (low.startswith(".."), high.endswith("..")), set(words.split())
        try:
            low, high = float(low.removeprefix("..")), float(high.removesuffix(".."))
            good = low < high and (low > 0 or "log" not in words)
        except ValueError:
            good = False
        if not good or words - _WORDS or ("tinted" in words and kind != "vec3"):
            advice = "write [lo, hi] with lo < hi, then log (lo > 0), degrees or tinted (a vec3)"
            raise Mistake(f"{where}'{form}' is no range for a {kind}; {advice}")
        said = {word: word in words for word in _WORDS}
        return {"widget": "slider", "low": low, "high": high, "open": opened, **said}
    if form.startswith("{") and form.endswith("}") and kind == "int":
        choices = tuple(word.strip() for word in form[1:-1].split(","))
        if len(set(choices)) == len(choices) > 1 and all(c.isidentifier() for c in choices):
            return {"widget": "choice", "choices": choices}
    if form == "color" and kind == "vec3":
        return {"widget": "color", "low": 0.0, "high": 1.0}
    if (form, kind) in (("direction", "vec3"), ("toggle", "bool"), ("time", "float")):
        return {"widget": form}
    raise Mistake(
        f"{where}annotation '{form}' does not suit a {kind}; allowed: [lo, hi] for numbers, color "
        "or direction for vec3, toggle for bool, {one, other} for int, time for float"
    )


def _default(initial, parameter, where):
    """Return the value of a uniform initialiser: a literal, vecN(...) or radians(...)."""
    function, bracket, inner = initial.partition("(")
    function, inner = (function.strip(), inner[:-1]) if bracket else ("", initial)
    if initial in ("true", "false"):
        return initial == "true"
    if parameter.degrees and function != "radians":
        raise Mistake(f"{where}a default in degrees is written radians({inner})")
    try:
        values = [float(v) for v in inner.split(",")]
        if function not in ("", "radians", "vec2", "vec3", "vec4"):
            raise ValueError
        if parameter.widget == "choice":
            return parameter.choices[int(initial)]
    except (ValueError, IndexError):
        raise Mistake(f"{where}default '{initial}' is no literal that suits it") from None
    return values[0] if len(values) == 1 else values
