"""The real window, driven frame by frame without a display: its pixels, the scene that results."""

import itertools
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from PIL import Image

from lumiar import Scene, capture, easel, hands, layout, lesson, opening, scenefile, settings
from lumiar.desktop import glfw  # which imports imgui before it
from lumiar.document import Document
from lumiar.errors import Mistake
from lumiar.watch import SETTLED, Watch
from lumiar.window import Viewer

SIZE = (720, 400)
MODEL = """// model   Own
uniform float k = 0.5;  // [0, 1]: share
uniform vec3 tint = vec3(0.2, 0.7, 0.4);  // color: of it
vec3 scatter(vec3 L, vec3 V) { return k * tint * max(L.z, 0.0)%s; }
"""
TRIANGLE = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


def plain():
    return Scene.default()._replace(samples=1)


@pytest.fixture
def viewer():
    with Viewer(plain(), "en", hidden=True, size=SIZE) as one:
        settle(one)
        yield one


def settle(one):
    """Turn until all is drawn as it will stay."""
    one.due = max(one.due, 1)
    while one.due or one.trial.busy or one.document.gate.waiting:
        one.frame()
    if one.stage.coarse:  # a coarse picture, as while it moves
        one.moved, one.due = 0.0, 1
        while one.due:
            one.frame()


def shown(one):
    """Return the pixels of the picture, (height, width, 3)."""
    one.desktop.use()
    size = one.stage.canvas.size
    return np.frombuffer(one.stage.canvas.read(components=3), np.uint8).reshape(size[1], size[0], 3)


def screen(one):
    """Return the pixels of the window, (height, width, 3)."""
    one.desktop.use()
    width, height = one.desktop.size
    data = one.desktop.context.screen.read((0, 0, width, height), 3)
    return np.frombuffer(data, np.uint8).reshape(height, width, 3)[::-1]


def captured(scene):
    found = capture(scene)
    return np.frombuffer(found.pixels, np.uint8).reshape(found.size[1], found.size[0], 3)


def press(one, key, held=0):
    one.desktop.key(key, glfw.PRESS, held)
    one.desktop.key(key, glfw.RELEASE, held)
    settle(one)


def drag(one, start, end, button=0, held=0, steps=4):
    one.desktop.move(*start)
    settle(one)
    one.desktop.button(button, glfw.PRESS, held)
    for i in range(1, steps + 1):
        one.desktop.move(*(a + (b - a) * i / steps for a, b in zip(start, end, strict=True)))
        one.frame()
    one.desktop.button(button, glfw.RELEASE, held)
    settle(one)


def save(one, path, text):
    """Save a file as an editor does, and wait until the window has seen that it has settled."""
    path.write_text(text)
    os.utime(path, ns=(time.time_ns(), time.time_ns() + 1000))
    one.frame()
    time.sleep(1.2 * SETTLED)
    one.frame()
    settle(one)


MIDDLE, ASIDE = (560, 200), (600, 230)


def test_the_window_shows_what_capture_draws(viewer):
    left, size = viewer._area()
    scene = hands.framed(viewer.scene, size)
    assert (shown(viewer) == captured(scene)).all()
    upper = slice(0, 300)  # the lines at the foot cover the rest
    assert (screen(viewer)[upper, left:] == shown(viewer)[upper]).all()
    assert len(np.unique(screen(viewer)[:, : left - 2].reshape(-1, 3), axis=0)) > 20  # the panel


def test_a_window_opens_where_pictures_were_drawn_before(renderer):
    assert renderer.context.version_code >= 330
    with Viewer(plain(), "en", hidden=True, size=(32, 24)) as viewer:
        settle(viewer)
        assert shown(viewer).any()


