"""The float64 models against constants, closed forms, properties and other programs.

"Erratum n" numbers a misprint of the slides. Mitsuba and tmm are optional: with these and pytest in
a venv, run there `PYTHONPATH=app python -m pytest --noconftest tests/test_reference.py`.
"""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest

from lumiar import reference
from lumiar import reference_energy as energy
from lumiar import reference_terms as terms

BLACK, WHITE, GOLD = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (1.0, 0.78, 0.34)
METAL = {"eta": (0.2, 0.92, 1.1), "k": (3.91, 2.45, 1.9)}
WARD = {"kd": GOLD, "ks": GOLD, "alpha_x": 0.1, "alpha_y": 0.5}
COOK = {"kd": GOLD, "f0": GOLD, "eta": 1.5, "alpha": 0.2}
SYMMETRIC = [
    ("oren_nayar", {"albedo": GOLD, "sigma": 0.6}),
    ("oren_nayar", {"albedo": GOLD, "sigma": 0.6, "form": "full"}),
    ("oren_nayar", {"albedo": GOLD, "roughness": 0.7, "form": "energy_preserving"}),
    *(("ward", {**WARD, "form": form}) for form in ("ward", "dur", "bounded")),
    ("strand", {"kd": GOLD, "ks": GOLD, "shininess": 20.0}),
    *(("cook_torrance", {**COOK, "shadowing": g}) for g in ("none", "implicit", "v_groove")),
    ("cook_torrance", {**COOK, "distribution": "ggx", "compensated": True}),
    ("rough_conductor", {**METAL, "alpha": 0.2, "alpha_y": 0.6, "anisotropic": True}),
    ("plastic", {"kd": GOLD, "eta": 1.5, "alpha": 0.2, "distribution": "beckmann"}),
    ("transparency", {"albedo": GOLD, "opacity": 0.4}),
]
near = partial(pytest.approx, rel=1e-12, abs=1e-12)
DISTRIBUTIONS = pytest.mark.parametrize("distribution", ["ggx", "beckmann"])


def at(*degrees, phi=0.0):
    theta, phi = np.radians(degrees), np.radians(phi)
    flat = [np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)]
    return np.stack([*flat, np.cos(theta)], axis=1)


def random_pairs(count):
    return (terms.unit(w) for w in np.random.default_rng(7).normal(size=(2, count, 3)))


def hemisphere(degrees, count):
    """Return directions and weights cos(theta) domega for what is even in y with edges at L."""
    x, w = np.polynomial.legendre.leggauss(count)

    def panels(*edges):
        nodes = [((a + b + (b - a) * x) / 2.0, (b - a) * w / 2.0) for a, b in pairwise(edges)]
        return np.hstack(nodes)

    theta, dtheta = panels(0.0, np.radians(degrees), np.pi / 2.0)
    phi, dphi = panels(0.0, np.pi / 2.0, np.pi)
    weight = np.outer(dtheta * np.sin(2.0 * theta), dphi).ravel()
    theta, phi = np.degrees(np.repeat(theta, len(phi))), np.degrees(np.tile(phi, len(theta)))
    return at(*theta, phi=phi), weight


def albedo(name, degrees, count=48, side=1.0, light=1.0, **parameters):
    """Return the share of the light from this angle that leaves into one hemisphere, red."""
    V, weight = hemisphere(degrees, count)
    L = np.repeat(at(degrees), len(V), axis=0)
    scatter = getattr(reference, name)(L * [1, 1, light], V * [1, 1, side], **parameters)
    return (scatter[:, 0] / L[:, 2]) @ weight


def cook(degrees, **parameters):
    lobe = {**COOK, "kd": BLACK, "f0": WHITE, "fresnel": "constant", "alpha": 0.1, **parameters}
    return albedo("cook_torrance", degrees, 160, **lobe)


def mean(F):
    x, w = np.polynomial.legendre.leggauss(200)
    return ((x + 1.0) / 2.0 * F((x + 1.0) / 2.0)) @ w


def brdf(name, L, V, **parameters):
    return getattr(reference, name)(L, V, **parameters) / np.abs(terms.unit(L)[:, 2:])


