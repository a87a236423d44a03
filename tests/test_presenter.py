"""A lesson in the real window: the question before the answer, large, with its sliders alone."""

import pytest
from hand import PANEL, spied
from test_window import MIDDLE, captured, drag, plain, press, save, screen, settle, shown

from lumiar import banner, compare, hands, lesson, presenter, settings
from lumiar.desktop import glfw
from lumiar.window import Viewer

SIZE = (900, 500)
LESSON = """title = "Own"
scene = "phong-blinn"
set = { samples = 1 }
[[step]]
title = { en = "Gloss", pt = "Brilho" }
caption = { en = "%s", pt = "Em palavras." }
formula = 'I = k_s'
plain = "I is ks"
ask = { en = "Wider or narrower?", pt = "Mais largo?" }
reveal = { en = "Narrower.", pt = "Mais estreito." }
sliders = ["shininess", "camera.azimuth", "model", "direction", "exposure"]
compare = [
    { caption = "ten", set = { shininess = 10 } },
    { caption = "fifty", set = { shininess = 50 } },
    { caption = "hundred", set = { shininess = 100 } },
]
[[step]]
title = "Last"
caption = "No question."
sliders = ["camera.distance"]
"""


@pytest.fixture
def viewer(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(LESSON % "In words.")
    with Viewer(lesson.load(str(path)), "en", "own", str(path), True, SIZE) as one:
        settle(one)
        yield one


@pytest.fixture
def look(monkeypatch):
    """Return a function that draws a window once more, and returns a Spy of its panel."""

    return lambda one: spied(one, monkeypatch, (*PANEL, presenter, banner))


def gloss(one):
    """Return the exponents of the pictures that are shown."""
    return [easel.shown.objects[0].values["shininess"] for easel in one.stage.easels]


def rows(spy):
    """Return the keys of the values that have a row, in order."""
    found = dict.fromkeys(path.split("/")[0] for path in spy.places if "/" in path)
    return list(found)


def test_the_question_stands_before_the_answer(viewer, look):
    seen, pictures = [], []
    for _ in range(4):
        said = look(viewer).said
        seen.append((gloss(viewer), "Wider or narrower?" in said, "Narrower." in said))
        pictures.append(screen(viewer).tobytes())
        press(viewer, glfw.KEY_PAGE_DOWN)
    assert seen[:2] == [([10, 50], True, False), ([10, 50, 100], False, True)]
    assert seen[2] == seen[3] and not any(seen[2][1:])  # after the last one there is none
    assert len(seen[2][0]) == 1 and len(set(pictures)) >= 3
    for key in (glfw.KEY_LEFT, glfw.KEY_RIGHT, glfw.KEY_PAGE_UP, glfw.KEY_PAGE_UP):
        press(viewer, key)
    assert gloss(viewer) == [10, 50] and viewer.document.page == 0


def test_the_pictures_of_a_step_stand_side_by_side_with_their_captions(viewer, look):
    press(viewer, glfw.KEY_PAGE_DOWN)
    assert {"ten", "fifty", "hundred"} <= {*look(viewer).said}
    (left, _), seen = viewer._area(), screen(viewer)
    for shot, easel, place in zip(
        viewer.document.stop.shots, viewer.stage.easels, viewer.stage.places, strict=True
    ):
        x, y, wide, high = place
        true = captured(hands.framed(shot.scene, (wide, high)))
        rows = slice(high // 2, high - 60)  # captions cover the rest
        assert (seen[y : y + high, left + x : left + x + wide][rows] == true[rows]).all()
        assert easel.shown.objects == shot.scene.objects
    corners = [place[:2] for place in viewer.stage.places]
    assert len({*corners}) == 3


def test_what_a_step_compares_ends_with_the_lesson(viewer, tmp_path):
    press(viewer, glfw.KEY_PAGE_DOWN)
    assert len(viewer.stage.easels) == 3
    (tmp_path / "plain.toml").write_text("exposure = 1.0\n")
    viewer.document.drop(str(tmp_path / "plain.toml"))
    settle(viewer)
    assert len(viewer.stage.easels) == 1 and viewer.document.beside.home == compare.Comparison()


def test_the_panel_has_the_sliders_of_the_step_alone(viewer, look):
    wanted = ["camera.azimuth", "model", "direction", "exposure", "0", "1"]
    assert rows(look(viewer)) == wanted
    assert {"0/shininess/shininess/##value", "1/shininess/shininess/##value"} <= {
        *look(viewer).places
    }
    before = viewer.state.width
    press(viewer, glfw.KEY_P)
    spy = look(viewer)
    assert any("camera" in path for path in spy.places)
    assert "Wider or narrower?" not in spy.said and len(rows(spy)) > 5
    assert viewer.state.width != before
    press(viewer, glfw.KEY_P)
    assert rows(look(viewer)) == wanted


def slide(one, look, name):
    """Drag a slider to nine tenths of its way."""
    left, top, right, bottom = look(one).places[name]
    middle = (top + bottom) / 2.0
    drag(one, (left + 0.5 * (right - left), middle), (left + 0.9 * (right - left), middle))


def test_a_slider_moves_all_pictures_but_what_sets_them_apart(viewer, look):
    first = viewer.scene
    slide(viewer, look, "exposure/exposure/##value")
    moved = viewer.scene.exposure
    assert moved > 1.0 and viewer.scene == settings.changed(first, "exposure", moved)
    assert [easel.shown.exposure for easel in viewer.stage.easels] == [moved] * 2
    assert gloss(viewer) == [10, 50] and "ten" in look(viewer).said
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert viewer.scene == first and [e.shown.exposure for e in viewer.stage.easels] == [0.0] * 2
    viewer.desktop.key(glfw.KEY_LEFT_CONTROL, glfw.RELEASE, 0)
    slide(viewer, look, "1/shininess/shininess/##value")
    ten, other = gloss(viewer)
    assert ten == 10 and other > 50 and viewer.scene == first
    said = look(viewer).said
    assert "ten" in said and "fifty" not in said  # a caption that no longer holds
    assert f"B   shininess = {other:.6g}" in said
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert gloss(viewer) == [10, 50] and "fifty" in look(viewer).said
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL | glfw.MOD_SHIFT)
    assert gloss(viewer) == [10, other]
    press(viewer, glfw.KEY_PAGE_DOWN)
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert gloss(viewer) == [10, 50, 100]  # no way back into another stop
    press(viewer, glfw.KEY_PAGE_UP)
    assert gloss(viewer) == [10, 50] and viewer.scene == first


def test_the_language_is_changed_in_the_panel(viewer, look):
    spy = look(viewer)
    left, top, right, bottom = spy.places["pt"]
    assert {"Gloss", "In words.", "Predict first"} <= {*spy.said}
    drag(viewer, ((left + right) / 2, (top + bottom) / 2), ((left + right) / 2, (top + bottom) / 2))
    assert {"Brilho", "Em palavras.", "Preveja antes", "Mais largo?"} <= {*look(viewer).said}


def test_a_formula_is_a_picture_and_words_where_none_can_be_made(viewer, look, monkeypatch):
    assert viewer.presenter._drawn and "I is ks" not in look(viewer).said
    before = screen(viewer)

    def refuse(*_):
        raise ImportError("no matplotlib")

    monkeypatch.setattr("lumiar.plots.formula", refuse)
    viewer.presenter._formula = None
    settle(viewer)
    assert "I is ks" in look(viewer).said and (screen(viewer) != before).any()


def test_letters_are_large_and_smaller_where_there_is_more_to_say(viewer, tmp_path):
    width = viewer.state.width
    assert viewer.presenter._share == 1.0 and width >= 23 * SIZE[1] / presenter.LINES - 1
    (tmp_path / "long.toml").write_text(LESSON % ("many words " * 32))
    viewer.desktop.events.append(("drop", [str(tmp_path / "long.toml")]))
    settle(viewer)
    assert not viewer.document.fault and viewer.document.name == "long"
    assert presenter.SMALLEST * 0.9 < viewer.presenter._share < 1.0


def test_any_scene_may_be_presented(look):
    with Viewer(plain(), "en", hidden=True, size=SIZE) as viewer:
        settle(viewer)
        narrow, picture = viewer.state.width, shown(viewer)
        press(viewer, glfw.KEY_P)
        spy = look(viewer)
        model = viewer.scene.objects[0].model
        names = [path.split("/")[1] for path in spy.places if "/" in path]
        assert list(dict.fromkeys(names)) == [p.name for p in model.parameters]
        assert rows(spy) == [model.name] and viewer.state.width != narrow
        drag(viewer, MIDDLE, (600, 230))
        press(viewer, glfw.KEY_P)
        press(viewer, glfw.KEY_R)
        assert (shown(viewer) == picture).all()


def test_a_saved_lesson_is_read_again_and_a_broken_one_leaves_the_last(viewer, look, tmp_path):
    press(viewer, glfw.KEY_PAGE_DOWN)
    path = tmp_path / "own.toml"
    save(viewer, path, LESSON % "In other words.")
    assert gloss(viewer) == [10, 50, 100] and "In other words." in look(viewer).said
    save(viewer, path, LESSON.replace("sliders = [", "slider = [") % "Broken.")
    assert f"{path}:" in viewer.document.fault and "In other words." in look(viewer).said


def test_every_stop_of_the_shipped_lessons_can_be_shown(look):
    for name in lesson.shipped():
        with Viewer(lesson.load(name), "pt", name, "", True, (320, 240)) as viewer:
            for stop in viewer.document.stops:
                paths = [path.split("/") for path in look(viewer).places if "/" in path]
                assert [easel.good for easel in viewer.stage.easels] == [
                    shot.scene for shot in stop.shots
                ]
                for key in stop.step.sliders:  # one row, or one in each picture
                    own = all(key in dict(shot.values) for shot in stop.shots)
                    found = {path[0] for path in paths if key in path[:2]}
                    assert found == ({str(i) for i in range(len(stop.shots))} if own else {key})
                assert not viewer.stage.fault and not viewer.state.message
                viewer.document.turn(1)


def test_what_a_lesson_is(tmp_path, lumiar):
    (tmp_path / "one.toml").write_text("samples = 1\n")
    (tmp_path / "two.toml").write_text('title = "x"\n[[step]]\ntitle =')
    assert lesson.is_lesson("phong") and lesson.is_lesson("two.toml", str(tmp_path))
    for name in ("phong-blinn", "one.toml", "none.toml", "two.png", ""):
        assert not lesson.is_lesson(name, str(tmp_path))
    said = lumiar("view", "phong", "--model", "blinn", code=2).stderr
    assert "--model: phong is a lesson" in said
    assert "two.toml:3: " in lumiar("view", "two.toml", code=2).stderr


def test_a_step_may_offer_lists_of_lights_and_shapes(tmp_path, look):
    """The keys of values that are chosen by their names, and those of the mesh's shape."""
    keys = ["light", "unit", "illuminant", "image", "mesh", "mesh.minor", "temperature"]
    path = tmp_path / "own.toml"
    path.write_text(
        'title = "Own"\nset = { samples = 1, mesh = "torus", light = "point" }\n'
        f'[[step]]\ntitle = "T"\ncaption = "C"\nsliders = {keys}\n'.replace("'", '"')
    )
    with Viewer(lesson.load(str(path)), "en", "own", str(path), True, SIZE) as viewer:
        settle(viewer)
        spy = look(viewer)
        lists = {"light": "##kind", "unit": "##unit", "illuminant": "##illuminant"}
        lists |= {
            "mesh": "##mesh",
            "mesh.minor": "minor/##value",
            "temperature": "temperature/##given",
        }
        for key, label in lists.items():
            assert any(p == f"{key}/{label}" for p in spy.places), key
        assert not any(p.startswith("image") for p in spy.places)  # a point has none
        left, top, right, below = spy.places["mesh.minor/minor/##value"]
        y = (top + below) / 2.0
        drag(viewer, (left + 0.3 * (right - left), y), (right - 5, y))
        assert viewer.scene.objects[0].mesh.startswith("torus:minor=")
