"""Spectra, in Python and on the graphics card, against constants of nature and the CIE's tables."""

import json
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from lumiar import catalog, files, measure, reference, spectrum, units

LIGHT = 299.792458  # its speed, um THz
BLACK_BODIES = np.array([  # K, u', v', cd/m^2: sums over the CIE's 1 nm table, 360 to 830 nm;
    (1000, 0.4480071, 0.5319380, 2.6869716e0),  # colour-science 0.4.7 is within 4e-6
    (1500, 0.3579078, 0.5404951, 7.7403136e3),
    (1900, 0.3136243, 0.5395668, 2.4172077e5),
    (2400, 0.2776495, 0.5328599, 3.7022024e6),
    (2856, 0.2559512, 0.5242806, 1.9749784e7),
    (3500, 0.2357108, 0.5112607, 1.0138713e8),
    (4500, 0.2173105, 0.4926849, 5.1663860e8),
    (5778, 0.2047928, 0.4739013, 1.8524242e9),
    (6650, 0.1997022, 0.4639780, 3.3683650e9),
    (8000, 0.1946243, 0.4521136, 6.6480346e9),
    (10000, 0.1903185, 0.4398963, 1.3260488e10),
    (12000, 0.1878520, 0.4316548, 2.1444190e10),
    (16000, 0.1852250, 0.4215093, 4.0817041e10),
    (20000, 0.1838846, 0.4156338, 6.2546173e10),
])  # fmt: skip
PLANCK = {  # W m^-2 sr^-1 um^-1 at 0.55 um, mpmath
    1000.0: 0.010307489906877388,
    2856.0: 249018.79988847653,
    5778.0: 25857643.225158412,
    6500.0: 43063119.24940565,
    10000.0: 186631063.7496415,
}
CIE_15 = {  # x, y
    "A": (0.44758, 0.40745),
    "D50": (0.34567, 0.35851),
    "D55": (0.33243, 0.34744),
    "D65": (0.31272, 0.32903),
    "D75": (0.29903, 0.31488),
    "E": (0.33333, 0.33333),
    "F2": (0.3721, 0.3751),
    "F7": (0.3129, 0.3292),
    "F11": (0.3805, 0.3769),
    "LED-B1": (0.4560, 0.4078),
    "LED-B3": (0.3756, 0.3723),
}
TO_XYZ = np.linalg.inv(spectrum._FROM_XYZ)


@pytest.fixture(scope="module")
def instrument():
    with measure.Instrument() as one:
        yield one


@pytest.fixture(scope="module")
def shader(instrument, tmp_path_factory):
    """Return a function: GLSL of a vec3, of lib/spectrum.glsl and L (n, 3) → its values (n, 3)."""
    path = tmp_path_factory.mktemp("spectrum") / "model.glsl"

    def evaluate(expression, L):
        path.write_text(
            '// model   Probe\n#include "lib/spectrum.glsl"\n'
            f"vec3 scatter(vec3 L, vec3 V) {{ return {expression}; }}\n"
        )
        return evaluated(instrument, catalog.read("model", str(path)), {}, L)

    return evaluate


def evaluated(instrument, model, values, L):
    pairs = instrument.pairs(L, np.zeros((len(L), 3)))
    found = instrument.scatter(model, values, pairs).astype(np.float64)
    instrument.forget(pairs)
    return found


def rows(*columns):
    return np.stack(np.broadcast_arrays(*columns, 0.0, 0.0)[:3], axis=1).astype(np.float32)


def seen(rgb):
    """Return u'v' (n, 2) and luminance (n,) of Lumiar's radiance (n, 3)."""
    X, Y, Z = TO_XYZ @ np.transpose(rgb)
    return np.stack([4.0 * X, 9.0 * Y] / (X + 15.0 * Y + 3.0 * Z), axis=1), units.EFFICACY * Y


def off(rgb):
    """Return how far black bodies of those temperatures are off: u'v', and luminance relatively."""
    uv, luminance = seen(rgb)
    distance = np.hypot(*(uv - BLACK_BODIES[:, 1:3]).T)
    return distance.max(), np.abs(luminance / BLACK_BODIES[:, 3] - 1.0).max()


