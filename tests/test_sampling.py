"""Every sample_scatter against its own density and its own scatter, by chance and by quadrature."""

import math

import numpy as np
import pytest

from lumiar import catalog, measure

SHIPPED = [catalog.read("model", name) for name in catalog.names("model")]
SAMPLED = {model.name: model for model in SHIPPED if "sample_scatter" in model.defines}
MORE = [  # beside the defaults: other choices of lobe, and what stretches it
    ("phong", {"form": "normalised", "diffuse": False}),
    ("rough_conductor", {"distribution": "beckmann", "anisotropic": True}),
    ("rough_conductor", {"distribution": "beckmann", "alpha": 0.5, "compensated": True}),
    ("rough_dielectric", {"distribution": "beckmann"}),
    ("rough_dielectric", {"eta": 0.8}),
    ("strand", {"form": "strand"}),
    ("ward", {"form": "slide", "kd": (0.0,) * 3, "alpha_x": 0.6}),
]
EVEN = ("black_body", "lambert", "oren_nayar", "strand", "transparency")  # drawn whatever V is
CASES = [(name, {}, angle) for name in SAMPLED if name not in EVEN for angle in (0.0, 40.0, 80.0)]
CASES += [(name, {}, 40.0) for name in EVEN] + [(name, more, 60.0) for name, more in MORE]
CASES += [("rough_dielectric", {}, 130.0)]
USED = {
    "black_body": {"emissivity": 0.5},
    "rough_dielectric": {"alpha": 0.8},
}  # beside what is said
EACH = pytest.mark.parametrize(
    "case", CASES, ids=[f"{name}-{angle:g}-{'-'.join(more)}" for name, more, angle in CASES]
)
LEVEL = 1.0 - (1.0 - 0.01) ** (0.5 / len(CASES))  # Z. Sidak, 1967: 0.01 for all of them together
COUNT, RINGS, SECTORS, FINE = 40_000, 24, 24, 9


@pytest.fixture(scope="module")
def instrument():
    with measure.Instrument() as one:
        yield one


@pytest.fixture(scope="module")
def drawn(instrument):
    """Return a function: case → (model, values, V, L, weight, density), drawn once."""
    kept = {}

    def draw(case):
        name, more, angle = case
        key = CASES.index(case)
        if key not in kept:
            model, V = SAMPLED[name], measure.polar(math.radians(angle), 0.6)
            values = {**model.defaults(), **USED.get(name, {}), **more}
            u = np.random.default_rng(3).random((COUNT, 2))
            sample = instrument.sampled(model, values, np.broadcast_to(V, (COUNT, 3)), u)
            kept[key] = model, values, V, *sample
        return kept[key]

    return draw


def chance_of_more(statistic, freedom):
    """Return the probability of a larger chi-square (E. Wilson and M. Hilferty, 1931)."""
    z = ((statistic / freedom) ** (1 / 3) - (1 - 2 / (9 * freedom))) / math.sqrt(2 / (9 * freedom))
    return 0.5 * math.erfc(z / math.sqrt(2.0))


def both_sides(model, values):
    return model.transmits or values.get("form") == "strand"


def integral(instrument, model, values, V, angle, bent, nodes):
    """Return the integral of scatter over all L, its panels finest where lobes may stand."""
    parts = [measure.hemisphere(angle, 0.6 + math.pi, nodes, V[2] < 0.0)]
    if bent is not None:
        parts.append(measure.hemisphere(bent, 0.6 + math.pi, nodes, V[2] > 0.0))
    w, share = (np.concatenate(part) for part in zip(*parts, strict=True))
    share = np.divide(share, np.abs(w[:, 2]), out=np.zeros_like(share), where=w[:, 2] != 0.0)
    pairs = instrument.pairs(w, np.broadcast_to(V, w.shape))
    scatter = instrument.scatter(model, values, pairs).astype(float)
    instrument.forget(pairs)
    return share @ scatter