def test_a_scene_of_several_passes_at_rest_is_what_capture_draws_too():
    lamp = settings.light("sphere:samples=1100:radius=1")
    scene = plain()._replace(lights=(lamp,), samples=4)
    assert layout.passes(scene) > 1
    with Viewer(scene, "en", hidden=True, size=(32, 24)) as viewer:
        press(viewer, glfw.KEY_H)
        viewer.stage.cost = 1.0  # as on a slow machine
        drag(viewer, (16, 12), (18, 13))
        assert viewer.scene.camera != scene.camera and not viewer.stage.coarse
        assert (shown(viewer) == captured(hands.framed(viewer.scene, (32, 24)))).all()


def test_shadows_in_many_directions_are_first_drawn_in_one(monkeypatch):
    """How long they take is not known before; then some rows a frame, all as capture draws them."""
    monkeypatch.setattr(easel, "LONG", 0.0)
    lamp = settings.light("quad:samples=64:shadows=true")
    scene = plain()._replace(lights=(lamp,))
    with Viewer(scene, "en", hidden=True, size=(32, 24)) as viewer:
        press(viewer, glfw.KEY_H)
        viewer._push(scene.set(exposure=1).changed("light.1.samples", 65))
        viewer.frame()
        assert viewer.stage.coarse
        first = shown(viewer)
        settle(viewer)
        whole = captured(hands.framed(viewer.scene, (32, 24)))
        assert not viewer.stage.coarse and (shown(viewer) == whole).all() and (first != whole).any()


def test_a_picture_with_broken_pixels_says_how_many(tmp_path):
    """As many as capture counts: none of them reaches a class unseen."""
    path = tmp_path / "own.glsl"
    path.write_text(MODEL % " + (L.x > 0.0 ? sqrt(k - 0.5) : 0.0)")
    scene = plain().changed("model", str(path))
    with Viewer(scene, "en", hidden=True, size=SIZE) as viewer:
        settle(viewer)
        assert viewer.stage.broken == 0
        viewer._push(viewer.scene.set(k=0))
        settle(viewer)
        viewer.moved, viewer.due = 0.0, 1  # it is counted at rest
        settle(viewer)
        assert viewer.stage.broken == capture(hands.framed(viewer.scene, viewer._area()[1])).broken
        red, green, blue = np.moveaxis(screen(viewer)[300:].astype(int), 2, 0)
        assert viewer.stage.broken > 0 and ((red > 2 * green) & (red > 2 * blue)).sum() > 1000


def test_a_slow_picture_is_coarse_only_while_it_moves(viewer):
    viewer._push(viewer.scene._replace(samples=16))
    settle(viewer)
    fine, viewer.stage.cost = shown(viewer), 1.0
    viewer._push(viewer.scene._replace(exposure=0.001))
    viewer.frame()
    assert viewer.stage.coarse and (shown(viewer) != fine).any()
    settle(viewer)
    assert not viewer.stage.coarse


def test_a_picture_that_takes_long_is_drawn_some_rows_a_frame_and_any_move_ends_it(viewer):
    before, (easel,) = shown(viewer), viewer.stage.easels
    viewer.stage.cost, easel.cost = 0.0, 10.0  # as on a slow machine
    viewer._push(viewer.scene._replace(exposure=1.0, samples=16))
    viewer.frame()
    assert viewer.stage.begun and viewer.stage.coarse and viewer.due
    half = shown(viewer)
    assert (half[0] != before[0]).any() and (half[-1] == before[-1]).all()
    viewer.stage.cost, easel.cost = 1.0, 10.0
    drag(viewer, MIDDLE, ASIDE)
    assert not viewer.stage.begun and not viewer.stage.coarse and easel.cost < 10.0
    assert (shown(viewer) == captured(hands.framed(viewer.scene, viewer._area()[1]))).all()


def test_an_idle_window_draws_nothing(viewer):
    viewer.awake = 0.0
    assert not any(viewer.frame() for _ in range(5))
    viewer.desktop.move(*MIDDLE)
    assert viewer.frame()


