"""The sky and the sun: the published model in float64, and what the graphics card makes of it."""

import math

import lamps
import numpy as np
import pytest

from lumiar import daylight, spectrum, units

HEIGHTS = (10, 20, 30, 40, 50, 60)  # degrees: the course's
ZENITH = (1201, 1737, 2237, 2722, 3258, 4098)  # cd/m^2, turbidity 3, albedo 0.3: PHYSICS C.8
DIFFUSE = (9482, 13132, 15604, 17226, 18229, 18951)  # lx on the ground, likewise
AIR_MASS = (5.5860, 2.9031, 1.9943, 1.5534, 1.3042, 1.1540)  # Kasten and Young 1989, likewise
CASES = [  # turbidity, albedo, height and azimuth in degrees
    *((3.0, 0.3, float(height), 30.0) for height in HEIGHTS),
    (1.0, 0.0, 0.0, 0.0),
    (2.5, 0.7, 5.0, -140.0),
    (10.0, 1.0, 90.0, 300.0),
]


@pytest.fixture(scope="module")
def context(renderer):
    with renderer.context:
        yield renderer.context


def test_the_zenith_has_the_published_luminance():
    for height, expected in zip(HEIGHTS, ZENITH, strict=True):
        one = daylight.sky(3.0, 0.3, math.radians(height))
        found = units.EFFICACY * daylight.luminance(one, 1.0, math.radians(90 - height))
        assert found == pytest.approx(expected, abs=0.6)
        rgb = daylight.radiance(one, 1.0, math.radians(90 - height))
        assert units.luminance(rgb) == pytest.approx(found, rel=1e-6)


def test_the_ground_has_the_published_illuminance():
    x, w = np.polynomial.legendre.leggauss(40)
    polar, weight = (x + 1.0) * math.pi / 4.0, w * math.pi / 4.0
    phi = (np.arange(48) + 0.5) * math.pi / 48
    for height, expected in zip(HEIGHTS, DIFFUSE, strict=True):
        h, total = math.radians(height), 0.0
        one = daylight.sky(3.0, 0.3, h)
        for p, share in zip(polar, weight * np.sin(polar) * np.cos(polar), strict=True):
            cosine = math.cos(p) * math.sin(h) + math.sin(p) * math.cos(h) * np.cos(phi)
            ring = [daylight.luminance(one, math.cos(p), math.acos(c)) for c in cosine]
            total += share * 2.0 * math.pi * sum(ring) / 48
        assert units.EFFICACY * total == pytest.approx(expected, rel=3e-4)


def test_at_the_ends_of_the_heights_the_coefficients_are_those_of_the_file():
    """X, albedo 0, turbidity 1, the first of six points: the file's first nine numbers."""
    published = (-1.117001, -0.1867262, -11.13505, 12.59865, -0.03937339, 1.167571, 0.007100686)
    one = daylight.sky(1.0, 0.0, 0.0)
    assert [triple[0] for triple in one.coefficients][:7] == pytest.approx(published, rel=1e-12)


def test_turbidity_and_albedo_are_linear_between_the_data():
    ends = [daylight.sky(t, a, 0.5).coefficients[3] for t, a in ((4, 0), (5, 0), (4, 1), (5, 1))]
    mean = [sum(four) / 4.0 for four in zip(*ends, strict=True)]
    assert daylight.sky(4.5, 0.5, 0.5).coefficients[3] == pytest.approx(mean)


def test_outside_the_air_the_sun_gives_the_solar_illuminance():
    """133.1 klx (Darula, Kittler and Gueymard 2005), extrapolated from six heights to no air."""
    lux = [units.luminance(daylight.sun(2.0, math.radians(height))) for height in HEIGHTS]
    assert math.exp(np.polyfit(AIR_MASS, np.log(lux), 2)[-1]) == pytest.approx(133_100, rel=0.03)


def test_a_low_sun_is_weak_and_red():
    every = [daylight.sun(3.0, math.radians(height)) for height in (0.5, 2, 5, 10, 30, 60, 90)]
    lux = [units.luminance(rgb) for rgb in every]
    assert lux == sorted(lux) and lux[0] < 5000 < 100_000 < lux[-1]
    redness = [rgb[0] / units.luminance(rgb) for rgb in every]
    assert redness == sorted(redness, reverse=True)