def test_all_that_scatters_is_sampled():
    smooth = {model.name for model in SHIPPED} - set(SAMPLED)
    assert smooth == {"conductor", "dielectric"}


@EACH
def test_directions_fall_as_their_density_says(instrument, drawn, case):
    model, values, V, L, weight, _ = drawn(case)
    seen = weight.max(axis=1) > 0.0  # what is drawn in vain has no density
    # cells of equal size in (cos of theta, phi), finely summed
    low = -1.0 if both_sides(model, values) else 0.0
    rings = RINGS if low == 0.0 else 2 * RINGS
    ring = ((L[seen, 2].astype(float) - low) * RINGS).astype(int).clip(0, rings - 1)
    phi = np.arctan2(L[seen, 1], L[seen, 0]) % (2.0 * math.pi)
    sector = np.minimum((phi / (2.0 * math.pi) * SECTORS).astype(int), SECTORS - 1)
    found = np.bincount(ring * SECTORS + sector, minlength=rings * SECTORS)
    steps = (np.arange(rings * FINE) + 0.5) / (RINGS * FINE) + low
    turns = (np.arange(SECTORS * FINE) + 0.5) / (SECTORS * FINE)
    w = measure.polar(
        np.repeat(np.arccos(steps), len(turns)), np.tile(turns, len(steps)) * 2 * np.pi
    )
    density = instrument.density(model, values, w, np.broadcast_to(V, w.shape)).astype(float)
    area = 2.0 * math.pi / (RINGS * FINE * SECTORS * FINE)
    cells = (density * area).reshape(rings, FINE, SECTORS, FINE).sum(axis=(1, 3)).ravel()
    expected = COUNT * cells
    rare = expected < 10.0
    found = np.append(found[~rare], found[rare].sum() + (~seen).sum())
    expected = np.append(expected[~rare], COUNT - expected[~rare].sum())
    statistic = ((found - expected) ** 2 / np.maximum(expected, 10.0)).sum()
    assert cells.sum() < 1.003
    assert chance_of_more(statistic, len(found) - 1) > LEVEL


@EACH
def test_a_weight_is_scatter_over_density(instrument, drawn, case):
    model, values, V, *sample = drawn(case)
    L, weight, density = (part[:5000] for part in sample)
    assert np.abs(np.linalg.norm(L, axis=1) - 1.0).max() < 1e-5
    pairs = instrument.pairs(L, np.broadcast_to(V, L.shape))
    scatter = instrument.scatter(model, values, pairs)
    instrument.forget(pairs)
    steady = (weight.max(axis=1) > 0.0) & (np.abs(L[:, 2]) > 1e-3)
    assert np.count_nonzero(steady) > 3000
    np.testing.assert_allclose(
        weight[steady] * density[steady, None], scatter[steady], rtol=2e-4, atol=1e-7
    )
    if not both_sides(model, values):
        assert (weight[L[:, 2] <= 0.0] == 0.0).all()


@EACH
def test_the_mean_weight_is_what_a_quadrature_finds(instrument, drawn, case):
    model, values, V, _, weight, _ = drawn(case)
    angle = math.acos(abs(V[2]))
    bent = None
    if both_sides(model, values):
        n = values.get("eta", 1.0) ** (1.0 if V[2] > 0.0 else -1.0)
        bent = math.asin(min(1.0, math.sin(angle) / n))
    (expected, other) = (
        integral(instrument, model, values, V, angle, bent, nodes) for nodes in (8, 6)
    )
    mean = weight.mean(axis=0, dtype=float)
    spread = weight.std(axis=0, dtype=float) / math.sqrt(COUNT)
    beyond = np.abs(mean - expected) - np.abs(other - expected) - 1e-4
    chance = [
        math.erfc(b / math.sqrt(2.0) / max(s, 1e-12)) for b, s in zip(beyond, spread, strict=True)
    ]
    assert min(chance) > LEVEL / 3.0
