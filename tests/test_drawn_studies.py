"""The studies that draw: their truths, and what each yields when it is small and untimed."""

import itertools

import numpy as np
import pytest

from lumiar import bench, colorimetry, reference, reference_terms, spectrum, studies, study
from lumiar.measure import timing
from lumiar.studies import environment, scale, shading_rate
from lumiar.studies import spectrum as spectra

TINY = {
    "shading-rate": {"MESHES": {True: (1, 2)}, "SIDE": 64, "SHOWN": (1,)},
    "area-light": {"COUNTS": {True: (1, 4)}, "SHOWN": 4, "PICTURE": 8},
    "environment": {"COUNTS": {True: (1, 16)}, "PLACES": 4},
    "spectrum": {"SUMS": {True: (8, 95)}, "FITS": {True: ()}},
    "scale": {"COUNTS": {"lights": ((), (1, 2)), "triangles": ((), (1024, 4096))}},
}


@pytest.fixture(scope="module")
def tiny():
    with bench.Bench(quick=True) as one:

        def race(jobs, *_, **__):
            for job in jobs.values():
                job()
            return dict.fromkeys(jobs, timing.Timing(1e-3, 0.9e-3, 1.1e-3, 0.0, 9))

        one.race = race
        one.costs = lambda jobs, _: dict.fromkeys(jobs, timing.Timing(9.0, 8.0, 10.0, 1.0, 9))
        yield one


@pytest.fixture(params=TINY)
def yielded(request, tiny, monkeypatch):
    """Return a study's module and all that it yields from a tiny plan."""
    module = studies.load(request.param)
    for name, value in TINY[request.param].items():
        monkeypatch.setattr(module, name, value)
    return module, [*module.run(tiny)]


def test_a_study_yields_points_pictures_and_remarks_that_it_has_words_for(yielded):
    module, found = yielded
    points = [one for one in found if isinstance(one, study.Point)]
    assert points
    for point in points:
        assert {point.case, point.variant, point.metric} <= {*module.WORDS}
        assert point.metric in module.METRICS and point.unit in ("ns", "ms", "MB")
        assert point.low <= point.cost <= point.high and point.cost > 0.0
        assert point.error is None or 0.0 <= point.error < 100.0
        assert all(isinstance(value, float) for value in (point.parameters or {}).values())
    assert len({(p.case, p.variant, p.metric) for p in points}) == len(points)
    for one in found:
        if isinstance(one, study.Shown):
            assert one.pixels.shape == (*one.error.shape, 3) and np.isfinite(one.pixels).all()
            assert {one.case, one.variant} <= {*module.WORDS} and max(one.error.shape) <= 256
        if isinstance(one, study.Remark):
            assert one.en and one.pt and "{" not in one.en + one.pt


def test_the_true_sphere_is_what_a_point_on_it_sends():
    """In the middle of the picture the normal is (0, 0, 1): Phong's terms by hand."""
    one = shading_rate.scene("phong", 1, 50.0, side=65)
    radiance, normals = shading_rate.analytic(one)
    assert normals[32, 32] == pytest.approx([0.0, 0.0, 1.0], abs=1e-12)
    L = reference_terms.unit(np.array([one.lights[0].values["direction"]]))
    values, power = one.objects[0].values, one.lights[0].values["irradiance"]
    expected = power * reference.phong(L, np.array([[0.0, 0.0, 1.0]]), **values)
    ambient = np.multiply(values["ka"], one.lights[1].values["radiance"])
    assert radiance[32, 32] == pytest.approx(expected[0] + ambient, rel=1e-12)
    edge = np.isfinite(normals[..., 0]).sum() / 65**2
    tangent = np.tan(np.arcsin(1.0 / 4.0)) / np.tan(np.radians(15.0))
    assert edge == pytest.approx(np.pi / 4.0 * tangent**2, rel=5e-3)


def test_phong_on_finer_meshes_comes_to_the_true_sphere(tiny):
    truth, normals = shading_rate.analytic(shading_rate.scene("phong", 1, 50.0, side=96))
    inside, errors = np.isfinite(normals[..., 0]), []
    for n in (2, 3, 4):
        pixels = tiny.image(shading_rate.scene("phong", n, 50.0, side=96))
        errors.append(shading_rate.compared(pixels, truth, inside, False)[0]["rmse"])
    assert errors[0] > 2.5 * errors[1] > 6.25 * errors[2]


