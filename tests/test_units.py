"""Units of lights: definitions, geometry by quadrature, spellings, and what is refused."""

import math

import numpy as np
import pytest

from lumiar import catalog, spectrum, units
from lumiar.errors import Mistake

WHITE = (1.0, 1.0, 1.0)
SPOT = {"inner": 10.0, "outer": 20.0}
SIX = {"corners": "six", **dict.fromkeys("abcdef", (0.0, 0.0, 0.0))}
SHAPES = [  # kind, native unit, parameters
    ("point", "W/sr", {}),
    ("spot", "W/sr", SPOT),
    ("directional", "W/m^2", {}),
    ("ambient", "W m^-2 sr^-1", {}),
    ("furnace", "W m^-2 sr^-1", {}),
    ("sphere", "W m^-2 sr^-1", {"radius": 0.3}),
    ("disk", "W m^-2 sr^-1", {"radius": 0.3}),
    ("quad", "W m^-2 sr^-1", {"width": 2.0, "height": 0.5}),
]
PAIRS = {"W": "lm", "W/sr": "cd", "W/m^2": "lx", "W/m^2/sr": "cd/m^2"}
SPECTRA = [(None, ""), (1000.0, ""), (6500.0, ""), (None, "A"), (None, "F11"), (None, "LED-B3")]


def told(function, *arguments):
    with pytest.raises(Mistake) as caught:
        function(*arguments)
    return str(caught.value)


def test_efficacy_is_that_of_the_shipped_d65():
    assert pytest.approx(spectrum.source(illuminant="D65")[1], abs=1e-5) == units.EFFICACY
    assert units.luminance(WHITE) == pytest.approx(units.EFFICACY, rel=1e-7)
    image = np.array([[WHITE, (0.0, 1.0, 0.0)]])
    assert units.luminance(image).tolist() == [[units.luminance(tuple(c)) for c in image[0]]]


@pytest.mark.parametrize("temperature, illuminant", SPECTRA)
@pytest.mark.parametrize("kind, native, values", SHAPES)
def test_watts_are_their_lumens_and_lumens_are_kept(kind, native, values, temperature, illuminant):
    """Of every shape and spectrum: W watts and W K_S lumens make one light, of S's colour."""
    color, efficacy = WHITE, units.EFFICACY
    if temperature or illuminant:
        color, efficacy = spectrum.source(temperature, illuminant)
    its = values, WHITE, temperature, illuminant
    for watts in set(units.allowed(native, kind)) & set(PAIRS):
        lumens = PAIRS[watts]
        if lumens not in units.allowed(native, kind):
            lumens = "lm/m^2"
        radiant = units.tint(kind, native, 3.0, watts, *its)
        luminous = units.tint(kind, native, 3.0 * efficacy, lumens, *its)
        assert radiant == pytest.approx(luminous, rel=1e-6)
        assert np.divide(radiant, radiant[1]) == pytest.approx(np.divide(color, color[1]))


def test_a_filter_takes_watts_away_but_no_lumens():
    red = ("point", "W/sr", 2.0)
    assert units.tint(*red, "W/sr", {}, (0.5, 0.25, 0.0)) == (1.0, 0.5, 0.0)
    filtered = units.tint(*red, "cd", {}, (0.5, 0.25, 0.0))
    assert units.luminance(filtered) == pytest.approx(2.0) and filtered[2] == 0.0
    warm, cut = (units.tint(*red, "W/sr", {}, c, 3000.0) for c in (WHITE, (0.5, 0.25, 0.0)))
    assert np.divide(cut, warm) == pytest.approx([0.5, 0.25, 0.0])


@pytest.mark.parametrize("temperature, illuminant", SPECTRA)
def test_a_point_of_800_lumens_is_of_64_candela(temperature, illuminant):
    rgb = units.tint("point", "W/sr", 800.0, "lm", {}, (1.0, 0.5, 0.2), temperature, illuminant)
    assert units.luminance(rgb) == pytest.approx(800.0 / (4.0 * math.pi), rel=1e-6)


def test_a_watt_of_a_black_body_has_its_efficacy():
    """PHYSICS C.7: 16.45 lm/W at 2856 K, so a 100 W bulb of that alone has 131 cd."""
    rgb = units.tint("point", "W/sr", 100.0, "W", {}, WHITE, 2856.0)
    assert units.luminance(rgb) == pytest.approx(1645.0 / (4.0 * math.pi), rel=1e-3)


@pytest.mark.parametrize("inner, outer", [(10.0, 20.0), (0.0, 90.0), (45.0, 45.0), (30.0, 20.0)])
def test_a_spots_flux_is_the_integral_of_its_intensity(inner, outer):
    """The falloff of glsl/lights/spot.glsl, summed over rings."""
    rise = np.linspace(0.0, 1.0 - math.cos(math.radians(outer)), 400_001)  # 1 - cos
    rise = (rise[1:] + rise[:-1]) / 2.0
    edge, full = (1.0 - math.cos(math.radians(angle)) for angle in (outer, inner))
    t = np.clip((edge - rise) / max(edge - full, 1e-20), 0.0, 1.0)
    solid_angle = 2.0 * math.pi * edge * np.mean(t * t * (3.0 - 2.0 * t))
    rgb = units.tint("spot", "W/sr", 5.0, "W", {"inner": inner, "outer": outer}, WHITE)
    assert rgb[0] == pytest.approx(5.0 / solid_angle, rel=1e-6)


