"""The composed source: nothing in it that the scene does not use, and every line traceable."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from lumiar import catalog, compose, flatten, glsltext
from lumiar.errors import Mistake
from lumiar.files import GLSL

LIGHTS = catalog.names("light")
PLAIN = [name for name in LIGHTS if not catalog.read("light", name).sampled]
MODELS = catalog.names("model")
RATES = tuple(compose.STAGES)
WORD = re.compile(r"[A-Za-z_]\w*")
ANISOTROPIC = """\
// model   Fibre
// needs   tangent
uniform float m = 20.0;  // [1, 100]: exponent

vec3 scatter(vec3 L, vec3 V) {
    return vec3(pow(max(1.0 - (L.x + V.x) * (L.x + V.x), 0.0), m)) * max(L.z, 0.0);
}
"""


def surface(model="lambert", lights=("directional",), rate="phong", constants=None, **facts):
    shader = model if isinstance(model, catalog.Shader) else catalog.read("model", model)
    kinds = [catalog.read("light", name) for name in lights]
    return compose.surface(shader, kinds, rate, constants or {}, **facts)


def parsed(text):
    return catalog.parse("model", "m.glsl", "m.glsl", text)


def code(source):
    return glsltext.without_comments(source.text)


@pytest.mark.parametrize("rate", RATES)
def test_a_lambert_scene_has_no_trace_of_anything_else(rate):
    sources = surface(rate=rate, two_sided=False, transformed=False)
    words = {word for source in sources.values() for word in WORD.findall(code(source))}
    foreign = "specular shininess lobe cos_power ks ka H R tangent environment surround position_1"
    foreign += " intensity_1 radiance_1 inner outer spot point ambient rig_world rig_turn rig_back"
    foreign += " srgb_encode tone exposure gl_FrontFacing sample_scatter"
    assert not words & set(foreign.split())
    whole = "\n".join(source.text for source in sources.values())
    assert not re.search(r"Blinn|specular|#include|each light|where ", code_and_marks(whole))


def code_and_marks(text):
    """Return the text without the prose of comments that introduce a file."""
    return "\n".join(line for line in text.split("\n") if not line.startswith("//"))


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("model", [*MODELS, "anisotropic"])
@pytest.mark.parametrize("lights", [(), ("ambient",), ("spot",), (*PLAIN, "spot", "quad", "sky")])
@pytest.mark.parametrize("facts", [(True, True), (False, False)])
def test_everything_declared_is_used(rate, model, lights, facts):
    shader = parsed(ANISOTROPIC) if model == "anisotropic" else model
    sources = surface(shader, lights, rate, two_sided=facts[0], transformed=facts[1])
    for stage, source in sources.items():
        for _, _, names, _, kept in glsltext.chunks(code(source)):
            if kept or "main" in names or any(n.isupper() for n in names):
                continue  # what goes from stage to stage, and the words for choices
            for name in names:
                used = len(re.findall(rf"\b{name}\b", code(source)))
                assert used > 1, f"{name} is declared in the {stage} stage and never used"


@pytest.mark.parametrize("model", [*MODELS, "anisotropic"])
def test_the_reference_compiler_takes_every_variant(model, tmp_path):
    shader = parsed(ANISOTROPIC) if model == "anisotropic" else catalog.read("model", model)
    variants = [{}]
    for parameter in shader.parameters:
        if parameter.constant:
            values = parameter.choices or (True, False)
            variants += [{parameter.name: value} for value in values]
    lights = [catalog.read("light", name) for name in (*PLAIN, "sphere")]
    sources = [
        compose.surface(shader, lights, rate, constants, *facts)
        for rate in RATES
        for constants in variants
        for facts in ((True, True), (False, False), (True, False), (False, True))
    ]
    glslang(sources, tmp_path)


@pytest.mark.parametrize("model", ["lambert", "rough_conductor", "transparency"])
def test_the_reference_compiler_takes_shadows_and_what_is_shown(model, tmp_path):
    """Exact, drawn from both sides, and drawn from the light alone; lights themselves, too."""
    shader = catalog.read("model", model)
    lights = [catalog.read("light", name) for name in LIGHTS]
    fixed = {f"corners_{i}": "five" for i in range(1, len(lights) + 1)}
    numbers = [i for i, light in enumerate(lights, 1) if "light" in light.defines]
    sources = [compose.surface(shader, lights, r, fixed, shadows=numbers) for r in RATES]
    sources += [compose.surface(shader, lights, "phong", fixed, shows=s) for s in compose.SHOWS]
    for i, light in enumerate(lights, 1):
        if {"environment", "arriving"} & light.defines:
            sources.append(compose.backdrop(light, i, fixed))
    glslang([*sources, compose.screen("add", {})], tmp_path)


@pytest.mark.parametrize("model", MODELS)
def test_the_reference_compiler_takes_what_is_measured(model, tmp_path):
    shader = catalog.read("model", model)
    needed = {"surround": "surround", "density": "scatter_pdf", "sampled": "sample_scatter"}
    needed["facet"] = "F_facet"
    kinds = ["scatter", "timed", *(k for k, name in needed.items() if name in shader.defines)]
    kinds += ["weighed"] * ("sampled" in kinds)
    constants = {p.name: p.default for p in shader.parameters if p.constant}
    sources = [
        compose.measured(shader, constants, kind, strict)
        for kind in kinds
        for strict in (False, True)
    ]
    glslang(sources, tmp_path)


@pytest.mark.parametrize("path", sorted((Path(GLSL) / "studies").iterdir()), ids=lambda p: p.stem)
def test_the_reference_compiler_takes_the_formulas_of_studies(path, tmp_path):
    """Every choice, one after the other."""
    if path.read_text().startswith("// light"):
        light = catalog.read("light", str(path))
        drawn = [
            kind for kind in ("light", "exact") if kind == "light" or "irradiance" in light.defines
        ]
        points = ("random", "stratified", "spread")
        lambert = catalog.read("model", "lambert")
        fixed = lambert.constants(lambert.defaults())
        kinds = [(kind, one) for kind in drawn for one in points]
        return glslang(
            [compose.estimated(lambert, light, fixed, *kind) for kind in kinds], tmp_path
        )
    shader = catalog.read("model", str(path))
    defaults = {p.name: p.default for p in shader.parameters if p.constant}
    sources = [
        compose.measured(shader, {**defaults, p.name: value}, "timed")
        for p in shader.parameters
        if p.constant
        for value in (p.choices or (False, True))
    ]
    glslang(sources or [compose.measured(shader, {}, "timed")], tmp_path)


@pytest.mark.parametrize("drawn", ["exact", "light", "even", "cosine", "model", "both"])
def test_the_reference_compiler_takes_estimates(drawn, tmp_path):
    model, light = catalog.read("model", "rough_conductor"), catalog.read("light", "quad")
    fixed = model.constants(model.defaults())
    points = ("random", "stratified", "spread")
    glslang([compose.estimated(model, light, fixed, drawn, one) for one in points], tmp_path)


def test_the_reference_compiler_takes_the_screen(tmp_path):
    tones, targets = ("none", "reinhard", "aces"), ("display", "linear")
    constants = [{"side": 2, "tone": tone, "target": t} for tone in tones for t in targets]
    programs = [compose.screen("present", each) for each in constants]
    glslang([*programs, compose.screen("factor", {})], tmp_path)


def glslang(programs, folder):
    """Compile every stage of every program with the Khronos reference compiler (glslang-tools)."""
    assert shutil.which("glslangValidator"), "install glslang-tools; `make test` does so"
    endings = {"vertex": "vert", "geometry": "geom", "fragment": "frag"}
    texts = {(stage, source.text) for program in programs for stage, source in program.items()}
    files = []
    for i, (stage, text) in enumerate(sorted(texts)):
        files.append(folder / f"{i}.{endings[stage]}")
        files[-1].write_text(text)
    command = ["glslangValidator", *map(str, files)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_every_line_knows_where_it_came_from():
    for source in surface("phong", LIGHTS, two_sided=True, transformed=True).values():
        lines = source.text.split("\n")
        for (path, number), line in zip(source.lines, lines, strict=False):
            if not path:
                continue
            with open(path, encoding="utf-8") as file:
                origin = file.read().split("\n")[number - 1]
            for word in WORD.findall(line.partition("//")[0]):
                base = re.sub(r"_\d+$", "", word)
                assert (
                    base in origin or base in ("const", "bool", "true", "false") or base.isupper()
                )


def test_lights_are_unrolled_by_name():
    source = surface("lambert", ("point", "spot", "point"))["fragment"]
    body = code(source)
    for i in (1, 2, 3):
        assert len(re.findall(rf"\blight_{i}\(", body)) == 2  # the function and its one call
        assert f"uniform vec3 intensity_{i} " in body
    assert "struct Incident" in body and body.count("struct Incident") == 1
    assert not re.search(r"\bfor\b|\bif\s*\(\s*rig_", body)


def test_choices_and_toggles_become_constants():
    body = code(surface("phong", constants={"form": "normalised", "diffuse": False})["fragment"])
    assert "const int FORM_SLIDE = 0, FORM_NORMALISED = 1, form = FORM_NORMALISED;" in body
    assert "const bool diffuse = false;" in body and "const bool specular = true;" in body
    assert not re.search(r"uniform (int|bool)", body)


def test_only_the_chosen_rate_evaluates():
    for rate, stage in (("flat", "geometry"), ("gouraud", "vertex"), ("phong", "fragment")):
        sources = surface("phong", rate=rate)
        assert {s for s, source in sources.items() if "scatter" in code(source)} == {stage}


def test_only_what_loops_is_watched_for_loops_cut_short(tmp_path):
    body = "vec3 scatter(vec3 L, vec3 V) { %s return vec3(L.z); }\n"
    for loop, watched in (("for (int i = 0; i < 9; ++i) {}", True), ("/* for */", False)):
        path = tmp_path / "m.glsl"
        path.write_text("// model   M\n" + body % loop)
        for rate, stage in (("flat", "geometry"), ("gouraud", "vertex"), ("phong", "fragment")):
            assert ("rig_cut_short" in surface(str(path), rate=rate)[stage].text) == watched


def test_an_ambient_light_alone_evaluates_no_lobe():
    body = code(surface("phong", ("ambient",))["fragment"])
    assert "surround" in body and "scatter" not in body and "cos_power" not in body


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ('#include "../secrets.glsl"', "leaves glsl/"),
        ('#include "/etc/passwd"', "leaves glsl/"),
        ('#include "~/x.glsl"', "leaves glsl/"),
        ('#include "lib\\\\lobe.glsl"', "leaves glsl/"),
        ('#include "https://example.org/x.glsl"', "leaves glsl/"),
        ('#include "models/phong.glsl"', "a file of models/ may not include"),
        ('#include "rigs/shade.glsl"', "a file of models/ may not include"),
        ('#include "lib/lobes.glsl"', "did you mean 'lib/lobe.glsl'"),
        ("#include <lobe>", 'write #include "lib/'),
        ("#include", 'write #include "lib/'),
    ],
)
def test_includes_stay_on_their_floor(line, told):
    text = f"{line}\nvec3 scatter(vec3 L, vec3 V) {{ return vec3(1.0); }}\n"
    with pytest.raises(Mistake) as mistake:
        surface(parsed(text))
    assert str(mistake.value).startswith("m.glsl:1: ") and told in str(mistake.value)


def test_a_file_is_included_once_and_circles_are_refused(tmp_path, monkeypatch):
    for folder in ("rigs", "models", "lights", "lib"):
        shutil.copytree(f"{compose.GLSL}/{folder}", tmp_path / folder)
    monkeypatch.setattr(flatten, "GLSL", str(tmp_path))
    (tmp_path / "lib" / "a.glsl").write_text('#include "lib/b.glsl"\nfloat a() { return b(); }\n')
    (tmp_path / "lib" / "b.glsl").write_text("float b() { return 1.0; }\n")
    text = '#include "lib/b.glsl"  // once\n#include "lib/a.glsl"\n'
    text += "vec3 scatter(vec3 L, vec3 V) { return vec3(a() * b()); }"
    assert code(surface(parsed(text))["fragment"]).count("float b()") == 1
    (tmp_path / "lib" / "b.glsl").write_text('#include "lib/a.glsl"\n')
    with pytest.raises(Mistake) as mistake:
        surface(parsed(text))
    told = str(mistake.value)
    assert told.startswith(f"{tmp_path}/lib/a.glsl:1: the files include each other in a circle: ")
    assert told.endswith(" m.glsl -> b.glsl -> a.glsl -> b.glsl")


def test_the_word_include_never_reaches_the_driver():
    text = (
        '// #include "x"\n/* #include "y" */\nvec3 scatter(vec3 L, vec3 V) { return vec3(L.z); }\n'
    )
    assert "#include" not in surface(parsed(text))["fragment"].text


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ("float a[100000];", "m.glsl:3: an array of 100000; allowed: up to 4096"),
        (
            "\n".join(f"uniform float u{i} = 0.0;  // [0, 1]" for i in range(1100)),
            "more than 1024 uniforms",
        ),
    ],
)
def test_what_brings_compilers_down_is_refused_before(body, told):
    uses = "a[int(V.x)]" if "a[" in body else " + ".join(f"u{i}" for i in range(1100))
    text = f"// model  bomb\n\n{body}\nvec3 scatter(vec3 L, vec3 V) {{ return vec3({uses}); }}\n"
    with pytest.raises(Mistake) as mistake:
        surface(parsed(text))
    assert told in str(mistake.value)


def test_unused_functions_and_their_comments_go():
    text = """\
// model   Test

// Never called.
float idle(float x) {
    return x;
}

#define TWICE(x) twice(x)
float twice(float x)
{
    return 2.0 * x;  // called through the macro
}
const float ONE = 1.0, TWO = 2.0;
struct Unused { float x; };
vec3 scatter(vec3 L, vec3 V) { return vec3(TWICE(ONE)); }
"""
    body = surface(parsed(text))["fragment"].text
    assert "idle" not in body and "Never called" not in body and "Unused" not in body
    assert "twice" in body and "const float ONE" in body