@pytest.mark.parametrize("n, brewster, critical, at_brewster, outside, inside", [
    (1.33, 53.06123726771, 48.753466631327, 0.07711257030552, 0.065930849299405, 0.4719491487927),
    (1.5, 56.30993247402, 41.810314895779, 0.14792899408284, 0.091777959342351, 0.59634575970771),
    (2.417, 67.523357352716, 24.439743865452, 0.50081532505755, 0.21218758832429, 0.86514423473714),
])  # fmt: skip
def test_fresnel_has_the_known_constants(n, brewster, critical, at_brewster, outside, inside):
    c = np.cos(np.radians([brewster, critical - 1e-6, critical + 1e-6]))
    assert terms.F_dielectric(c[0], n) == near(at_brewster / 2.0)  # R_p = 0
    assert terms.F_dielectric(c[1], 1.0 / n) < 1.0 == terms.F_dielectric(c[2], 1.0 / n)
    assert terms.F_dielectric(1.0, n) == near(((n - 1.0) / (n + 1.0)) ** 2)
    assert terms.average_dielectric(n) == near(outside)
    assert terms.average_dielectric(1.0 / n) == near(inside)
    assert mean(lambda c: terms.F_dielectric(c, n)) == near(outside, abs=1e-9)


def test_fresnel_is_cook_and_torrances_transmits_the_rest_and_is_a_metals_without_absorption():
    c, n = np.meshgrid(np.linspace(0.01, 1.0, 100), [1.0 + 1e-6, 1.33, 2.4])
    g = np.sqrt(n**2 + c**2 - 1.0)
    ratio = (c * (g + c) - 1.0) / (c * (g - c) + 1.0)  # erratum 17
    expected = 0.5 * ((g - c) / (g + c)) ** 2 * (1.0 + ratio**2)
    assert terms.F_dielectric(c, n) == near(expected)
    assert terms.F_conductor(c, n, 0.0) == near(expected)
    for index in (n, 1.0 / n):
        assert terms.F_dielectric(c, index) + terms.T_dielectric(c, index) == near(1.0)


def test_fresnel_of_the_slide_and_schlick_are_as_far_off_as_the_errata_say():
    """Errata 18 (75 degrees is next to a pole) and 20 (on the inside: the angle of refraction)."""
    slide = terms.F_slide(np.cos(np.radians([0.0, 60.0, 75.0])), 1.5)
    assert slide == near([0.441, 5.125, 517.0], rel=1e-3)
    for n, degrees, error in ((1.5, 85.0, 0.036), (1.33, 83.8, 0.060)):
        c, f0 = np.cos(np.radians(degrees)), ((n - 1.0) / (n + 1.0)) ** 2
        assert abs(terms.F_schlick(c, f0) - terms.F_dielectric(c, n)) == near(error, abs=6e-4)
    c, s = np.cos(np.radians(40.0)), np.sin(np.radians(40.0))
    schlick = terms.F_schlick(np.array([c, np.sqrt(1.0 - 1.5**2 * s**2)]), 0.04)
    assert [terms.F_dielectric(c, 1.0 / 1.5), *schlick] == near([0.2453, 0.0407, 0.2456], abs=5e-5)


def test_f82_goes_through_its_two_points_and_keeps_its_mean():
    assert terms.F_f82(np.array([1.0, 1.0 / 7.0]), 0.9, 0.7) == near([0.9, 0.7])
    assert terms.average_f82(0.9, 0.7) == near(mean(lambda c: terms.F_f82(c, 0.9, 0.7)))
    assert terms.average_schlick(0.04) == near(0.085714285714285714)


@pytest.mark.parametrize("degrees, bent, slide", [(20.0, 13.18, 16.31), (60.0, 35.26, 31.48)])
def test_refraction_bends_by_snell_where_the_slide_does_not(degrees, bent, slide):
    ray, passes = terms.refract(at(degrees, phi=30.0), 1.5)
    assert passes.all() and ray == near(at(180.0 - bent, phi=210.0), abs=1e-4)
    s, c = np.sin(np.radians(degrees)) / 1.5, np.cos(np.radians(degrees)) / 1.5
    assert np.degrees(np.arctan2(s, np.sqrt(1.0 - c**2))) == near(slide, abs=5e-3)  # erratum 25
    back, passes = terms.refract(ray, 1.0 / 1.5)
    assert passes.all() and back == near(at(degrees, phi=30.0))
    assert not terms.refract(at(60.0), 1.0 / 1.5)[1].any()