@pytest.mark.parametrize("kind, values, area", [
    ("sphere", {"radius": 0.5}, math.pi),
    ("disk", {"radius": 0.5}, math.pi / 4.0),
    ("quad", {"width": 2.0, "height": 3.0}, 6.0),
    ("polygon", {**SIX, "corners": "three", "b": (3.0, 0.0, 0.0), "c": (0.0, 0.0, 4.0)}, 6.0),
    ("polygon", {**SIX, "corners": "four", "a": (0.0, 1.0, 0.0), "b": (2.0, 1.0, 0.0),
                 "c": (2.0, 4.0, 4.0), "d": (0.0, 4.0, 4.0)}, 10.0),
])  # fmt: skip
def test_an_area_light_sends_pi_times_its_radiance_from_its_area(kind, values, area):
    """J. H. Lambert, 1760: exitance is pi L, whatever the shape."""
    native = "W m^-2 sr^-1"
    assert units.tint(kind, native, 7.0, "W", values, WHITE)[0] == pytest.approx(
        7.0 / math.pi / area
    )
    assert units.tint(kind, native, 7.0, "W/m^2", values, WHITE)[0] == pytest.approx(7.0 / math.pi)
    rgb = units.tint(kind, native, 7.0, "lm/m^2", values, WHITE)
    assert units.luminance(rgb) == pytest.approx(7.0 / math.pi)
    assert units.luminance(units.tint(kind, native, 7.0, "cd/m^2", values, WHITE)) == (
        pytest.approx(7.0)
    )


def test_a_uniform_surrounding_gives_pi_times_its_radiance():
    rgb = units.tint("furnace", "W m^-2 sr^-1", 1000.0, "lx", {}, WHITE, 6500.0)
    assert math.pi * units.luminance(rgb) == pytest.approx(1000.0)


@pytest.mark.parametrize(
    "kind", ["point", "spot", "directional", "ambient", "sphere", "disk", "quad", "polygon"]
)
def test_a_shipped_light_may_be_given_in_its_own_unit_first(kind):
    shader = catalog.read("light", kind)
    native = next(p.unit for p in shader.parameters if p.tinted)
    own, *others = units.allowed(native, kind)
    assert units.unit(native) == own and others
    for given in (own, *others):
        values = shader.defaults()
        made = units.tint(kind, native, 2.0, given, values, (1.0, 0.9, 0.8), 2700.0)
        assert all(math.isfinite(channel) for channel in made)


@pytest.mark.parametrize("text, unit", [
    ("W", "W"), ("watts", "W"), ("lm", "lm"), ("Lumen", "lm"), ("cd", "cd"), ("candela", "cd"),
    ("lm/sr", "cd"), ("lx", "lx"), ("lux", "lx"), ("lm/m2", "lm/m^2"), ("lm m^-2", "lm/m^2"),
    ("W/m2", "W/m^2"), ("W/m²", "W/m^2"), ("W·m⁻²", "W/m^2"), ("W m^-2", "W/m^2"),
    ("W/sr", "W/sr"), ("W sr⁻¹", "W/sr"), ("W m^-2 sr^-1", "W/m^2/sr"), ("W/(m² sr)", "W/m^2/sr"),
    ("W/m2/sr", "W/m^2/sr"), ("W/(m^2·sr)", "W/m^2/sr"), ("w/m2sr", "W/m^2/sr"),
    ("cd/m2", "cd/m^2"), ("cd/m²", "cd/m^2"), ("cd m-2", "cd/m^2"), ("nit", "cd/m^2"),
    ("nits", "cd/m^2"), ("candelas per square", None), ("W/m", None), ("lm lm", None),
    ("lm/lm", None), ("m^2", None), ("", None), ("1/W", None), ("W^2", None), ("K", None),
])  # fmt: skip
def test_units_have_many_spellings(text, unit):
    if unit:
        assert units.unit(text) == unit
        assert units.split(f"1.5e2 {text}") == units.split(f" 150{text} ") == (150.0, unit)
    else:
        line = told(units.unit, text, "intensity: ")
        assert line.startswith(f"intensity: no unit '{text}'") and "allowed: W, " in line


def test_a_number_may_come_without_a_unit_but_not_the_other_way_round():
    assert units.split("-.5") == (-0.5, "") and units.split("3.") == (3.0, "")
    for text in ("lm", "", "1,5 lm", "eight lm", "0x10 W", "nan lm"):
        assert told(units.split, text, "here: ").startswith("here: ")


def test_what_cannot_shine_is_refused():
    black = (0.0, 0.0, 0.0)
    assert "brighten its color" in told(units.tint, "point", "W/sr", 1.0, "cd", {}, black)
    assert units.tint("point", "W/sr", 1.0, "W/sr", {}, black) == black
    flat = {"width": 0.0, "height": 1.0}
    assert "larger" in told(units.tint, "quad", "W m^-2 sr^-1", 1.0, "lm", flat, WHITE)


def test_what_has_no_known_shape_keeps_to_its_own_quantity():
    assert units.allowed("W/sr", "/home/me/lamp.glsl") == ("W/sr", "cd")
    assert units.allowed("W m^-2 sr^-1", "studio") == ("W/m^2/sr", "cd/m^2")
    assert units.allowed("unitless", "mine") == ()


def test_ev100_shows_white_at_its_saturation():
    """Lagarde and de Rousiers 2014: 1.2 * 2^EV100 cd/m^2 is the brightest; EV100 15 is sunny."""
    rgb = units.tint("ambient", "W m^-2 sr^-1", 1.2 * 2.0**15, "cd/m^2", {}, WHITE)
    assert units.exposure(15.0) * rgb[0] == pytest.approx(1.0, rel=1e-6)
    assert units.exposure(1.0) / units.exposure(2.0) == pytest.approx(2.0)
