"""What a scene consists of, as immutable records, and the domain and unit of each value."""

from typing import NamedTuple

from .catalog import Shader
from .parameter import Parameter

RATES = ("flat", "gouraud", "phong")
TONES = ("none", "reinhard", "aces")


class Camera(NamedTuple):
    """The eye; what is None follows from the scene. See CAMERA for domains and units."""

    position: tuple[float, float, float] | None = None
    target: tuple[float, float, float] | None = None
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    fov: float = 30.0
    azimuth: float = 20.0
    elevation: float = 15.0
    distance: float | None = None


class Object(NamedTuple):
    """A mesh with a model on it. See OBJECT; values holds every parameter of the model.

    mesh is what `geometry.canonical` returns; values maps parameter names to checked values.
    """

    model: Shader
    values: dict
    mesh: str = "sphere"
    name: str = ""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rotation: tuple[float, float, float] = (0.0, 0.0, 0.0)
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    fit: float | None = None
    crease: float | None = None


class Light(NamedTuple):
    """A light of some kind; values holds every parameter of the kind. See LIGHT for the others.

    unit is that of its tinted value, "" for the one of its file; illuminant names a spectrum of
    `spectrum.names`; image is the path of a .hdr, or the name of one that comes with Lumiar.
    """

    kind: Shader
    values: dict
    name: str = ""
    unit: str = ""
    temperature: float | None = None
    illuminant: str = ""
    image: str = ""
    samples: int = 16
    shadows: bool = False
    visible: bool = False


class Panel(NamedTuple):
    """One picture of a sheet: the scene with some values changed, or another scene altogether.

    caption maps a language (en, pt) to a line; values are pairs for `settings.changed`; scene is
    the name or path of another scene, or empty.
    """

    caption: dict = {}  # noqa: RUF012  never changed in place
    values: tuple[tuple[str, object], ...] = ()
    scene: str = ""


def _numbers(name, kind, default, low, high, unit, text, beyond=(False, False)):
    return Parameter(name, kind, default, "slider", low, high, beyond, unit=unit, text=text)


def _place(name, default, text):
    return _numbers(name, "vec3", default, -10, 10, "m", text, (True, True))


def _angle(name, default, low, high, text, kind="float"):
    return _numbers(name, kind, default, low, high, "degrees", text)


def _toggle(name, text):
    return Parameter(name, "bool", False, "toggle", text=text)


def _choice(name, choices, default, text):
    return Parameter(name, "int", default, "choice", choices=choices, text=text)


def _table(*parameters):
    return {parameter.name: parameter for parameter in parameters}


SCENE = _table(
    _numbers("size", "ivec2", (768, 768), 1, 16384, "pixels", "width, height"),
    _numbers("samples", "int", 4, 1, 64, "per pixel", "1, 4, 9, 16, 25, 36, 49 or 64"),
    _choice("shading", RATES, "phong", "evaluate the model per face, per vertex or per pixel"),
    _numbers("background", "vec3", (0.05, 0.05, 0.05), 0, 1, "W m^-2 sr^-1", "radiance", (0, 1)),
    _numbers("exposure", "float", 0.0, -20, 20, "EV", "factor 2^EV on the radiance"),
    _numbers("ev100", "float", None, -20, 30, "EV", "a camera's exposure for these luminances"),
    _choice("tone", TONES, "none", "tone curve after the exposure"),
    _numbers("time", "float", 0.0, 0, 60, "s", "for models that change with it", (True, True)),
    _choice("lang", ("system", "en", "pt"), "system", "language of a sheet's captions"),
    _numbers("columns", "int", 0, 0, 64, "", "panels in a row of a sheet; 0 chooses"),
)
CAMERA = _table(
    _place("position", None, "where the eye is; left out: azimuth, elevation and distance say"),
    _place("target", None, "what it looks at; left out: the middle of the scene"),
    Parameter("up", "vec3", (0.0, 1.0, 0.0), "direction", text="which way is up"),
    _angle("fov", 30.0, 1, 170, "vertical angle of view"),
    _angle("azimuth", 20.0, -360, 360, "of the eye around y, from the z axis"),
    _angle("elevation", 15.0, -90, 90, "of the eye above the horizon"),
    _numbers("distance", "float", None, 1e-6, 1e6, "m", "to the target; left out: all in view"),
)
OBJECT = _table(
    _place("position", (0.0, 0.0, 0.0), "of its origin"),
    _angle("rotation", (0.0, 0.0, 0.0), -360, 360, "about x, then y, then z", "vec3"),
    _numbers("scale", "vec3", (1.0, 1.0, 1.0), -100, 100, "", "along its own axes", (True, True)),
    _numbers("fit", "float", None, 1e-6, 1e6, "m", "radius to fit the mesh into"),
    _angle("crease", None, 0, 180, "edges sharper than this stay sharp"),
)
LIGHT = _table(
    _numbers("temperature", "float", None, 500, 100000, "K", "colour of a black body"),
    _numbers("samples", "int", 16, 1, 4096, "per point", "directions to a light with an extent"),
    _toggle("shadows", "whether the objects of the scene hide it"),
    _toggle("visible", "whether the eye sees the light itself"),
)
LIGHT_TEXTS = ("unit", "illuminant", "image")  # their domains follow from the kind of light