@pytest.mark.parametrize("m, blinn, phong", [
    (1.0, 0.34961552679193, 0.47746482927569), (10.0, 0.66636835986139, 1.9098593171027),
    (100.0, 4.2207890907971, 16.233804195373),
])  # fmt: skip
def test_normalised_lobes_have_the_published_norm_and_albedo_one(m, blinn, phong):
    for name, norm in (("blinn", blinn), ("phong", phong)):
        lobe = {"kd": BLACK, "ks": WHITE, "shininess": m, "form": "normalised"}
        assert brdf(name, at(0.0), at(0.0), **lobe)[0, 0] == near(norm)
        assert albedo(name, 0.0, 64, **lobe) == near(1.0, abs=1e-9)


def test_the_lobes_of_the_slide_gain_energy_and_are_not_reciprocal():
    """Errata 33 and 34, whose lobes are not divided by pi; 43 has its peak beyond the thread."""
    lobe = {"kd": BLACK, "ks": WHITE, "shininess": 10.0}
    phong = [np.pi * albedo("phong", t, **lobe) for t in (0.0, 85.0, 89.0, 89.9)]
    assert phong == near([0.524, 1.03, 3.96, 37.2], rel=5e-3)
    assert [np.pi * albedo("blinn", t, **lobe) for t in (0.0, 89.0)] == near([1.5, 9.13], rel=2e-3)
    L, V = at(20.0), at(-60.0)
    assert brdf("phong", L, V, **lobe) / brdf("phong", V, L, **lobe) == near(0.532, abs=5e-4)
    strand = reference.strand(at(60, 60, 60), at(-60, -120, 60), form="strand", **lobe)
    assert np.pi * strand[:, 0] == near([1.0, 1.0, 0.0])


def test_oren_nayar_loses_and_gains_what_the_errata_say():
    """Erratum 32; sigma = 20 is the slide's in degrees, taken for radians."""
    for sigma, A in ((20.0, 0.500), (np.radians(20.0), 0.865)):
        lit = reference.oren_nayar(at(0.0), at(0.0), albedo=WHITE, sigma=sigma)
        assert np.pi * lit == near(A, abs=5e-4)
    found = [albedo("oren_nayar", t, albedo=WHITE, sigma=s) for t, s in ((89.0, 0.1), (0.0, 0.5))]
    found.append(albedo("oren_nayar", 89.0, albedo=WHITE, sigma=0.3, form="full"))
    assert found == near([1.0075, 0.7845, 1.044], abs=5e-4)


def test_ward_has_the_albedos_and_the_wrong_exponent_of_the_errata():
    lobe, H = {"kd": BLACK, "ks": WHITE, "alpha_x": 0.2, "alpha_y": 0.2}, at(20.0, 30.0)
    both = (reference.ward(H, H, form=form, **lobe) for form in ("slide", "ward"))
    assert np.divide(*both)[:, 0] == near([1.35, 5.1], rel=6e-3)  # erratum 41
    for alpha, form, degrees, expected in (
        (0.2, "ward", 0, 0.895), (0.2, "ward", 85, 0.18), (0.2, "dur", 85, 1.13),  # erratum 42
        (0.2, "dur", 89, 3.38), (0.2, "bounded", 0, 0.96), (0.2, "bounded", 89, 0.9),
        (0.5, "dur", 89, 5.14), (0.5, "bounded", 89, 0.93),
    ):  # fmt: skip
        lobe = {"kd": BLACK, "ks": WHITE, "alpha_x": alpha, "alpha_y": alpha, "form": form}
        assert albedo("ward", degrees, 120, **lobe) == near(expected, abs=6e-3)


def test_published_cook_torrance_is_four_times_the_slide_and_implicit_g_loses():
    norms = [cook(0.0, shadowing="v_groove", norm=norm) for norm in ("slide", "published")]
    assert norms == near([1.0, 4.0], rel=5e-4)  # erratum 44
    found = [cook(degrees, shadowing="implicit") for degrees in (0.0, 60.0, 89.0)]
    assert found == near([0.98, 0.25, 0.0065], rel=1e-2)  # erratum 46