def test_gouraud_on_a_finer_mesh_is_said_to_beat_phong_only_where_it_does():
    def point(variant, error, cost):
        return study.Point(
            "", "m = 5", variant, "rmse", error, cost, 0.9 * cost, 1.1 * cost, 0, "ms"
        )

    coarse, fine = point("phong 80", 0.02, 3.0), point("gouraud 5120", 0.01, 2.0)
    (remark,) = shading_rate.remarks(5.0, [coarse, fine])
    assert "5,120" in remark.en and "nearer" in remark.en and "5.120" in remark.pt
    (remark,) = shading_rate.remarks(5.0, [coarse, fine._replace(error=0.03)])
    assert "no mesh" in remark.en
    assert not [*shading_rate.remarks(5.0, [coarse, point("gouraud 5120", 0.01, 3.0)])]


def test_the_light_of_a_lamp_is_its_own_colour_where_all_is_reflected():
    """And the sums of ever more bins add up to the same."""
    _, weights = spectra._weights("A")
    x, y = spectrum.chromaticity(weights.sum(axis=0))
    assert (x, y) == pytest.approx((0.44758, 0.40745), abs=2e-5)  # CIE 15
    for count in (3, 48):
        rgb = spectra._binned("gold", "A", count)[2].sum(axis=0)
        assert rgb == pytest.approx(spectrum.rgb(weights.sum(axis=0)), rel=1e-9)


def test_gold_reflects_as_its_index_says():
    """F at normal incidence of n + ik: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2)."""
    n, k = spectra.metal_spectrum("gold", 650.0)
    found = spectra._fresnel(np.ones(1), n + 1j * k)
    assert found[0] == pytest.approx(((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2), rel=1e-12)


def test_more_wavelengths_are_never_much_worse(tiny):
    cosines = np.linspace(0.0, 1.0, 17)
    truth, white = spectra.reflected("gold", "D65", cosines)
    errors = []
    for triples in (2, 4, 8, 16):
        job = (spectra.metal_model("gold", "D65", triples), {})
        lab = colorimetry.lab(spectra._measured(tiny, job, cosines) @ spectra.TO_XYZ.T, white)
        errors.append(colorimetry.difference(lab, colorimetry.lab(truth, white)).max())
    assert errors[0] < 3.0 and errors[-1] < 0.05
    assert all(b < 0.6 * a for a, b in itertools.pairwise(errors))


def test_krysteks_fit_is_as_good_as_he_says(tiny):
    """Within 8e-5 in u and 9e-5 in v (1960) from 1000 to 15000 K, with the constants of his day."""
    model = tiny.formulas("black_body")
    job = (model, {**model.defaults(), "form": "krystek"})
    kelvin = np.array([1000.0, 2000.0, 4000.0, 8000.0, 15000.0])
    cosines = (1e6 / kelvin - 50.0) / 950.0
    uv = colorimetry.chromaticity(spectra._measured(tiny, job, cosines) @ spectra.TO_XYZ.T)
    true = colorimetry.chromaticity([spectrum.xyz(spectrum.black_body(T)) for T in kelvin])
    assert (np.abs(uv - true) < (1e-4, 1.5 * 1.1e-4)).all()


def test_the_exponent_of_a_power_law_is_found_within_its_bounds():
    counts = [10.0, 100.0, 1e3, 1e4]
    points = [
        study.Point("", "lights", "", "time", None, n**0.7, 0.95 * n**0.7, 1.05 * n**0.7, 0, "ms",
                    parameters={"count": n})
        for n in counts
    ]  # fmt: skip
    low, high = scale.power(points)
    assert low < 0.7 < high and high - low < 0.1


def test_a_default_is_held_to_the_worst_of_all_cases():
    def point(case, variant, error):
        return study.Point("environment", case, variant, "rms", error, 1.0, 0.9, 1.1, 0.0, "ns")

    found = [point("a", "both 16", 0.2), point("a", "model 64", 0.1)]
    found += [point("b", "both 16", 0.2), point("b", "model 64", 5.0)]
    errors = {p.variant: (p.error, p.default) for p in environment.together(found)}
    assert errors == {"both 16": (0.2, True), "model 64": (5.0, False)}
