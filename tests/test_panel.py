"""The panel: every widget by mouse and keyboard, and the Scene that comes of it."""

import math
import os
import random

import pytest
from hand import Hand
from imgui_bundle import imgui

from lumiar import catalog, geometry, lesson, notation, parts, scenefile, settings, words
from lumiar.scene import Scene


@pytest.fixture
def hand(monkeypatch):
    hands = []

    def begin(scene=None, lang="en"):
        hands.append(Hand(scene or Scene.default(), lang, monkeypatch))
        return hands[-1]

    yield begin
    for one in hands:
        one.close()


def values(hand):
    return hand.scene.objects[0].values


def lit(*kinds):
    return Scene.default()._replace(lights=tuple(settings.light(kind) for kind in kinds))


def every_shader():
    return [(kind, name) for kind in ("model", "light") for name in catalog.names(kind)]


@pytest.mark.parametrize("kind, name", every_shader(), ids=lambda word: word)
def test_every_parameter_has_its_widget_and_looking_changes_nothing(hand, kind, name):
    scene = lit(name) if kind == "light" else Scene.default().set(model=name)
    one = hand(scene)
    shader = scene.lights[0].kind if kind == "light" else scene.objects[0].model
    labels = {"toggle": ["##value"], "color": ["##swatch", "##0"], "direction": ["ball", "##2"]}
    for parameter in shader.parameters:
        vector = parameter.type.startswith("vec")
        wanted = labels.get(parameter.widget, ["##0", "##2"] if vector else ["##value"])
        if parameter.widget == "choice" and not one.sees(f"{parameter.name}/##value"):
            wanted = parameter.choices
        assert all(one.sees(f"{parameter.name}/{label}") for label in wanted), parameter.name
    assert one.scene is scene


ODD = """// model   Odd 100 % own
uniform float share = 0.5;              // [0, 1]: 100 %s of 50 %d (%)
uniform float far = 1.0;                // [0, 1e300 ..]: as far as can be (m)
uniform float tiny = 2e-20;             // [1e-20, 1e20] log: many decades (K^4)
uniform vec2 pair = vec2(0.5);          // [0, 1]: two (%n)
uniform vec4 four = vec4(0.0);          // [.. -1e-9, 1e-9]: four
uniform int many = 7;                   // [.. -4000000000, 4000000000 ..]: a lot
uniform int few = 2;                    // [0.5, 3.5]: between 1 and 3
uniform float turn = radians(4.0);       // [0, 90] degrees: an angle
uniform float age = 0.0;                // time: of the lamp (s)
vec3 scatter(vec3 L, vec3 V) {
    return vec3(share + far + tiny + pair.x + four.w + float(many + few) + turn + age);
}
"""


def test_a_students_file_with_odd_ranges_gets_its_widgets_too(hand, tmp_path):
    (tmp_path / "odd.glsl").write_text(ODD)
    one = hand(Scene.default().changed("model", "odd.glsl", folder=str(tmp_path)))
    for parameter in one.scene.objects[0].model.parameters[:-1]:
        label = "##1" if parameter.type.startswith("vec") else "##value"
        for by in (400, -800, 1000):
            one.drag(f"{parameter.name}/{label}", (by, 0))
        assert parameter.check(values(one)[parameter.name]) == values(one)[parameter.name]
        assert values(one)[parameter.name] != parameter.default and not one.state.message
        y = one.place(f"{parameter.name}/{label}")[1]
        one.move(30.0, y)
        one.frame(40)  # the tooltip
    assert not one.sees("age/##value")


def test_a_students_light_may_have_a_unit_of_its_own(hand, tmp_path):
    (tmp_path / "odd.glsl").write_text(
        """// light   Odd
#include "lib/light.glsl"
uniform vec3 glow = vec3(1.0);  // [0, 5 ..] tinted: how it glows (candlepower)
Incident light(vec3 place, vec2 u) { return Incident(vec3(0.0, 1.0, 0.0), glow); }
"""
    )
    one = hand(Scene.default()._replace(lights=(settings.light("odd.glsl", folder=str(tmp_path)),)))
    one.type("glow/##value", "2")
    assert one.scene.lights[0].values["glow"] == 2.0 and not one.sees("##unit")


def test_a_slider_follows_the_mouse_between_its_ends(hand):
    one = hand(Scene.default().set(model="dielectric"))
    one.drag("eta/##value", (1000, 0))
    assert values(one)["eta"] == 4.0
    one.drag("eta/##value", (-2000, 0))
    assert values(one)["eta"] == 0.25