def test_plancks_law_has_the_known_values(shader):
    for temperature, expected in PLANCK.items():
        assert spectrum.planck(0.55, temperature) == pytest.approx(expected, rel=1e-12)
    found = shader("vec3(planck(0.55, L.x))", rows(list(PLANCK)))[:, 0]
    assert found == pytest.approx(list(PLANCK.values()), rel=4e-6)


def test_plancks_law_is_exact_from_rayleigh_and_jeans_to_wien(shader):
    """Far out 2ckT/lambda^4 is left; at the other end nothing at all, but no NaN either."""
    wavelength = np.float32(10.0) ** np.arange(3.0, 6.0, 0.5)
    found = shader("vec3(planck(L.x, L.y))", rows(wavelength, 3e4))[:, 0]
    ratio = spectrum.FIRST / spectrum.SECOND
    x = spectrum.SECOND / (wavelength.astype(float) * 3e4)
    assert found == pytest.approx(
        ratio * 3e4 / wavelength.astype(float) ** 4 * (1 - x / 2), rel=1e-6
    )
    assert shader("vec3(planck(L.x, L.y))", rows([0.1, 0.36], [500.0, 3.0]))[:, 0].tolist() == [
        0,
        0,
    ]
    assert spectrum.planck(0.36, 3.0) == 0.0


@pytest.mark.parametrize("temperature", [1000.0, 2856.0, 5778.0, 20000.0])
def test_wien_says_where_the_maximum_is(temperature):
    at = 2897.7719551851727 / temperature
    peak, near = spectrum.planck(at, temperature), (at * 0.999, at * 1.001)
    assert all(spectrum.planck(wavelength, temperature) < peak for wavelength in near)
    slope = spectrum.planck(at * (1 + 1e-5), temperature) - spectrum.planck(
        at * (1 - 1e-5), temperature
    )
    assert abs(slope) < 1e-9 * peak


@pytest.mark.parametrize("temperature, share", [
    (2856.0, 0.10527446402658413), (5778.0, 0.4652611069759888), (6500.0, 0.48747251786206657),
])  # fmt: skip
def test_the_visible_share_of_a_black_body_is_the_known_one(temperature, share):
    x, weight = np.polynomial.legendre.leggauss(40)
    radiance = [spectrum.planck(0.58 + 0.2 * t, temperature) for t in x]
    whole = spectrum.STEFAN_BOLTZMANN * temperature**4 / math.pi
    assert 0.2 * (radiance @ weight) / whole == pytest.approx(share, rel=1e-10)


def test_black_bodies_have_the_known_efficacy():
    for temperature, expected in ((2856.0, 16.45), (5778.0, 92.08), (6650.0, 95.43)):
        assert spectrum.source(temperature)[1] == pytest.approx(expected, abs=0.005)
    near = [spectrum.source(temperature)[1] for temperature in (6450.0, 6650.0, 6850.0)]
    assert max(near) == near[1]


def test_a_watt_at_540_terahertz_is_683_lumens(shader):
    """The definition of the candela; on the way K_m = 683.002 and V there."""
    V = shader("vec3(luminosity(L.x))", rows([LIGHT / 540.0, 0.555]))[:, 0]
    assert spectrum.LUMENS * V[0] == pytest.approx(683.0, rel=1e-4)
    assert V[1] == pytest.approx(1.0, abs=1e-6)


def test_black_bodies_have_their_chromaticity_and_luminance(shader):
    """On the graphics card at the model's default number of wavelengths."""
    temperatures = BLACK_BODIES[:, 0]
    made = [spectrum.source(temperature) for temperature in temperatures]
    power = spectrum.STEFAN_BOLTZMANN * temperatures**4 / math.pi
    scale = [p * efficacy / units.EFFICACY for p, (_, efficacy) in zip(power, made, strict=True)]
    assert max(off(np.array([rgb for rgb, _ in made]) * np.array(scale)[:, None])) < 5e-6
    count = catalog.read("model", "black_body").defaults()["wavelengths"]
    distance, luminance = off(shader(f"black_body(L.x, {count}, false)", rows(temperatures)))
    assert distance < 5e-6 and luminance < 1e-5