@pytest.mark.parametrize("alpha, distribution, normal, low, mean", [
    (0.1, "ggx", 0.98830, 0.88346, 0.97205), (0.5, "ggx", 0.68785, 0.86011, 0.70024),
    (1.0, "ggx", 1.0 - np.log(2.0), 0.76021, 0.40914), (0.5, "beckmann", 0.94300, None, 0.89342),
])  # fmt: skip
def test_the_single_scattering_albedo_is_the_known_one(alpha, distribution, normal, low, mean):
    lost = energy.lost(np.array([1.0, 0.1]), alpha, distribution)
    found = 1.0 - np.array([*lost, energy.lost_average(alpha, distribution)])
    assert found == near([normal, low or found[1], mean], abs=6e-6)


@DISTRIBUTIONS
@pytest.mark.parametrize("degrees, alpha", [(0.0, 0.4), (40.0, 0.4), (80.0, 0.6), (88.0, 1.0)])
def test_what_is_compensated_returns_all_the_light(degrees, alpha, distribution):
    lobe = {"alpha": alpha, "distribution": distribution, "compensated": True}
    metal = albedo("rough_conductor", degrees, 160, f0=WHITE, form="schlick", **lobe)
    assert [metal, cook(degrees, **lobe)] == near([1.0, 1.0], abs=1e-6)
    white = {"albedo": WHITE, "roughness": alpha, "form": "energy_preserving"}
    assert albedo("oren_nayar", degrees, **white) == near(1.0, abs=1e-6)


@DISTRIBUTIONS
@pytest.mark.parametrize("degrees", [0.0, 50.0, 85.0])
def test_normals_and_visible_normals_have_unit_measure(degrees, distribution):
    """int D n.h = 1 (Walter et al. 2007, eq. 4) and int G1(v) v.h D = n.v."""
    H, weight = hemisphere(degrees, 200)
    D = terms.D(H, 0.3, 0.5, distribution)[:, 0] * weight
    assert D.sum() == near(1.0, abs=1e-6)
    V, G1 = at(degrees), 1.0 / (1.0 + terms.smith_lambda(at(degrees), 0.3, 0.5, distribution))
    assert G1 * ((np.maximum(H @ V[0], 0.0) / H[:, 2]) @ D) == near(V[0, 2], abs=2e-5)


@DISTRIBUTIONS
def test_rough_glass_loses_light_and_is_reciprocal_up_to_the_squares_of_the_indices(distribution):
    """f(l, v) / n_v^2 = f(v, l) / n_l^2 (E. Veach, 1997, sec. 5.2)."""
    glass = {"eta": 1.5, "alpha": 0.3, "distribution": distribution}
    for light in (1.0, -1.0):
        for degrees in (0.0, 30.0, 70.0):
            R = albedo("rough_dielectric", degrees, 100, light, light, **glass)
            T = albedo("rough_dielectric", degrees, 100, -light, light, **glass)
            assert R > 0.0 and T > 0.0 and 0.75 < R + T <= 1.0
    L, V = random_pairs(4000)
    there, back = (brdf("rough_dielectric", *pair, **glass) for pair in ((L, V), (V, L)))
    n2_l, n2_v = (np.where(w[:, 2:] > 0.0, 1.0, 1.5**2) for w in (L, V))
    assert there / n2_v == near(back / n2_l, rel=1e-9, abs=1e-15)
    assert (there[L[:, 2] * V[:, 2] < 0.0] > 0.0).sum() > 900


@pytest.mark.parametrize("name, parameters", SYMMETRIC)
def test_a_model_is_reciprocal_and_black_from_below_and_finite_at_every_angle(name, parameters):
    L, V = (np.where([True, True, False], w, np.abs(w)) for w in random_pairs(500))
    there, back = brdf(name, L, V, **parameters), brdf(name, V, L, **parameters)
    assert there == near(back, rel=1e-9) and (there >= 0.0).all()
    edges = [0.0, 1e-30, 1e-6, 45.0, 89.9999, 90.0, 90.0001, 180.0]
    w = np.vstack([at(*edges, phi=phi) for phi in (0.0, 30.0, 180.0, 210.0)])
    L, V = np.repeat(w, len(w), axis=0), np.tile(w, (len(w), 1))
    value = getattr(reference, name)(L, V, **parameters)
    assert np.isfinite(value).all()
    assert not value[(L[:, 2] <= 0.0) | (V[:, 2] <= 0.0)].any()


