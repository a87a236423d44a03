"""What the panel writes: symbols, units, domains, colours, angles, and its words."""

import pytest

from lumiar import catalog, editing, notation, parts, words


def every_shader():
    return [(kind, name) for kind in ("model", "light") for name in catalog.names(kind)]


@pytest.mark.parametrize("channel", [0.0, 0.001, 0.0031308, 0.18, 0.5, 1.0])
def test_encoding_for_the_screen_has_an_inverse(channel):
    assert notation.decoded(notation.encoded(channel)) == pytest.approx(channel, abs=1e-6)


def test_middle_grey_is_encoded_as_the_standard_says():
    assert notation.encoded(0.2140411) == pytest.approx(0.5, abs=1e-6)  # IEC 61966-2-1


@pytest.mark.parametrize("azimuth", [-170.0, -45.0, 0.0, 90.0])
@pytest.mark.parametrize("elevation", [-80.0, 0.0, 35.0])
def test_angles_and_directions_are_inverse(azimuth, elevation):
    found = notation.angles(notation.toward(azimuth, elevation, 3.0))
    assert found == pytest.approx((azimuth, elevation), abs=1e-5)


@pytest.mark.parametrize(
    "name, text, letter, below",
    [
        ("alpha_x", "rms slope", "α", "x"),
        ("kd", "rho_d, diffuse share", "ρ", "d"),
        ("kd", "diffuse share", "k", "d"),
        ("shininess", "alpha', exponent of the lobe", "α′", ""),
        ("f0", "reflectance", "f", "0"),
        ("temperature", "T", "T", ""),
        ("albedo", "rho of the layer", "ρ", ""),
        ("opacity", "how much of it", "", ""),
    ],
)
def test_symbols_are_those_of_the_papers(name, text, letter, below):
    assert notation.symbol(name, text) == (letter, below)


@pytest.mark.parametrize("kind, name", every_shader(), ids=lambda word: word)
def test_a_domain_is_written_as_in_the_file(kind, name):
    shader = catalog.read(kind, name)
    lines = shader.text.split("\n")
    for parameter in shader.parameters:
        if parameter.widget in ("slider", "choice") and parameter.line:
            assert notation.domain(parameter) in lines[parameter.line - 1]


def test_units_are_printed_with_raised_digits():
    assert notation.unit("W m^-2 sr^-1") == "W m⁻² sr⁻¹"
    assert (notation.unit("unitless"), notation.unit("degrees")) == ("", "°")


def test_every_value_is_explained_in_portuguese():
    tables = (parts.CAMERA, parts.OBJECT, parts.LIGHT)
    given = [parameter for table in tables for parameter in table.values()]
    given += [parts.SCENE[name] for name in editing.PICTURE]
    for kind, name in every_shader():
        given += catalog.read(kind, name).parameters
    short = {p.text for p in given if len(p.text) == 1}  # symbols: T, F, G
    assert {p.text for p in given} - short <= words.TEXT["pt"]["texts"].keys()


def test_both_languages_have_the_same_words():
    english, portuguese = words.TEXT["en"], words.TEXT["pt"]
    assert english.keys() == portuguese.keys()