def test_the_middle_of_a_log_slider_is_the_geometric_mean(hand):
    one = hand(Scene.default().set(model="cook_torrance"))
    one.click("alpha/##value")
    assert values(one)["alpha"] == pytest.approx(math.sqrt(0.001), rel=0.1)


def test_typed_values_are_exact_and_pass_a_soft_end(hand):
    one = hand()
    one.type("shininess/##value", "5000.25")
    assert values(one)["shininess"] == 5000.25
    one.type("exposure/##value", "0.1")
    assert one.scene.exposure == 0.1


def test_a_value_out_of_the_domain_leaves_the_scene_and_says_what_is_allowed(hand):
    one = hand()
    before = one.scene
    one.type("shininess/##value", "-3")
    assert one.scene == before
    assert "shininess = -3.0 is not possible; allowed: 1 or more" in one.state.message
    one.type("shininess/##value", "50")
    assert values(one)["shininess"] == 50.0 and one.state.message == ""


def test_whole_numbers_stay_whole(hand):
    one = hand(Scene.default().set(model="black_body"))
    one.type("wavelengths/##value", "31")
    assert values(one)["wavelengths"] == 31 and isinstance(values(one)["wavelengths"], int)


def test_a_colour_is_linear_and_only_the_typed_channel_changes(hand):
    scene = Scene.default().set(kd=(0.123456789, 0.5, 0.25))
    one = hand(scene)
    one.type("kd/##1", "0.75")
    assert values(one)["kd"] == (0.123456789, 0.75, 0.25)
    one.type("kd/##1", "2")
    assert values(one)["kd"][1] == 0.75 and "allowed" in one.state.message


def test_the_picker_shows_the_colour_as_a_screen_does(hand):
    one = hand(Scene.default().set(kd=(0.5, 0.5, 0.5)))
    one.click("kd/##swatch")
    left, top, *_ = one.spy.places["phong/kd/##picker"]
    one.io.add_mouse_pos_event(left + 2, top + 2)  # the corner of white
    one.frame(2)
    one.button(True)
    one.button(False)
    assert values(one)["kd"] == pytest.approx((1.0, 1.0, 1.0), abs=0.05)


def test_the_ball_turns_a_direction_and_keeps_its_length(hand):
    one = hand()
    before = one.scene.lights[0].values["direction"]
    one.drag("direction/ball", (40, -10))
    after = one.scene.lights[0].values["direction"]
    turned = [b - a for a, b in zip(notation.angles(before), notation.angles(after), strict=True)]
    assert turned == pytest.approx([40.0, 10.0], abs=1e-3)
    assert math.hypot(*after) == pytest.approx(math.hypot(*before), abs=1e-6)


def test_the_ball_stops_at_the_pole_and_comes_back(hand):
    one = hand()
    before = notation.angles(one.scene.lights[0].values["direction"])
    one.drag("direction/ball", (0, -300))
    up = one.scene.lights[0].values["direction"]
    assert up[1] == pytest.approx(math.hypot(*up), abs=1e-6)
    one.drag("direction/ball", (0, 45))
    after = one.scene.lights[0].values["direction"]
    assert notation.angles(after) == pytest.approx((before[0], 44.99), abs=0.1)


def test_a_direction_is_typed_by_components_and_never_nothing(hand):
    one = hand(lit("directional:direction=0,1,0"))
    one.type("direction/##0", "0.5")
    assert one.scene.lights[0].values["direction"] == (0.5, 1.0, 0.0)
    one.type("direction/##0", "0")
    one.type("direction/##1", "0")
    assert any(one.scene.lights[0].values["direction"])


@pytest.mark.parametrize("text", ["nan", "inf", "-1e400"])
def test_what_is_no_number_leaves_every_widget_as_it_was(hand, text):
    one = hand(lit("directional"))
    before = one.scene
    for name in ("direction/##0", "direction/##azimuth", "direction/##elevation", "kd/##2"):
        one.type(name, text)
    one.type("shininess/##value", text)
    one.type("irradiance/##value", text)
    assert one.scene == before


