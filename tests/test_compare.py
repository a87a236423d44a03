"""Pictures beside each other: which scenes they are of, where they stand, what they differ by."""

import itertools

import pytest

from lumiar import Scene, compare, contrast, opening, picture, scenefile, settings
from lumiar.compare import Comparison, Variant
from lumiar.errors import Mistake

PLAIN = Scene.default()


def test_a_variant_follows_the_scene_in_all_but_its_values():
    variant = Variant((("shading", "flat"), ("model", "ward")))
    for scene in (PLAIN, PLAIN.set(exposure=2.0, camera__fov=50, shading="gouraud")):
        found = compare.scene_of(variant, scene)
        assert (found.shading, found.objects[0].model.name) == ("flat", "ward")
        assert found._replace(shading=scene.shading, objects=scene.objects) == scene
    with pytest.raises(Mistake, match="shinyness"):
        compare.scene_of(Variant((("shinyness", 3),)), PLAIN)


def test_a_kept_scene_has_the_camera_of_the_others_unless_it_is_apart():
    kept = PLAIN.set(shininess=3, camera__azimuth=70)
    now = PLAIN.set(camera__azimuth=-20)
    assert compare.scene_of(Variant(kept=kept), now) == kept._replace(camera=now.camera)
    assert compare.scene_of(Variant(kept=kept, apart=True), now) == kept


def test_differences_make_one_scene_into_the_other():
    scenes = [
        PLAIN,
        PLAIN.set(shading="flat", exposure=1.0, samples=9),
        PLAIN.set(model="ward", mesh="torus", rotation=(0, 10, 0)),
        PLAIN.set(kd=(1, 0, 0), ambient=False),
        PLAIN.set(direction=(0, 0, 1), irradiance=2.0, camera__azimuth=80),
    ]
    for a, b in itertools.permutations(scenes, 2):
        pairs = contrast.differences(a, b)
        assert pairs and settings.all_changed(a, pairs) == b
        assert len(dict(pairs)) == len(pairs)
    assert contrast.differences(PLAIN, PLAIN) == ()
    for other in (
        PLAIN._replace(lights=PLAIN.lights[:1]),
        PLAIN._replace(objects=PLAIN.objects * 2),
        PLAIN.set(light="point"),
    ):
        assert contrast.differences(PLAIN, other) is None
    assert contrast.differences(PLAIN.set(ev100=3.0), PLAIN) is None  # nothing leaves it out again


def test_captions_say_what_differs_in_both_languages():
    comparison = compare.added(Comparison(), Variant((("shininess", 80.0), ("shading", "flat"))))
    scenes = [compare.scene_of(one, PLAIN) for one in comparison.shown]
    a, b = compare.captions(comparison, scenes)
    assert b == {
        "en": "shininess = 80, shading = flat",
        "pt": "brilho = 80, tonalização = flat",
    }
    assert a["en"] == f"shininess = {PLAIN.objects[0].values['shininess']:g}, shading = phong"
    kept = compare.added(Comparison(), Variant(kept=PLAIN.set(exposure=-1.0)))
    scenes = [compare.scene_of(one, PLAIN) for one in kept.shown]
    assert [one["en"] for one in compare.captions(kept, scenes)] == [
        "exposure = 0 EV",
        "exposure = -1 EV",
    ]
    named = Comparison("grid", (Variant(caption={"en": "a lamp"}), Variant((("tone", "aces"),))))
    assert compare.captions(named, [PLAIN, None])[0] == {"en": "a lamp"}


def test_pictures_come_and_go():
    full = compare.added(compare.models(["phong", "ward", "lambert"]), Variant(kept=PLAIN))
    assert len(full.variants) == compare.MOST and compare.added(full, Variant()) is full
    assert compare.without(full, 1).variants == full.variants[:1] + full.variants[2:]
    pair = compare.added(Comparison(), Variant((("tone", "aces"),)))
    assert pair.mode == "split" and compare.without(pair, 0) == Comparison()
    assert compare.swapped(pair).variants == pair.variants[::-1]
    assert compare.added(pair, Variant()).variants == (Variant(), Variant())  # the other is B
    assert len(compare.added(pair._replace(mode="grid"), Variant()).variants) == 3
    lone = compare.in_mode(Comparison(), "difference", PLAIN)
    assert lone.variants[1].kept is PLAIN and len(lone.shown) == 2
    assert compare.in_mode(lone, "one", PLAIN).shown == (Variant(),)


