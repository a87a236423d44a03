"""Where everything in a scene stands, and what each object needs compiled. Draws nothing."""

import math
import struct
from typing import NamedTuple

from . import camera, compose
from .errors import Mistake
from .geometry import Geometry
from .parameter import TINT
from .parts import Object


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
    centre, radius = camera.enclosing(spheres)
    aspect = scene.size[0] / scene.size[1]
    eye, target = camera.viewpoint(scene.camera, aspect, centre, radius)
    if eye == target:
        raise Mistake(f"the eye stands on its target, {target}; move camera.position or the target")
    lens = camera.perspective(scene.camera.fov, aspect, *camera.clip_planes(eye, target, spheres))
    view = camera.product(lens, camera.look_at(eye, target, scene.camera.up))
    placed = []
    for one, mesh, world, (middle, extent) in zip(
        scene.objects, geometries, worlds, spheres, strict=True
    ):
        closed = mesh.closed and math.dist(eye, middle) > extent  # not seen from within
        placed.append(Placed(one, mesh, world, camera.product(view, world), eye, closed))
    return placed


def constants(scene, placed):
    """Return {name: value} of what is compiled in for an object, as `compose.surface` takes it."""
    fixed = placed.object.model.constants(placed.object.values)
    for i, one in enumerate(scene.lights, 1):
        fixed |= {f"{name}_{i}": v for name, v in one.kind.constants(one.values).items()}
    return fixed


def sources(scene, placed):
    """Return the composed GLSL {stage: Source} that draws an object in a scene."""
    kinds = [light.kind for light in scene.lights]
    fixed = constants(scene, placed)
    return compose.surface(
        placed.object.model, kinds, scene.shading, fixed, not placed.closed, placed.transformed
    )


def uniforms(scene, placed):
    """Return {name: bytes} of what is set while running, as float32 and int32, for an object."""
    values = {
        "rig_clip": _columns(placed.clip, 4),
        "rig_world": _columns(placed.world, 4),
        "rig_turn": _columns(camera.normal_matrix(placed.world), 3),
        "rig_lead": _columns(camera.linear_part(placed.world), 3),
        "rig_eye": struct.pack("3f", *placed.eye),
        **packed(placed.object.model, placed.object.values, scene.time, ""),
    }
    for i, light in enumerate(scene.lights, 1):
        values.update(packed(light.kind, light.values, scene.time, f"_{i}"))
    return values


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
