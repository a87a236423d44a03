"""What breaks the contract of glsl/README.md is told with its line; what keeps it is drawn."""

import re

import numpy as np
import pytest

from lumiar import catalog, compose, contract, glsltext, settings
from lumiar.errors import Mistake
from lumiar.picture import radiance
from lumiar.scene import Scene

SCATTER = "vec3 scatter(vec3 L, vec3 V) { return vec3(max(L.z, 0.0)); }\n"
BODY = "vec3 scatter(vec3 L, vec3 V) {\n    float x = L.z;\n    %s\n    return vec3(x);\n}\n"
LIGHT = (
    '// light   Own\n#include "lib/light.glsl"\nuniform float power = 3.0;  // [0, 9]: E (W/m^2)\n'
)


def told(text, kind="model"):
    """Return what is said of a text behind its file name."""
    with pytest.raises(Mistake) as mistake:
        catalog.parse(kind, "m.glsl", "m.glsl", text)
    return str(mistake.value).removeprefix("m.glsl:")


def shown(renderer, tmp_path, text, rate="phong"):
    """Return the radiance of a sphere under a light straight from the eye."""
    (tmp_path / "m.glsl").write_text(text)
    scene = Scene.default().set(model=str(tmp_path / "m.glsl"), size=(16, 16), shading=rate)
    return radiance(scene.set(light="directional:direction=0,0,1", background=0.0), renderer)


@pytest.mark.parametrize(
    ("text", "line", "why"),
    [
        (f"\n{SCATTER}\nfloat f(float x) {{\n    return x;\n", 4, "'{' is never closed"),
        (f"{SCATTER}}}\n", 2, "'}' closes nothing"),
        (f"{SCATTER}float f() {{ return (1.0; }}\n", 2, "'}' closes nothing"),
        (f"\n/* one\ntwo\n{SCATTER}", 2, "this comment is never closed by */"),
        (f"\n/*/\n{SCATTER}", 2, "this comment is never closed by */"),
        (f"// one \\\n{SCATTER}", 1, "swallows the line below"),
    ],
)
def test_what_is_never_closed_is_told_with_its_line(text, line, why):
    assert told(text).startswith(f"{line}: ") and why in told(text)


@pytest.mark.parametrize("line", ["float índice = 1.0;", "float f() { return 1.0 − 2.0; }"])
def test_letters_that_drivers_stumble_over_are_told_with_their_line(line):
    letter = next(one for one in line if not one.isascii())
    assert told(f"// ação\n{SCATTER}{line}\n").startswith(f"3: '{letter}' (U+")
    assert told(f"{SCATTER}uniform float é = 1.0;  // [0, 1]: é\n").startswith("2: 'é' (U+00E9)")


@pytest.mark.parametrize(
    "head",
    [
        "vec3 scatter(vec3 L)",
        "vec3 scatter(vec3 L, vec3 V, float x)",
        "float scatter(vec3 L, vec3 V)",
        "vec3 scatter(vec2 L, vec3 V)",
    ],
)
def test_a_wrong_signature_is_told_with_the_right_one(head):
    assert told(f"\n{head} {{ return 1.0; }}\n") == "2: write vec3 scatter(vec3 L, vec3 V)"


def test_a_light_with_a_wrong_signature_is_told_the_right_one():
    text = f"{LIGHT}Incident light(vec3 place) {{ return Incident(place, place); }}\n"
    assert told(text, "light") == "4: write Incident light(vec3 place, vec2 u)"


@pytest.mark.parametrize(
    "head",
    [
        "highp vec3 scatter(vec3 L, vec3 V) {",
        "vec3 scatter(const in highp vec3 L, in vec3 V) {",
        "vec3 scatter(vec3 L, vec3 V)\n// why\n{",
        "vec3 scatter(vec3 L, vec3 V)\n\n{",
        "vec3 scatter(vec3 L, vec3 V)\n/* one\n\ntwo */\n\n{",
        "vec3 scatter(\n    vec3 L,\n    vec3 V\n) {",
        "vec3\nscatter(vec3 L, vec3 V) {",
        "float half_of(float x) { return 0.5 * x; } vec3 scatter(vec3 L, vec3 V) {",
    ],
)
def test_a_function_may_be_written_in_any_layout(renderer, tmp_path, head):
    text = head + "\n    return vec3(max(L.z, 0.0));\n}\n"
    assert (shown(renderer, tmp_path, text) == shown(renderer, tmp_path, SCATTER)).all()


