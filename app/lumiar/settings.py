"""Changing one value of a scene by its name, as `--set`, `--vary`, panels and the window do."""

import math
import re

from . import catalog, geometry
from .errors import Mistake, nearest
from .parts import CAMERA, LIGHT, LIGHT_TEXTS, OBJECT, SCENE, Light

_NUMBER = re.compile(r"[-+.\d]+(?:[eE][-+]?\d+)?")


def changed(scene, key, value, where="", folder=""):
    """Return the scene with one value changed.

    key    a value of the scene (`exposure`) or of its camera (`camera.fov`); `model`, `material`,
           `mesh` and the values of objects (`rotation`), for all objects; `light`, which replaces
           all lights; a parameter (`shininess`), for all objects whose model has it, else for all
           such lights; `mesh.minor`, of the shapes that have it; or one of those behind the name or
           number of an object or light: `left.kd`, `object.2.mesh`, `light.1.color`, `point.unit`
    value  as a scene file has it, or text as on the command line
    folder where relative paths begin

    Raises Mistake, its line beginning with `where`, naming what is allowed.
    """
    if key in SCENE:
        return scene._replace(**{key: scene_value(key, _typed(SCENE[key], value, where), where)})
    first, _, rest = key.partition(".")
    if first == "camera" and rest in CAMERA:
        value = CAMERA[rest].check(_typed(CAMERA[rest], value, where), where)
        return scene._replace(camera=scene.camera._replace(**{rest: value}))
    if key == "light":
        return scene._replace(lights=(light(str(value), where, folder),))
    objects, lights, rest = addressed(scene, key)
    in_objects = [i for i in objects if _takes(scene.objects[i], rest)]
    in_lights = [i for i in lights if _lights_up(scene.lights[i], rest) and not in_objects]
    if not in_objects and not in_lights:
        raise Mistake(f"{where}no value '{key}'; {nearest(key, keys(scene))}")
    changed_objects, changed_lights = list(scene.objects), list(scene.lights)
    for i in in_objects:
        changed_objects[i] = _object_with(scene.objects[i], rest, value, where, folder)
    for i in in_lights:
        changed_lights[i] = checked(light_with(scene.lights[i], rest, value, where, folder), where)
    return scene._replace(objects=tuple(changed_objects), lights=tuple(changed_lights))


def all_changed(scene, pairs, where="", folder=""):
    """Return the scene with every (key, value) changed; models first, whatever the order.

    A model brings its own defaults along, which must not undo what was set beside it.
    """
    for key, value in models_first(pairs):
        scene = changed(scene, key, value, where, folder)
    return scene


def models_first(pairs):
    """Return (key, value) pairs in the order in which they are to be changed."""
    order = {"model": 0, "material": 1}
    return sorted(pairs, key=lambda pair: order.get(pair[0].rpartition(".")[2], 2))


def keys(scene):
    """Return every key that `changed` takes for this scene, without those behind numbers."""
    names = [*SCENE, *(f"camera.{name}" for name in CAMERA), "model", "material", "mesh"]
    names += ["light", *OBJECT, *LIGHT, *LIGHT_TEXTS] if scene.lights else ["light", *OBJECT]
    names += (f"mesh.{name}" for one in scene.objects for name in geometry.shape(one.mesh))
    for one in (*scene.objects, *scene.lights):
        names += one.values
        names += (f"{one.name}.{value}" for value in one.values if one.name)
    return dict.fromkeys(names)


def found(scene, key):
    """Return (Parameter, value, its Light or None, address) of what `changed` changes first.

    The address is a key of one value only; None for what is chosen by its name, as a mesh.
    """
    first, _, rest = key.partition(".")
    if key in SCENE:
        return SCENE[key], getattr(scene, key), None, key
    if first == "camera" and rest in CAMERA:
        return CAMERA[rest], getattr(scene.camera, rest), None, key
    objects, lights, rest = addressed(scene, key)
    for i in objects:
        one, at = scene.objects[i], f"object.{i + 1}.{rest}"
        if rest in OBJECT:
            return OBJECT[rest], getattr(one, rest), None, at
        if rest in one.values:
            return one.model.parameter(rest), one.values[rest], None, at
        if rest in _of_shape(one):
            return geometry.slider(one.mesh, rest[5:]), _of_shape(one)[rest], None, at
    for i in lights:
        one, at = scene.lights[i], f"light.{i + 1}.{rest}"
        if rest in LIGHT:
            return LIGHT[rest], getattr(one, rest), one, at
        if rest in one.values:
            return one.kind.parameter(rest), one.values[rest], one, at
    return None


