"""Solid angles and form factors against closed forms of the literature, and against each other.

B-… and C-… are the numbers of J. R. Howell, "A catalog of radiation heat transfer configuration
factors"; their values to 17 digits were taken with mpmath.
"""

import math

import numpy as np
import pytest

from lumiar import estimates, factor_card, factors

ORIGIN, UP = np.zeros(3), np.array([0.0, 0.0, 1.0])
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
WALL = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], float)
LETTER_L = np.array([[0, 0, 1], [2, 0, 1], [2, 1, 1], [1, 1, 1], [1, 2, 1], [0, 2, 1]], float)


def moved(polygon, *way):
    return polygon + np.array(way)


def centred(side, height):
    return moved((SQUARE - [0.5, 0.5, 0.0]) * side, 0, 0, height)


def disk(radius, height, n=64):
    turn = 2.0 * math.pi * np.arange(n) / n
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), np.full(n, height)], axis=1)


def turned(seed=3):
    """Return a random rotation, as a function of points."""
    q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return lambda points: points @ (q * np.linalg.det(q)).T


def F12(one, other):
    return factors.exchange(one, other)[0] / factors.plane(one)[1]


def closed(point, normal, polygon):
    return factors.solid_angle(point, polygon)[0], factors.form_factor(point, normal, polygon)[0]


@pytest.mark.parametrize(
    "polygon, expected",
    [
        (SQUARE + UP, 0.138531605994893),  # B-3
        (centred(1, 1), 0.23945647046077354),
        (centred(1, 10), 0.0031725255325554263),
        (moved(WALL, 0, 1, 0), 0.055734197002553502),  # B-4
    ],
)
def test_a_patch_sees_rectangles_as_the_catalog_says(polygon, expected):
    assert factors.form_factor(ORIGIN, UP, polygon)[0] == pytest.approx(expected, rel=1e-14)


def test_solid_angles_of_an_octant_a_cube_face_and_squares():
    simplex = np.eye(3)
    for polygon, expected in (
        (simplex, math.pi / 2),
        (centred(2, 1), 2 * math.pi / 3),
        (centred(1, 1), 0.80543168316132317),
        (centred(1, 100), 9.9997500072914323e-5),
    ):
        assert factors.solid_angle(ORIGIN, polygon)[0] == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("distance", [0.05, 0.5, 2.0, 100.0])
@pytest.mark.parametrize("side", [2.0, 1.0, 0.1, 1e-2, 1e-3, 1e-4])
def test_no_digit_is_lost_at_any_size(side, distance):
    a = side / 2.0
    omega = 4.0 * math.atan(a * a / (distance * math.sqrt(2 * a * a + distance * distance)))
    t = a / math.hypot(a, distance)
    F = 4.0 / math.pi * t * math.atan(t)  # four times B-3
    move = turned()
    found = closed(ORIGIN, move(UP), move(centred(side, distance)))
    assert found == pytest.approx((omega, F), rel=1e-9)
    assert factors.form_factor(ORIGIN, UP, centred(side, distance))[1] < 1e-12 * F


@pytest.mark.parametrize("scale", [1.0, 1e-2, 1e-4])
def test_what_is_below_the_horizon_does_not_count(scale):
    """A wall from depth to height is seen as B-4 says of its upper part alone."""
    height, depth, away = 0.7 * scale, 0.4 * scale, 1.0

    def corner(side, high):  # B-4: F to a wall whose corner is across from the patch
        c = math.hypot(high, away)
        return (math.atan(side / away) - away / c * math.atan(side / c)) / (2.0 * math.pi)

    wall = np.array([[-1, away, -depth], [1, away, -depth], [1, away, height], [-1, away, height]])
    move = turned(5)
    found = factors.form_factor(ORIGIN, move(UP), move(wall))[0]
    assert found == pytest.approx(2.0 * corner(1.0, height), rel=1e-8)
    assert factors.form_factor(ORIGIN, -UP, wall)[0] == pytest.approx(
        2 * corner(1, depth), rel=1e-7
    )
    above = factors.solid_angle(ORIGIN, factors.clipped(wall, ORIGIN, UP))[0]
    below = factors.solid_angle(ORIGIN, factors.clipped(wall, ORIGIN, -UP))[0]
    assert above + below == pytest.approx(factors.solid_angle(ORIGIN, wall)[0], rel=1e-9)
    assert factors.form_factor(ORIGIN, UP, wall - [0, 0, 2.0])[0] == 0.0


