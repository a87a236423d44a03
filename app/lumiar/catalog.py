"""What each GLSL file says of itself: its header, its parameters, its claims."""

import math
import os
import re
from typing import NamedTuple

from .errors import Mistake, nearest
from .files import GLSL, read_text
from .glsltext import check_comments, check_letters, without_comments
from .parameter import TINT, Parameter, parse_uniform

SOURCE_LIMIT = 1 << 20  # bytes of one GLSL file; a longer one is refused before any driver sees it
CLAIMS = ("positive", "reciprocal", "conserving", "constant")
NEEDS = ("tangent",)  # what a file may ask of the rig beyond the normal
FOLDERS = {"model": "models", "light": "lights"}
DEFINES = {
    "model": {
        "scatter": "vec3 scatter(vec3 L, vec3 V)",
        "surround": "vec3 surround(vec3 V)",
        "sample_scatter": "vec3 sample_scatter(vec3 V, vec2 u, out vec3 L)",
        "scatter_pdf": "float scatter_pdf(vec3 L, vec3 V)",
        "emitted": "vec3 emitted(vec3 V)",
        "F_facet": "vec3 F_facet(float c)",
    },
    "light": {
        "light": "Incident light(vec3 place, vec2 u)",
        "environment": "vec3 environment(vec3 direction)",
        "ambience": "vec3 ambience(vec3 normal)",
        "irradiance": "vec3 irradiance(vec3 place, vec3 normal)",
        "arriving": "vec3 arriving(vec3 place, vec3 direction)",
        "density": "float density(vec3 place, vec3 direction)",
        "reach": "float reach(vec3 place, vec3 direction)",
    },
}
REQUIRED = {"model": ("scatter",), "light": ("light", "environment")}  # one of these
OWN_KEYS = {  # scene keys of an object or a light, which no parameter may take over
    "model": (
        "mesh",
        "model",
        "material",
        "name",
        "position",
        "rotation",
        "scale",
        "fit",
        "crease",
    ),
    "light": (
        "kind",
        "name",
        "unit",
        "temperature",
        "illuminant",
        "image",
        "samples",
        "shadows",
        "visible",
    ),
}
SCENE_KEYS = (  # of the scene itself, which no parameter may take over either
    "size",
    "samples",
    "shading",
    "background",
    "exposure",
    "ev100",
    "tone",
    "time",
    "lang",
    "columns",
)
_FUNCTION = re.compile(r"^\w+ (\w+)\(", re.MULTILINE)  # as our own files are written
_UNIFORM = re.compile(r"\buniform\b")
_GIVEN = re.compile(r"\s*uniform\s+\w+\s+(\w+)[^;]*;\s*// given: ")


class Shader(NamedTuple):
    """One GLSL file: kind is model, light or rig; name is what a scene calls it by.

    claims maps each claimed property to the condition it is claimed under ("" for always);
    defines holds the names of its functions, given those of the uniforms that the host computes;
    library counts how often files that it includes were read again since.
    """

    kind: str
    name: str
    path: str
    text: str
    header: dict[str, str]
    claims: dict[str, str]
    needs: tuple[str, ...]
    defines: frozenset[str]
    parameters: tuple[Parameter, ...]
    given: tuple[str, ...] = ()
    library: int = 0

    def defaults(self):
        """Return {parameter name: default value}."""
        return {parameter.name: parameter.default for parameter in self.parameters}

    @property
    def source(self):
        """What tells its GLSL from that of others, and from its own before it was edited."""
        return self.text, self.library

    @property
    def transmits(self):
        """Whether light passes the surface: L or V may be below it."""
        return self.header.get("sides") == "both"

    @property
    def sampled(self):
        """Whether a light has an extent, over which `light` draws directions by chance."""
        return "sampled" in self.header

    @property
    def tinted(self):
        """The parameter that unit, temperature and illuminant of a light speak of, or None."""
        return next((parameter for parameter in self.parameters if parameter.tinted), None)

    def constants(self, values):
        """Return those of values that are compiled in, the choices and toggles."""
        return {p.name: values[p.name] for p in self.parameters if p.constant}

    def in_radians(self, values):
        """Return values with those given in degrees in radians, as the shader takes them."""
        angles = {p.name: math.radians(values[p.name]) for p in self.parameters if p.degrees}
        return {**values, **angles}

    def covers(self, claim, values):
        """Return whether a claim of the header speaks of these values."""
        condition = self.claims.get(claim)
        if not condition:
            return condition is not None
        name, _, value = (part.strip() for part in condition.partition("="))
        return str(values[name]) == value

    def changes(self, values):
        """Return in words where values differ from the defaults."""
        said = []
        for parameter in self.parameters:
            value = values[parameter.name]
            if value != parameter.default:
                same = isinstance(value, tuple) and len(set(value)) == 1
                value = value[0] if same else value
                shown = f"{value:.6g}" if isinstance(value, float) else str(value)
                said.append(f"{parameter.name} = {shown}")
        return ", ".join(said) or "the defaults"

    def parameter(self, name, where=""):
        """Return the parameter of that name; raise Mistake with the closest spelling."""
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        names = [p.name for p in self.parameters]
        raise Mistake(f"{where}{self.name} has no parameter '{name}'; {nearest(name, names)}")