def canonical(key, value, where="", folder=""):
    """Return a value that means the same wherever the scene goes: paths in full."""
    kind = key.rpartition(".")[2]
    if kind == "mesh":
        return geometry.canonical(str(value), folder, where)
    if kind == "model":
        return catalog.read("model", str(value), where, folder).name
    if key == "light":
        name, *rest = light_parts(str(value))
        rest = (
            f"image={canonical('image', part[6:], where, folder)}"
            if part.startswith("image=")
            else part
            for part in rest
        )
        return ":".join([catalog.read("light", name, where, folder).name, *rest])
    if kind == "image":
        from . import surroundings

        return surroundings.canonical(str(value), folder, where)
    return value


def scene_value(key, value, where=""):
    """Return a checked value of the scene itself; samples must be a square."""
    value = SCENE[key].check(value, where)
    if key == "samples" and math.isqrt(value) ** 2 != value:
        raise Mistake(f"{where}samples = {value} is not possible; allowed: {SCENE[key].text}")
    return value


def object_value(key, value, where=""):
    """Return a checked value of an object itself; a scale must not flatten it."""
    value = OBJECT[key].check(value, where)
    if key == "scale" and 0.0 in value:
        raise Mistake(f"{where}scale = {value} flattens the mesh; allowed: any number but 0")
    return value


def light(spec, where="", folder=""):
    """Return the Light that text such as `point:intensity=80:position=0,2,0` describes."""
    name, *values = light_parts(spec)
    kind = catalog.read("light", name, where, folder)
    one = Light(kind, kind.defaults())
    for setting in values:
        key, _, value = setting.partition("=")
        one = light_with(one, key, value, where, folder)
    return checked(one, where)


def light_with(one, key, value, where="", folder=""):
    """Return a Light with one value changed; `checked` tells whether it all goes together.

    What is tinted takes a unit along: "800 lm". Of temperature and illuminant the last one holds.
    """
    if key in LIGHT:
        value = LIGHT[key].check(_typed(LIGHT[key], value, where), where)
        spectrum = {"illuminant": ""} if key == "temperature" else {}
        return one._replace(**{key: value}, **spectrum)
    if key in LIGHT_TEXTS:
        if not isinstance(value, str):
            raise Mistake(f'{where}{key} = {value!r}; write text in quotes: "…"')
        if key == "image" and "picture" in one.kind.given:
            value = canonical(key, value, where, folder)
        spectrum = {"temperature": None} if key == "illuminant" else {}
        return one._replace(**{key: value.strip()}, **spectrum)
    parameter = one.kind.parameter(key, where)
    if parameter.tinted and isinstance(value, str) and not _NUMBER.fullmatch(value.strip()):
        from . import units

        value, unit = units.split(value, where)
        one = one._replace(unit=unit)
    value = parameter.check(_typed(parameter, value, where), where)
    return one._replace(values={**one.values, key: value})


def own_keys(kind):
    """Return {key: what it may be} of the keys, beside its parameters, of a kind of light."""
    found = {}
    if kind.tinted:
        from . import spectrum, units

        found["unit"] = ", ".join(units.allowed(kind.tinted.unit, kind.name))
        found["temperature"] = LIGHT["temperature"].allowed()
        found["illuminant"] = ", ".join(spectrum.names())
    if "picture" in kind.given:
        from . import surroundings

        found["image"] = f"the path of a .hdr, {', '.join(surroundings.shipped())}"
    if kind.sampled:
        found["samples"] = LIGHT["samples"].allowed()
    if "light" in kind.defines:
        found["shadows"] = LIGHT["shadows"].allowed()
    if {"environment", "arriving"} & kind.defines:
        found["visible"] = LIGHT["visible"].allowed()
    return found


