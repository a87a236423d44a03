"""Edits of a scene that no single value makes: lights come and go, kinds and units change."""

import functools

from . import scenefile, settings, units
from .errors import Mistake
from .parameter import TINT
from .parts import CAMERA, LIGHT, LIGHT_TEXTS, OBJECT, SCENE, Camera, Light

PICTURE = ("shading", "samples", "exposure", "ev100", "tone", "background", "time")
NEUTRAL_EV100 = 7.203  # where units.exposure is 1, so that switching it on changes nothing
VIEWS = {  # azimuth and elevation of the eye, in degrees
    "front": (0.0, 0.0),
    "right": (90.0, 0.0),
    "back": (180.0, 0.0),
    "left": (-90.0, 0.0),
    "top": (0.0, 90.0),
}
STARTS = {"ev100": NEUTRAL_EV100, "temperature": 6500.0, "fit": 1.0, "crease": 30.0}


def with_light(scene, spec, folder=""):
    """Return the scene with one more light, as `settings.light` reads it."""
    most = scenefile.SECTIONS["light"]
    if len(scene.lights) >= most:
        raise Mistake(f"{most} lights; a scene has at most that many")
    return scene._replace(lights=(*scene.lights, settings.light(spec, folder=folder)))


def without_light(scene, index):
    """Return the scene without one of its lights."""
    return scene._replace(lights=scene.lights[:index] + scene.lights[index + 1 :])


def with_kind(scene, index, spec, folder=""):
    """Return the scene with a light of another kind; what was set by hand and suits it is kept."""
    old, new = scene.lights[index], settings.light(spec, folder=folder)
    fresh = Light(old.kind, old.kind.defaults())
    own = {key: getattr(old, key) for key in (*LIGHT_TEXTS, *LIGHT)}
    given = {key: value for key, value in own.items() if value != getattr(fresh, key)}
    given |= {key: value for key, value in old.values.items() if value != fresh.values[key]}
    for key, value in given.items():
        try:
            new = settings.checked(settings.light_with(new, key, value))
        except Mistake:
            continue  # the other kind has no such key, or its domain does not hold the value
    if new.unit:  # as many lumens as before
        number = old.values[old.kind.tinted.name]
        new = settings.light_with(new, new.kind.tinted.name, number)
    return scene._replace(lights=_put(scene.lights, index, new._replace(name=old.name)))


def with_unit(scene, index, unit):
    """Return the scene with a light's number in another unit, as bright as it was."""
    one = scene.lights[index]
    other = settings.checked(one._replace(unit=unit))
    tinted = one.kind.tinted
    number = one.values[tinted.name] * unit_ratio(other) / unit_ratio(one)
    number = tinted.check(float(f"{number:.6g}"))
    return scene._replace(
        lights=_put(scene.lights, index, other._replace(values={**one.values, tinted.name: number}))
    )


def unit_ratio(light):
    """Return how many of a light's unit are as bright as one of the unit of its file.

    A light that has no brightness in its unit, being black or without extent, gives 1.
    """
    if not light.unit:
        return 1.0
    kind, tinted = light.kind, light.kind.tinted
    spectrum = (light.values[TINT], light.temperature, light.illuminant)
    return _ratio(kind.name, tinted.unit, light.unit, tuple(light.values.items()), *spectrum)


@functools.lru_cache(maxsize=64)  # the panel asks in every frame, and a spectrum takes 0.1 ms
def _ratio(kind, native, unit, values, *spectrum):
    values = dict(values)
    try:
        one, other = (
            units.luminance(units.tint(kind, native, 1.0, given, values, *spectrum))
            for given in (native, unit)
        )
    except Mistake:
        return 1.0
    return one / other if one > 0.0 and other > 0.0 else 1.0


def in_unit(light):
    """Return the tinted parameter of a light with its range and default in the light's unit."""
    tinted = light.kind.tinted
    if not light.unit:
        return tinted
    ratio = unit_ratio(light)
    low, high, default = (
        float(f"{ratio * value:.2g}") for value in (tinted.low, tinted.high, tinted.default)
    )
    return tinted._replace(low=low, high=high, default=default, unit=light.unit)


def left_out(scene, key):
    """Return the scene with a value that may be left out (None) left out.

    key: as `settings.changed` takes it: "ev100", "camera.target", "object.1.fit", "light.2.…".
    """
    first, _, rest = key.partition(".")
    if not rest:
        return scene._replace(**{key: None})
    if first == "camera":
        return scene._replace(camera=scene.camera._replace(**{rest: None}))
    number, _, name = rest.partition(".")
    field = "objects" if first == "object" else "lights"
    among, index = getattr(scene, field), int(number) - 1
    return scene._replace(**{field: _put(among, index, among[index]._replace(**{name: None}))})


def reset(scene, section, index=0):
    """Return the scene with all values of a section as they are by default.

    section: "object" (the parameters of its model), "placement", "light", "picture" or "camera".
    """
    if section == "camera":
        return scene._replace(camera=Camera())
    if section == "picture":
        return scene._replace(**{key: SCENE[key].default for key in PICTURE})
    if section == "light":
        one = scene.lights[index]
        fresh = Light(one.kind, one.kind.defaults(), one.name, image=one.image)
        return scene._replace(lights=_put(scene.lights, index, fresh))
    one = scene.objects[index]
    if section == "placement":
        fresh = one._replace(**{key: parameter.default for key, parameter in OBJECT.items()})
    else:
        fresh = one._replace(values=one.model.defaults())
    return scene._replace(objects=_put(scene.objects, index, fresh))


def start(key, view=None):
    """Return the value at which one that was left out begins.

    view: (eye, target) of the picture as it is, or None.
    """
    eye, target = view or ((0.0, 0.0, 5.0), (0.0, 0.0, 0.0))
    if key == "position":
        return eye
    if key == "target":
        return target
    if key == "distance":
        return sum((a - b) ** 2 for a, b in zip(eye, target, strict=True)) ** 0.5
    return STARTS[key]


def camera_keys(camera):
    """Return those keys of a camera that count: a position leaves no choice of angles."""
    if camera.position is not None:
        return [key for key in CAMERA if key not in ("azimuth", "elevation", "distance")]
    return list(CAMERA)


def looking_from(scene, view):
    """Return the scene seen from one of VIEWS, all of it in view unless a distance is given."""
    azimuth, elevation = VIEWS[view]
    camera = scene.camera._replace(position=None, azimuth=azimuth, elevation=elevation)
    return scene if camera == scene.camera else scene._replace(camera=camera)


def seen_from(camera):
    """Return from which of VIEWS a camera looks, "" for none of them."""
    angles = (camera.azimuth, camera.elevation)
    names = (name for name, view in VIEWS.items() if view == angles and camera.position is None)
    return next(names, "")


def _put(among, index, one):
    return (*among[:index], one, *among[index + 1 :])
