"""What a light meter, a luminance meter and a protractor would read at one point of a picture.

`measured` returns a dict, which `--json` prints; a number is None (null) where there is none.

  size_px, at_px                     of the picture; the pixel, from the top left one, 0, 0
  object                             number, name, mesh, model; null: no object is seen there
  position_m, normal                 in the scene; the normal on the side that is seen
  distance_m, theta_o_deg            to the eye; between the normal and the eye
  radiance_rgb, radiance_W_m2_sr, luminance_cd_m2            toward the eye
  emitted_rgb, emitted_W_m2_sr, emitted_cd_m2                the object's own part of it
  irradiance_rgb, irradiance_W_m2, illuminance_lx            on the side that is seen
  exitance_rgb, exitance_W_m2, luminous_exitance_lm_m2       all that leaves on that side
  exitance_exact                     whether the exitance is more than an estimate
  albedo_to_eye_rgb, albedo_to_eye   hemispherical-directional reflectance toward the eye
  lights                             for each light of the scene, alone:
    number, name, kind, efficacy_lm_W
    radiance_..., luminance_..., irradiance_..., illuminance_..., exitance_...   as above
    share_of_luminance, share_of_illuminance
    theta_i_deg, azimuth_deg         of its middle; 180: opposite the eye; null: it is all around
    f_rgb_1_sr, f_1_sr               the model's f from there to the eye
    albedo_rgb, albedo               the share of light from there that leaves in all directions

The three numbers of an ..._rgb are linear sRGB, those of a radiance in W m^-2 sr^-1 of white.
Single numbers of f and albedo are weighted as luminance is. Watts are lumens over the luminous
efficacy of the light's spectrum (D65's where it has none), as if the surface were grey; a black
body's own are those of its temperature. Lights with an extent are sampled in SAMPLES directions.

The exitance is pi times the radiance where f is constant, and albedo times irradiance under a light
from one direction or the same all around: exact. Of other lights the albedo for their middle, or
the mean one, is taken: an estimate. There is none where light passes the surface. Albedos count
what is mirrored, even of a light from one direction, whose image is drawn nowhere.
"""

import math
from typing import NamedTuple

from . import facing, geometry, layout, reflectance, units, variants
from .errors import Mistake

SAMPLES = 4096  # directions to a light with an extent
QUANTITIES = {  # name: its radiometric and its photometric key
    "radiance": ("radiance_W_m2_sr", "luminance_cd_m2"),
    "emitted": ("emitted_W_m2_sr", "emitted_cd_m2"),
    "irradiance": ("irradiance_W_m2", "illuminance_lx"),
    "exitance": ("exitance_W_m2", "luminous_exitance_lm_m2"),
}
OF_SURFACES = (  # what there is of an object only
    *("position_m", "normal", "distance_m", "theta_o_deg", "exitance_exact"),
    *("albedo_to_eye_rgb", "albedo_to_eye"),
)
OF_DIRECTIONS = ("theta_i_deg", "azimuth_deg", "f_rgb_1_sr", "f_1_sr", "albedo_rgb", "albedo")


def place(text, size):
    """Return the pixel (x, y), from the top left one, 0, 0, that `--at` names in a picture.

    Two numbers from 0 to 1 of which one has a decimal point are shares of width and height; others
    count pixels. Raises Mistake.
    """
    width, height = size
    try:
        x, y = map(float, text.split(","))
        if "." in text and 0.0 <= x <= 1.0 and 0.0 <= y <= 1.0:
            x, y = min(x * width, width - 1), min(y * height, height - 1)
        x, y = math.floor(x), math.floor(y)
    except (ValueError, OverflowError):
        advice = "write a pixel, as 100,200, or shares of width and height, as 0.5,0.5"
        raise Mistake(f"--at {text}: {advice}") from None
    if not (0 <= x < width and 0 <= y < height):
        most = f"0,0 to {width - 1},{height - 1}"
        raise Mistake(f"--at {text}: the picture is {width}x{height}; allowed: {most}")
    return x, y


def measured(scene, at, renderer, instrument):
    """Return the dict of the module's docstring for the pixel `at` (x, y) of a scene.

    renderer is a Renderer, instrument a measure.Instrument. Raises Mistake.
    """
    more = {True: {"samples": SAMPLES}, False: {}}
    lights = tuple(light._replace(**more[light.kind.sampled]) for light in scene.lights)
    scene = scene._replace(lights=lights)
    bare = variants.lit_by(scene, lights)
    number = renderer.pixel(variants.shape(scene), *at, shows="object")
    seen = renderer.pixel(scene, *at)
    found = {"size_px": [*scene.size], "at_px": [*at], "object": None}
    found |= dict.fromkeys(OF_SURFACES)
    for name in QUANTITIES:
        found |= _quantity(name, None)
    visible = any(light.visible for light in lights)
    if number is None or (visible and seen != renderer.pixel(bare, *at)):  # a light is in front
        return {**found, **_quantity("radiance", seen), "lights": []}
    number = round(number[0])
    one = scene.objects[number - 1]
    what = {"name": one.name, "mesh": one.mesh, "model": one.model.name}
    V = facing.to_eye(scene, at, renderer)
    point = _Point(bare, at, one, V, renderer, instrument)
    return {**found, "object": {"number": number, **what}, **_reading(point, seen)}


