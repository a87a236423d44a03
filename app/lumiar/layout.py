"""Where everything in a scene stands, and what each object needs compiled. Draws nothing."""

import math
import struct
from typing import NamedTuple

from . import camera, compose
from .errors import Mistake
from .geometry import Geometry
from .parameter import TINT
from .parts import Object

AT_ONCE = 1024  # directions to lights in one pass: a driver's limit on loops, and a pass's time
HIDDEN = 128  # of them those to lights that cast shadows


class Placed(NamedTuple):
    """An object in its place.

    world  matrix from object space to the scene; clip from object space to clip space (see camera)
    eye    position of the eye in the scene
    closed whether its back faces can be left out
    """

    object: Object
    geometry: Geometry
    world: tuple
    clip: tuple
    eye: tuple[float, float, float]
    closed: bool

    @property
    def transformed(self):
        """Whether the object is anywhere else than where its mesh lies."""
        return self.world != camera.IDENTITY


def arrange(scene, geometries):
    """Return the Placed objects of a scene; geometries holds the Geometry of each, in order."""
    worlds = [_world(one, mesh) for one, mesh in zip(scene.objects, geometries, strict=True)]
    spheres = [
        _sphere(one, mesh, world)
        for one, mesh, world in zip(scene.objects, geometries, worlds, strict=True)
    ]
    eye, target, near, far = _looks(scene, spheres)
    lens = camera.perspective(scene.camera.fov, scene.size[0] / scene.size[1], near, far)
    clip = camera.product(lens, camera.look_at(eye, target, scene.camera.up))
    placed = []
    for one, mesh, world, (middle, extent) in zip(
        scene.objects, geometries, worlds, spheres, strict=True
    ):
        closed = mesh.closed and math.dist(eye, middle) > extent  # not seen from within
        placed.append(Placed(one, mesh, world, camera.product(clip, world), eye, closed))
    return placed


def constants(scene, placed):
    """Return {name: value} of what is compiled in for an object, as `compose.surface` takes it."""
    return placed.object.model.constants(placed.object.values) | of_lights(scene)


def of_lights(scene):
    """Return {name: value} of what is compiled in for the lights of a scene."""
    return {
        f"{name}_{i}": value
        for i, one in enumerate(scene.lights, 1)
        for name, value in one.kind.constants(one.values).items()
    }


def sources(scene, placed, shows="radiance"):
    """Return the composed GLSL {stage: Source} that draws an object in a scene."""
    kinds = [light.kind for light in scene.lights]
    fixed, facts = constants(scene, placed), (not placed.closed, placed.transformed)
    return compose.surface(
        placed.object.model, kinds, scene.shading, fixed, *facts, shadows(scene), shows
    )


def shadows(scene):
    """Return the numbers, from 1, of the lights of a scene that cast shadows."""
    return tuple(i for i, light in enumerate(scene.lights, 1) if light.shadows)


def _aims(scene):
    return sum(light.shadows and not light.kind.sampled for light in scene.lights)


def directions(scene):
    """Return how many directions to its lights a scene has at a place, and of them the shadowed."""
    extended = [light for light in scene.lights if light.kind.sampled]
    hidden = sum(light.samples for light in extended if light.shadows)
    return sum(light.samples for light in extended), hidden


