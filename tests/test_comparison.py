"""Comparisons in the real window: each mode, its pixels, the mouse on it, the tool, F12."""

import json
import time

import numpy as np
import pytest
from hand import spied
from PIL import Image
from test_window import captured, drag, plain, press, save, screen, settle

from lumiar import (
    Scene,
    banner,
    capture,
    compare,
    comparison,
    gallery,
    hands,
    labels,
    panel,
    picture,
    scale,
    sections,
    widgets,
)
from lumiar.compare import Comparison, Variant
from lumiar.comparing import TEXT
from lumiar.desktop import glfw
from lumiar.window import Viewer

SIZE = (760, 420)
PAIR = compare.added(Comparison(), Variant((("shading", "flat"),)))
MODEL = """// model   Own
uniform float k = 0.5;  // [0, 1]: share
vec3 scatter(vec3 L, vec3 V) { return vec3(k * max(L.z, 0.0))%s; }
"""


@pytest.fixture
def viewer():
    with Viewer(plain(), "en", hidden=True, size=SIZE) as one:
        settle(one)
        yield one


@pytest.fixture
def look(monkeypatch):
    """Return a function that draws a window once more, and returns a Spy of panel and tool."""

    return lambda one: spied(
        one, monkeypatch, (panel, sections, widgets, labels, comparison, gallery, banner)
    )


@pytest.fixture
def wide(viewer):
    """A window with room for the tool."""
    glfw.set_window_size(viewer.desktop.window, 1150, 420)
    press(viewer, glfw.KEY_F2)
    return viewer


def show(one, what):
    one.document.beside.show(what)
    settle(one)


def pixels(one, easel):
    one.desktop.use()
    width, height = easel.canvas.size
    data = easel.canvas.read(components=3)
    return np.frombuffer(data, np.uint8).reshape(height, width, 3)


def rest(one):
    """Let the pictures rest, and wait until all numbers have come."""
    deadline = time.monotonic() + 60.0
    while True:
        one.moved, one.due = 0.0, 1
        one.frame()
        if not (one.stage.coarse or one.stage.busy) or time.monotonic() > deadline:
            break
        time.sleep(0.02)
    settle(one)


def click(one, look, name, last=False):
    """Click on a widget of the panel or of a tool; without `last` there must be one of a name."""
    found = [at for path, at in look(one).places.items() if f"/{path}".endswith(f"/{name}")]
    assert found and (last or len(found) == 1), (name, [*look(one).places])
    left, top, right, bottom = found[-1]
    at = ((left + right) / 2.0, (top + bottom) / 2.0)
    drag(one, at, at)


def true(one, i, scene=None):
    """Return what `capture` draws of a picture's scene in its place."""
    wanted = scene or compare.scene_of(one.document.beside.comparison.shown[i], one.scene)
    return captured(hands.framed(wanted, one.stage.places[i][2:]))