def test_a_drag_turns_the_view_and_is_one_step_to_undo(viewer):
    before, picture = viewer.scene, shown(viewer)
    drag(viewer, MIDDLE, ASIDE)
    turned, other = viewer.scene, shown(viewer)
    assert turned.camera.azimuth < before.camera.azimuth
    assert turned.camera.elevation > before.camera.elevation
    assert (other != picture).any()
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert viewer.scene == before and (shown(viewer) == picture).all()
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL | glfw.MOD_SHIFT)
    assert viewer.scene == turned and (shown(viewer) == other).all()


@pytest.mark.parametrize(("button", "held"), [(1, 0), (2, 0), (0, glfw.MOD_SHIFT)])
def test_the_view_is_moved_as_people_expect(viewer, button, held):
    drag(viewer, MIDDLE, ASIDE, button, held)
    camera = viewer.scene.camera
    assert camera.target[0] < 0.0 < camera.target[1]
    assert camera.azimuth == plain().camera.azimuth
    press(viewer, glfw.KEY_R)
    assert viewer.scene == plain()


def test_the_wheel_goes_nearer_and_alt_moves_the_light(viewer):
    viewer.desktop.move(*MIDDLE)
    settle(viewer)
    viewer.desktop.wheel(0, 3)
    settle(viewer)
    near = shown(viewer)
    drag(viewer, MIDDLE, (650, 150), 0, glfw.MOD_ALT)
    assert viewer.scene.camera.distance and viewer.scene.lights != plain().lights
    assert (shown(viewer) != near).any()
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert (shown(viewer) == near).all()


def test_a_widget_of_the_panel_changes_the_scene_and_the_picture(viewer):
    """Whatever is at a place of the panel, found by dragging there: sliders, as one step each."""
    picture, before = shown(viewer), viewer.scene
    for y in range(60, 380, 12):
        drag(viewer, (200, y), (245, y))
        if viewer.scene != before:
            break
    assert viewer.scene != before and (shown(viewer) != picture).any()
    assert viewer.scene.camera == before.camera  # the panel has the mouse, not the view
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert viewer.scene == before


def test_a_window_without_size_waits(viewer):
    glfw.iconify_window(viewer.desktop.window)
    assert viewer.desktop.size == (0, 0)
    viewer.desktop.move(*MIDDLE)
    viewer.desktop.wheel(0, 1)
    viewer.desktop.button(0, glfw.PRESS, 0)
    viewer.desktop.move(*ASIDE)
    assert not any(viewer.frame() for _ in range(4))
    viewer.desktop.button(0, glfw.RELEASE, 0)
    glfw.restore_window(viewer.desktop.window)
    settle(viewer)
    assert viewer.stage.canvas.size == viewer._area()[1]


def test_any_size_is_drawn(viewer):
    sizes = [
        (0, 0),
        (1, 1),
        (300, 2),
        (3, 300),
        (500, 333),
        (0, 7),
        *[(400 + i, 300) for i in range(9)],
    ]
    for size in (*sizes, SIZE):
        glfw.set_window_size(viewer.desktop.window, *size)
        viewer.frame()
    settle(viewer)
    assert (shown(viewer) == captured(hands.framed(plain(), viewer._area()[1]))).all()


def test_hiding_the_panel_leaves_the_window_to_the_picture(viewer):
    press(viewer, glfw.KEY_H)
    assert viewer.stage.canvas.size == SIZE
    assert (screen(viewer)[:300] == shown(viewer)[:300]).all()
    press(viewer, glfw.KEY_H)
    assert viewer.stage.canvas.size != SIZE


def test_full_screen_and_back(viewer):
    press(viewer, glfw.KEY_F11)
    assert glfw.get_window_monitor(viewer.desktop.window)
    press(viewer, glfw.KEY_F11)
    assert not glfw.get_window_monitor(viewer.desktop.window)
    assert viewer.desktop.size == SIZE


def test_the_keys_are_shown_and_escape_closes(viewer):
    before = screen(viewer)
    press(viewer, glfw.KEY_F1)
    assert (screen(viewer)[100:250, 450:] != before[100:250, 450:]).any()
    assert not viewer.desktop.closing
    press(viewer, glfw.KEY_ESCAPE)
    assert viewer.desktop.closing


