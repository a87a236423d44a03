"""Scenes made from a scene so that their radiance is another quantity of it."""

import math

from . import catalog, spectrum, units
from .parts import Light

SAMPLES = 256  # directions of the furnace that an albedo is the mean over


def lit_by(scene, lights):
    """Return the scene under these Lights alone, none of which the eye sees."""
    return scene._replace(lights=tuple(light._replace(visible=False) for light in lights))


def white(scene):
    """Return the scene whose radiance is the irradiance on the side of a surface that is seen.

    Every object is Lambert's with f = 1: what it reflects is the irradiance itself [W m^-2].
    """
    model = catalog.read("model", "lambert")
    values = {**model.defaults(), "albedo": (1.0, 1.0, 1.0), "form": "slide"}
    objects = tuple(one._replace(model=model, values=values) for one in scene.objects)
    return lit_by(scene, scene.lights)._replace(objects=objects)


def shape(scene):
    """Return the scene whose objects and normals are the same, in the dark: quick to compile."""
    return lit_by(white(scene), ())


def furnace(scene, samples=SAMPLES):
    """Return the scene in a furnace of radiance 1: its radiance is the albedo toward the eye.

    That is the hemispherical-directional reflectance (F. Nicodemus, 1977), plus what the objects
    emit themselves.
    """
    kind = catalog.read("light", "furnace")
    return scene._replace(lights=(Light(kind, kind.defaults(), samples=samples),))


def middle(light):
    """Return a Light from one direction, that of a Light's middle; None where it is all around."""
    values, sampled = light.values, light.kind.sampled
    if "environment" in light.kind.defines:
        return None
    if light.kind.name == "sun":
        from . import daylight

        height, azimuth = (math.radians(values[key]) for key in ("height", "azimuth"))
        return _plain("directional", direction=daylight.direction(height, azimuth))
    if sampled and "position" in values:
        return _plain("point", position=values["position"])
    if light.kind.name == "polygon":
        corners = units.corners(values)
        mean = (sum(axis) / len(corners) for axis in zip(*corners, strict=True))
        return _plain("point", position=tuple(mean))
    return light


def _plain(name, **values):
    kind = catalog.read("light", name)
    return Light(kind, {**kind.defaults(), **values})


def emits(scene):
    """Return whether an object of the scene emits light itself."""
    return any("emitted" in one.model.defines for one in scene.objects)


def own_efficacy(one):
    """Return the luminous efficacy [lm/W] of what an Object emits: a black body's, else D65's."""
    if one.model.name == "black_body":
        return spectrum.source(one.values["temperature"])[1]
    return units.EFFICACY


def efficacy(light):
    """Return the luminous efficacy of a Light's spectrum [lm/W]; that of D65 where it has none."""
    if light.temperature is None and not light.illuminant:
        return units.EFFICACY
    return spectrum.source(light.temperature, light.illuminant)[1]