STATED = {8: (1.6e-2, 1.7e-2), 16: (4.3e-3, 2.5e-3), 24: (7.2e-4, 9.4e-4)}
STATED |= {32: (2.1e-4, 3.2e-4), 48: (5.1e-5, 1.3e-5)}  # PHYSICS B.10 for 380 to 780: 2.0e-3 … 5e-5


@pytest.mark.parametrize("count", STATED)
def test_fewer_wavelengths_cost_what_is_said(shader, count):
    found = off(shader(f"black_body(L.x, {count}, false)", rows(BLACK_BODIES[:, 0])))
    for error, stated in zip(found, STATED[count], strict=True):
        assert 0.3 * stated < error < 1.1 * stated


def test_the_fit_is_as_far_off_as_known(shader):
    """PHYSICS B.10: u'v' 0.018 at 1000 K, 0.0012 at 2856 K; x 0.015."""
    nm = np.array(list(spectrum.observer()))
    table = np.array(list(spectrum.observer().values()))
    error = np.abs(shader("cie_1931_fit(L.x)", rows(nm / 1000.0)) - table).max(axis=0)
    assert error == pytest.approx([0.0148, 0.008, 0.022], rel=0.15)
    uv, _ = seen(shader("black_body(L.x, 95, true)", rows(BLACK_BODIES[:, 0])))
    distance = np.hypot(*(uv - BLACK_BODIES[:, 1:3]).T)
    assert distance[[0, 4]] == pytest.approx([0.018, 0.0013], rel=0.1)


def test_between_its_rows_the_table_follows_the_cies_own(shader):
    """Four rows of the 1 nm table, and one beyond each end."""
    published = {
        443: (0.350013, 0.02695857, 1.7762637),
        557: (0.5446916, 0.9993046, 0.0048998),
        601: (1.0607352, 0.6181555, 0.00076096),
        648: (0.3130192, 0.1187792, 3.2e-6),
        350: (0.0, 0.0, 0.0),
        840: (0.0, 0.0, 0.0),
    }
    found = shader("cie_1931(L.x)", rows(np.array(list(published)) / 1000.0))
    assert found == pytest.approx(np.array(list(published.values())), abs=2.5e-4)


@pytest.mark.parametrize("name", spectrum.names())
def test_illuminants_have_the_chromaticity_of_cie_15(name):
    found = spectrum.chromaticity(spectrum.xyz(spectrum.powers(name)))
    assert found == pytest.approx(CIE_15[name], abs=6e-5)
    sources = (Path(files.ASSETS) / "spectra" / "SOURCES.md").read_text(encoding="utf-8")
    efficacy = spectrum.source(illuminant=name)[1]
    assert f"| {name} | {found[0]:.5f} | {found[1]:.5f} |" in sources
    assert f"| {efficacy:.2f} |" in sources


def test_illuminant_a_is_the_black_body_of_its_definition():
    """100 (560 / l)^5 (exp(1.435e7 / 2848 / 560) - 1) / (exp(1.435e7 / 2848 / l) - 1), CIE 15."""
    powers = spectrum.powers("A")
    for nm in (380, 555, 780):
        rest = math.expm1(1.435e7 / (2848.0 * 560.0)) / math.expm1(1.435e7 / (2848.0 * nm))
        assert powers[nm] / powers[560] == pytest.approx((560.0 / nm) ** 5 * rest, rel=1e-12)
    x, y = spectrum.chromaticity(spectrum.xyz(spectrum.black_body(2856.0)))
    assert (x, y) == pytest.approx((0.447535, 0.407428), abs=2e-6)