def test_surrounds_mirror_and_refract():
    V = np.concatenate([at(0.0, 30.0, 60.0, phi=40.0), at(130.0, 180.0, 90.0)])
    assert reference.dielectric_surround(V, np.ones_like, eta=1.5) == near(np.ones_like(V))
    seen = reference.dielectric_surround(at(60.0), lambda w: (w < 0.0) * 1.0, eta=1.5)[0]
    assert seen == near([1.0, 0.0, 1.0 - terms.F_dielectric(0.5, 1.5)])  # both rays lead to -x
    eta, k = np.array(METAL["eta"]), np.array(METAL["k"])
    exact = ((eta - 1.0) ** 2 + k**2) / ((eta + 1.0) ** 2 + k**2)
    for form, expected in (("schlick", GOLD), ("f82", GOLD), ("exact", exact)):
        metal = {**METAL, "f0": GOLD, "f82": BLACK, "form": form}
        assert reference.conductor_surround(at(0.0), np.ones_like, **metal)[0] == near(expected)
    glass = reference.transparency_surround(at(60.0), np.abs, albedo=GOLD, opacity=0.25)
    assert glass[0] == near([0.75 * np.sqrt(0.75), 0.0, 0.375 + 0.25 * GOLD[2]])


def test_fresnel_agrees_with_tmm():
    tmm = pytest.importorskip("tmm", reason="an optional program to compare with")
    for theta in np.radians([0.0, 20.0, 56.0, 75.0, 89.9]):
        for n in (1.5, 1.0 / 1.2, 0.2 + 3.91j, 1.1 + 1.9j):
            inside, c = tmm.snell(1.0, n, theta), np.cos(theta)
            expected = np.mean([tmm.interface_R(p, 1.0, n, theta, inside) for p in "sp"])
            assert terms.F_conductor(c, np.real(n), np.imag(n)) == near(expected)
            assert np.imag(n) or terms.F_dielectric(c, n) == near(expected)


def test_rough_metal_glass_and_fresnel_agree_with_mitsuba():
    """GGX alone: Mitsuba's Beckmann G1 is 0.3 % off. Its G is separable."""
    mi = pytest.importorskip("mitsuba", reason="an optional program to compare with")
    mi.set_variant("scalar_rgb")
    for c in np.linspace(0.02, 1.0, 40):
        ours = [*terms.F_dielectric(c, np.array([1.5, 1.0 / 1.5])), terms.F_conductor(c, 0.2, 3.9)]
        metal = mi.fresnel_conductor(c, mi.Complex2f(0.2, 3.9))
        assert ours == near([mi.fresnel(c, 1.5)[0], mi.fresnel(c, 1.0 / 1.5)[0], metal], abs=1e-6)
    L, V = random_pairs(400)
    across = L[:, 2] * V[:, 2] < 0.0

    def theirs(**description):
        bsdf, si, values = mi.load_dict(description), mi.SurfaceInteraction3f(), []
        for light, si.wi in zip(L.tolist(), V.tolist(), strict=True):
            values.append(bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(light))[0])
        return np.array(values)

    glass = theirs(type="roughdielectric", distribution="ggx", alpha=0.3, int_ior=1.5, ext_ior=1.0)
    surface = {"alpha": 0.3, "shadowing": "separable"}
    ours = reference.rough_dielectric(L, V, eta=1.5, **surface)[:, 0]
    assert ours == near(glass, rel=1e-5, abs=1e-6)
    assert (glass[across] > 0.0).sum() > 30
    metal = theirs(type="roughconductor", distribution="ggx", alpha=0.3, eta=0.2, k=3.91)
    ours = reference.rough_conductor(L, V, eta=0.2, k=3.91, **surface)[:, 0]
    assert ours == near(metal, rel=1e-5, abs=1e-6)