def test_a_screenshot_carries_its_scene(viewer, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    drag(viewer, MIDDLE, ASIDE)
    for number in (1, 2):
        press(viewer, glfw.KEY_F12)
        with Image.open(tmp_path / f"lumiar-{number:03}.png") as saved:
            assert (np.asarray(saved) == shown(viewer)).all()
    scene = Scene.load("lumiar-001.png")
    assert scene.camera == viewer.scene.camera
    assert (captured(scene) == shown(viewer)).all()


def test_files_are_dropped(viewer, tmp_path):
    mesh, model = tmp_path / "one.off", tmp_path / "own.glsl"
    mesh.write_text(TRIANGLE)
    model.write_text(MODEL % "")
    capture(plain().set(shininess=7, size=(40, 30)), str(tmp_path / "made.png"))
    (tmp_path / "red.toml").write_text('[[object]]\nmodel = "lambert"\nalbedo = [1, 0, 0]\n')
    (tmp_path / "lamp.glsl").write_text(
        '// light   Lamp\n#include "lib/light.glsl"\nIncident light(vec3 place, vec2 u) '
        "{ return Incident(vec3(0.0, 0.0, 1.0), vec3(1.0)); }\n"
    )
    (tmp_path / "no.txt").write_text("nothing")
    seen = [shown(viewer)]

    def drop(name):
        viewer.desktop.events.append(("drop", [str(tmp_path / name)]))
        settle(viewer)
        seen.append(shown(viewer))
        return viewer.scene

    assert drop("one.off").objects[0].mesh == str(mesh)
    assert drop("own.glsl").objects[0].model.path == str(model)
    assert len(drop("lamp.glsl").lights) == 3
    assert drop("made.png").objects[0].values["shininess"] == 7.0
    assert drop("red.toml").objects[0].values["albedo"] == (1.0, 0.0, 0.0)
    assert all((a != b).any() for a, b in itertools.pairwise(seen))
    before = viewer.scene
    assert drop("no.txt") is before and "no.txt" in viewer.document.fault
    assert (seen[-1] == seen[-2]).all()


def test_what_is_chosen_in_the_bar_is_opened(viewer):
    for name, shipped in (("teapot", scenefile.shipped()), ("phong", lesson.shipped())):
        viewer.state.path, viewer.due = shipped[name], 1
        settle(viewer)
        assert viewer.document.name == name and not viewer.document.fault
        assert viewer.presents == (name == "phong") and viewer.state.home is viewer.document.home
    viewer.document.drop("/none/at/all.obj")
    assert "/none/at/all.obj" in viewer.document.fault


def test_a_saved_shader_is_read_again_and_a_broken_one_leaves_the_last_picture(tmp_path):
    path = tmp_path / "own.glsl"
    path.write_text(MODEL % "")
    scene = plain().changed("model", str(path)).set(k=0.9)
    with Viewer(scene, "en", hidden=True, size=SIZE) as viewer:
        settle(viewer)
        first = shown(viewer)
        save(viewer, path, MODEL % " * L.z")
        second = shown(viewer)
        assert (second != first).any() and not viewer.document.fault
        for broken, said in (
            (MODEL % " * nope", f"{path}:4: "),  # the driver tells
            ("// model   Own\nvec3 scatter(vec3 L", f"{path}:"),  # the contract tells
        ):
            save(viewer, path, broken)
            assert said in viewer.document.fault + viewer.stage.fault
            assert (shown(viewer) == second).all()
        glfw.set_window_size(viewer.desktop.window, 700, 390)
        settle(viewer)
        assert viewer.stage.canvas.size == viewer._area()[1]  # the last good scene, in the new size
        glfw.set_window_size(viewer.desktop.window, *SIZE)
        save(viewer, path, MODEL % "")
        assert not viewer.document.fault + viewer.stage.fault
        assert viewer.scene.objects[0].values["k"] == 0.9
        assert (shown(viewer) == first).all()


def test_many_saves_leave_nothing_behind(tmp_path):
    """Forty saves, one in four broken: no program of an earlier one is kept, and each is fast."""
    path, times = tmp_path / "own.glsl", []
    path.write_text(MODEL % "")
    with Viewer(plain().changed("model", str(path)), "en", hidden=True, size=SIZE) as viewer:
        settle(viewer)
        kept = len(viewer.stage.renderer._programs), len(viewer.stage.renderer._stock.arrays)
        for i in range(40):
            path.write_text(MODEL % (" * nope" if i % 4 == 3 else f" * {i + 1}.0"))
            began = time.perf_counter()
            viewer._reload([str(path)])
            while viewer.document.gate.waiting or viewer.due == 3:
                viewer.frame()
            times.append(time.perf_counter() - began)
            assert bool(viewer.document.fault) == (i % 4 == 3)
        assert (
            len(viewer.stage.renderer._programs),
            len(viewer.stage.renderer._stock.arrays),
        ) == kept
    assert sorted(times)[20] < 1.0  # 0.04 s where nothing else runs


def test_a_value_survives_a_save_in_which_its_line_was_missing(tmp_path):
    path = tmp_path / "own.glsl"
    path.write_text(MODEL % "")
    document = Document(plain().changed("model", str(path)).set(k=0.9))
    path.write_text(
        MODEL.replace("uniform float k = 0.5;  // [0, 1]: share", "const float k = 0.1;") % ""
    )
    assert document.reload() and "k" not in document.scene.objects[0].values
    document.push(document.scene.set(tint=(1.0, 0.0, 0.0)))
    path.write_text((MODEL % "").replace("vec3(0.2, 0.7, 0.4)", "vec3(0.5)"))
    document.reload()
    assert document.scene.objects[0].values == {"k": 0.9, "tint": (1.0, 0.0, 0.0)}
    document.undo()
    assert document.scene.objects[0].values == {"k": 0.9, "tint": (0.5, 0.5, 0.5)}


def test_a_saved_scene_file_is_read_again(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text("samples = 1\n[camera]\nazimuth = 10\n")
    with Viewer(Scene.load(str(path)), "en", "one", str(path), True, SIZE) as viewer:
        settle(viewer)
        before = shown(viewer)
        save(viewer, path, "samples = 1\n[camera]\nazimuth = 80\n")
        assert viewer.scene.camera.azimuth == 80.0 and (shown(viewer) != before).any()
        save(viewer, path, "samples = 2\n")
        assert f"{path}:1: samples = 2" in viewer.document.fault
        assert viewer.scene.camera.azimuth == 80.0


def test_a_saved_mesh_is_read_again(tmp_path):
    path = tmp_path / "one.off"
    path.write_text(TRIANGLE)
    with Viewer(plain().changed("mesh", str(path)), "en", hidden=True, size=SIZE) as viewer:
        settle(viewer)
        before = shown(viewer)
        save(viewer, path, TRIANGLE.replace("0 1 0", "0 0.2 0"))
        other = shown(viewer)
        assert (other != before).any()
        assert (other == captured(hands.framed(viewer.scene, viewer._area()[1]))).all()


def test_a_picture_of_surroundings_is_dropped(viewer, tmp_path):
    capture(plain()._replace(size=(32, 16), background=(0.2, 0.4, 0.6)), str(tmp_path / "sky.hdr"))
    viewer.desktop.events.append(("drop", [str(tmp_path / "sky.hdr")]))
    before = shown(viewer)
    settle(viewer)
    *others, around = viewer.scene.lights
    stay = [one for one in plain().lights if one.kind.name != "ambient"]  # it lies around, too
    assert others == stay
    assert around.image == str(tmp_path / "sky.hdr") and around.visible
    assert (shown(viewer)[:50, :50] != before[:50, :50]).any()  # where only the background was


def test_a_file_counts_only_once_it_has_settled(tmp_path):
    path, watch = tmp_path / "one.glsl", Watch()
    path.write_text("a")
    watch.follow([str(path)])
    assert watch.changed(0.0) == []
    path.write_text("ab")
    assert watch.changed(1.0) == [] and watch.restless
    path.write_text("abc")
    assert watch.changed(1.0 + SETTLED) == []
    path.unlink()  # as some editors do
    assert watch.changed(1.1 + SETTLED) == []
    path.write_text("abcd")
    assert watch.changed(2.0) == []
    assert watch.changed(2.0 + 1.01 * SETTLED) == [str(path)]
    assert watch.changed(3.0) == [] and not watch.restless


def test_a_sheet_is_shown_picture_by_picture(viewer):
    viewer.document.open(Scene.load("shading-rates"), "shading-rates")
    rates = []
    for _ in range(3):
        settle(viewer)
        rates.append(viewer.scene.shading)
        press(viewer, glfw.KEY_PAGE_DOWN)
    assert len(viewer.document.pages) >= 3 and set(rates) == {"flat", "gouraud", "phong"}
    press(viewer, glfw.KEY_PAGE_UP)
    assert viewer.document.page == len(rates) - 1 or len(viewer.document.pages) > 3


def test_a_closed_window_can_be_restored(tmp_path):
    path = tmp_path / "own.glsl"
    path.write_text(MODEL % "")
    scene = plain().changed("model", str(path))
    with Viewer(scene, "en", hidden=True, size=SIZE) as viewer:
        settle(viewer)
        drag(viewer, MIDDLE, ASIDE)
        left = viewer.scene
    path.write_text(MODEL % " * L.z")  # edited since
    again = opening.kept()
    assert again.camera == left.camera and again.objects[0].values == left.objects[0].values
    assert again.objects[0].model.text == MODEL % " * L.z"


def test_without_a_window_before_there_is_nothing_to_restore(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    with pytest.raises(Mistake, match="--restore"):
        opening.kept()


def test_without_a_display_one_line_names_what_draws_without(lumiar):
    none = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}
    assert "lumiar capture" in lumiar("view", "teapot", code=2, env=none).stderr
    lumiar("view", "teapot", "--restore", code=2, env=none)
    assert "no scene" in lumiar("view", "teapott", code=2, env=none).stderr


@pytest.mark.parametrize("name", scenefile.shipped())
def test_every_scene_that_comes_with_lumiar_can_be_opened(name):
    found = opening.pages(Scene.load(name))
    assert found and not any(scene.panels for _, scene in found)


def test_a_window_may_stay_open_for_longer_than_a_picture_may_take():
    job = "limit_time(0.2), limit_time(math.inf), time.sleep(0.8)"
    code = "import math, sys, time\nfrom lumiar.supervise import limit_time, supervised\n"
    code += f"sys.exit(supervised(lambda: ({job}) and 7))"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 7


def test_undo_brings_back_what_was_open_with_its_page_and_its_name(viewer, tmp_path):
    document, own, taught = viewer.document, tmp_path / "own.toml", lesson.shipped()["phong"]
    own.write_text(plain().toml())
    document.drop(scenefile.shipped()["models"])
    captions = []
    for _ in range(3):
        captions.append((document.name, document.caption, document.scene))
        document.turn(1)
    document.drop(str(own))
    assert (document.name, document.path) == ("own", str(own)) and not document.caption
    document.undo()
    assert document.name == "models" and document.page == 3
    for known in reversed(captions):
        document.undo()
        assert (document.name, document.caption, document.scene) == known
    for _ in range(4):
        document.redo()
    assert document.name == "own" and len(document.pages) == 1
    document.drop(taught)
    document.turn(1)
    stop, beside = document.stop, document.beside.comparison
    document.drop(str(own))
    assert not document.stop
    document.undo()
    assert document.stop == stop and document.beside.comparison == document.beside.home == beside
    settle(viewer)