@pytest.mark.parametrize(
    ("line", "use"),
    [
        ("struct Lobe { float share; } lobe;", "lobe.share = x; x = lobe.share;"),
        ("struct Lobe {\n    float share;\n} a, b[2];", "b[1].share = x; x = b[1].share;"),
        ("const struct Lobe { float share; } lobe = Lobe(1.0);", "x *= lobe.share;"),
        ("struct Lobe { float share; }; float f(Lobe b) { return b.share; }", "x = f(Lobe(x));"),
        ("", "struct Lobe { float share; } lobe; lobe.share = x; x = lobe.share;"),
    ],
)
def test_a_struct_and_its_variables_are_kept_where_used(renderer, tmp_path, line, use):
    found = shown(renderer, tmp_path, f"{line}\n{BODY % use}")
    assert found.max() > 0.9 and (found == shown(renderer, tmp_path, BODY % "")).all()


LIGHTS = {  # each gives E = power from above
    "plain": "return Incident(vec3(0, 0, 1), vec3(power));",
    "field": "Beam b = Beam(vec3(0, 0, 1), power); return Incident(b.axis, vec3(b.power));",
    "array": "Beam b; b.power[N - 1] = power; return Incident(vec3(0, 0, 1), vec3(b.power[1]));",
    "variable": "beam.power = power; return Incident(vec3(0, 0, 1), vec3(beam.power));",
    "macro": "return Incident(vec3(0, 0, 1), vec3(HALF(2.0)));",
}
DECLARED = {
    "plain": "",
    "field": "struct Beam {\n    vec3 axis;\n    float power;\n};\n",
    "array": "const int N = 2;\nstruct Beam {\n    float power[N];\n};\n",
    "variable": "struct Beam {\n    float power;\n} beam;\n",
    "macro": "#define POWER power\n#define HALF(x) (0.5 * (x) * POWER)\n",
}


@pytest.mark.parametrize("name", LIGHTS)
def test_a_light_used_twice_keeps_its_two_selves_apart(renderer, tmp_path, name):
    """Its fields, arrays, variables and macros are renamed where they must be, and only there."""
    body = f"Incident light(vec3 place, vec2 u) {{ {LIGHTS[name]} }}\n"
    (tmp_path / "own.glsl").write_text(LIGHT + DECLARED[name] + body)
    lights = [settings.light(f"{tmp_path / 'own.glsl'}:power={power}") for power in (1, 4)]
    scene = Scene.default().set(model="lambert", size=(16, 16), background=0.0)
    found = radiance(scene._replace(lights=tuple(lights)), renderer)
    scene = scene.set(light="directional:direction=0,0,1:irradiance=5")
    assert np.abs(found - radiance(scene, renderer)).max() < 1e-6


@pytest.mark.parametrize(
    "functions",
    [
        "float f(float x) {\n    return f(x - 1.0);\n}\n",
        "float g(float x);\nfloat f(float x) { return g(x); }\nfloat g(float x) { return f(x); }\n",
    ],
)
@pytest.mark.parametrize("rate", ["flat", "gouraud", "phong"])
def test_recursion_is_told_with_file_and_line(renderer, tmp_path, functions, rate):
    with pytest.raises(Mistake, match=r"/m\.glsl:[23]: .*recursion"):
        shown(renderer, tmp_path, f"\n{functions}{BODY % 'x = f(x);'}", rate)


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("#version 330", "'version': the rigs say that"),
        ("#  line 7", "'line': the rigs say that"),
        ("#extension GL_ARB_gpu_shader5 : enable", "'extension': the rigs say that"),
        ("float f() { return gl_FragCoord.x; }", "'gl_FragCoord': one text serves every"),
        ("void f() { discard; }", "'discard': works at one shading rate only"),
        ("float f(float x) { return dFdx(x); }", "'dFdx': works at one shading rate only"),
        ("float f(float x) { return fwidth(x); }", "'fwidth': works at one shading rate only"),
        ("vec4 f(vec2 p) { return texture(s, p); }", "'texture': no textures"),
        ("vec4 f(sampler2D s) { return vec4(0.0); }", "'sampler2D': no textures"),
        ("in vec3 position;", "no inputs or outputs"),
        ("out vec3 color;", "no inputs or outputs"),
        ("flat in int face;", "no inputs or outputs"),
        ("noperspective in highp vec3 p;", "no inputs or outputs"),
        ("layout(location = 0) in vec3 p;", "no inputs or outputs"),
        ("varying vec3 p;", "no inputs or outputs"),
        ("in Block { float x; } b;", "no inputs or outputs"),
        ("float rig_mine(float x) { return x; }", "'rig_mine': names that begin with rig_"),
        ("float f() { return rig_eye.x; }", "'rig_eye': names that begin with rig_"),
        ("float dot(vec3 a, vec3 b) { return 1.0; }", "'dot' is a function of GLSL"),
        ("vec3 normalize(vec3 a)\n{ return a; }", "'normalize' is a function of GLSL"),
        ("float a() { return 1.0; } float sqrt(float b) { return b; }", "'sqrt' is a function of"),
        ("void main() {}", "'main' is a function of the rigs"),
        ("vec3 to_local(vec3 w, float x) { return w; }", "'to_local' is a function of the rigs"),
    ],
)
def test_what_does_not_serve_every_rate_is_refused_with_its_line(line, why):
    said = told(f"// model   M\n\n{line}\n{SCATTER}")
    assert said.startswith("3: ") and why in said
    assert told(f"// model   M\n{SCATTER}\n{line}\n").startswith("4: ")