def test_the_suns_disk_has_its_solid_angle_and_is_brightest_in_the_middle():
    assert pytest.approx(6.7967023572968099e-5) == daylight.SOLID_ANGLE  # closed_form.json
    coefficients = np.array(daylight.disk(3.0, 0.7))
    mu = np.sqrt((np.arange(2000) + 0.5) / 2000)  # rings of equal solid angle
    radiance = np.stack([mu**i for i in range(6)], 1) @ coefficients
    assert (np.diff(radiance, axis=0) > 0.0).all()
    mean = radiance.mean(axis=0) * daylight.SOLID_ANGLE
    assert mean == pytest.approx(daylight.sun(3.0, 0.7), rel=1e-4)


def test_the_azimuth_runs_from_z_toward_x():
    assert daylight.direction(0.0, 0.0) == pytest.approx((0, 0, 1))
    assert daylight.direction(0.0, math.pi / 2) == pytest.approx((1, 0, 0))
    assert daylight.direction(math.pi / 2, 1.0) == pytest.approx((0, 1, 0))


def test_mitsubas_spectral_sky_is_as_bright():
    """It has the model's data every 40 nm, where those used here are of the whole spectrum."""
    mi = pytest.importorskip("mitsuba", reason="an optional program to compare with")
    mi.set_variant("scalar_spectral")
    x, y, z = daylight.direction(math.radians(30.0), 0.4)
    fields = {"type": "sunsky", "turbidity": 3.0, "albedo": 0.3, "sun_scale": 0.0}
    fields["sun_direction"] = [z, x, y]  # its z is up
    emitter = mi.load_dict({"type": "scene", "one": fields}).emitters()[0]
    directions = [d for d in lamps.even(40) if d[1] > 0.1]
    up, gamma = lamps.sky_angles(np.array(directions), 30.0, math.degrees(0.4))
    ratios = []
    for direction, *angles in zip(directions, up, gamma, strict=True):
        seen, total = mi.SurfaceInteraction3f(), 0.0
        seen.wi = mi.Vector3f(*(-direction[[2, 0, 1]]).tolist())
        for first in range(380, 720, 20):
            waves = range(first, first + 20, 5)
            seen.wavelengths = mi.Spectrum([float(nm) for nm in waves])
            powers = np.ravel(emitter.eval(seen)) * 1000.0  # per nm there, per um here
            total += spectrum.xyz(dict(zip(waves, powers, strict=True)))[1]
        one = daylight.sky(3.0, 0.3, math.radians(30.0))
        ours = units.EFFICACY * daylight.luminance(one, *angles)
        ratios.append(spectrum.LUMENS * total / ours)
    assert np.array(ratios) == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize(("turbidity", "albedo", "height", "azimuth"), CASES)
def test_the_cards_sky_is_the_published_one(context, turbidity, albedo, height, azimuth):
    light = lamps.light("sky", turbidity=turbidity, albedo=albedo, height=height, azimuth=azimuth)
    rng = np.random.default_rng(2)
    sun = np.array(daylight.direction(math.radians(height), math.radians(azimuth)))
    near = sun + rng.normal(size=(300, 3)) * 10.0 ** rng.uniform(-6, -1, (300, 1))
    low = lamps.even(300)
    low[:, 1] = 10.0 ** rng.uniform(-6, -1, 300)
    directions = np.concatenate([lamps.even(1500), near, low])
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    directions[:, 1] = np.abs(directions[:, 1])
    directions = directions.astype(np.float32)
    up, gamma = lamps.sky_angles(directions.astype(float), height, azimuth)
    one = daylight.sky(turbidity, albedo, math.radians(height))
    expected = np.array([daylight.radiance(one, *pair) for pair in zip(up, gamma, strict=True)])
    found = lamps.seen(context, light, directions)
    assert (np.abs(found - expected).max(1) / np.abs(expected).max(1)).max() < 1e-5
    assert not lamps.seen(context, light, directions * (1, -1, 1) - (0, 1e-30, 0)).any()
    assert (lamps.seen(context, light, directions, "arriving") == found).all()


