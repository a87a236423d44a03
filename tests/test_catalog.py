"""What a GLSL file says of itself."""

import pytest

from lumiar import catalog
from lumiar.errors import Mistake

MINNAERT = """\
// model   Minnaert
// paper   M. Minnaert, "The reciprocity principle in lunar photometry",
//         Astrophysical Journal 93, 1941, p. 403-410
// claims  positive, reciprocal
// note    gains energy for k < 1 at grazing angles
#include "lib/constants.glsl"

uniform vec3 albedo = vec3(0.8);  // color: rho_0 (unitless)
uniform float k = 0.7;            // [0.5, 1.5]: limb-darkening exponent (unitless)
/* uniform float not_this = 1.0; */
// uniform float nor_this = 1.0;

vec3 scatter(vec3 L, vec3 V) {
    return albedo * pow(max(L.z, 0.0), k) * pow(max(V.z, 0.0), k - 1.0);
}
"""


def parsed(text, kind="model"):
    return catalog.parse(kind, "m.glsl", "m.glsl", text)


def test_the_header_of_the_design_page_is_read():
    shader = parsed(MINNAERT)
    assert shader.header["model"] == "Minnaert"
    assert shader.header["paper"].endswith("Astrophysical Journal 93, 1941, p. 403-410")
    assert shader.claims == {"positive": "", "reciprocal": ""}
    assert [p.name for p in shader.parameters] == ["albedo", "k"]
    assert shader.defaults() == {"albedo": (0.8, 0.8, 0.8), "k": 0.7}
    assert shader.defines == {"scatter"}


@pytest.mark.parametrize("kind", ["model", "light"])
def test_every_shipped_file_keeps_the_contract(kind):
    names = catalog.names(kind)
    assert names
    for name in names:
        shader = catalog.read(kind, name)
        assert shader.header[kind]
        assert all(p.text for p in shader.parameters), name
        if kind == "model":
            assert shader.header["paper"] and shader.claims


def test_claims_may_depend_on_a_choice():
    assert catalog.read("model", "lambert").claims["conserving"] == "form = normalised"


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (("vec3 scatter", "vec3 skatter"), "m.glsl:1: a model must define vec3 scatter"),
        (("reciprocal", "reciprokal"), "m.glsl:4: claims 'reciprokal'; did you mean 'reciprocal'"),
        (
            ("reciprocal", "reciprocal (k = high)"),
            "m.glsl:4: 'reciprocal (k = high)' names no choice",
        ),
        (
            ("// note ", "// needs   tangents\n// note "),
            "m.glsl:5: needs 'tangents'; did you mean 'tangent'",
        ),
        (("float k", "float albedo"), "m.glsl:9: 'albedo' is declared twice"),
        (("float k", "float position"), "m.glsl:9: 'position' is a key of scenes"),
        (("// [0.5, 1.5]", "//"), "m.glsl:9: uniform 'k': "),
    ],
)
def test_a_breach_is_told_with_its_line(change, told):
    with pytest.raises(Mistake) as mistake:
        parsed(MINNAERT.replace(*change))
    assert str(mistake.value).startswith(told)


def test_files_that_are_no_text_are_refused(tmp_path):
    for name, data, told in (
        ("nul.glsl", b"// model\n\0", ":2: holds a NUL byte"),
        ("latin.glsl", b"// model\n// \xe9", ":2: not UTF-8"),
        ("big.glsl", b"/" * (catalog.SOURCE_LIMIT + 1), "bytes; allowed"),
    ):
        path = tmp_path / name
        path.write_bytes(data)
        with pytest.raises(Mistake) as mistake:
            catalog.read("model", str(path))
        assert told in str(mistake.value)
    folder = tmp_path / "folder.glsl"
    folder.mkdir()
    with pytest.raises(Mistake, match="not a regular file"):
        catalog.read("model", str(folder))


def test_a_byte_order_mark_and_any_line_end_are_taken(tmp_path):
    for i, end in enumerate((b"\r\n", b"\r", b"\n")):
        path = tmp_path / f"m{i}.glsl"
        path.write_bytes(b"\xef\xbb\xbf" + MINNAERT.encode().replace(b"\n", end))
        assert catalog.read("model", str(path)).parameters[1].line == 9


def test_an_unknown_name_is_told_with_the_closest():
    with pytest.raises(Mistake, match=r"here: no model 'pong'; did you mean 'phong'\?"):
        catalog.read("model", "pong", "here: ")