def test_what_only_looks_forbidden_is_taken():
    text = """\
// discard, texture() and gl_FragCoord in a comment; /* #version 330 */
const float textured = 1.0, main_lobe = 2.0, origin = 0.5;
float f(
    in float x,
    out float y
) {
    y = x;
    return origin;
}
"""
    shader = catalog.parse("model", "m.glsl", "m.glsl", text + SCATTER)
    assert shader.defines == {"f", "scatter"}


@pytest.mark.parametrize(
    "loop",
    [
        "for (;;) {}",
        "for (;;);",
        "for (int i = 0; ; ++i) x += 1.0;",
        "for (; true; ) { x += 1.0; }",
        "while (true) { x += 1.0; }",
        "do { x += 1.0; } while (true);",
    ],
)
def test_a_loop_without_an_end_is_refused_with_its_line(loop):
    assert told(BODY % loop).startswith("3: a loop without an end; give it a condition or a break")


@pytest.mark.parametrize(
    "loop",
    [
        "for (;;) { x += 1.0; if (x > 3.0) break; }",
        "for (;;) if (x > 3.0) break; else x += 1.0;",
        "while (true) { if (x > 3.0) { break; } x += 1.0; }",
        "while (true) { if (x > 3.0) return vec3(x); x += 1.0; }",
        "do { x += 1.0; if (x > 3.0) break; } while (true);",
    ],
)
def test_a_loop_that_breaks_is_drawn(renderer, tmp_path, loop):
    """x grows by ones from L.z in [0, 1] until it is beyond 3."""
    found = shown(renderer, tmp_path, BODY % loop)[8, 8, 0] / np.pi  # the light's irradiance
    assert 3.0 < found <= 4.0


@pytest.mark.parametrize("key", ["mesh", "scale", "light", *catalog.SCENE_KEYS])
def test_a_parameter_named_like_a_key_of_scenes_is_refused(key):
    said = told(f"\nuniform float {key} = 1.0;  // [0, 1]: x\n{SCATTER}")
    assert said == f"2: '{key}' is a key of scenes; rename it"


def test_a_colour_beside_what_is_tinted_is_refused_on_its_line():
    lines = (
        "uniform vec3 color = vec3(1);  // color: x",
        "uniform vec3 E = vec3(1);  // [0, 2] tinted",
    )
    assert told("\n".join([*lines, SCATTER])).startswith("1: 'color' comes with what is tinted")
    assert told("\n".join([*lines[::-1], SCATTER])).startswith("2: 'color' comes with")


@pytest.mark.parametrize(
    "line",
    [
        "uniform float a = 1.0; uniform float b = 1.0;",
        "uniform float a = 1.0; const float b = 1.0;",
        "const float a = 1.0; uniform float b = 1.0;",
        "uniform float a = 1.0, b = 1.0;",
    ],
)
def test_a_parameter_has_its_line_for_itself(line):
    assert told(f"\n{line}  // [0, 2]: x\n{SCATTER}").startswith("2: ")


@pytest.mark.parametrize("place", ["MODEL", "LIGHTS", "FRAME"])
def test_the_places_of_the_rigs_are_not_for_models(place):
    shader = catalog.parse("model", "m.glsl", "m.glsl", f'\n#include "{place}"\n{SCATTER}')
    with pytest.raises(Mistake, match=r"^m\.glsl:2: a file of models/ may not include"):
        compose.surface(shader, [], "phong", {})


@pytest.mark.parametrize("kind", ["model", "light"])
def test_what_comes_with_lumiar_keeps_the_contract(kind):
    """`catalog` does not check these again at every start.

    Two lights look up a table that the host gives: a picture and chances, which are no formula.
    """
    tables = []
    for name in catalog.names(kind):
        shader = catalog.read(kind, name)
        glsltext.check_comments(shader.text, shader.path)
        code = glsltext.without_comments(shader.text)
        if "table" in shader.given:
            tables.append(name)
            code = re.sub(r"sampler2D|texelFetch|textureSize", "lookup", code)
        assert contract.check(code, shader.path, catalog.DEFINES[kind]) == shader.defines
    assert tables == (["environment", "sky"] if kind == "light" else [])