class _Point(NamedTuple):
    """A point of an object; V is the direction to the eye in its frame."""

    scene: object
    at: tuple
    object: object
    V: tuple
    renderer: object
    instrument: object

    def pixel(self, scene, shows="radiance"):
        """Return what is seen at the point in a variant of its scene, three floats."""
        return self.renderer.pixel(scene, *self.at, shows=shows)

    @property
    def material(self):
        """What the functions of `reflectance` begin with."""
        return self.instrument, self.object.model, self.object.values


def _reading(point, seen):
    """Return the part of the dict that is about a surface, whose radiance is `seen`."""
    scene, model = point.scene, point.object.model
    shape = variants.shape(scene)
    position, normal = (point.pixel(shape, shows) for shows in ("position", "normal"))
    meshes = [geometry.load(one.mesh, crease=one.crease) for one in scene.objects]
    eye = layout.arrange(scene, meshes)[0].eye
    own = point.pixel(variants.lit_by(scene, ())) if "emitted" in model.defines else None
    lights = [_lit(point, number, own) for number in range(1, len(scene.lights) + 1)]
    found = _quantity("emitted", own, variants.own_efficacy(point.object))
    exact = all(light["exitance_exact"] for light in lights)
    for name in ("radiance", "irradiance", "exitance"):
        found |= _sum(name, lights, own and name != "irradiance" and found)
    found |= {"radiance_rgb": [*seen], "luminance_cd_m2": units.luminance(seen)}
    for share, whole in (("luminance", "luminance_cd_m2"), ("illuminance", "illuminance_lx")):
        for light in lights:
            light[f"share_of_{share}"] = light[whole] / found[whole] if found[whole] else None
    albedo = reflectance.toward(*point.material, point.V)
    return {
        **{"position_m": [*position], "normal": [*normal]},
        **{"distance_m": math.dist(eye, position), "theta_o_deg": facing.theta(point.V)},
        **{**found, "exitance_exact": exact},
        **_weighted("albedo_to_eye_rgb", "albedo_to_eye", albedo),
        "lights": lights,
    }


def _lit(point, number, own):
    """Return the dict of one light: what comes of it alone, and from where."""
    light, V = point.scene.lights[number - 1], point.V
    alone = variants.lit_by(point.scene, [light])
    seen, E = point.pixel(alone), point.pixel(variants.white(alone))
    L = [a - b for a, b in zip(seen, own, strict=True)] if own else seen
    efficacy = variants.efficacy(light)
    found = {"number": number, "name": light.name, "kind": light.kind.name}
    found |= {"efficacy_lm_W": efficacy}
    found |= _quantity("radiance", L, efficacy) | _quantity("irradiance", E, efficacy)
    found |= dict.fromkeys(OF_DIRECTIONS)
    albedo, exact = None, light.kind.name in units.UNIFORM
    way = facing.to_light(point.scene, light, point.at, point.renderer)
    if way:
        found |= {"theta_i_deg": facing.theta(way), "azimuth_deg": facing.turn(way, V)}
        f = reflectance.bidirectional(*point.material, way, V)
        angles = [math.radians(facing.theta(way))]
        albedo = reflectance.albedo(*point.material, angles, facing.azimuth(way))[0]
        found |= _weighted("f_rgb_1_sr", "f_1_sr", f) | _weighted("albedo_rgb", "albedo", albedo)
        exact = not light.kind.sampled
    model, values = point.object.model, point.object.values
    asked = reflectance.surroundings(model, values)
    if model.transmits:
        M, exact = None, False
    elif model.covers("constant", values) and "environment" not in asked:
        M, exact = [math.pi * channel for channel in L], True
    else:
        if albedo is None:
            albedo = reflectance.mean(*point.material, light.kind.sampled)
        M = [e * float(a) for e, a in zip(E, albedo, strict=True)]
        exact = exact and len(asked) < 2  # which is seen through
    return {**found, **_quantity("exitance", M, efficacy), "exitance_exact": exact}


def _quantity(name, rgb, efficacy=units.EFFICACY):
    """Return {key: value} of a quantity in RGB, in watts and in lumens; None of none."""
    watts, lumens = QUANTITIES[name]
    if rgb is None:
        return {f"{name}_rgb": None, watts: None, lumens: None}
    value = units.luminance(rgb)
    return {f"{name}_rgb": [*map(float, rgb)], watts: value / efficacy, lumens: value}


def _sum(name, lights, own):
    """Return a quantity of all lights, with what the object gives of its `own`, if any."""
    found = {}
    factor = math.pi if name == "exitance" else 1.0  # of a radiance that is alike all around
    for key, its in zip(_quantity(name, None), _quantity("emitted", None), strict=True):
        values = [light[key] for light in lights]
        if None in values:
            found[key] = None
        elif key.endswith("_rgb"):
            values += [[factor * channel for channel in own[its]]] if own else []
            found[key] = [math.fsum(channel) for channel in zip(*values, strict=True)] or [0.0] * 3
        else:
            found[key] = math.fsum([*values, factor * own[its]] if own else values)
    return found


def _weighted(channels, single, rgb):
    """Return {channels: three numbers, single: their mean as luminance weighs them}."""
    if rgb is None:
        return {channels: None, single: None}
    rgb = [*map(float, rgb)]
    return {channels: rgb, single: units.luminance(rgb) / units.EFFICACY}
