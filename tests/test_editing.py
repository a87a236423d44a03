"""Edits of several values at once: what suits is kept, what is left is as bright as it was."""

import math

import pytest

from lumiar import camera, catalog, editing, parts, settings, units
from lumiar.errors import Mistake
from lumiar.scene import Scene


def lit(*specs):
    return Scene.default()._replace(lights=tuple(settings.light(spec) for spec in specs))


def brightness(light):
    """Return the luminance of a light's number times its colour, in the unit of its file."""
    tinted = light.kind.tinted
    return units.luminance(
        units.tint(
            light.kind.name,
            tinted.unit,
            light.values[tinted.name],
            light.unit or tinted.unit,
            light.values,
            light.values["color"],
            light.temperature,
            light.illuminant,
        )
    )


def in_every_unit():
    for name in catalog.names("light"):
        kind = catalog.read("light", name)
        if kind.tinted:
            for unit in units.allowed(kind.tinted.unit, name):
                yield name, unit


@pytest.mark.parametrize("spectrum", ["", ":temperature=2700", ":illuminant=F11"])
@pytest.mark.parametrize("name, unit", [*in_every_unit()])
def test_a_light_is_as_bright_in_any_unit(name, unit, spectrum):
    scene = lit(f"{name}:color=1,0.5,0.2{spectrum}")
    other = editing.with_unit(scene, 0, unit)
    assert other.lights[0].unit == unit
    assert brightness(other.lights[0]) == pytest.approx(brightness(scene.lights[0]), rel=1e-5)
    back = editing.with_unit(other, 0, units.unit(scene.lights[0].kind.tinted.unit))
    key = scene.lights[0].kind.tinted.name
    assert back.lights[0].values[key] == pytest.approx(scene.lights[0].values[key], rel=1e-5)


def test_the_range_of_a_slider_follows_the_unit():
    light = editing.with_unit(lit("point"), 0, "cd").lights[0]
    native, other = light.kind.tinted, editing.in_unit(light)
    assert other.unit == "cd" and other.open == native.open
    assert other.high == pytest.approx(500.0 * 176.80388, rel=0.05)


def test_what_has_no_brightness_takes_another_unit_or_is_told_why_not():
    for spec in ("point:color=0,0,0", "disk:radius=0", "spot:inner=0:outer=0"):
        for unit in ("lm", "cd", "cd/m^2"):
            scene = lit(spec)
            if unit in settings.own_keys(scene.lights[0].kind)["unit"].split(", "):
                dark = spec.startswith("point") or unit == "lm"
                if dark:
                    with pytest.raises(Mistake, match=r"brighten its color|make it larger"):
                        editing.with_unit(scene, 0, unit)
                else:
                    assert editing.with_unit(scene, 0, unit).lights[0].unit == unit


def test_a_unit_that_a_kind_has_not_is_refused():
    with pytest.raises(Mistake, match="allowed: W/m"):
        editing.with_unit(lit("directional"), 0, "lm")


def test_lights_come_and_go():
    scene = editing.with_light(Scene.default(), "spot:outer=30")
    assert [one.kind.name for one in scene.lights] == ["directional", "ambient", "spot"]
    assert [one.kind.name for one in editing.without_light(scene, 1).lights] == [
        "directional",
        "spot",
    ]


def test_a_scene_takes_only_so_many_lights():
    scene = lit(*["point"] * 64)
    with pytest.raises(Mistake, match="64 lights"):
        editing.with_light(scene, "point")


def test_another_kind_keeps_what_suits_it():
    scene = lit("point:position=1,2,3:intensity=7:color=1,0,0:temperature=3000")
    scene = scene._replace(lights=(scene.lights[0]._replace(name="lamp"),))
    one = editing.with_kind(scene, 0, "spot").lights[0]
    assert (one.name, one.kind.name, one.temperature) == ("lamp", "spot", 3000.0)
    kept = {key: one.values[key] for key in ("position", "intensity", "color")}
    assert kept == {"position": (1.0, 2.0, 3.0), "intensity": 7.0, "color": (1.0, 0.0, 0.0)}
    sky = editing.with_kind(scene, 0, "sky").lights[0]
    assert (sky.temperature, sky.values) == (None, sky.kind.defaults())