def checked(one, where=""):
    """Return a Light whose own keys suit its kind, its unit as Lumiar spells it.

    where begins the line of a Mistake: text, or a function that gives it for a key.
    """
    at = where if callable(where) else lambda key: where
    fresh, kind = Light(one.kind, {}), one.kind
    given = {key: getattr(one, key) for key in (*LIGHT_TEXTS, *LIGHT)}
    given = {key: value for key, value in given.items() if value != getattr(fresh, key)}
    allowed = own_keys(kind) if given else {}
    for key in given:
        if key not in allowed:
            raise Mistake(f"{at(key)}a light of the kind {kind.name} has no {key}; leave it out")
    if one.unit:
        from . import units

        unit = units.unit(one.unit, at("unit"))
        if unit not in allowed["unit"].split(", "):
            what = f"{kind.tinted.name} of {kind.name} in {unit}"
            raise Mistake(f"{at('unit')}{what}; allowed: {allowed['unit']}")
        one = one._replace(unit=unit)
    if one.illuminant and one.illuminant not in (names := allowed["illuminant"].split(", ")):
        why = nearest(one.illuminant, names)
        raise Mistake(f"{at('illuminant')}no illuminant '{one.illuminant}'; {why}")
    if one.unit:
        units.radiant(one, at("unit"))  # tells of what is black, or has no extent
    return one


def light_parts(spec):
    """Return [kind or path, "key=value", ...] of a light written as text, see `light`."""
    path, ending, rest = spec.partition(".glsl")  # a path may hold a colon, as on Windows
    return [path + ending, *rest.split(":")[1:]] if ending else spec.split(":")


def addressed(scene, key):
    """Return (indices of objects, indices of lights, rest of the key) that a key may speak of."""
    first, _, rest = key.partition(".")
    number, _, last = rest.partition(".")
    if first in ("object", "light") and number.isdecimal() and number.isascii():
        among = scene.objects if first == "object" else scene.lights
        chosen = [int(number) - 1] if 1 <= int(number) <= len(among) else []
        return (chosen, [], last) if first == "object" else ([], chosen, last)
    objects, lights = range(len(scene.objects)), range(len(scene.lights))
    if not rest:
        return objects, lights, key
    if first == "mesh":
        return objects, [], key
    named = [i for i in objects if scene.objects[i].name == first]
    lamps = [i for i in lights if first in (scene.lights[i].name, scene.lights[i].kind.name)]
    return named, lamps, rest


def _lights_up(one, key):
    return key in one.values or key in LIGHT or key in LIGHT_TEXTS


def _takes(one, key):
    return key in ("mesh", "model", "material", *OBJECT, *one.values, *_of_shape(one))


def _of_shape(one):
    """Return {"mesh.minor": value, …} of the shape of an object, {} where its mesh is a file."""
    return {f"mesh.{name}": value for name, value in geometry.shape(one.mesh).items()}


def _object_with(one, key, value, where, folder):
    if key == "mesh":
        return one._replace(mesh=geometry.canonical(str(value), folder, where))
    if key.startswith("mesh."):
        return one._replace(mesh=geometry.reshaped(one.mesh, key[5:], value, where))
    if key == "model":
        return _with_model(one, catalog.read("model", str(value), where, folder))
    if key == "material":
        from . import materials

        return materials.applied(one, str(value), where=where)
    if key in OBJECT:
        value = object_value(key, _typed(OBJECT[key], value, where), where)
        return one._replace(**{key: value})
    parameter = one.model.parameter(key, where)
    value = parameter.check(_typed(parameter, value, where), where)
    return one._replace(values={**one.values, key: value})


def _with_model(one, model):
    """Return an object with another model; what was set by hand and still fits is kept."""
    values = model.defaults()
    for key, value in one.values.items():
        if key in values and value != one.model.parameter(key).default:
            try:
                values[key] = model.parameter(key).check(value)
            except Mistake:
                continue  # the other model's domain does not hold it: its own default stays
    return one._replace(model=model, values=values)


def _typed(parameter, value, where):
    if parameter.widget == "time":
        parameter.refuse_time(where)
    return parameter.read(value, where) if isinstance(value, str) else value