def test_a_concave_polygon_is_the_sum_of_its_parts_from_whichever_corner():
    parts = np.array([[0, 0, 1], [2, 0, 1], [2, 1, 1], [0, 1, 1.0]]), moved(SQUARE, 0, 1, 1)
    place = np.array([0.3, 1.2, 0.1])
    for normal in (UP, np.array([0.6, -0.64, 0.48])):
        expected = np.sum([closed(place, normal, part) for part in parts], axis=0)
        for shift in range(6):
            for one in (np.roll(LETTER_L, shift, axis=0), np.roll(LETTER_L, shift, axis=0)[::-1]):
                assert closed(place, normal, one) == pytest.approx(expected, rel=1e-13)
    expected = sum(F12(SQUARE, part) for part in parts)
    assert F12(SQUARE, LETTER_L) == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(
    "one, other, expected",
    [  # C-11, then C-14
        (SQUARE, SQUARE + 0.1 * UP, 0.82699452239725658),
        (SQUARE, SQUARE + 0.5 * UP, 0.41525328357714674),
        (SQUARE, SQUARE + UP, 0.19982489569838738),
        (SQUARE, SQUARE + 2 * UP, 0.068589588818552448),
        (SQUARE, SQUARE + 10 * UP, 0.0031620568387576016),
        (SQUARE, WALL, 0.20004377607540315),
        (SQUARE, WALL * 2 - [0.5, 0, 0], None),
        (SQUARE, WALL * [1, 1, 2], 0.23285260279536189),
    ],
)
def test_polygons_see_each_other_as_the_catalog_says(one, other, expected):
    move = turned(7)
    flux, error, _ = factors.exchange(move(one), move(other))
    back, _, _ = factors.exchange(move(other), move(one))
    assert flux == pytest.approx(back, rel=1e-12)  # reciprocity
    assert error < 1e-11
    if expected:
        assert flux / factors.plane(one)[1] == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize(
    "radius, expected", [(1.0, 0.38196601125010515), (2.0, 0.76393202250021030)]
)
def test_polygons_of_more_corners_tend_to_coaxial_disks(radius, expected):
    """C-41; a polygon of n corners lacks a share (2 pi / n)^2 / 6 of its disk's area."""
    off = [F12(disk(1, 0, n), disk(radius, 1, n)) - expected for n in (16, 32, 64)]
    assert off[0] / off[1] == pytest.approx(4.0, rel=0.02)
    assert off[1] / off[2] == pytest.approx(4.0, rel=0.01)
    assert abs(off[2]) < 3e-4


@pytest.mark.parametrize("size", [(1, 2, 3), (1, 1, 0.01), (1, 1e-3, 2)])
def test_the_walls_of_a_closed_box_see_each_other_and_nothing_else(size):
    corners = [[x, y, z] for x in (0, size[0]) for y in (0, size[1]) for z in (0, size[2])]
    faces = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))
    walls = [turned(9)(np.array(corners, float)[list(face)]) for face in faces]
    for wall in walls[::2]:  # one of each pair
        row = sum(F12(wall, other) for other in walls if other is not wall)
        assert row == pytest.approx(1.0, abs=1e-10)


def test_small_polygons_far_apart_are_points():
    """A cos theta cos theta' / (pi r^2), at 1e-4 across right to 1e-8."""
    here, there = turned(1)(centred(1e-4, 0)), turned(2)(centred(1e-4, 0))
    there = moved(there, 0.3, -0.2, 1.0)
    way = there.mean(axis=0) - here.mean(axis=0)
    cosines = (factors.facing(a, b)[0] @ way for a, b in ((here, there), (there, here)))
    expected = abs(math.prod(cosines)) * 1e-8 / (math.pi * (way @ way) ** 2)
    assert F12(here, there) == pytest.approx(expected, rel=1e-7)


