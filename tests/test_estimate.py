"""Estimates of what is reflected, drawn in every way, against closed forms and each other."""

import numpy as np
import pytest

from lumiar import catalog
from lumiar.estimate import Estimator, Way
from lumiar.parts import Light, Object
from lumiar.studies import area_light, environment

DRAWN = ("light", "even", "cosine", "model", "both")


@pytest.fixture(scope="module")
def estimator():
    with Estimator() as one:
        yield one


def scattering(model, **values):
    kind = catalog.read("model", model)
    return Object(kind, {**kind.defaults(), **values})


@pytest.fixture(scope="module")
def floor(estimator):
    """Return Pieces of the floor below a lamp, 1 x 32 places, 64 times over, and the truth."""
    u = np.random.default_rng(1).random((32, 2))
    places = np.broadcast_to(area_light.floor(1.0, u), (64, 32, 3))
    truth = area_light.truth(1.0, places, 0.8)
    return estimator.pieces(places, np.broadcast_to((0.0, 1.0, 0.0), places.shape)), truth


def lamp(kind):
    return area_light.lamps(1.0)[kind]


@pytest.mark.parametrize("points", ["random", "stratified", "spread"])
@pytest.mark.parametrize("kind", ["angle", "area"])
def test_the_mean_of_points_of_a_lamp_is_its_closed_form(estimator, floor, kind, points):
    pieces, truth = floor
    one, way = scattering("lambert"), Way("light", points, 16)
    found = estimator.radiance(pieces, one, lamp(kind), (0.0, 5.0, 0.0), way)[..., 0]
    spread = found.std(axis=0) / 8.0  # of a mean over 64
    assert (np.abs(found.mean(axis=0) - truth[0]) < 5.0 * spread + 1e-6).all()


@pytest.mark.parametrize("drawn", DRAWN)
def test_every_way_to_draw_directions_means_the_same(estimator, floor, drawn):
    pieces, truth = floor
    way = Way(drawn, "random", 64)
    found = estimator.radiance(pieces, scattering("lambert"), lamp("angle"), (0.0, 5.0, 0.0), way)
    spread = found[..., 0].std(axis=0) / 8.0
    assert (np.abs(found[..., 0].mean(axis=0) - truth[0]) < 5.0 * spread + 1e-6).all()


@pytest.mark.parametrize(
    ("points", "power"), [("random", 0.5), ("stratified", 0.9), ("spread", 1.1)]
)
def test_errors_fall_as_they_should(estimator, floor, points, power):
    """C. Lemieux, "Monte Carlo and quasi-Monte Carlo sampling", 2009."""
    pieces, truth = floor
    eye, errors = (0.0, 5.0, 0.0), []
    for n in (4, 64):
        way = Way("light", points, n)
        found = estimator.radiance(pieces, scattering("lambert"), lamp("area"), eye, way)[..., 0]
        errors.append(np.sqrt(np.mean((found / truth - 1.0) ** 2)))
    assert np.log(errors[0] / errors[1]) / np.log(16.0) > power - 0.06


def test_both_closed_forms_are_exact(estimator, floor):
    """The stable one to float32; Lambert's own sum to what a driver's acos leaves."""
    pieces, truth = floor
    for kind, error in (("angle", 1e-6), (area_light.EDGES, 1e-3)):
        found = estimator.radiance(
            pieces, scattering("lambert"), lamp(kind), (0.0, 5.0, 0.0), Way("exact")
        )
        assert np.abs(found[..., 0] / truth - 1.0).max() < error


@pytest.mark.parametrize("drawn", DRAWN)
def test_a_furnace_is_reflected_by_the_albedo(estimator, drawn):
    """Lambert's is 0.8; without noise where directions have the density of what is reflected."""
    points = environment.sphere(environment.spiral(32)).astype(np.float32)
    pieces = estimator.pieces(*[np.broadcast_to(points, (32, 32, 3))] * 2)
    way = Way(drawn, "spread", 64)
    furnace = environment.light("furnace")
    found = estimator.radiance(pieces, scattering("lambert"), furnace, environment.EYE, way)
    assert np.abs(found.mean() / 0.8 - 1.0) < 2e-3
    if drawn in ("cosine", "model"):
        assert np.abs(found / 0.8 - 1.0).max() < 1e-5


def test_the_truth_of_a_furnace_is_the_albedo():
    points = environment.sphere(environment.spiral(5))
    assert environment.truth("furnace", "lambert", points) == pytest.approx(0.8, rel=1e-9)


def test_the_truth_of_an_image_is_what_many_directions_come_to(estimator):
    """Independent of the sums: by the table of chances of the light, on the card."""
    points = environment.sphere(environment.spiral(8))
    pieces = estimator.pieces(*[np.broadcast_to(points, (64, 8, 3))] * 2)
    one, lamp = environment.material("gold 0.3"), environment.light("venice")
    found = estimator.radiance(pieces, one, lamp, environment.EYE, Way("both", "spread", 64))
    true = environment.truth("venice", "gold 0.3", points)
    spread = found.std(axis=0) / 8.0
    assert (np.abs(found.mean(axis=0) - true) < 5.0 * spread + 5e-4 * true).all()


def test_all_of_an_image_is_its_mean_radiance():
    """The solid angles of the nodes add up to the whole sphere; their means do not change."""
    for fine in (1, 2):
        ways, weights = environment.nodes("venice", fine)
        assert np.linalg.norm(ways, axis=1) == pytest.approx(1.0, abs=1e-12)
        if fine == 1:
            whole = weights.sum(axis=0)
    assert weights.sum(axis=0) == pytest.approx(whole, rel=1e-4)


def test_a_piece_does_not_depend_on_how_it_is_timed(estimator, floor):
    pieces, _ = floor
    arguments = (pieces, scattering("lambert"), lamp("angle"), (0.0, 5.0, 0.0), Way("exact"))
    once = estimator.radiance(*arguments)
    estimator.job(*arguments, repeats=32)()  # along a diagonal of all pieces
    assert np.array_equal(estimator.radiance(*arguments), once)


def test_a_light_without_an_extent_of_its_own_kind(estimator, floor):
    kind = catalog.read("light", "quad")
    dark = Light(kind, {**kind.defaults(), "radiance": 0.0})
    found = estimator.radiance(
        floor[0], scattering("phong"), dark, (0.0, 5.0, 0.0), Way("both", "spread", 4)
    )
    assert not found.any()
