"""Scenes: TOML in and out, values by name, and one line for whatever is wrong."""

import math
import os

import pytest

from lumiar import scenefile, settings
from lumiar.errors import Mistake
from lumiar.scene import Scene

FULL = """\
title = { en = "Two spheres", pt = "Duas esferas" }
size = [320, 200]
samples = 9
shading = "gouraud"
background = [0.1, 0.2, 0.3]
exposure = 1.5
tone = "aces"
time = 2.0

[camera]
position = [0, 1, 8]
target = [0, 0, 0]
fov = 25

[[object]]
name = "left"
mesh = "sphere:subdivision=3"
model = "blinn"
position = [-1.2, 0, 0]
kd = [0.6, 0.1, 0.1]
shininess = 200
specular = false

[[object]]
mesh = "torus:minor=0.2"
model = "lambert"
rotation = [90, 0, 0]
scale = 0.8
fit = 1.5
crease = 30
form = "slide"

[[light]]
kind = "spot"
name = "lamp"
position = [3, 4, 5]
inner = 5
outer = 15

[[light]]
kind = "ambient"
radiance = 0.3

[[panel]]
caption = { en = "dim", pt = "fraca" }
set = { "lamp.intensity" = 10, "left.kd" = [0, 1, 0] }

[[panel]]
caption = "flat"
set = { shading = "flat" }
"""


def parsed(text, path="scene.toml"):
    return scenefile.parse(text, path, Scene.default())


def test_a_scene_file_says_everything():
    scene = parsed(FULL)
    assert (scene.size, scene.samples, scene.shading) == ((320, 200), 9, "gouraud")
    assert (scene.background, scene.exposure, scene.tone) == ((0.1, 0.2, 0.3), 1.5, "aces")
    left, ring = scene.objects
    assert (left.name, left.mesh, left.model.name) == ("left", "sphere:subdivision=3", "blinn")
    assert left.values["kd"] == (0.6, 0.1, 0.1) and left.values["ks"] == (0.4, 0.4, 0.4)
    assert left.values["specular"] is False and left.position == (-1.2, 0.0, 0.0)
    assert (ring.scale, ring.fit, ring.crease) == ((0.8,) * 3, 1.5, 30.0)
    assert ring.values["form"] == "slide"
    lamp, sky = scene.lights
    assert (lamp.kind.name, lamp.name, lamp.values["outer"]) == ("spot", "lamp", 15.0)
    assert sky.values == {"color": (1.0, 1.0, 1.0), "radiance": 0.3}
    assert scene.camera.position == (0.0, 1.0, 8.0) and scene.camera.fov == 25.0
    assert scene.panels[0].caption == {"en": "dim", "pt": "fraca"}
    assert scene.panels[1].values == (("shading", "flat"),)


def test_toml_round_trip(tmp_path):
    for scene in (parsed(FULL), Scene.default()):
        assert parsed(scene.toml(str(tmp_path))) == scene


def test_every_shipped_scene_loads_and_survives_its_own_text():
    names = scenefile.shipped()
    assert {"phong-terms", "phong-blinn", "shading-rates", "teapot", "models"} <= set(names)
    for name, path in names.items():
        scene = Scene.load(name)
        assert set(scene.title) == {"en", "pt"}, name
        for panel in scene.panels:
            assert panel.scene or set(panel.caption) == {"en", "pt"}, name
        assert scenefile.parse(scene.toml(os.path.dirname(path)), path, Scene.default()) == scene


def test_a_scene_is_frozen():
    with pytest.raises(AttributeError):
        Scene.default().exposure = 1.0