@pytest.mark.parametrize("seed", range(4))
def test_whatever_is_clicked_and_typed_the_scene_is_one_that_can_be_saved(hand, seed):
    chance = random.Random(seed)
    model, *kinds = chance.choice(catalog.names("model")), *chance.sample(catalog.names("light"), 3)
    one = hand(lit(*kinds).set(model=model))
    for _ in range(60):
        x, y = chance.uniform(0, 430), chance.uniform(0, 1500)
        one.io.add_key_event(imgui.Key.mod_ctrl, chance.random() < 0.3)
        one.move(x, y)
        one.button(True)
        one.move(
            x + chance.uniform(-200, 200), y + chance.uniform(-40, 40) * (chance.random() < 0.3)
        )
        one.button(False)
        one.io.add_key_event(imgui.Key.mod_ctrl, False)
        one.io.add_input_characters_utf8(chance.choice(["", "0.3", "-5", "1e39", "torus", "é%s"]))
        one.frame(2)
        one.key(chance.choice([imgui.Key.enter, imgui.Key.escape, imgui.Key.tab]))
    assert scenefile.parse(one.scene.toml(), "scene.toml", Scene.default()) == one.scene


def test_a_toggle_and_a_choice(hand):
    one = hand()
    was = values(one)["specular"]
    one.click("specular/##value")
    assert values(one)["specular"] is not was
    one.click("form/normalised")
    assert values(one)["form"] == "normalised"


def test_reset_brings_back_the_default_and_its_button_goes(hand):
    one = hand()
    one.type("shininess/##value", "77")
    one.click("shininess/↺")
    assert values(one)["shininess"] == one.scene.objects[0].model.defaults()["shininess"]
    assert not one.sees("shininess/↺")


def test_a_value_goes_back_to_its_default_or_to_what_it_was_when_opened(hand):
    one = hand(Scene.default().set(shininess=77.0))
    one.type("shininess/##value", "5")
    one.io.add_key_event(imgui.Key.mod_shift, True)
    one.click("shininess/↺")
    one.io.add_key_event(imgui.Key.mod_shift, False)
    assert values(one)["shininess"] == 77.0
    one.click("shininess/↺")
    assert values(one)["shininess"] == 40.0
    one.click("shininess/↺")  # as it is by default, but not as it was
    assert values(one)["shininess"] == 77.0


def test_a_right_click_on_a_name_offers_the_ways_back_and_typing(hand):
    one = hand(Scene.default().set(shininess=77.0))
    one.type("shininess/##value", "5")

    def menu(option):
        left, top, _, below = one.spy.places["phong/shininess/##value"]
        one.move(left - 60.0, (top + below) / 2.0)
        one.button(True, 1)
        one.button(False, 1)
        one.frame(2)
        one.click(option)

    menu("as opened: 77##opened")
    assert values(one)["shininess"] == 77.0
    menu("default: 40##default")
    assert values(one)["shininess"] == 40.0
    menu("type a value")
    one.io.add_input_characters_utf8("12.5")
    one.frame(2)
    one.key(imgui.Key.enter)
    assert values(one)["shininess"] == 12.5


def test_what_was_opened_with_another_model_is_no_way_back(hand):
    one = hand(Scene.default().set(model="lambert", albedo=(0.1, 0.2, 0.3)))
    one.choose("model", "oren_nayar")
    assert values(one)["albedo"] == (0.1, 0.2, 0.3)
    one.click("albedo/↺")
    assert values(one)["albedo"] == one.scene.objects[0].model.defaults()["albedo"]
    assert not one.sees("albedo/↺")


def test_the_shape_of_a_mesh_has_sliders(hand):
    one = hand(Scene.default().set(mesh="torus"))
    one.click("Shape of the mesh###shape", 0.2)
    for parameter in geometry.SHAPES["torus"]:
        assert one.sees(f"shape/{parameter.name}/##value")
    one.type("minor/##value", "0.25")
    assert one.scene.objects[0].mesh == "torus:minor=0.25"
    one.type("rings/##value", "3000")  # beyond the end of its slider
    assert one.scene.objects[0].mesh == "torus:minor=0.25:rings=3000"
    one.type("minor/##value", "-1")
    assert "minor = -1.0 is not possible" in one.state.message
    one.click("minor/↺")
    assert one.scene.objects[0].mesh == "torus:rings=3000"
    one.choose("mesh", "suzanne")
    assert not one.sees("Shape of the mesh###shape")


@pytest.mark.parametrize("shape", geometry.SHAPES)
def test_a_shape_is_told_by_what_differs_and_read_back(shape):
    spec = shape
    for parameter in geometry.SHAPES[shape]:
        slider = geometry.slider(shape, parameter.name)
        assert parameter.low <= slider.low < slider.high <= parameter.high
        value = parameter.check(min(parameter.high, parameter.default * 2 + 1))
        spec = geometry.reshaped(spec, parameter.name, value)
        assert geometry.shape(spec)[parameter.name] == value
    for parameter in geometry.SHAPES[shape]:
        spec = geometry.reshaped(spec, parameter.name, parameter.default)
    assert spec == shape