def names(kind):
    """Return the names of the files of a kind ("model" or "light") that come with Lumiar."""
    folder = os.path.join(GLSL, FOLDERS[kind])
    return sorted(f[:-5] for f in os.listdir(folder) if f.endswith(".glsl"))


def read(kind, name, where="", folder="", edited=False):
    """Return the Shader for a shipped file by its name, or for any file by its path in `folder`.

    kind is model, light or rig; a path becomes the name of the Shader, in full; edited: see
    `parse`. Raises Mistake, beginning with `where` when there is no such file, and naming file:line
    when the file breaks the contract of glsl/README.md.
    """
    if name.endswith(".frag" if kind == "rig" else ".glsl"):
        path = name = os.path.abspath(os.path.join(folder, os.path.expanduser(name)))
        if not os.path.exists(path):
            known = ", ".join(names(kind))
            raise Mistake(f"{where}no file {path}; name a GLSL file, or one of {known}")
    elif name in names(kind):
        path = os.path.join(GLSL, FOLDERS[kind], f"{name}.glsl")
    else:
        advice = "; a file of your own is named with its ending, as in my_model.glsl"
        raise Mistake(f"{where}no {kind} '{name}'; {nearest(name, names(kind))}{advice}")
    text = read_text(path, SOURCE_LIMIT, "a GLSL file")
    return parse(kind, name, path, unix(text), edited)


def unix(text):
    """Return a text with its lines ended as GLSL files of ours are."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


def parse(kind, name, path, text, edited=False):
    """Return the Shader for a text; see `read`.

    What comes with Lumiar is tested to keep the contract; edited says that it was changed since.
    """
    ours = path.startswith(os.path.join(GLSL, ""))
    if edited or not ours:
        from . import contract  # which takes 8 ms

        check_comments(text, path)
    code, lines = without_comments(text), text.split("\n")
    check_letters(code, path)
    parameters, given = {}, []
    for number, bare in enumerate(code.split("\n"), 1):
        if not _UNIFORM.search(bare) or (kind == "rig" and "rig_" in bare):
            continue  # what the rigs themselves set is no parameter
        if ours and (found := _GIVEN.match(lines[number - 1])):
            given.append(found.group(1))
            continue
        parameter = parse_uniform(lines[number - 1], number, path)
        if parameter.name in parameters:
            raise Mistake(f"{path}:{number}: '{parameter.name}' is declared twice; keep one line")
        if kind != "rig" and parameter.name in (*OWN_KEYS[kind], *SCENE_KEYS, "light"):
            raise Mistake(f"{path}:{number}: '{parameter.name}' is a key of scenes; rename it")
        parameters[parameter.name] = parameter
    tinted = any(parameter.tinted for parameter in parameters.values())
    if tinted and TINT in parameters:
        where = f"{path}:{parameters[TINT].line}: "
        raise Mistake(
            f"{where}'{TINT}' comes with what is tinted; leave this line out, or rename it"
        )
    if tinted:
        what = "colour of the light" if kind == "light" else "colour of what is tinted"
        parameters[TINT] = Parameter(TINT, "vec3", (1.0, 1.0, 1.0), "color", 0.0, 1.0, text=what)
    wanted = DEFINES.get(kind)
    if not wanted or (ours and not edited):
        defines = frozenset(_FUNCTION.findall(code))
    else:
        defines = contract.check(code, path, wanted)
    if wanted and not defines.intersection(REQUIRED[kind]):
        either = " or ".join(wanted[name] for name in REQUIRED[kind])
        raise Mistake(f"{path}:1: a {kind} must define {either}")
    header, places = _header(lines)
    needs = tuple(header.get("needs", "").replace(",", " ").split())
    for word in needs:
        if word not in NEEDS:
            raise Mistake(f"{path}:{places['needs']}: needs '{word}'; {nearest(word, NEEDS)}")
    claims = _claims(header.get("claims", ""), parameters, f"{path}:{places.get('claims', 1)}: ")
    parameters = tuple(parameters.values())
    fields = (kind, name, path, text, header, claims, needs, defines, parameters)
    return Shader(*fields, tuple(given))


def _header(lines):
    """Return the header of a file, {key: text}, and the line on which each key stands."""
    header, places, key = {}, {}, None
    for number, line in enumerate(lines, 1):
        if not line.startswith("//"):
            if line.strip():
                break
            continue
        word, _, said = line[2:].removeprefix(" ").partition("  ")
        if word.isidentifier() and said.strip():
            key = word
            header[key], places[key] = said.strip(), number
        elif key:
            header[key] += " " + line[2:].strip()
    return header, places


def _claims(text, parameters, where):
    claims = {}
    for claim in filter(None, map(str.strip, text.split(","))):
        name, _, condition = claim.partition("(")
        name, condition = name.strip(), condition.rstrip(") ")
        if name not in CLAIMS:
            raise Mistake(f"{where}claims '{name}'; {nearest(name, CLAIMS)}")
        choice, _, value = (part.strip() for part in condition.partition("="))
        if condition and (choice not in parameters or value not in parameters[choice].choices):
            raise Mistake(f"{where}'{name} ({condition})' names no choice of this file")
        claims[name] = condition
    return claims
