"""The errors that studies find are those of the papers; their truth is float64."""

import math

import numpy as np
import pytest

from lumiar import bench, studies, study
from lumiar.timing import Timing


@pytest.fixture(scope="module")
def found():
    """Return a function: a study's name → its Points {(case, variant, metric): error}, Remarks."""
    with bench.Bench(quick=True) as one:
        one.costs = lambda jobs, _: dict.fromkeys(jobs, Timing(1.0, 0.9, 1.1, 1.0, 9))

        def done(name):
            everything = [*studies.load(name).run(one)]
            points = [p for p in everything if isinstance(p, study.Point)]
            remarks = [r for r in everything if isinstance(r, study.Remark)]
            return {(p.case, p.variant, p.metric): p.error for p in points}, remarks

        yield done


def test_schlick_errs_on_glass_as_the_sines_and_tangents_say(found):
    """A. Fresnel, 1823: the largest difference, at 85 degrees, is 0.036."""
    errors, _ = found("fresnel")
    i = np.radians(np.linspace(0.001, 89.999, 90_001))
    t = np.arcsin(np.sin(i) / 1.5)
    F = 0.5 * ((np.sin(i - t) / np.sin(i + t)) ** 2 + (np.tan(i - t) / np.tan(i + t)) ** 2)
    off = np.abs(0.04 + 0.96 * (1.0 - np.cos(i)) ** 5 - F)
    assert errors["glass", "schlick", "absolute"] == pytest.approx(off.max(), rel=1e-3)
    assert errors["glass", "schlick", "relative"] == pytest.approx((off / F).max(), rel=1e-3)
    assert off.max() == pytest.approx(0.036, abs=5e-4)


def test_what_is_constant_misses_all_at_grazing(found):
    errors, _ = found("fresnel")
    assert errors["glass", "constant", "absolute"] == pytest.approx(0.96, abs=0.01)
    for case in ("glass", "outside", "near one", "inside", "metals"):
        assert errors[case, "exact", "relative"] < study.FLOAT


def test_a_power_of_a_rounded_cosine_loses_an_exponent_s_worth_of_digits(found):
    """A cosine within half a step of float32 off, 2^-25 to 2^-24: m times that in the lobe."""
    errors, remarks = found("lobes")
    for m in (1e4, 1e6):
        naive = errors[f"blinn {m:g}", "naive", "relative"]
        assert m * 2.0**-25 < naive < 4.0 * m * 2.0**-24
        assert errors[f"blinn {m:g}", "stable", "relative"] < naive / 30.0
    for m in (10.0, 100.0, 1e4, 1e6):  # Phong's gap takes no more than rounding from what is given
        assert errors[f"phong {m:g}", "stable", "relative"] < study.FLOAT
    assert "not to be told" in remarks[0].en and "não se pode dizer" in remarks[0].pt


def test_the_full_model_is_the_truth_of_diffuse_surfaces(found):
    errors, remarks = found("diffuse")
    for case in ("sigma 10", "sigma 30", "sigma 45"):
        assert errors[case, "full", "brdf"] < 1e-6 and errors[case, "full", "albedo"] < 1e-4
        assert errors[case, "lambert", "brdf"] > errors[case, "qualitative", "brdf"] > 0.0
    gained = [float(word.strip(",:")) for word in remarks[0].en.split() if word[0] in "01"]
    assert gained[0] > 1.0 >= math.floor(gained[1] * 1000.0) / 1000.0  # EON never returns more


def test_no_model_breaks_on_a_hard_case_and_the_slides_do(found):
    errors, remarks = found("precision")
    for (case, variant, metric), error in errors.items():
        if metric == "broken":
            assert error > 0.25 if variant == "printed" else error < 0.02, (case, variant)
            assert variant != "lumiar" or error == 0.0
    assert remarks[0].en.endswith("Lumiar's none.")
