"""The matrices against pyrr, another program's, and against what a camera must do."""

import math

import numpy as np
import pyrr
import pytest

from lumiar import camera
from lumiar.parts import Camera

RNG = np.random.default_rng(7)


def array(matrix):
    return np.array(matrix).reshape(4, 4)


@pytest.mark.parametrize("case", range(20))
def test_looking_agrees_with_pyrr(case):
    eye, target = RNG.normal(size=3) * 3, RNG.normal(size=3)
    found = array(camera.look_at(eye, target, (0, 1, 0)))
    expected = pyrr.matrix44.create_look_at(
        eye, target, [0, 1, 0]
    ).T  # pyrr multiplies from the left
    assert np.allclose(found, expected, atol=1e-6)


@pytest.mark.parametrize(("fov", "aspect"), [(30, 1.0), (75, 16 / 9), (5, 0.5)])
def test_the_lens_agrees_with_pyrr(fov, aspect):
    found = array(camera.perspective(fov, aspect, 0.1, 50.0))
    expected = pyrr.matrix44.create_perspective_projection(fov, aspect, 0.1, 50.0).T
    expected[1] *= -1.0  # our y points down, for rows from the top
    assert np.allclose(found, expected, rtol=1e-6, atol=1e-7)


@pytest.mark.parametrize("case", range(20))
def test_a_placement_scales_turns_and_moves(case):
    angles, position = RNG.uniform(-180, 180, 3), RNG.normal(size=3)
    scale = RNG.uniform(0.2, 3.0, 3) * RNG.choice([-1, 1], 3)
    found = array(camera.placement(position, angles, scale))
    # pyrr's quaternions turn as a right hand does; its matrices from angles do the opposite
    turn = pyrr.Quaternion()
    for axis, angle in zip(np.eye(3), np.radians(angles), strict=True):
        turn = pyrr.Quaternion.from_axis_rotation(axis, angle) * turn
    for point in RNG.normal(size=(5, 3)):
        expected = np.array(turn * pyrr.Vector3(point * scale)) + position
        assert np.allclose((found @ [*point, 1.0])[:3], expected, atol=1e-6)
        assert np.allclose(camera.point(tuple(found.ravel()), point), expected, atol=1e-6)
    assert camera.mirrors(tuple(found.ravel())) == (np.linalg.det(found) < 0)


@pytest.mark.parametrize("case", range(10))
def test_normals_stay_perpendicular_and_outside(case):
    matrix = camera.placement((0, 0, 0), RNG.uniform(-180, 180, 3), RNG.uniform(-2, 2, 3))
    turn = np.array(camera.normal_matrix(matrix)).reshape(3, 3)
    linear = array(matrix)[:3, :3]
    normal, other = RNG.normal(size=3), RNG.normal(size=3)
    tangent = np.cross(normal, other)
    assert abs((turn @ normal) @ (linear @ tangent)) < 1e-9
    assert (turn @ normal) @ (linear @ normal) > 0.0


def test_product_is_the_matrix_product():
    a, b = RNG.normal(size=(2, 16))
    assert np.allclose(array(camera.product(tuple(a), tuple(b))), array(a) @ array(b))


@pytest.mark.parametrize("up", [(0, 1, 0), (0, 0, 1), (1e-3, 0, 0), (1e6, 1e6, 0)])
@pytest.mark.parametrize("eye", [(0, 5, 0), (0, -5, 0), (0, 0, 5), (5, 0, 0), (1e-9, 5, 0)])
def test_looking_anywhere_gives_a_rotation(eye, up):
    turn = array(camera.look_at(eye, (0, 0, 0), up))[:3, :3]
    assert np.allclose(turn @ turn.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(turn) == pytest.approx(1.0)


@pytest.mark.parametrize("elevation", [-90.0, -30.0, 0.0, 89.9999, 90.0])
@pytest.mark.parametrize("aspect", [0.4, 1.0, 2.5])
def test_a_sphere_is_framed_whole(elevation, aspect):
    one = Camera(elevation=elevation, azimuth=130.0, fov=40.0)
    eye, target = camera.viewpoint(one, aspect, (1.0, 2.0, 3.0), 0.7)
    assert target == (1.0, 2.0, 3.0)
    half = math.asin(0.7 / math.dist(eye, target))
    limit = math.radians(20.0)
    limit = min(limit, math.atan(math.tan(limit) * aspect))
    assert 0.9 * limit < half < limit
    near, far = camera.clip_planes(eye, target, [(target, 0.7)])
    assert 0.0 < near <= math.dist(eye, target) - 0.7 and far >= math.dist(eye, target) + 0.7


def test_the_near_plane_stands_before_what_is_off_the_middle():
    """Depth is along the view: a sphere beside it is nearer by that than its distance says."""
    aside = [((-3.0, 0.0, 0.0), 1.0), ((3.0, 0.0, 0.0), 1.0)]
    near, far = camera.clip_planes((0.0, 0.0, 10.0), (0.0, 0.0, 0.0), aside)
    assert near <= 9.0 and far >= 11.0
    behind = [((0.0, 0.0, 0.0), 1.0), ((0.0, 0.0, 30.0), 1.0)]
    assert camera.clip_planes((0.0, 0.0, 10.0), (0.0, 0.0, 0.0), behind)[0] > 8.0


def test_what_is_given_is_kept():
    one = Camera(position=(1.0, 2.0, 3.0), target=(0.0, 1.0, 0.0))
    assert camera.viewpoint(one, 1.0, (9.0, 9.0, 9.0), 1.0) == ((1.0, 2.0, 3.0), (0.0, 1.0, 0.0))
    one = Camera(azimuth=90.0, elevation=0.0, distance=4.0)
    eye, _ = camera.viewpoint(one, 1.0, (0.0, 0.0, 0.0), 1.0)
    assert np.allclose(eye, (4.0, 0.0, 0.0))


def test_a_sphere_around_spheres():
    centre, radius = camera.enclosing([((0, 0, 0), 1.0), ((10, 0, 0), 2.0)])
    assert centre == (5.5, 0.0, 0.0) and radius == pytest.approx(6.5)