def test_only_what_lies_in_front_of_each_other_is_seen():
    """A wall through the middle of a floor is seen from the half in front of it, its upper part."""
    through = moved(WALL * [1, 1, 2], 0, 0.5, -1)
    assert F12(SQUARE, through) == pytest.approx(F12(SQUARE * [1, 0.5, 1], WALL) / 2, rel=1e-12)
    assert factors.exchange(SQUARE, moved(SQUARE, 2, 0, 0))[0] == 0.0


PLACES = [
    (UP, centred(1, 1)),
    (UP, moved(WALL * 2, -1, 1, -0.5)),
    (np.array([0.6, 0, 0.8]), LETTER_L),
]


@pytest.mark.parametrize("normal, polygon", PLACES)
@pytest.mark.parametrize("way", ["nusselt", "rays", "points"])
def test_every_way_agrees_within_the_error_it_tells(way, normal, polygon):
    place = np.array([0.1, 0.2, 0.05])
    chance = () if way == "nusselt" else (40_000, 1)
    found = getattr(estimates, way)(place, normal, polygon, *chance)
    omega, F = closed(place, normal, polygon)
    above = factors.solid_angle(place, factors.clipped(polygon, place, normal))[0]
    for (value, error), expected in zip(found, (omega, above, F), strict=True):
        assert abs(value - expected) <= (1.0 if way == "nusselt" else 4.0) * error
        assert error < (1e-9 if way == "nusselt" else 0.06) * expected


@pytest.mark.parametrize(
    "one, other", [(SQUARE, moved(SQUARE * 0.7, 0.3, 0.2, 0.8)), (SQUARE, LETTER_L)]
)
@pytest.mark.parametrize("way", ["nusselt_mean", "rays_between", "points_between"])
def test_every_way_between_polygons_agrees_within_the_error_it_tells(way, one, other):
    chance = () if way == "nusselt_mean" else (40_000, 1)
    for a, b in ((one, other), (other, one)):
        value, error = getattr(estimates, way)(a, b, *chance)
        assert abs(value - F12(a, b)) <= (1.0 if way == "nusselt_mean" else 4.0) * error
        assert error < (1e-5 if way == "nusselt_mean" else 0.05) * value


@pytest.mark.parametrize("side", [1.0, 1e-4])
def test_nusselts_shadow_is_exact_at_every_size(side):
    found = estimates.nusselt(ORIGIN, UP, centred(side, 0.5))
    exact = closed(ORIGIN, UP, centred(side, 0.5))
    assert (found.omega[0], found.F[0]) == pytest.approx(exact, rel=1e-9)


def test_monte_carlo_errs_by_one_over_the_root_and_tells_so():
    off, told = {}, {}
    exact = F12(SQUARE, SQUARE + UP)
    for count in (100, 10_000):
        found = [estimates.rays_between(SQUARE, SQUARE + UP, count, s) for s in range(40)]
        off[count] = math.sqrt(np.mean([(value - exact) ** 2 for value, _ in found]))
        told[count] = np.mean([error for _, error in found])
        assert off[count] == pytest.approx(told[count], rel=0.35)
    assert told[100] / told[10_000] == pytest.approx(10.0, rel=0.1)


@pytest.mark.parametrize("distance", [0.05, 1.0, 10.0])
@pytest.mark.parametrize("side", [2.0, 1e-2, 1e-4])
def test_the_card_keeps_five_digits_at_any_size(side, distance, renderer):
    """Above, partly below the horizon, and of corners too many or concave for one polygon there."""
    move = turned(4)
    wall = moved(np.roll(centred(side, 0), 1, axis=1), distance, 0, 0.2 * side)
    shapes = [(UP, centred(side, distance)), (UP, wall), (UP, disk(side / 2, distance, 8))]
    shapes += [
        (np.array([0.6, 0, 0.8]), moved(LETTER_L - UP, -1, -1, 0) * side / 2 + distance * UP)
    ]
    for normal, polygon in shapes:
        found = factor_card.evaluated(renderer, move(polygon), move(normal))
        assert found[::-1] == pytest.approx(closed(ORIGIN, normal, polygon), rel=1e-5)


def test_where_no_ray_hits_the_error_is_what_may_have_been_missed():
    value, error = estimates.rays(ORIGIN, UP, centred(1e-4, 1), 1000, 0).F
    assert value == 0.0 and error == 3.0 / 1000