@pytest.mark.parametrize(
    ("text", "line", "told"),
    [
        ("exposur = 1", 1, "unknown key 'exposur'; did you mean 'exposure'?"),
        ("\n\nshading = 'gouraut'", 3, 'shading = "gouraut" is not possible; allowed: one of flat'),
        ("exposure = '1'", 1, 'exposure = "1" is not possible'),
        ("exposure = true", 1, "exposure = true is not possible"),
        ("exposure = nan", 1, "exposure = nan is not possible; allowed: -20 to 20"),
        ("exposure = inf", 1, "exposure = inf"),
        ("exposure = 1e999", 1, "exposure = inf"),
        ("samples = 5", 1, "samples = 5 is not possible; allowed: 1, 4, 9, 16"),
        ("size = [0, 10]", 1, "size = [0, 10]"),
        ("size = [10.5, 10]", 1, "size = [10.5, 10]"),
        ("size = [10]", 1, "size = [10]"),
        ("size = [999999, 10]", 1, "allowed: two numbers, each 1 to 16384"),
        ("background = [-1, 0, 0]", 1, "allowed: three numbers, each 0 or more"),
        ("title = 3", 1, "title is a line of text"),
        ("title = { fr = 'x' }", 1, "title is a line of text"),
        ("object = 3", 1, "'object' is a section; write [[object]]"),
        ("[object]\nmesh = 'sphere'", 1, "'object' is a section; write [[object]]"),
        ("object = []", 1, "a scene needs an object"),
        ("[[camera]]", 1, "'camera' is a section; write [camera]"),
        ("[camera]\nfov = 0", 2, "fov = 0 is not possible; allowed: 1 to 170"),
        ("[camera]\nfoo = 0", 2, "unknown key 'foo'"),
        ("[camera]\nposition = [1, 1, 1]\ntarget = [1, 1, 1]", 3, "stands on its target"),
        (
            "[camera]\nup = [0, 0, 0]",
            2,
            "up = [0, 0, 0] is not possible; allowed: three numbers, not all",
        ),
        (
            "[[object]]\n[[object]]\nmesh = 'spere'",
            3,
            "object 2: no mesh 'spere'; did you mean 'sphere'?",
        ),
        ("[[object]]\nmesh = 'no.obj'", 2, "object 1: no file "),
        (
            "[[object]]\nmesh = 'torus:mnor=1'",
            2,
            "torus has no parameter 'mnor'; did you mean 'minor'",
        ),
        ("[[object]]\nmesh = 'torus:minor=-1'", 2, "allowed: 1e-06 to 1e+06"),
        ("[[object]]\nmesh = 3", 2, "mesh = 3; write text in quotes"),
        ("[[object]]\nmodel = 'fong'", 2, "no model 'fong'; did you mean 'phong'?"),
        ("[[object]]\nmodel = 'no.glsl'", 2, "object 1: no file "),
        ("[[object]]\nkd = [1, 0]", 2, "kd = [1, 0] is not possible"),
        ("[[object]]\nkd = 'red'", 2, 'kd = "red" is not possible'),
        (
            "[[object]]\nkd = 1.5",
            2,
            "kd = 1.5 is not possible; allowed: three numbers, each 0 to 1",
        ),
        ("[[object]]\nshininess = -5", 2, "shininess = -5 is not possible; allowed: 1 or more"),
        ("[[object]]\nshine = 5", 2, "unknown key 'shine'; did you mean 'shininess'?"),
        ("[[object]]\nscale = [1, 0, 1]", 2, "flattens the mesh"),
        ("[[object]]\nspecular = 1", 2, "specular = 1 is not possible; allowed: true or false"),
        ("[[object]]\nform = 'slides'", 2, "allowed: one of slide, normalised"),
        ("[[light]]\nkind = 'moon'", 2, "light 1: no light 'moon'"),
        (
            "[[light]]\nkind = 'point'\nintensity = -1",
            3,
            "intensity = -1 is not possible; allowed: 0 or more",
        ),
        ("[[light]]\nkind = 'point'\ndirection = [0, 1, 0]", 3, "unknown key 'direction'"),
        ("[[light]]\ndirection = [0, 0, 0]", 2, "allowed: three numbers, not all zero"),
        ("[[panel]]\nset = { foo = 1 }", 2, "panel 1: no value 'foo'"),
        ("[[panel]]\nset = 3", 2, "write set = { key = value"),
        ("[[panel]]\ncaptoin = 'x'", 2, "unknown key 'captoin'; did you mean 'caption'?"),
        ("[[panel]]\nscene = '../x.toml'", 2, "lies outside the folder of the scene"),
        ("[[object]]\nmesh = '../x.obj'", 2, "lies outside the folder of the scene"),
        ("[[object]]\nmesh = '/etc/x.ply'", 2, "lies outside the folder of the scene"),
        ("[[object]]\nmodel = '/etc/x.glsl'", 2, "lies outside the folder of the scene"),
        ("[[panel]]\nset = { mesh = '/etc/x.ply' }", 2, "lies outside the folder of the scene"),
        ("[[panel]]\nset = { light = '/etc/x.glsl' }", 2, "lies outside the folder of the scene"),
        ("[[panel]]\nset = { light = '../x.glsl:a=1' }", 2, "../x.glsl lies outside the folder"),
        ("[[panel]]\nset = { 'object.1.model' = '../x.glsl' }", 2, "lies outside the folder"),
        ("[[panel]]\nset = { model = '../x.GLSL' }", 2, "lies outside the folder of the scene"),
        ("[[panel]]\nset = { model = '../x.frag' }", 2, "no model '../x.frag'"),
        ("[[panel]]\nscene = '../x.obj'", 2, "lies outside the folder of the scene"),
        ("[[panel]]\nscene = '../x.PNG'", 2, "lies outside the folder of the scene"),
        ("[[panel]]\nscene = '/etc/x.glsl'", 2, "lies outside the folder of the scene"),
        ("[[panel]]\nscene = '~/x.toml'", 2, "lies outside the folder of the scene"),
        ("[[object]]\nmodel = '../x.frag'", 2, "no model '../x.frag'"),
        ("[[light]]\nkind = '../x.glsl'", 2, "lies outside the folder of the scene"),
        ("a = [1, 2", 1, "not TOML: "),
        ("a = 1\na = 2", 2, "not TOML: "),
        ("x = " + "[" * 20000, 1, "not TOML that can be read"),
        ("exposure = " + "1" * 5000, 1, "not TOML that can be read"),
        ("\n".join("[[light]]" for _ in range(70)), 70, "70 of light; allowed: up to 64"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(tmp_path, text, line, told):
    path = str(tmp_path / "s.toml")
    with pytest.raises(Mistake) as mistake:
        parsed(text, path)
    said = str(mistake.value)
    assert said.startswith(f"{path}:{line}: ") and told in said and "\n" not in said


def test_a_file_elsewhere_is_opened_only_by_a_scene_that_knows_it(tmp_path):
    mesh = tmp_path / "elsewhere" / "tri.off"
    mesh.parent.mkdir()
    mesh.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    model = tmp_path / "elsewhere" / "own.glsl"
    model.write_text("// model   Own\nvec3 scatter(vec3 L, vec3 V) { return vec3(L.z); }\n")
    scene = Scene.default().changed("mesh", str(mesh)).changed("model", str(model))
    folder = tmp_path / "here"
    folder.mkdir()
    text = scene.toml(str(folder))
    assert "[content]" in text
    path = str(folder / "s.toml")
    assert scenefile.parse(text, path, Scene.default()).objects[0].mesh == str(mesh)
    mesh.write_text(mesh.read_text().replace("0 1 0\n3", "0 2 0\n3"))
    with pytest.raises(Mistake, match=r"no longer what this scene was made with; .*--mesh"):
        scenefile.parse(text, path, Scene.default())
    inside = scene.toml(str(tmp_path))
    assert "[content]" not in inside and 'mesh = "elsewhere/tri.off"' in inside


def test_a_link_does_not_lead_out_of_the_folder(tmp_path):
    (tmp_path / "secret.obj").write_text("v 0 0 0\n")
    (tmp_path / "scene").mkdir()
    (tmp_path / "scene" / "link.obj").symlink_to(tmp_path / "secret.obj")
    with pytest.raises(Mistake, match="lies outside"):
        parsed("[[object]]\nmesh = 'link.obj'", str(tmp_path / "scene" / "s.toml"))


@pytest.mark.parametrize(
    "panel",
    ["scene = 'link.obj'", "set = { mesh = 'link.obj' }", "set = { light = 'link.glsl' }"],
)
def test_a_link_in_a_panel_does_not_lead_out_of_the_folder_either(tmp_path, panel):
    (tmp_path / "scene").mkdir()
    for name in ("link.obj", "link.glsl"):
        (tmp_path / name).write_text("secret\n")
        (tmp_path / "scene" / name).symlink_to(tmp_path / name)
    with pytest.raises(Mistake, match="lies outside") as mistake:
        parsed(f"[[panel]]\n{panel}", str(tmp_path / "scene" / "s.toml"))
    assert "secret" not in str(mistake.value)


def test_a_light_of_a_panel_lies_beside_the_scene(tmp_path, monkeypatch):
    """And not in the folder where somebody happens to be, which holds another of that name."""
    text = "// light   Own\nuniform vec3 E = vec3(%d.0);  // [0, 9] tinted: x\n"
    text += "vec3 environment(vec3 direction) { return E; }\n"
    (tmp_path / "scene").mkdir()
    (tmp_path / "own.glsl").write_text(text % 1)
    (tmp_path / "scene" / "own.glsl").write_text(text % 2)
    monkeypatch.chdir(tmp_path)
    path = str(tmp_path / "scene" / "s.toml")
    scene = parsed("[[panel]]\nset = { light = 'own.glsl:color=0,1,0' }", path)
    light = f"{tmp_path / 'scene' / 'own.glsl'}:color=0,1,0"
    assert scene.panels[0].values == (("light", light),)
    for folder in ("scene", ".", "elsewhere"):  # where a picture of it may be put
        (tmp_path / folder).mkdir(exist_ok=True)
        again = parsed(scene.toml(str(tmp_path / folder)), str(tmp_path / folder / "a.png"))
        assert again == scene


def test_the_time_of_a_model_is_that_of_the_scene(tmp_path):
    model = tmp_path / "own.glsl"
    model.write_text(
        "// model   Own\nuniform float age = 0.0;  // time: since the start (s)\n"
        "vec3 scatter(vec3 L, vec3 V) { return vec3(L.z * exp2(-age)); }\n"
    )
    scene = Scene.default().changed("model", str(model))
    with pytest.raises(Mistake, match=r"^--set: age follows the time of the scene; set time"):
        scene.changed("age", "5", "--set: ")
    assert scene.changed("time", "5").time == 5.0


@pytest.mark.parametrize(
    ("key", "value", "read"),
    [
        ("exposure", "2", lambda s: s.exposure == 2.0),
        ("size", "64x32", lambda s: s.size == (64, 32)),
        ("camera.fov", "20", lambda s: s.camera.fov == 20.0),
        ("mesh", "teapot", lambda s: {o.mesh for o in s.objects} == {"teapot"}),
        ("model", "lambert", lambda s: {o.model.name for o in s.objects} == {"lambert"}),
        ("rotation", "0,45,0", lambda s: s.objects[1].rotation == (0.0, 45.0, 0.0)),
        ("shininess", "7", lambda s: s.objects[0].values["shininess"] == 7.0),
        ("form", "normalised", lambda s: {o.values["form"] for o in s.objects} == {"normalised"}),
        ("left.kd", "0,1,0", lambda s: s.objects[0].values["kd"] == (0.0, 1.0, 0.0)),
        ("object.2.albedo", "0.1", lambda s: s.objects[1].values["albedo"] == (0.1,) * 3),
        ("lamp.intensity", "5", lambda s: s.lights[0].values["intensity"] == 5.0),
        ("spot.inner", "3", lambda s: s.lights[0].values["inner"] == 3.0),
        ("light.2.radiance", "2", lambda s: s.lights[1].values["radiance"] == 2.0),
        ("radiance", "2", lambda s: s.lights[1].values["radiance"] == 2.0),
        ("light", "point:intensity=3", lambda s: len(s.lights) == 1),
    ],
)
def test_a_value_is_changed_by_its_name(key, value, read):
    scene = parsed(FULL)
    assert not read(scene) and read(scene.changed(key, value))


@pytest.mark.parametrize(
    ("key", "told"),
    [
        ("shinines", "did you mean 'shininess'?"),
        ("camera.fv", "no value 'camera.fv'"),
        ("object.3.kd", "no value 'object.3.kd'"),
        ("object.0.kd", "no value"),
        ("object.².kd", "no value 'object.².kd'"),
        ("object.١.kd", "no value 'object.١.kd'"),  # a digit, and no number of ours
        ("middle.kd", "no value 'middle.kd'"),
        ("left.albedo", "no value 'left.albedo'"),
        ("", "no value ''"),
        ("..", "no value"),
    ],
)
def test_an_unknown_name_is_told(key, told):
    with pytest.raises(Mistake) as mistake:
        parsed(FULL).changed(key, "1", "--set: ")
    assert str(mistake.value).startswith("--set: ") and told in str(mistake.value)


def test_changing_the_model_keeps_what_was_set_and_still_fits():
    scene = Scene.default().set(kd=(0.1, 0.2, 0.3), model="blinn")
    values = scene.objects[0].values
    assert values["kd"] == (0.1, 0.2, 0.3) and values["shininess"] == 160.0
    both = settings.all_changed(Scene.default(), [("shininess", "40"), ("model", "blinn")])
    assert both.objects[0].values["shininess"] == 40.0  # though 40 is Phong's own default


def test_two_objects_that_are_equal_can_be_told_apart():
    one = Scene.default().objects[0]
    scene = Scene.default()._replace(objects=(one, one, one))
    shades = [o.values["shininess"] for o in scene.changed("object.2.shininess", 9).objects]
    assert shades == [40.0, 9.0, 40.0]


def test_loading_a_mesh_or_a_model_puts_it_into_the_default_scene(tmp_path):
    model = tmp_path / "own.glsl"
    model.write_text("// model   Own\nvec3 scatter(vec3 L, vec3 V) { return vec3(L.z); }\n")
    assert Scene.load(str(model)).objects[0].model.name == str(model)
    mesh = tmp_path / "tri.off"
    mesh.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    assert Scene.load("tri.off", str(tmp_path)).objects[0].mesh == str(mesh)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("teapott", "no scene 'teapott'; did you mean 'teapot'?"),
        ("gone.toml", "gone.toml: no such file"),
        ("plain.png", "carries no scene"),
        ("fake.png", "not a PNG picture"),
        ("folder.toml", "not a regular file"),
        ("pipe.toml", "not a regular file"),
        ("latin.toml", ":1: not UTF-8"),
        ("big.toml", "allowed for a scene file"),
        ("x.gltf", "no file "),
    ],
)
def test_a_scene_that_is_none_is_told(tmp_path, name, told):
    (tmp_path / "plain.png").write_bytes(b"\x89PNG\r\n\x1a\n" + b"\0\0\0\0IEND\xaeB`\x82")
    (tmp_path / "fake.png").write_bytes(b"GIF89a")
    (tmp_path / "folder.toml").mkdir()
    os.mkfifo(tmp_path / "pipe.toml")
    (tmp_path / "latin.toml").write_bytes(b"title = '\xe9'")
    (tmp_path / "big.toml").write_bytes(b"#" * (2 << 20))
    with pytest.raises(Mistake) as mistake:
        Scene.load(name, str(tmp_path))
    assert told in str(mistake.value)


def test_a_byte_order_mark_is_taken(tmp_path):
    (tmp_path / "bom.toml").write_bytes(b"\xef\xbb\xbfexposure = 1\r\n")
    assert Scene.load("bom.toml", str(tmp_path)).exposure == 1.0


def test_a_picture_carries_the_text_of_its_scene():
    from lumiar import image

    chunk = scenefile.chunk("exposure = 1  # çãé")
    data = b"".join(image.png((2, 2), [bytes(12)], [chunk]))
    assert scenefile.embedded(data, "x.png") == "exposure = 1  # çãé"
    for cut in range(8, len(data), 7):  # a picture torn anywhere says so, and nothing worse
        try:
            scenefile.embedded(data[:cut], "x.png")
        except Mistake as mistake:
            assert "carries no scene" in str(mistake)


def test_numbers_are_finite_wherever_they_come_from():
    for value in (math.nan, math.inf, -math.inf):
        with pytest.raises(Mistake):
            Scene.default().changed("camera.position", [value, 0.0, 0.0])


def test_a_parameter_of_a_shape_is_changed_by_its_name():
    scene = Scene.default().set(mesh="torus")._replace(objects=Scene.default().objects * 2)
    scene = scene.changed("object.1.mesh", "torus:rings=9").changed("mesh.minor", "0.2")
    assert [one.mesh for one in scene.objects] == ["torus:minor=0.2:rings=9", "sphere"]
    assert scene.changed("mesh.minor", 0.4).objects[0].mesh == "torus:rings=9"
    assert {"mesh.minor", "mesh.subdivision"} <= {*settings.keys(scene)}
    with pytest.raises(Mistake, match=r"torus: minor = -1.0 is not possible; allowed: 1e-06 to"):
        scene.changed("object.1.mesh.minor", -1.0)
    with pytest.raises(Mistake, match=r"no value 'object.2.mesh.minor'"):
        scene.changed("object.2.mesh.minor", 0.2)
