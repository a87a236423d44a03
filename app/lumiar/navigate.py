"""Drags and wheel turns → another camera, or a light that stands elsewhere.

dx and dy are what the mouse moved, as shares of the picture's height, to the right and down. eye
and target are where those of the camera are, see `camera.viewpoint`. What is under the mouse
follows it, whatever the scale of the scene; at the poles the eye stops short of turning over.
"""

import math

from .camera import cross, dot, look_at
from .parts import CAMERA

POLE = math.radians(89.9)  # highest elevation: at 90 degrees the way up would flip
TURN = math.pi  # radians that a drag over the height of the picture turns
STEP = 0.9  # factor on the distance, a notch of the wheel


def orbit(camera, eye, target, dx, dy):
    """Return the camera turned about its target, as if the scene were dragged."""
    up = _scaled(camera.up, 1.0 / math.hypot(*camera.up))
    right, _, back = _axes(camera, eye, target)
    elevation = math.asin(max(-1.0, min(1.0, dot(back, up)))) + TURN * dy
    elevation = max(-POLE, min(POLE, elevation))
    away = cross(_turned(right, up, -TURN * dx), up)
    if camera.position is None and up == (0.0, 1.0, 0.0):
        azimuth = math.degrees(math.atan2(away[0], away[2]))
        return camera._replace(azimuth=azimuth, elevation=math.degrees(elevation))
    back = _plus(_scaled(away, math.cos(elevation)), _scaled(up, math.sin(elevation)))
    position = _plus(target, _scaled(back, math.dist(eye, target)))
    return camera._replace(position=position, target=target)


def pan(camera, eye, target, dx, dy):
    """Return the camera moved sideways, so that the target follows the mouse."""
    right, up, _ = _axes(camera, eye, target)
    height = 2.0 * math.tan(math.radians(camera.fov) / 2.0) * math.dist(eye, target)
    shift = _plus(_scaled(right, -dx * height), _scaled(up, dy * height))
    moved = camera._replace(target=_plus(target, shift))
    return moved._replace(position=_plus(eye, shift)) if camera.position else moved


def zoom(camera, eye, target, notches):
    """Return the camera nearer to its target, or farther for negative notches of the wheel."""
    domain = CAMERA["distance"]
    distance = max(domain.low, math.dist(eye, target) * STEP**notches)
    if camera.position is None and distance <= domain.high:
        return camera._replace(distance=distance)
    back = _axes(camera, eye, target)[2]
    return camera._replace(position=_plus(target, _scaled(back, distance)), target=target)


def movable(light):
    """Return whether `swing` can move a light."""
    return bool(_handle(light))


def swing(light, camera, eye, target, dx, dy):
    """Return {parameter: value} that moves a light about the target, the way the mouse went."""
    handle = _handle(light)
    if handle == "azimuth":  # on the sky: its azimuth, and its height above the horizon
        domain = light.kind.parameter("height")
        height = light.values["height"] - math.degrees(TURN * dy)
        azimuth = light.values["azimuth"] + math.degrees(TURN * dx)
        return {
            "azimuth": math.remainder(azimuth, 360.0),
            "height": max(domain.low, min(domain.high, height)),
        }
    centre = target if handle == "position" else (0.0, 0.0, 0.0)
    arm = _plus(light.values[handle], _scaled(centre, -1.0))
    up = _scaled(camera.up, 1.0 / math.hypot(*camera.up))
    arm = _turned(_turned(arm, up, TURN * dx), _axes(camera, eye, target)[0], TURN * dy)
    return {handle: _plus(centre, arm)}


def standing(light):
    """Return where a light stands, or the middle of its corners; None if nowhere."""
    corners = _corners(light)
    if not corners:
        return None
    places = [light.values[name] for name in corners]
    return tuple(sum(axis) / len(places) for axis in zip(*places, strict=True))


def carry(light, camera, eye, target, dx, dy):
    """Return {parameter: value} that moves a light that stands somewhere as the mouse went."""
    right, up, back = _axes(camera, eye, target)
    depth = dot(_plus(eye, _scaled(standing(light), -1.0)), back)
    height = 2.0 * math.tan(math.radians(camera.fov) / 2.0) * depth
    shift = _plus(_scaled(right, dx * height), _scaled(up, -dy * height))
    return {name: _plus(light.values[name], shift) for name in _corners(light)}


def pixel(place, camera, eye, target, size):
    """Return the (x, y) at which a place is seen in a picture of a size, None if behind the eye."""
    arm = _plus(place, _scaled(eye, -1.0))
    x, y, away = (dot(arm, axis) for axis in _axes(camera, eye, target))
    if away >= 0.0:
        return None
    scale = 0.5 * size[1] / (math.tan(math.radians(camera.fov) / 2.0) * -away)
    return 0.5 * size[0] + scale * x, 0.5 * size[1] - scale * y


def _corners(light):
    """Return the names of the parameters that say where a light stands."""
    if "corners" in light.values:
        count = 3 + light.kind.parameter("corners").choices.index(light.values["corners"])
        return "abcdef"[:count]
    return ("position",) if "position" in light.values else ()


def _handle(light):
    """Return the name of the parameter by which a light is moved, or None."""
    for parameter in light.kind.parameters:
        if parameter.widget == "direction" or parameter.name in ("position", "azimuth"):
            return parameter.name
    return None


def _axes(camera, eye, target):
    """Return the directions right, up and back of the eye."""
    matrix = look_at(eye, target, camera.up)
    return matrix[0:3], matrix[4:7], matrix[8:11]


def _turned(a, axis, angle):
    """Return a vector turned about an axis of length 1 (O. Rodrigues, 1840)."""
    along = _scaled(axis, dot(axis, a) * (1.0 - math.cos(angle)))
    across = _scaled(cross(axis, a), math.sin(angle))
    return _plus(_plus(_scaled(a, math.cos(angle)), across), along)


def _scaled(a, factor):
    return tuple(factor * p for p in a)


def _plus(a, b):
    return tuple(p + q for p, q in zip(a, b, strict=True))
