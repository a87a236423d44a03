"""The lights in the picture of the real window: discs that are dragged, and what Alt moves."""

import math

import pytest
from test_presenter import look  # noqa: F401  a fixture
from test_window import captured, drag, plain, press, screen, settle, shown

from lumiar import hands, settings
from lumiar.desktop import glfw
from lumiar.window import Viewer

SIZE = (800, 860)
KINDS = ("directional", "point:position=1.2,1,1", "spot:position=-1.2,1,1")


@pytest.fixture
def viewer():
    scene = plain()._replace(lights=tuple(map(settings.light, KINDS)))
    scene = scene._replace(camera=scene.camera._replace(distance=9.0))
    with Viewer(scene, "en", hidden=True, size=SIZE) as one:
        settle(one)
        yield one


def places(one):
    return dict(one.handles._places)


def test_a_disc_is_dragged_and_its_light_follows_the_mouse(viewer):
    before, picture = viewer.scene, shown(viewer)
    assert {*places(viewer)} == {1, 2}
    x, y = start = places(viewer)[2]
    drag(viewer, (x + 3, y - 2), (x + 43, y + 28))
    assert math.dist(places(viewer)[2], (x + 40, y + 30)) < 0.01
    assert viewer.scene.camera == before.camera and viewer.scene.lights[:2] == before.lights[:2]
    assert viewer.state.lamp == 2 and viewer.pointer.picked is None
    assert (shown(viewer) != picture).any()
    assert (shown(viewer) == captured(hands.framed(viewer.scene, viewer._area()[1]))).all()
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert viewer.scene == before and math.dist(places(viewer)[2], start) < 1e-9


def test_the_alt_key_moves_the_light_that_was_touched_last(viewer, look):  # noqa: F811
    lights = viewer.scene.lights
    drag(viewer, (600, 420), (620, 400), 0, glfw.MOD_ALT)
    assert viewer.scene.lights[0] != lights[0] and viewer.scene.lights[1:] == lights[1:]
    spy = look(viewer)
    (name,) = [path for path in spy.places if path.endswith("spot###2")]
    left, top, _, below = spy.places[name]
    drag(viewer, (left + 30, (top + below) / 2), (left + 30, (top + below) / 2))
    assert viewer.state.lamp == 2
    before = viewer.scene
    drag(viewer, (600, 420), (620, 400), 0, glfw.MOD_ALT)
    assert viewer.scene.lights[:2] == before.lights[:2]
    assert viewer.scene.lights[2].values["position"] != before.lights[2].values["position"]
    assert any("spot   ◉" in path for path in look(viewer).places)


def test_a_light_that_cannot_be_turned_is_carried(viewer):
    viewer._push(viewer.scene._replace(lights=tuple(map(settings.light, ("ambient", "polygon")))))
    settle(viewer)
    before = viewer.scene.lights[1].values
    drag(viewer, (600, 420), (620, 400), 0, glfw.MOD_ALT)
    after = viewer.scene.lights[1].values
    shifts = {tuple(q - p for p, q in zip(before[c], after[c], strict=True)) for c in "abc"}
    assert all(s == pytest.approx(min(shifts), abs=1e-6) for s in shifts) and min(shifts) != (
        0,
        0,
        0,
    )


def test_discs_are_hidden_by_l_and_in_front_of_a_class(viewer):
    marked, start = screen(viewer), places(viewer)[1]
    press(viewer, glfw.KEY_L)
    assert not places(viewer) and (screen(viewer) != marked).any()
    lights = viewer.scene.lights
    drag(viewer, start, (start[0] + 30, start[1]))
    assert viewer.scene.lights == lights  # the view was turned instead
    press(viewer, glfw.KEY_R)
    press(viewer, glfw.KEY_L)
    assert places(viewer)
    press(viewer, glfw.KEY_P)
    assert not places(viewer)


def test_discs_outside_the_picture_are_not_there(viewer):
    lamp = settings.light("point:position=90,90,0")
    viewer._push(viewer.scene._replace(lights=(lamp,)))
    settle(viewer)
    assert not places(viewer)
    drag(viewer, (600, 420), (620, 400))
    assert viewer.scene.lights == (lamp,)
