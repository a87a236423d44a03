"""Films: their scenes, their files frame by frame, and the tool that makes them in the window."""

import io
import math
import os

import numpy as np
import pytest
from PIL import Image, ImageSequence
from test_window import plain, press, settle

from lumiar import Scene, capture, film, hands, settings
from lumiar.desktop import glfw
from lumiar.window import Viewer

SIZE = (24, 16)
VIEW = ((0.0, 1.0, 5.0), (1.0, 0.0, 0.0))


def small():
    return plain()._replace(size=SIZE)


def test_a_turntable_is_one_turn_in_even_steps_and_has_no_seam():
    for count in (1, 2, 7, 60):
        scenes = [*film.turntable(small(), VIEW, count)]
        turns = [math.radians(one.camera.azimuth) for one in scenes]
        steps = np.exp(1j * np.diff([*turns, turns[0]]))
        assert len(scenes) == count and scenes[0] == small()
        assert np.abs(steps - np.exp(2j * math.pi / count)).max() < 1e-9
        assert all(one.camera._replace(azimuth=20.0) == small().camera for one in scenes)


def test_an_eye_with_a_place_of_its_own_goes_around_its_target():
    up = (0.2, 1.0, 0.1)
    camera = small().camera._replace(position=VIEW[0], target=VIEW[1], up=up)
    scenes = [*film.turntable(small()._replace(camera=camera), VIEW, 8)]
    arms = np.array([one.camera.position for one in scenes]) - VIEW[1]
    assert np.allclose(np.linalg.norm(arms, axis=1), math.dist(*VIEW))
    assert np.allclose(arms @ up, arms[0] @ up)  # as high as before
    steps = np.linalg.norm(np.diff(arms, axis=0, append=arms[:1]), axis=1)
    assert np.allclose(steps, steps[0]) and np.allclose(arms.mean(0) @ [1, 0, -2], 0, atol=1e-9)


def test_a_sweep_moves_as_its_slider_does():
    scene, key = small(), "object.1.shininess"
    assert settings.found(scene, key)[0].log
    there = [one.objects[0].values["shininess"] for one in film.sweep(scene, key, 1.0, 100.0, 5)]
    assert there == pytest.approx([1.0, 10**0.5, 10.0, 10**1.5, 100.0])
    back = [one.exposure for one in film.sweep(scene, "exposure", -1.0, 2.0, 6, back=True)]
    assert back == pytest.approx([-1.0, 0.0, 1.0, 2.0, 1.0, 0.0])
    whole = film.sweep(scene.set(model="black_body"), "wavelengths", 13, 16, 4)
    assert [one.objects[0].values["wavelengths"] for one in whole] == [13, 14, 15, 16]


def pictures(count):
    """Return so many pictures, of noise on top and a gradient below."""
    chance = np.random.default_rng(4)
    found = chance.integers(0, 256, (count, SIZE[1], SIZE[0], 3), np.uint8)
    found[:, 8:] = np.linspace(0, 200, SIZE[0])[:, None]
    return found


@pytest.mark.parametrize("ending, near", [(".webp", 0), (".png", 0), (".gif", 40)])
def test_a_film_holds_its_frames_for_their_time_and_runs_for_ever(ending, near, tmp_path):
    frames, path = pictures(5), tmp_path / f"one{ending}"
    path.write_bytes(b"".join(film.encoded(ending, SIZE, (f.tobytes() for f in frames), 20.0)))
    with Image.open(path) as found:
        assert (found.n_frames, found.info["loop"]) == (5, 0)
        for one, frame in zip(ImageSequence.Iterator(found), frames, strict=True):
            one.load()
            off = np.abs(np.asarray(one.convert("RGB"), int) - frame)
            assert off.mean() <= near / 4 and off.max() <= 4 * near
            assert one.info["duration"] == 50


def test_a_lossy_film_is_smaller_and_near():
    frame = np.linspace(60, 190, 3 * 96 * 64).reshape(64, 96, 3)
    frame = (frame + np.random.default_rng(1).normal(0, 3, frame.shape)).astype(np.uint8)
    files = [
        next(film.encoded(".webp", (96, 64), iter([frame.tobytes()]), 25.0, lossless))
        for lossless in (True, False)
    ]
    assert len(files[1]) < len(files[0]) / 2
    with Image.open(io.BytesIO(files[1])) as found:
        assert np.abs(np.asarray(found.convert("RGB"), int) - frame).mean() < 5