def test_scenes_lessons_and_files_are_opened_from_the_bar(hand):
    one = hand()
    one.click("Open …##open")
    titles = [path for path in one.spy.places if path.endswith("##phong")]
    assert titles and titles != ["##phong"]
    assert any(p.startswith("Where the model is evaluated") for p in one.spy.places)
    one.click(titles[0])
    assert one.state.path == lesson.shipped()["phong"]
    for typed, path in (("teapot", scenefile.shipped()["teapot"]), ("a/b.obj", "a/b.obj")):
        one.click("Open …##open")
        one.click("##path")
        one.io.add_input_characters_utf8(typed)
        one.frame(2)
        one.key(imgui.Key.enter)
        assert one.state.path == os.path.abspath(path)


def test_reset_all_of_an_object(hand):
    one = hand(Scene.default().set(shininess=77.0, kd=(0.1, 0.2, 0.3)))
    one.click("phong/reset all")
    assert values(one) == one.scene.objects[0].model.defaults()


def test_model_mesh_and_material_from_lists(hand):
    one = hand()
    one.choose("model", "lambert")
    assert one.scene.objects[0].model.name == "lambert"
    one.choose("mesh", "teapot")
    assert one.scene.objects[0].mesh == "teapot"
    one.choose("material", "Gold")
    assert one.scene.objects[0].model.name == "rough_conductor"
    assert values(one)["f0"] == (1.0, 0.71, 0.29)


def test_a_mesh_is_typed_too_and_a_wrong_one_only_says_so(hand):
    one = hand()
    for text, mesh in (("torus:minor=0.2", "torus:minor=0.2"), ("tours", "torus:minor=0.2")):
        one.click("##mesh")
        one.click("##path")
        one.io.add_input_characters_utf8(text)
        one.frame(2)
        one.key(imgui.Key.enter)
        one.frame(2)
        assert one.scene.objects[0].mesh == mesh
    assert "did you mean 'torus'" in one.state.message


def test_lights_are_added_changed_and_removed(hand):
    one = hand()
    one.choose("add", "spot")
    assert [light.kind.name for light in one.scene.lights] == ["directional", "ambient", "spot"]
    one.click("3  spot###2", 0.2)
    one.click("2/##kind")
    one.click("disk")
    assert one.scene.lights[2].kind.name == "disk"
    one.click("2/remove")
    assert [light.kind.name for light in one.scene.lights] == ["directional", "ambient"]


def test_open_lights_out_of_sight_wait_for_being_scrolled_to(hand):
    one = hand(lit(*["point"] * 6))
    for i in range(1, 6):
        one.click(f"{i + 1}  point###{i}", 0.2)
    ends = [place[3] for place in one.spy.places.values()]
    assert all(one.sees(f"{i}/intensity/##value") for i in range(6))
    one.io.display_size = (1000, 500)
    one.frame(3)
    assert not any(one.sees(f"{i}/intensity/##value") for i in (4, 5))
    below = one.place("##add")[1]
    one.move(300.0, 300.0)
    while not one.sees("4/intensity/##value") or one.place("4/intensity/##value")[1] > 300.0:
        one.io.add_mouse_wheel_event(0.0, -1.0)
        one.frame(2)
        assert one.sees("##add") and max(ends) > below > 500.0  # the blanks are as high as the rows
    one.type("4/intensity/##value", "7")
    assert [light.values["intensity"] for light in one.scene.lights] == [60.0] * 4 + [7.0, 60.0]
    x, y = one.place("4/intensity/##value")
    one.move(x, y)
    one.button(True)
    for _ in range(40):  # held, though scrolled away
        one.io.add_mouse_wheel_event(0.0, 5.0)
        one.frame()
    one.move(x + 40.0, y)
    one.button(False)
    assert one.scene.lights[4].values["intensity"] > 7.0


@pytest.mark.parametrize("kind", catalog.names("light"))
def test_a_light_shows_the_own_keys_that_its_kind_has_and_no_others(hand, kind):
    one = hand(lit(kind))
    lists = {"unit": "##unit", "illuminant": "##illuminant", "image": "##image"}
    own = settings.own_keys(one.scene.lights[0].kind)
    for key in ("unit", "illuminant", "image"):
        assert one.sees(f"0/{lists[key]}") == (key in own), key
    for key, label in (("temperature", "##given"), ("shadows", "##value"), ("visible", "##value")):
        assert one.sees(f"0/{key}/{label}") == (key in own), key
    assert one.sees("0/samples/##value") == ("samples" in own)