def test_what_is_turned_turns_by_as_much_in_every_picture():
    def turn(scene):
        return scene.set(camera__azimuth=scene.camera.azimuth + 5.0)

    pictures = (
        *(Variant(), Variant((("camera.azimuth", 60.0),)), Variant((("tone", "aces"),))),
        *(Variant(kept=PLAIN.set(camera__azimuth=-90)),),
        *(Variant(kept=PLAIN.set(camera__azimuth=-90), apart=True),),
    )
    start = Comparison("grid", pictures)
    after, scene = compare.moved(start, PLAIN, turn)

    def angles(comparison, scene):
        return [compare.scene_of(one, scene).camera.azimuth for one in comparison.shown]

    assert [b - a for a, b in zip(angles(start, PLAIN), angles(after, scene), strict=True)] == [
        5.0
    ] * 5
    assert angles(after, scene)[0] == angles(after, scene)[2] == angles(after, scene)[3]
    home = compare.looking_as(after, start)
    assert angles(home, PLAIN)[:4] == angles(start, PLAIN)[:4]


@pytest.mark.parametrize("size", [(850, 800), (1280, 800), (300, 900), (7, 5), (1, 1), (3, 400)])
@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_places_are_alike_and_do_not_overlap(size, count):
    places = compare.places("grid", count, size)
    assert len(places) == count and len({place[2:] for place in places}) == 1
    for left, top, wide, high in places:
        assert wide > 0 < high and left >= 0 <= top
        if min(size) > 60:
            assert left + wide <= size[0] and top + high <= size[1]
    for a, b in itertools.combinations(places, 2):
        assert abs(a[0] - b[0]) >= a[2] + compare.GAP or abs(a[1] - b[1]) >= a[3] + compare.GAP
    covered = count * places[0][2] * places[0][3]
    assert covered >= 0.6 * size[0] * size[1] or min(size) < 60
    assert compare.places("split", 2, size) == [(0, 0, *size)] * 2


def test_three_stand_in_a_row_where_that_is_larger():
    assert len({top for _, top, _, _ in compare.places("grid", 3, (1280, 420))}) == 1
    assert len({top for _, top, _, _ in compare.places("grid", 3, (900, 800))}) == 2


def test_a_sheet_shows_the_pictures_again(tmp_path):
    base = PLAIN._replace(size=(40, 30), samples=1)
    comparison = compare.added(compare.models(["phong", "ward"]), Variant(kept=base.set(kd=0.1)))
    now = base.set(camera__azimuth=50)
    scenes = [compare.scene_of(one, now) for one in comparison.shown]
    made = compare.sheet(now, scenes, comparison, 3)
    path = tmp_path / "sheet.toml"
    path.write_text(made.toml(str(tmp_path)))
    again = [one for _, one in opening.pages(Scene.load(str(path)))]
    assert [one._replace(lang="system", columns=0) for one in again] == scenes
    said = [caption for _, _, caption in picture.panels(made, "en")]
    assert said == [one["en"] for one in compare.captions(comparison, scenes)]
    assert "model = ward" in said[1]
    other = compare.added(Comparison(), Variant(kept=base.set(light="point")))
    scenes = [compare.scene_of(one, now) for one in other.shown]
    assert compare.sheet(now, scenes, other, 2) is None


@pytest.mark.parametrize("name", scenefile.shipped())
def test_the_rates_of_every_scene_can_be_compared(name):
    scene = opening.pages(Scene.load(name))[0][1]
    comparison = compare.rates()
    scenes = [compare.scene_of(one, scene) for one in comparison.shown]
    assert [one.shading for one in scenes] == ["flat", "gouraud", "phong"]
    assert compare.sheet(scene, scenes, comparison, 3)
    assert all(one["pt"] for one in compare.captions(comparison, scenes))