@pytest.fixture
def tool(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = small().set(mesh="box")
    with Viewer(scene, "en", hidden=True, size=(640, 400)) as viewer:
        settle(viewer)
        press(viewer, glfw.KEY_F8)
        tool = viewer.drawer.tool
        tool.viewer, tool.plan.size, tool.plan.count = viewer, SIZE, 6
        yield tool


def filmed(tool, frames=10_000):
    tool.begin(tool.viewer._now(0.0))
    tool.viewer.due = 1
    for _ in range(frames):
        if tool.film:
            tool.viewer.frame(0.005)
    assert frames < 10_000 or not tool.film
    tool.viewer.due = 1
    tool.viewer.frame()


@pytest.mark.parametrize("ending", [".webp", ".png"])
def test_the_frames_are_captures_of_their_scenes(tool, ending, tmp_path):
    tool.plan.ending, scene = ending, tool.viewer.scene
    filmed(tool)
    assert tool.saved == f"saved lumiar-001{ending}" and not tool.fault
    framed = hands.framed(scene, SIZE)
    scenes = film.turntable(framed, tool.viewer.stage.looks(framed, SIZE)[1], 6)
    with Image.open(f"lumiar-001{ending}") as found:
        for one, wanted in zip(ImageSequence.Iterator(found), scenes, strict=True):
            assert one.convert("RGB").tobytes() == capture(wanted).pixels
    assert tool.viewer.scene is scene
    if ending == ".png":
        assert Scene.load("lumiar-001.png") == framed
    filmed(tool)
    assert sorted(os.listdir(tmp_path)) == [f"lumiar-001{ending}", f"lumiar-002{ending}"]


def test_a_slider_is_swept(tool):
    tool.plan.kind, tool.plan.ending, tool.plan.back = "sweep", ".png", False
    tool.viewer.due = 1
    tool.viewer.frame()
    assert tool.plan.key == "object.1.shininess" and (tool.plan.start, tool.plan.end) == (1, 1000)
    filmed(tool)
    with Image.open("lumiar-001.png") as found:
        found.seek(5)
        last = hands.framed(tool.viewer.scene, SIZE).set(shininess=1000.0)
        assert found.convert("RGB").tobytes() == capture(last).pixels


def test_a_film_that_is_given_up_or_fails_leaves_nothing(tool, tmp_path, monkeypatch):
    filmed(tool, frames=3)
    assert tool.film and 0 < tool.film.given < 6
    tool.release()
    assert os.listdir(tmp_path) == []
    tool.plan.kind, tool.plan.key, tool.plan.start, tool.plan.end = "sweep", "exposure", 0, 999
    filmed(tool)
    assert "exposure = " in tool.fault and "allowed: -20 to 20" in tool.fault
    monkeypatch.setattr(
        "lumiar.files.os.replace", lambda *_: (_ for _ in ()).throw(OSError("full"))
    )
    tool.plan.kind = "turntable"
    filmed(tool)
    assert "full" in tool.fault and not tool.saved and os.listdir(tmp_path) == []
    filmed(tool, frames=2)
    tool.viewer.release()
    assert os.listdir(tmp_path) == []


def test_the_window_lives_on_while_it_films(tool):
    before = tool.viewer.scene
    filmed(tool, frames=2)
    tool.viewer._push(before._replace(exposure=1.0))
    tool.viewer.state.lang = "pt"
    glfw.set_window_size(tool.viewer.desktop.window, 0, 0)
    tool.viewer.frame()
    glfw.set_window_size(tool.viewer.desktop.window, 500, 300)
    while tool.film:
        tool.viewer.frame(0.005)
    assert tool.saved == "lumiar-001.webp salvo" and tool.viewer.scene.exposure == 1.0
    with Image.open("lumiar-001.webp") as found:
        wanted = capture(hands.framed(before, SIZE)).pixels
        assert found.convert("RGB").tobytes() == wanted
    tool.viewer.awake = tool.viewer.moved = 0.0
    settle(tool.viewer)
    assert not any(tool.viewer.frame() for _ in range(4))


def test_a_film_that_no_encoder_makes_is_not_told_as_saved(tool, monkeypatch, tmp_path):
    def encoded(*_):
        raise KeyError("WEBP")  # as Pillow without it
        yield

    monkeypatch.setattr(film, "encoded", encoded)
    filmed(tool)
    assert "WEBP" in tool.fault and not tool.saved and os.listdir(tmp_path) == []