def test_temperature_and_illuminant_take_turns(hand):
    one = hand()
    one.click("0/temperature/##given")
    assert one.scene.lights[0].temperature == 6500.0
    one.click("0/##illuminant")
    one.click("A")
    assert (one.scene.lights[0].illuminant, one.scene.lights[0].temperature) == ("A", None)
    one.click("0/temperature/##given")
    assert (one.scene.lights[0].illuminant, one.scene.lights[0].temperature) == ("", 6500.0)
    one.click("0/temperature/##given")
    assert one.scene.lights[0].temperature is None


def test_another_unit_is_as_bright(hand):
    one = hand(lit("point"))
    one.click("0/##unit")
    one.click("lm")
    light = one.scene.lights[0]
    lumens = 4.0 * math.pi * 60.0 * 176.80388  # over the sphere, D65's lumens per watt
    assert light.unit == "lm" and light.values["intensity"] == pytest.approx(lumens, rel=1e-5)


def test_exposure_tone_rate_and_samples_of_the_picture(hand):
    one = hand()
    one.type("exposure/##value", "-1.5")
    one.click("tone/aces")
    one.click("shading/gouraud")
    one.click("9")
    scene = one.scene
    assert (scene.exposure, scene.tone, scene.shading, scene.samples) == (
        -1.5,
        "aces",
        "gouraud",
        9,
    )
    one.click("ev100/##given")
    assert one.scene.gain == pytest.approx(2.0**-1.5, rel=1e-3)


def test_the_camera_shows_angles_until_it_has_a_position(hand):
    one = hand()
    one.click("Camera###camera", 0.2)
    one.type("fov/##value", "45")
    one.type("azimuth/##value", "-90")
    assert (one.scene.camera.fov, one.scene.camera.azimuth) == (45.0, -90.0)
    one.state.view = ((1.0, 2.0, 3.0), (0.0, 0.0, 0.0))
    one.frame()
    one.click("camera/position/##given")
    assert one.scene.camera.position == (1.0, 2.0, 3.0)
    assert not one.sees("camera/azimuth/##value")
    one.click("camera/right")
    assert one.scene.camera == parts.Camera(fov=45.0, azimuth=90.0, elevation=0.0)
    one.click("camera/reset all")
    assert one.scene.camera == parts.Camera()


def test_the_second_object_is_the_one_that_changes(hand):
    first = Scene.default().objects[0]
    one = hand(Scene.default()._replace(objects=(first, first._replace(name="right"))))
    one.click("##object")
    one.click("2  right")
    one.type("shininess/##value", "9")
    assert [o.values["shininess"] for o in one.scene.objects] == [first.values["shininess"], 9.0]


def test_a_drag_is_one_step_of_undo(hand):
    one = hand()
    first = one.scene
    one.drag("shininess/##value", (60, 0))
    second = one.scene
    one.drag("shininess/##value", (-90, 0))
    assert len({values(one)["shininess"], second.objects[0].values["shininess"]}) == 2
    assert (one.history.undo(), one.history.undo()) == (second, first)


@pytest.mark.parametrize("lang, what", [("en", "k_d, diffuse share"), ("pt", "k_d, fração difusa")])
def test_a_tooltip_tells_the_text_the_domain_and_the_paper(hand, lang, what):
    one = hand(lang=lang)
    one.move(100.0, one.place("kd/##swatch")[1])
    one.frame(60)
    model = one.scene.objects[0].model
    told = ["kd", what, f"{words.TEXT[lang]['allowed']}: [0, 1]", model.header["paper"]]
    assert {*told} <= {*one.spy.said}


def test_the_symbol_the_name_and_the_unit_of_a_vector_are_seen(hand):
    one = hand(lit("disk"))
    assert {"α", "shininess", "m", "position"} <= {*one.spy.said}


def test_the_panel_speaks_portuguese(hand):
    one = hand(lang="pt")
    assert one.sees("Luzes###lights") and one.sees("Câmera###camera")
    one.click("en")
    assert one.sees("Lights###lights")


def test_the_font_has_every_letter_that_the_panel_writes(hand):
    hand()
    font = imgui.get_io().fonts.fonts[0]
    texts = [str(words.TEXT), "↺", "αβγδηθκλμνρστφψω′⁻⁰¹²³⁴⁵⁶⁷⁸⁹°²"]
    for letter in set("".join(texts)) - set("\n"):
        assert font.is_glyph_in_font(ord(letter)), letter