def passes(scene):
    """Return over how many passes the directions to the lights of a scene are spread."""
    every, hidden = directions(scene)
    return max(1, -(-hidden // HIDDEN), -(-every // AT_ONCE))


def uniforms(scene, placed, number=1):
    """Return {name: bytes} of what is set while running, as float32 and int32, for an object."""
    values = {
        "rig_clip": _columns(placed.clip, 4),
        "rig_world": _columns(placed.world, 4),
        "rig_turn": _columns(camera.normal_matrix(placed.world), 3),
        "rig_lead": _columns(camera.linear_part(placed.world), 3),
        "rig_eye": struct.pack("3f", *placed.eye),
        "rig_number": struct.pack("f", number),
        "rig_aims": struct.pack("i", _aims(scene)),
        **packed(placed.object.model, placed.object.values, scene.time, ""),
    }
    for i, light in enumerate(scene.lights, 1):
        values.update(of_light(light, scene.time, i))
    return values


def of_light(light, time, number):
    """Return {name: bytes} of what is set while running for light `number` of a scene."""
    values = packed(light.kind, light.values, time, f"_{number}")
    values[f"samples_{number}"] = struct.pack("i", light.samples)
    if light.unit or light.temperature or light.illuminant:
        from . import units

        rgb = units.radiant(light, f"light {number}: ")
        values[f"{light.kind.tinted.name}_{number}"] = struct.pack("3f", *rgb)
    given = _given(light)
    plain = {f"{k}_{number}": v for k, v in given.items() if isinstance(v, bytes)}
    return values | plain


def tables(light, number):
    """Return {name: surroundings.Texels} of the tables that light `number` looks up."""
    given = _given(light)
    return {f"{k}_{number}": v for k, v in given.items() if not isinstance(v, bytes)}


def _given(light):
    if not light.kind.given:
        return {}
    from . import surroundings

    return surroundings.given(light)


def view(scene, placed):
    """Return {name: bytes} of how the eye looks into a scene, as rigs/backdrop.frag takes it."""
    spheres = [_sphere(one.object, one.geometry, one.world) for one in placed]
    aspect = scene.size[0] / scene.size[1]
    eye, target, near, far = _looks(scene, spheres)
    axes = camera.look_at(eye, target, scene.camera.up)
    up = math.tan(math.radians(scene.camera.fov) / 2.0)
    right, down, ahead = (
        tuple(stretch * axes[4 * row + k] for k in range(3))
        for row, stretch in ((0, up * aspect), (1, -up), (2, -1.0))
    )
    a, b = camera.perspective(scene.camera.fov, aspect, near, far)[10:12]
    return {
        "rig_eye": struct.pack("3f", *eye),
        "rig_rays": struct.pack("9f", *right, *down, *ahead),
        "rig_depth": struct.pack("2f", 0.5 - 0.5 * a, 0.5 * b),
    }


def viewpoint(scene, geometries):
    """Return (eye, target) of the eye of a scene; geometries holds the Geometry of each object."""
    pairs = zip(scene.objects, geometries, strict=True)
    return _looks(scene, [_sphere(one, mesh, _world(one, mesh)) for one, mesh in pairs])[:2]


def _looks(scene, spheres):
    """Return (eye, target, near, far) of the eye of a scene with such spheres in it."""
    aspect = scene.size[0] / scene.size[1]
    eye, target = camera.viewpoint(scene.camera, aspect, *camera.enclosing(spheres))
    if eye == target:
        raise Mistake(f"the eye stands on its target, {target}; move camera.position or the target")
    return eye, target, *camera.clip_planes(eye, target, spheres)


def _world(one, mesh):
    matrix = camera.placement(one.position, one.rotation, one.scale)
    if not one.fit:
        return matrix
    scale = one.fit / (mesh.radius or 1.0)
    to_origin = tuple(-scale * c for c in mesh.centre)
    return camera.product(matrix, camera.placement(to_origin, (0.0, 0.0, 0.0), (scale,) * 3))


def _sphere(one, mesh, world):
    """Return (centre, radius) of a sphere around a placed mesh."""
    radius = (one.fit or mesh.radius) * max(map(abs, one.scale))
    return camera.point(world, mesh.centre), radius or 1e-6


def _columns(matrix, n):
    """Return the bytes of an n x n matrix as OpenGL wants them, column by column."""
    return struct.pack(f"{n * n}f", *(matrix[n * i + j] for j in range(n) for i in range(n)))


def packed(shader, values, time, suffix):
    """Return {name + suffix: bytes} of the parameters of a shader that are set while running."""
    packed = {}
    for parameter in shader.parameters:
        if parameter.constant:
            continue
        value = time if parameter.widget == "time" else values[parameter.name]
        if parameter.degrees:
            value = math.radians(value)
        if parameter.widget == "direction":
            length = math.hypot(*value)
            value = [v / length for v in value]
        if parameter.tinted:
            value = [value * channel for channel in values[TINT]]
        numbers = value if isinstance(value, (tuple, list)) else (value,)
        form = "i" if parameter.type == "int" else "f"
        packed[parameter.name + suffix] = struct.pack(f"{len(numbers)}{form}", *numbers)
    return packed