@pytest.mark.parametrize(
    "wanted",
    [compare.rates(), PAIR, compare.models(["phong", "ward", "lambert", "strand"])],
    ids=["rates", "split", "models"],
)
def test_every_picture_is_what_capture_draws_of_its_scene(viewer, wanted):
    show(viewer, wanted)
    assert len(viewer.stage.easels) == len(wanted.shown)
    seen, (left, _) = screen(viewer), viewer._area()
    for i, (easel, (x, y, wide, high)) in enumerate(
        zip(viewer.stage.easels, viewer.stage.places, strict=True)
    ):
        assert (pixels(viewer, easel) == true(viewer, i)).all()
        if wanted.mode == "grid":
            rows = slice(y + high // 2, y + high - 60)  # the rest is below captions
            assert (
                seen[rows, left + x : left + x + wide] == true(viewer, i)[high // 2 : -60]
            ).all()
    assert len({pixels(viewer, one).tobytes() for one in viewer.stage.easels}) == len(wanted.shown)


def test_the_line_between_two_is_dragged_and_moved_by_keys(viewer):
    show(viewer, PAIR)
    left, (width, height) = viewer._area()
    a, b = (pixels(viewer, one) for one in viewer.stage.easels)
    before = viewer.scene

    def stands_at(share):
        x, rows = round(share * width), slice(height // 4, height // 3)
        seen = screen(viewer)[rows, left:]
        clear = 14  # pixels beside the line that its handle may cover
        return (seen[:, : max(0, x - clear)] == a[rows, : max(0, x - clear)]).all() and (
            seen[:, x + clear :] == b[rows, x + clear :]
        ).all()

    assert (a != b).any() and viewer.stage.share == 0.5 and stands_at(0.5)
    line = left + 0.5 * width
    drag(viewer, (line, 100), (line + 0.3 * width, 130))
    assert abs(viewer.stage.share - 0.8) < 0.01 and stands_at(viewer.stage.share)
    assert viewer.scene is before  # the view has not been turned
    for _ in range(17):
        press(viewer, glfw.KEY_LEFT, glfw.MOD_SHIFT)
    assert viewer.stage.share == 0.0 and stands_at(0.0)
    for _ in range(21):
        press(viewer, glfw.KEY_RIGHT, glfw.MOD_SHIFT)
    assert viewer.stage.share == 1.0 and stands_at(1.0)
    drag(viewer, (left + width - 3, 200), (left - 500, 200))
    assert viewer.stage.share == 0.0


def test_turning_one_picture_turns_all_and_is_one_step_to_undo(viewer):
    show(viewer, Comparison("grid", (Variant(), Variant((("camera.azimuth", 60.0),)))))
    left, _ = viewer._area()
    before = [pixels(viewer, one) for one in viewer.stage.easels]
    for x, y, wide, high in viewer.stage.places:
        middle = (left + x + wide // 2, y + high // 2)
        drag(viewer, middle, (middle[0] + high // 8, middle[1]))
        shown = [one.shown.camera.azimuth for one in viewer.stage.easels]
        assert shown == pytest.approx([20.0 - 22.5, 60.0 - 22.5], abs=0.8)
        turned = [pixels(viewer, one) for one in viewer.stage.easels]
        assert all((a != b).any() for a, b in zip(before, turned, strict=True))
        press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
        after = [pixels(viewer, one) for one in viewer.stage.easels]
        assert all((a == b).all() for a, b in zip(before, after, strict=True))
    viewer.desktop.wheel(0, 2)
    settle(viewer)
    assert viewer.stage.easels[0].shown.camera.distance
    press(viewer, glfw.KEY_R)
    assert viewer.scene.camera == plain().camera


def test_what_is_compared_is_undone_like_all_else(viewer):
    show(viewer, PAIR)
    viewer._push(viewer.scene.set(exposure=1.0))
    settle(viewer)
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert viewer.scene == plain() and viewer.document.beside.comparison is PAIR
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert viewer.document.beside.comparison == Comparison() and len(viewer.stage.easels) == 1
    press(viewer, glfw.KEY_Y, glfw.MOD_CONTROL)
    assert viewer.document.beside.comparison == PAIR and len(viewer.stage.easels) == 2


def test_a_click_picks_a_pixel_of_its_own_picture(viewer):
    show(viewer, compare.models(["phong", "ward"]))
    left, _ = viewer._area()
    for i, (x, y, _, _) in enumerate(viewer.stage.places):
        at = (left + x + 31, y + 47)
        drag(viewer, at, at)
        assert viewer.pointer.picked == (31, 47) and viewer.stage.active == i
        assert viewer.stage.shown == viewer.stage.easels[i].shown
        assert viewer.stage.shown.objects[0].model.name == ("phong", "ward")[i]
    show(viewer, Comparison())
    assert viewer.stage.shown.objects[0].model.name == "phong"


def test_the_difference_has_the_numbers_of_the_verb(viewer, lumiar, tmp_path):
    show(viewer, PAIR._replace(mode="difference"))
    rest(viewer)
    one, names = viewer.stage.deviation, ("a.png", "b.png")
    arrays = []
    for i, name in enumerate(names):
        scene = compare.scene_of(viewer.document.beside.comparison.shown[i], viewer.scene)
        capture(hands.framed(scene, viewer._area()[1]), str(tmp_path / name))
        arrays.append(np.asarray(Image.open(tmp_path / name), np.float64) / 255.0)
    said = json.loads(lumiar("compare", *names, "--json").stdout)
    for name in ("rmse", "max", "share", "not_finite"):
        assert one.numbers[name] == pytest.approx(said[name], rel=1e-5)
    assert one.flip == pytest.approx(said["flip"], rel=1e-6) and one.flip > 0.0
    values = np.abs(arrays[0] - arrays[1]).max(2)
    assert one.ruler.high >= values.max() >= 0.5 * one.ruler.high and not one.ruler.log
    painted = scale.colours(values, one.ruler, np.full(values.shape, True))
    apart = painted.astype(int) - pixels(viewer, one)
    assert abs(apart).max() <= 2
    left, (_, height) = viewer._area()
    rows = slice(height // 2, height - 60)
    assert (screen(viewer)[rows, left:] == pixels(viewer, one)[rows]).all()


def test_a_moving_difference_has_colours_and_no_numbers(viewer):
    show(viewer, PAIR._replace(mode="difference"))
    rest(viewer)
    before, high = pixels(viewer, viewer.stage.deviation), viewer.stage.deviation.ruler.high
    viewer._push(viewer.scene.set(camera__azimuth=70))
    viewer.frame()
    assert (pixels(viewer, viewer.stage.deviation) != before).any()
    assert viewer.stage.deviation.numbers is None and viewer.stage.deviation.flip is None
    assert viewer.stage.deviation.ruler.high == high
    show(viewer, Comparison())
    assert viewer.stage.deviation is None and not viewer.stage.busy


def test_an_idle_comparison_draws_nothing(viewer):
    show(viewer, PAIR._replace(mode="difference"))
    rest(viewer)
    viewer.awake = 0.0
    assert not any(viewer.frame() for _ in range(5))


def test_alike_pictures_do_not_differ(viewer, look):
    show(viewer, Comparison("difference", (Variant(), Variant())))
    rest(viewer)
    assert viewer.stage.deviation.numbers["max"] == 0.0 and viewer.stage.deviation.flip == 0.0
    assert "no difference" in look(viewer).said


def test_only_what_changes_is_drawn_again(viewer, monkeypatch):
    show(viewer, compare.added(PAIR._replace(mode="grid"), Variant(kept=viewer.scene)))
    drawn = []
    show_scene = viewer.stage.renderer.show
    monkeypatch.setattr(
        viewer.stage.renderer, "show", lambda one, at: (drawn.append(one), show_scene(one, at))
    )
    viewer.stage.cost = 0.0
    viewer._push(viewer.scene.set(exposure=0.5))
    settle(viewer)
    assert [one.exposure for one in drawn] == [0.5, 0.5]  # not the one that was kept
    drawn.clear()
    viewer.stage.cost = 1.0
    viewer._push(viewer.scene.set(exposure=0.25, samples=16))
    viewer.frame()
    assert [one.samples for one in drawn] == [1, 1] and viewer.stage.coarse
    settle(viewer)
    assert not viewer.stage.coarse


def test_a_broken_picture_is_told_and_stays_as_it_was(viewer, tmp_path):
    path = tmp_path / "own.glsl"
    path.write_text(MODEL % "")
    show(viewer, compare.added(Comparison(), Variant((("model", str(path)),))))
    good = pixels(viewer, viewer.stage.easels[1])
    for broken in (" * nope", ";\n}\nuniform float x"):
        save(viewer, path, MODEL % broken)
        viewer._push(viewer.scene.set(exposure=viewer.scene.exposure))
        said = viewer.document.fault + viewer.stage.fault
        assert str(path) in said
        assert (pixels(viewer, viewer.stage.easels[1]) == good).all()
    save(viewer, path, MODEL % " * 0.5")
    assert not viewer.document.fault + viewer.stage.fault
    assert (pixels(viewer, viewer.stage.easels[1]) != good).any()
    show(viewer, compare.added(Comparison(), Variant((("shinyness", 3.0),))))
    assert viewer.stage.fault.startswith("B: no value 'shinyness'")
    assert (pixels(viewer, viewer.stage.easels[0]) == true(viewer, 0, viewer.scene)).all()
    viewer._push(viewer.scene.set(kd=(1, 0, 0)))
    settle(viewer)
    assert (pixels(viewer, viewer.stage.easels[0]) == true(viewer, 0, viewer.scene)).all()


def test_any_size_is_shown(viewer):
    for wanted in (PAIR, compare.rates(), PAIR._replace(mode="difference")):
        viewer.document.beside.show(wanted)
        for size in ((0, 0), (1, 1), (300, 2), (3, 300), (0, 7), (401, 300)):
            glfw.set_window_size(viewer.desktop.window, *size)
            viewer.frame()
            viewer.desktop.move(2, 1)
            viewer.desktop.wheel(0, 1)
            viewer.desktop.button(0, glfw.PRESS, 0)
            viewer.desktop.move(5, 3)
            viewer.frame()
            viewer.desktop.button(0, glfw.RELEASE, 0)
            viewer.frame()
        viewer.document.history.push(viewer.document.history.scene)
    glfw.set_window_size(viewer.desktop.window, *SIZE)
    show(viewer, compare.rates())
    assert (pixels(viewer, viewer.stage.easels[2]) == true(viewer, 2)).all()
    assert not viewer.stage.fault


@pytest.mark.parametrize("wanted", [compare.rates(), PAIR, PAIR._replace(mode="difference")])
def test_a_screenshot_reopens_as_what_was_compared(viewer, wanted, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    viewer._push(viewer.scene.set(camera__azimuth=50, shininess=7))
    show(viewer, wanted)
    rest(viewer)
    press(viewer, glfw.KEY_F12)
    found = Scene.load("lumiar-001.png")
    ones = [one for _, one, _ in picture.panels(found, "en")]
    assert [one.shading for one in ones] == [
        compare.scene_of(one, viewer.scene).shading for one in wanted.shown
    ]
    for i, one in enumerate(ones):
        assert (captured(one) == pixels(viewer, viewer.stage.easels[i])).all()
    if wanted.mode != "difference":
        with Image.open("lumiar-001.png") as saved:
            assert (np.asarray(saved) == captured(found)).all()
    else:
        with Image.open("lumiar-001.png") as saved:
            top = np.asarray(saved)[: viewer._area()[1][1], :]
        assert (top == pixels(viewer, viewer.stage.deviation)).all()


def test_a_screenshot_is_of_what_was_asked_for_last(viewer, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    show(viewer, compare.rates())
    viewer.document.beside.show(PAIR._replace(mode="difference"))
    viewer.desktop.key(glfw.KEY_F12, glfw.PRESS, 0)
    viewer.frame()
    assert len(Scene.load("lumiar-001.png").panels) == 2 and not viewer.fault


def test_a_screenshot_of_what_no_sheet_can_say(viewer, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    show(viewer, compare.added(Comparison(), Variant(kept=plain().set(light="point"))))
    press(viewer, glfw.KEY_F12)
    assert Scene.load("lumiar-001.png").objects == viewer.scene.objects and not viewer.fault
    with Image.open("lumiar-001.png") as saved:
        assert saved.size[0] > 2 * viewer._area()[1][0]


def test_the_tool_is_found_and_works(wide, look):
    click(wide, look, "The three shading rates")
    assert wide.document.beside.comparison == compare.rates()
    said = look(wide).said
    assert {"A   shading = flat", "B   shading = gouraud", "C   shading = phong"} <= {*said}
    click(wide, look, "1/×")
    assert [one.values[0][1] for one in wide.document.beside.comparison.variants] == [
        "flat",
        "phong",
    ]
    click(wide, look, "swap A and B")
    assert [one.values[0][1] for one in wide.document.beside.comparison.variants] == [
        "phong",
        "flat",
    ]
    click(wide, look, "A | B")
    assert wide.document.beside.comparison.mode == "split"
    click(wide, look, "One")
    assert len(wide.stage.easels) == 1
    click(wide, look, "Keep this picture as B")
    assert wide.document.beside.comparison.variants == (Variant(), Variant(kept=wide.scene))
    wide._push(wide.scene.set(shininess=3))
    settle(wide)
    assert "A   shininess = 3" in look(wide).said
    click(wide, look, "Difference")
    assert wide.stage.mode == "difference"


def test_same_but_with_takes_a_click_and_a_slider_moves_it(wide, look):
    click(wide, look, "Same, but with …")
    click(wide, look, "a value")
    click(wide, look, "shininess##shininess")
    (key, value), *_ = wide.document.beside.comparison.variants[1].values
    assert key == "shininess" and value != wide.scene.objects[0].values["shininess"]
    assert wide.document.beside.comparison.mode == "split"
    before, steps = wide.scene, len(wide.document.history._past)
    path = [path for path in look(wide).places if path.endswith("##value") and path[0] == "1"]
    left, top, right, bottom = look(wide).places[path[0]]
    middle = (top + bottom) / 2.0
    drag(wide, (left + 0.4 * (right - left), middle), (left + 0.8 * (right - left), middle))
    moved = wide.document.beside.comparison.variants[1].values[0][1]
    assert moved != value and wide.scene is before
    assert len(wide.document.history._past) == steps + 1
    assert wide.stage.easels[1].shown.objects[0].values["shininess"] == moved
    click(wide, look, "but with …")
    click(wide, look, "mesh")
    click(wide, look, "torus")
    assert dict(wide.document.beside.comparison.variants[1].values) == {
        "shininess": moved,
        "mesh": "torus",
    }


def test_models_are_ticked(wide, look):
    click(wide, look, "##models")
    click(wide, look, "lambert")
    click(wide, look, "blinn")
    names = [dict(one.values)["model"] for one in wide.document.beside.comparison.variants]
    assert names == ["phong", "lambert", "blinn"]
    click(wide, look, "lambert")
    assert len(wide.stage.easels) == 2
    click(wide, look, "phong", last=True)
    click(wide, look, "blinn")  # one is left, whatever is clicked
    assert wide.document.beside.comparison == compare.models(["blinn"])


def test_a_lone_picture_has_none_to_change_places_with(wide, look):
    show(wide, compare.models(["ward"]))
    swap = TEXT["en"]["compare"]["swap"]
    assert not any(swap in place for place in look(wide).places)
    show(wide, PAIR)
    assert any(swap in place for place in look(wide).places)


def test_the_tool_speaks_both_languages(wide, look):
    show(wide, PAIR)
    wide.state.lang = "pt"
    spy = look(wide)
    assert "B   tonalização = flat" in spy.said and "As três tonalizações" in spy.places


def test_a_file_is_dropped_onto_a_picture(viewer, tmp_path):
    show(viewer, compare.rates())
    left, _ = viewer._area()
    capture(plain().set(kd=(1, 0, 0), camera__azimuth=80, size=(40, 30)), str(tmp_path / "red.png"))
    (tmp_path / "one.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    (tmp_path / "no.txt").write_text("nothing")
    for i, name in ((1, "red.png"), (2, "one.off"), (2, "no.txt")):
        x, y, wide, high = viewer.stage.places[i]
        viewer.desktop.move(left + x + wide // 2, y + high // 2)
        viewer.desktop.events.append(("drop", [str(tmp_path / name)]))
        settle(viewer)
    flat, red, mesh = viewer.document.beside.comparison.variants
    assert flat.values == (("shading", "flat"),) and viewer.scene == plain()
    assert red.apart and viewer.stage.easels[1].shown.camera.azimuth == 80.0
    assert viewer.stage.easels[1].shown.objects[0].values["kd"] == (1.0, 0.0, 0.0)
    assert dict(mesh.values) == {"shading": "phong", "mesh": str(tmp_path / "one.off")}
    assert "no.txt" in viewer.document.fault
    viewer.desktop.move(left + 5, 5)
    viewer.desktop.events.append(("drop", [str(tmp_path / "one.off")]))
    settle(viewer)
    assert viewer.scene.objects[0].mesh == str(tmp_path / "one.off")
