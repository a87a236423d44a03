"""Every sample_scatter against its own density and its own scatter, by chance and by quadrature."""

import itertools
import math

import numpy as np
import pytest

from lumiar import catalog, measure

SHIPPED = [catalog.read("model", name) for name in catalog.names("model")]
SAMPLED = [model for model in SHIPPED if "sample_scatter" in model.defines]
ANGLES = (0.0, 40.0, 80.0)  # degrees of the eye from the normal
COUNT, RINGS, SECTORS, FINE = 200_000, 24, 24, 12


def cases():
    """Yield (model, values) of every choice, with roughness where there is some."""
    for model in SAMPLED:
        wanted = [p for p in model.parameters if p.name in ("distribution", "anisotropic")]
        ranges = [p.choices if p.widget == "choice" else (False, True) for p in wanted]
        for row in itertools.product(*ranges):
            yield (
                model,
                {**model.defaults(), **dict(zip((p.name for p in wanted), row, strict=True))},
            )


CASES = [
    pytest.param(*case, angle, id=f"{case[0].name}-{i}-{angle:g}")
    for i, case in enumerate(cases())
    for angle in ANGLES
]
LEVEL = 1.0 - (1.0 - 0.01) ** (1.0 / len(CASES))  # Z. Sidak, 1967: 0.01 for all of them together


@pytest.fixture(scope="module")
def instrument():
    with measure.Instrument() as one:
        yield one


def chance_of_more(statistic, freedom):
    """Return the probability of a larger chi-square (E. Wilson and M. Hilferty, 1931)."""
    z = ((statistic / freedom) ** (1 / 3) - (1 - 2 / (9 * freedom))) / math.sqrt(2 / (9 * freedom))
    return 0.5 * math.erfc(z / math.sqrt(2.0))


def test_there_is_something_to_sample():
    assert {"lambert", "rough_conductor"} <= {model.name for model in SAMPLED}


@pytest.mark.parametrize(("model", "values", "angle"), CASES)
def test_directions_fall_as_their_density_says(instrument, model, values, angle):
    V = measure.polar(math.radians(angle), 0.6)
    u = np.random.default_rng(3).random((COUNT, 2))
    L, _, _ = instrument.sampled(model, values, np.broadcast_to(V, (COUNT, 3)), u)
    above = L[:, 2] > 0.0
    # cells of equal size in (cos of theta, phi), finely summed
    ring = np.minimum((L[above, 2].astype(float) * RINGS).astype(int), RINGS - 1)
    phi = np.arctan2(L[above, 1], L[above, 0]) % (2.0 * math.pi)
    sector = np.minimum((phi / (2.0 * math.pi) * SECTORS).astype(int), SECTORS - 1)
    seen = np.bincount(ring * SECTORS + sector, minlength=RINGS * SECTORS)
    steps = (np.arange(RINGS * FINE) + 0.5) / (RINGS * FINE)
    turns = (np.arange(SECTORS * FINE) + 0.5) / (SECTORS * FINE) * 2.0 * math.pi
    z, around = (a.ravel() for a in np.meshgrid(steps, turns, indexing="ij"))
    w = np.stack([np.sqrt(1 - z**2) * np.cos(around), np.sqrt(1 - z**2) * np.sin(around), z], 1)
    density = instrument.density(model, values, w, np.broadcast_to(V, w.shape)).astype(float)
    area = 2.0 * math.pi / (RINGS * FINE * SECTORS * FINE)
    cells = (density * area).reshape(RINGS, FINE, SECTORS, FINE).sum(axis=(1, 3)).ravel()
    expected = COUNT * cells
    rare = expected < 10.0
    seen = np.append(seen[~rare], seen[rare].sum() + (~above).sum())
    expected = np.append(expected[~rare], COUNT - expected[~rare].sum())
    statistic = ((seen - expected) ** 2 / np.maximum(expected, 10.0)).sum()
    assert chance_of_more(statistic, len(seen) - 1) > LEVEL


@pytest.mark.parametrize(("model", "values", "angle"), CASES)
def test_a_weight_is_scatter_over_density(instrument, model, values, angle):
    V = np.broadcast_to(measure.polar(math.radians(angle), 0.6), (5000, 3))
    u = np.random.default_rng(4).random((5000, 2))
    L, weight, density = instrument.sampled(model, values, V, u)
    above = L[:, 2] > 1e-3
    assert np.abs(np.linalg.norm(L, axis=1) - 1.0).max() < 1e-5
    pairs = instrument.pairs(L, V)
    scatter = instrument.scatter(model, values, pairs)
    np.testing.assert_allclose(
        weight[above] * density[above, None], scatter[above], rtol=2e-4, atol=1e-7
    )
