"""Orbit, pan and zoom: what is under the mouse follows it, at any scale, without a jump."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lumiar import camera, catalog, navigate
from lumiar.parts import CAMERA, Camera, Light

SCALES = (1e-3, 1.0, 1e6)
UPS = ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.3, -0.8, 0.2))
drags = st.floats(-0.4, 0.4)


def seen(one, scale=1.0):
    """Return (eye, target, matrix to the eye's axes) of a camera before a scene of that size."""
    eye, target = camera.viewpoint(one, 1.5, (0.1 * scale, 0.2 * scale, 0.0), scale)
    return eye, target, np.reshape(camera.look_at(eye, target, one.up), (4, 4))


def on_screen(one, scale, place):
    """Return where a place is seen, as shares of the picture's height, to the right and down."""
    x, y, z, _ = seen(one, scale)[2] @ [*place, 1.0]
    height = 2.0 * math.tan(math.radians(one.fov) / 2.0) * -z
    return np.array([x, -y]) / height


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("up", UPS)
@pytest.mark.parametrize("placed", [False, True])
def test_panning_moves_the_target_exactly_with_the_mouse(scale, up, placed):
    one = Camera(up=up)
    if placed:
        one = one._replace(position=seen(one, scale)[0])
    eye, target, _ = seen(one, scale)
    after = navigate.pan(one, eye, target, 0.2, -0.1)
    assert on_screen(after, scale, target) == pytest.approx([0.2, -0.1], abs=1e-9)
    assert math.dist(*seen(after, scale)[:2]) == pytest.approx(math.dist(eye, target))


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("up", UPS)
def test_orbiting_moves_what_is_in_front_the_way_the_mouse_went(scale, up):
    one = Camera(up=up)
    eye, target, _ = seen(one, scale)
    front = np.array(target) + 0.3 * scale * (np.array(eye) - target) / math.dist(eye, target)
    right = navigate.orbit(one, eye, target, 0.02, 0.0)
    down = navigate.orbit(one, eye, target, 0.0, 0.02)
    assert on_screen(right, scale, front)[0] > 0.001
    assert on_screen(down, scale, front)[1] > 0.001
    for after in (right, down):
        assert seen(after, scale)[1] == pytest.approx(target)
        assert math.dist(*seen(after, scale)[:2]) == pytest.approx(math.dist(eye, target))


@given(st.floats(-360, 360), st.sampled_from([-90.0, -89.95, 0.0, 89.95, 90.0]), drags, drags)
def test_nothing_jumps_at_the_poles(azimuth, elevation, dx, dy):
    """A hundredth of a drag turns the view by a hundredth of its angle, wherever it begins."""
    one = Camera(azimuth=azimuth, elevation=elevation)
    most = navigate.TURN * math.hypot(dx, dy) + math.radians(0.2)  # the eye stops short of a pole
    before = seen(one)
    after = seen(navigate.orbit(one, *before[:2], dx, dy))
    turn = after[2][:3, :3] @ before[2][:3, :3].T
    assert math.acos(max(-1.0, min(1.0, (np.trace(turn) - 1.0) / 2.0))) <= most + 1e-6


@given(st.lists(st.tuples(drags, drags), max_size=8), st.sampled_from(UPS))
def test_many_drags_never_turn_the_view_over(path, up):
    one = Camera(up=up)
    for dx, dy in path:
        one = navigate.orbit(one, *seen(one)[:2], dx, dy)
    eye, target, axes = seen(one)
    assert np.dot(axes[1, :3], up) >= 0.0
    assert np.isfinite(axes).all() and math.dist(eye, target) > 0.0


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("notches", [1, -1, 30, -30])
def test_the_wheel_changes_the_distance_by_a_factor_and_stays_in_the_domain(scale, notches):
    one = Camera()
    eye, target, axes = seen(one, scale)
    after = navigate.zoom(one, eye, target, notches)
    wanted = max(math.dist(eye, target) * navigate.STEP**notches, CAMERA["distance"].low)
    assert math.dist(*seen(after, scale)[:2]) == pytest.approx(wanted)
    assert seen(after, scale)[2][:3, :3] == pytest.approx(axes[:3, :3], abs=1e-9)
    for key, value in after._asdict().items():
        assert value is None or value == CAMERA[key].check(value), key


@pytest.mark.parametrize("kind", ["directional", "point", "spot", "sphere", "disk", "quad"])
def test_a_light_in_front_goes_the_way_the_mouse_went(kind):
    kind = catalog.read("light", kind)
    one = Camera(azimuth=0.0, elevation=0.0, target=(0.0, 0.0, 0.0))
    eye, target, _ = seen(one)
    name = "direction" if "direction" in kind.defaults() else "position"
    light = Light(kind, {**kind.defaults(), name: (0.0, 0.0, 2.0)})
    x, y, z = navigate.swing(light, one, eye, target, 0.1, -0.2)[name]
    assert x > 0.1 and y > 0.1
    assert math.hypot(x, y, z) == pytest.approx(2.0)


def test_the_sun_stays_above_the_horizon():
    kind = catalog.read("light", "sun")
    light = Light(kind, kind.defaults())
    one = Camera()
    for dy in (-5.0, 5.0):
        values = navigate.swing(light, one, *seen(one)[:2], 3.0, dy)
        assert {k: kind.parameter(k).check(v) for k, v in values.items()} == values


def test_what_has_no_place_cannot_be_moved():
    moved = {name for name in catalog.names("light") if navigate.movable(_light(name))}
    assert not moved & {"ambient", "furnace", "studio", "polygon", "environment"}
    assert moved >= {"directional", "point", "spot", "sun", "sky"}


def _light(name):
    kind = catalog.read("light", name)
    return Light(kind, kind.defaults())


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("up", UPS)
@pytest.mark.parametrize("name", ["point", "polygon"])
def test_a_light_that_is_carried_stays_below_the_mouse(scale, up, name):
    light, one = _light(name), Camera(up=up)
    corners = [p.name for p in light.kind.parameters if p.type == "vec3" and p.unit == "m"]
    values = {key: tuple(scale * p / 9.0 for p in light.values[key]) for key in corners}
    light = light._replace(values={**light.values, **values})
    eye, target, _ = seen(one, scale)
    before = np.array(navigate.pixel(navigate.standing(light), one, eye, target, (600, 400)))
    share = on_screen(one, scale, navigate.standing(light))
    assert before == pytest.approx(400 * share + [300, 200], abs=1e-6)
    moved = navigate.carry(light, one, eye, target, 0.1, -0.2)
    after = light._replace(values={**light.values, **moved})
    place = navigate.pixel(navigate.standing(after), one, eye, target, (600, 400))
    assert np.array(place) - before == pytest.approx([40.0, -80.0], abs=1e-6)
    ahead = np.subtract(target, eye) / math.dist(eye, target)
    shift = np.subtract(navigate.standing(after), navigate.standing(light))
    assert abs(shift @ ahead) < 1e-9 * scale  # as far from the eye as before


def test_what_is_behind_the_eye_or_stands_nowhere_has_no_pixel():
    one = Camera()
    eye, target, _ = seen(one)
    behind = tuple(2.0 * e - t for e, t in zip(eye, target, strict=True))
    assert navigate.pixel(behind, one, eye, target, (600, 400)) is None
    standing = {name for name in catalog.names("light") if navigate.standing(_light(name))}
    assert standing == {"point", "spot", "sphere", "disk", "quad", "polygon"}