@pytest.mark.parametrize(("turbidity", "albedo", "height", "azimuth"), CASES[::3])
def test_directions_of_the_sky_fall_as_their_density_says(
    context, turbidity, albedo, height, azimuth
):
    light = lamps.light("sky", turbidity=turbidity, albedo=albedo, height=height, azimuth=azimuth)
    turn = math.radians(azimuth)
    assert lamps.chance_of_such(context, light, 100_000, (64, 16), math.pi / 2, turn) > 0.003


def test_an_irradiance_of_the_sky_is_its_radiance_over_the_density(context):
    light = lamps.light("sky", height=25.0, azimuth=110.0)
    directions, density, irradiance = lamps.drawn(context, light, lamps.grid(64, 64))
    radiance = lamps.seen(context, light, directions)
    assert np.abs(radiance / density[:, None] / irradiance - 1.0).max() < 1e-5
    assert density.min() > 0.0 and np.abs(np.linalg.norm(directions, axis=1) - 1).max() < 1e-6
    assert not lamps.seen(context, light, [[0, -1, 0]], "density").any()


@pytest.mark.parametrize(("height", "expected"), [*zip(HEIGHTS, DIFFUSE, strict=True)])
def test_sampled_the_sky_gives_the_published_illuminance(context, height, expected):
    light = lamps.light("sky", height=float(height))
    directions, _, irradiance = lamps.drawn(context, light, lamps.jittered(256, 256))
    found = units.luminance((irradiance * directions[:, 1:2]).mean(axis=0))
    assert found == pytest.approx(expected, rel=5e-4)


def test_all_that_a_sky_and_a_sun_are_made_of_matters(context):
    directions = lamps.even(50)
    usual = lamps.seen(context, lamps.light("sky"), directions)
    for name, value in (("turbidity", 5.0), ("albedo", 0.9), ("height", 41.0), ("azimuth", 31.0)):
        assert (lamps.seen(context, lamps.light("sky", **{name: value}), directions) != usual).any()
    doubled = lamps.seen(context, lamps.light("sky", strength=2.0), directions)
    assert np.allclose(doubled, 2.0 * usual)
    usual = np.hstack(lamps.drawn(context, lamps.light("sun"), [(0.3, 0.4)])[::2])
    for name, value in (("turbidity", 5.0), ("height", 41.0), ("azimuth", 31.0), ("strength", 2.0)):
        light = lamps.light("sun", **{name: value})
        assert (np.hstack(lamps.drawn(context, light, [(0.3, 0.4)])[::2]) != usual).any()


@pytest.mark.parametrize(("turbidity", "height"), [(3.0, 40.0), (2.0, 0.0), (10.0, 90.0)])
def test_sampled_the_sun_gives_its_irradiance(context, turbidity, height):
    light = lamps.light("sun", turbidity=turbidity, height=height, azimuth=70.0, strength=2.0)
    directions, density, irradiance = lamps.drawn(context, light, lamps.grid(256, 16))
    expected = daylight.sun(turbidity, math.radians(height))
    assert irradiance.mean(axis=0) == pytest.approx(2.0 * np.array(expected), rel=1e-4)
    assert np.allclose(density, 1.0 / daylight.SOLID_ANGLE, rtol=1e-6)
    _, angle = lamps.sky_angles(directions, height, 70.0)
    assert 0.997 * daylight.RADIUS < angle.max() < daylight.RADIUS
    inner = angle < 0.99 * daylight.RADIUS
    arriving = lamps.seen(context, light, directions[inner], "arriving")
    assert np.allclose(arriving / density[inner, None], irradiance[inner], rtol=1e-3)
    middle = np.array(daylight.direction(math.radians(height), math.radians(70.0)))
    off = directions - middle
    outside = middle + off / np.linalg.norm(off, axis=1)[:, None] * 1.001 * daylight.RADIUS
    assert not lamps.seen(context, light, outside, "arriving").any()
    assert not lamps.seen(context, light, outside, "density").any()
