"""A parameter is one line of GLSL: every form of it read, every misuse told with file and line."""

import math

import pytest

from lumiar.errors import Mistake
from lumiar.parameter import Parameter, parse_uniform


def parsed(line):
    return parse_uniform(line, 7, "m.glsl")


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        (
            "uniform float k = 0.7;  // [0.5, 1.5]: limb darkening (unitless)",
            {"default": 0.7, "low": 0.5, "high": 1.5, "text": "limb darkening", "unit": "unitless"},
        ),
        ("uniform float m = 40;//[1, 1000 ..] log", {"log": True, "open": (False, True)}),
        ("  uniform vec3 p = vec3(1, -2.5, 3e1); // [.. -5, 50]", {"default": (1.0, -2.5, 30.0)}),
        (
            "uniform float a = radians(20.0); // [0, 90] degrees: half-angle",
            {"default": 20.0, "degrees": True},
        ),
        (
            "uniform vec3 c = vec3(0.5); // color: albedo",
            {"default": (0.5, 0.5, 0.5), "widget": "color"},
        ),
        ("uniform vec3 d = vec3(0.0, 1.0, 0.0); // direction", {"widget": "direction"}),
        ("uniform bool on = true; // toggle: a term", {"default": True, "constant": True}),
        (
            "uniform int G = 1; // {none, smith, cook_torrance}: shadowing",
            {"default": "smith", "choices": ("none", "smith", "cook_torrance"), "constant": True},
        ),
        ("uniform int n = 3; // [1, 8]: slits", {"default": 3, "type": "int", "constant": False}),
        ("uniform float t = 0.0; // time: since the start (s)", {"widget": "time", "unit": "s"}),
    ],
)
def test_a_line_is_the_whole_declaration(line, expected):
    parameter = parsed(line)
    for key, value in expected.items():
        assert getattr(parameter, key) == value
    assert parameter.line == 7


@pytest.mark.parametrize(
    "line",
    [
        "uniform float k = 0.7;",
        "uniform float k;  // [0, 1]",
        "uniform float k = 0.7, j = 1.0;  // [0, 1]",
        "uniform float k[3];  // [0, 1]",
        "uniform sampler2D t = 0;  // [0, 1]",
        "uniform float k = 0.7;  // a fine number",
        "uniform float k = 0.7;  // [1, 0]: backwards",
        "uniform float k = 0.7;  // [0, 1] log: a log of zero",
        "uniform float k = 0.7;  // [0, 1] logg",
        "uniform float k = 0.7;  // [a, b]",
        "uniform float k = 2.0;  // [0, 1]: default outside",
        "uniform float k = x;  // [0, 1]",
        "uniform float a = 20.0;  // [0, 90] degrees",
        "uniform float k = 0.7;  // color",
        "uniform float k = 0.7;  // toggle",
        "uniform vec3 c = vec3(0.5);  // toggle",
        "uniform vec3 c = vec3(1.5);  // color: more than white",
        "uniform vec3 d = vec3(0.0);  // direction: nowhere",
        "uniform vec3 c = vec3(1, 2);  // [0, 3]",
        "uniform int G = 3;  // {a, b}",
        "uniform int G = 0;  // {a}",
        "uniform int G = 0;  // {a, a}",
        "uniform int G = 0;  // {a, 2b}",
        "uniform bool b = 1;  // toggle",
    ],
)
def test_a_misuse_is_told_with_its_line(line):
    with pytest.raises(Mistake, match=r"^m\.glsl:7: ") as told:
        parsed(line)
    assert "\n" not in str(told.value) and len(str(told.value)) < 300


def test_a_range_is_the_domain_unless_it_is_open():
    closed = Parameter("k", "float", 0.5, low=0.0, high=1.0)
    opened = Parameter("m", "float", 40.0, low=1.0, high=1000.0, open=(False, True))
    assert closed.check(1) == 1.0 and opened.check(1e6) == 1e6
    for parameter, value in ((closed, 1.01), (closed, -0.01), (opened, 0.9), (opened, math.inf)):
        with pytest.raises(Mistake, match="allowed"):
            parameter.check(value)


@pytest.mark.parametrize("value", [math.nan, math.inf, True, "0.5", None, [0.5, 0.5], 1e300])
def test_what_is_no_number_is_refused(value):
    with pytest.raises(Mistake):
        Parameter("k", "float", 0.5, low=0.0, high=1.0).check(value)


def test_text_is_read_as_on_a_command_line():
    vector = Parameter("v", "vec3", (0, 0, 0), low=-5, high=5)
    assert vector.read("1,2,3") == vector.read("[1, 2 3]") == (1.0, 2.0, 3.0)
    assert vector.read("0.5") == (0.5, 0.5, 0.5)
    assert Parameter("s", "ivec2", (1, 1), low=1, high=9999).read("640x480") == (640, 480)
    toggle = Parameter("t", "bool", True, "toggle")
    assert (toggle.read("off"), toggle.read("Yes"), toggle.read("true")) == (False, True, True)
    assert Parameter("n", "int", 1, low=1, high=8).read("3") == 3
    for parameter, text in ((vector, "1,2"), (vector, "red"), (toggle, "maybe")):
        with pytest.raises(Mistake):
            parameter.read(text)
    with pytest.raises(Mistake):
        Parameter("n", "int", 1, low=1, high=8).read("2.5")


@pytest.mark.parametrize("text", ["5e9", "-5e9", "2147483648", "1e30"])
def test_an_open_whole_number_stays_within_32_bits(text):
    """An int of GLSL: from -2^31 to 2^31 - 1."""
    number = Parameter("n", "int", 3, low=0, high=10, open=(True, True))
    assert number.read("2147483647") == 2**31 - 1
    for value in (text, float(text)):
        with pytest.raises(Mistake, match="allowed: a whole number of 32 bits"):
            number.read(value) if isinstance(value, str) else number.check(value)