def test_another_kind_keeps_the_lumens():
    one = editing.with_kind(lit("point:intensity=800 lm"), 0, "sphere").lights[0]
    assert (one.unit, one.values["radiance"]) == ("lm", 800.0)


@pytest.mark.parametrize("name", catalog.names("light"))
@pytest.mark.parametrize("other", catalog.names("light"))
def test_any_kind_becomes_any_other(name, other):
    given = settings.own_keys(catalog.read("light", name))
    spec = ":".join([name, *(f"{key}=true" for key in ("shadows", "visible") if key in given)])
    one = editing.with_kind(lit(spec), 0, other).lights[0]
    assert one.kind.name == other and settings.checked(one) == one


def test_what_may_be_left_out_is_left_out_again():
    keys = ["ev100", "camera.position", "camera.target", "camera.distance"]
    keys += ["object.1.fit", "object.1.crease", "light.1.temperature"]
    scene = Scene.default()
    for key in keys:
        value = editing.start(key.rpartition(".")[2], ((0.0, 0.0, 4.0), (0.0, 0.0, 1.0)))
        given = scene.changed(key, value)
        assert given != scene and editing.left_out(given, key) == scene, key


def test_an_eye_that_is_placed_by_hand_begins_where_it_is():
    view = ((1.0, 2.0, 5.0), (1.0, 2.0, 2.0))
    begins = [editing.start(key, view) for key in ("position", "target", "distance")]
    assert begins == [*view, 3.0]


def test_switching_a_camera_exposure_on_changes_no_brightness():
    assert Scene.default().changed("ev100", editing.NEUTRAL_EV100).gain == pytest.approx(
        1, rel=1e-3
    )


@pytest.mark.parametrize("section", ["object", "placement", "light", "picture", "camera"])
def test_resetting_a_section_leaves_the_others(section):
    changed = Scene.default().set(
        shininess=9,
        rotation=(0, 45, 0),
        irradiance=1.0,
        tone="aces",
        size=(64, 64),
        camera__fov=50,
    )
    fields = {"object": "objects", "placement": "objects", "light": "lights", "camera": "camera"}
    plain, one = Scene.default(), editing.reset(changed, section)
    if section == "picture":
        assert one == changed._replace(tone="none")
        return
    for field in ("objects", "lights", "camera", "tone", "size"):
        same = getattr(one, field) == getattr(changed, field)
        assert same == (field != fields[section]), field
    if section == "object":
        assert one.objects[0] == plain.objects[0]._replace(rotation=(0.0, 45.0, 0.0))
    if section == "placement":
        assert one.objects[0].values["shininess"] == 9.0
    if section in ("light", "camera"):
        assert getattr(one, fields[section]) == getattr(plain, fields[section])


@pytest.mark.parametrize("view", editing.VIEWS)
def test_a_view_from_a_side_is_known_again(view):
    scene = editing.looking_from(Scene.default().set(camera__position=(1, 2, 3)), view)
    assert scene.camera.position is None and editing.seen_from(scene.camera) == view
    assert editing.looking_from(scene, view) is scene
    assert editing.seen_from(parts.Camera((0.0, 0.0, 3.0), azimuth=0.0, elevation=0.0)) == ""


def test_the_eye_of_a_view_stands_where_its_name_says():
    axes = {"front": 2, "right": 0, "back": 2, "left": 0, "top": 1}
    signs = {"front": 1, "right": 1, "back": -1, "left": -1, "top": 1}
    for view in editing.VIEWS:
        looks = editing.looking_from(Scene.default(), view).camera
        eye, _ = camera.viewpoint(looks, 1.0, (0.0, 0.0, 0.0), 1.0)
        along = eye[axes[view]] * signs[view]
        assert along == pytest.approx(math.hypot(*eye))


def test_a_position_leaves_a_camera_no_angles():
    assert not {"azimuth", "elevation", "distance"} & {
        *editing.camera_keys(parts.Camera((0.0, 0.0, 3.0)))
    }
    assert editing.camera_keys(parts.Camera()) == list(parts.CAMERA)
    assert math.isfinite(editing.NEUTRAL_EV100)
