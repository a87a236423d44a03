"""The time of a scene in the real window: it runs and stops, and only then is anything drawn."""

import pytest
from hand import PANEL, spied
from test_window import SIZE, plain, press, screen, settle, shown

from lumiar import opening
from lumiar.clock import Clock
from lumiar.desktop import glfw
from lumiar.window import Viewer

MODEL = """// model   Pulse
uniform float age = 0.0;  // time: since it began (s)
vec3 scatter(vec3 L, vec3 V) { return vec3(0.3 + 0.1 * sin(age)) * max(L.z, 0.0); }
"""


@pytest.fixture
def viewer(tmp_path):
    path = tmp_path / "pulse.glsl"
    path.write_text(MODEL)
    with Viewer(plain().changed("model", str(path)), "en", hidden=True, size=SIZE) as one:
        settle(one)
        yield one


def test_a_clock_runs_around_its_period_from_where_it_was():
    clock = Clock(60.0)
    clock.tick(5.0)
    assert (clock.runs, clock.time) == (False, 0.0)
    clock.start(100.0, 50.0)
    for now, time in ((100.0, 50.0), (104.5, 54.5), (111.0, 1.0), (231.0, 1.0)):
        clock.tick(now)
        assert clock.runs and clock.time == pytest.approx(time)
    clock.stop()
    clock.tick(300.0)
    assert not clock.runs and clock.time == pytest.approx(1.0)


def space(one):
    """Press the space bar, and turn a little."""
    one.desktop.key(glfw.KEY_SPACE, glfw.PRESS, 0)
    one.desktop.key(glfw.KEY_SPACE, glfw.RELEASE, 0)
    for _ in range(5):
        one.frame()


def test_the_space_bar_lets_the_time_run_and_stops_it(viewer):
    before, picture = viewer.scene, shown(viewer)
    space(viewer)
    viewer.awake = 0.0
    times = []
    for _ in range(4):
        assert viewer.frame()  # though nothing else happens
        times.append(viewer.stage.shown.time)
    assert times == sorted(set(times)) and times[0] > 0.0
    assert (shown(viewer) != picture).any()
    assert viewer.document.history.scene.scene is before  # nothing to undo yet
    space(viewer)
    assert viewer.scene.time >= times[-1] and not viewer.document.clock.runs
    settle(viewer)
    viewer.awake = 0.0
    assert not any(viewer.frame() for _ in range(4))
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert viewer.scene == before and (shown(viewer) == picture).all()


def test_while_it_runs_sliders_act_and_the_time_may_be_set(viewer):
    space(viewer)
    viewer._push(viewer.scene._replace(exposure=1.0))
    viewer.frame()
    assert viewer.scene.exposure == 1.0 and viewer.document.clock.runs
    viewer._push(viewer.scene._replace(time=30.0))
    viewer.frame()
    assert 30.0 <= viewer.scene.time < 59.0
    viewer.document.undo()
    viewer.document.undo()
    viewer.frame()
    assert viewer.scene.exposure == 0.0 and viewer.document.clock.runs


def test_where_nothing_changes_with_time_it_does_not_run(viewer):
    space(viewer)
    viewer._push(viewer.scene.set(model="phong"))
    viewer.frame()
    assert not viewer.document.clock.runs
    space(viewer)
    assert not viewer.document.clock.runs and not opening.uses_time(viewer.scene)


def test_another_scene_begins_with_its_own_time(viewer):
    space(viewer)
    viewer.document.open(viewer.scene._replace(time=7.0))
    assert viewer.scene.time == 7.0 and not viewer.document.clock.runs


def test_the_button_beside_the_parameter_plays_too(viewer, monkeypatch):
    spy = spied(viewer, monkeypatch, PANEL)
    (place,) = [at for path, at in spy.places.items() if path.endswith("age/▶##play")]
    assert "t = 0.00 s" in spy.said
    before = screen(viewer)
    viewer.desktop.move((place[0] + place[2]) / 2, (place[1] + place[3]) / 2)
    for action in (glfw.PRESS, glfw.RELEASE):
        viewer.desktop.button(0, action, 0)
        for _ in range(3):
            viewer.frame()
    assert viewer.document.clock.runs and (screen(viewer) != before).any()