def test_white_is_d65_and_what_is_out_of_the_gamut_stays_so():
    assert spectrum.source(illuminant="D65")[0] == pytest.approx((1.0, 1.0, 1.0), abs=2e-4)
    r, _, b = spectrum.source(1000.0)[0]
    assert b == pytest.approx(-0.09, abs=0.005) and r > 4.0
    assert spectrum.source(1850.0)[0][2] < 0.0 < spectrum.source(1950.0)[0][2]


def test_the_matrix_is_that_of_srgbs_primaries():
    """Columns of red, green and blue (IEC 61966-2-1), which make white (0.95047, 1, 1.08883)."""
    x, y = np.array([(0.64, 0.33), (0.3, 0.6), (0.15, 0.06)]).T
    primaries = np.stack([x / y, np.ones(3), (1.0 - x - y) / y])
    expected = primaries * np.linalg.solve(primaries, [0.95047, 1.0, 1.08883])
    assert np.allclose(TO_XYZ, expected, atol=1e-7)
    assert np.allclose(TO_XYZ[1], units.LUMINANCE, atol=1e-7)


def test_the_shader_has_the_same_constants(shader):
    text = (Path(files.GLSL) / "lib" / "spectrum.glsl").read_text(encoding="utf-8")
    constants = dict(re.findall(r"const float (\w+) = ([\d.]+);", text))
    assert {name: float(value) for name, value in constants.items()} == {
        "LUMENS": spectrum.LUMENS,
        "EFFICACY": units.EFFICACY,
    }
    weights = re.search(r"const vec3 LUMINANCE = vec3\((.*)\);", text)[1]
    assert tuple(map(float, weights.split(","))) == units.LUMINANCE
    found = shader("srgb_from_xyz(L)", np.eye(3)).T
    assert found == pytest.approx(np.array(spectrum._FROM_XYZ), rel=1e-6)


def test_exponentials_are_exact_to_float32(shader):
    x = np.concatenate([np.linspace(-86, 88, 4001), np.linspace(-0.6, 0.6, 4001), [-1e-9, 1e-20]])
    x = x.astype(np.float32)
    found = shader("vec3(exponential(L.x), exponential_minus_one(L.x), 0.0)", rows(x))
    x = x.astype(np.float64)
    assert found[:, 0] == pytest.approx(np.exp(x), rel=2.0 * 2.0**-23)
    assert found[:, 1] == pytest.approx(np.expm1(x), rel=2.0 * 2.0**-23, abs=0.0)


def test_a_black_body_emits_planck_and_reflects_the_rest(instrument, tmp_path):
    """A copy of the model that scatters what ours emits."""
    text = catalog.read("model", "black_body").text
    text = text.replace("vec3 scatter(vec3 L", "vec3 reflected(vec3 L")
    path = tmp_path / "glow.glsl"
    path.write_text(text.replace("vec3 emitted(", "vec3 scatter(vec3 L, "))
    model = catalog.read("model", str(path))
    values = {**model.defaults(), "temperature": 3500.0, "emissivity": 0.4}
    (rgb,) = evaluated(instrument, model, values, rows([0.0]))
    assert units.luminance(rgb) == pytest.approx(0.4 * 1.0138713e8, rel=1e-5)
    (color,) = evaluated(instrument, model, {**values, "shown": "color"}, rows([0.0]))
    assert color == pytest.approx(0.4 * np.array(spectrum.source(3500.0)[0]), abs=1e-5)
    up = np.array([[0.0, 0.0, 1.0]])
    assert reference.black_body(up, up, emissivity=0.4) * math.pi == pytest.approx(0.6)
    assert reference.black_body_surround(up, np.ones_like, emissivity=0.4) == pytest.approx(0.6)


def test_a_light_needs_no_numpy():
    code = (
        "import json, sys; from lumiar import units\n"
        'rgb = units.tint("point", "W/sr", 1.0, "lm", {}, (1, 1, 1), 3000.0)\n'
        'print(json.dumps(["numpy" in sys.modules, rgb]))'
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded, rgb = json.loads(done.stdout)
    assert not loaded and len(rgb) == 3
