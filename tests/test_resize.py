"""What stands in the window while its size changes: tools, what was picked, help, small columns."""

import itertools

import pytest
from hand import Spy
from test_window import SIZE, plain, press, settle

from lumiar import banner, datasheet, editor, phrases
from lumiar.desktop import glfw
from lumiar.window import Viewer


@pytest.fixture
def viewer():
    with Viewer(plain(), "pt", hidden=True, size=SIZE) as one:
        settle(one)
        yield one


def resize(one, *size):
    glfw.set_window_size(one.desktop.window, *size)
    settle(one)


class Placed:
    """ImGui, noting (text, left, top, right) of each text that is written."""

    def __init__(self, true):
        self.true, self.found = true, []

    def __getattr__(self, name):
        made = getattr(self.true, name)
        if name not in ("text", "text_colored"):
            return made

        def write(*given):
            made(*given)
            low, high = self.true.get_item_rect_min(), self.true.get_item_rect_max()
            self.found.append((given[-1], low.x, low.y, high.x))

        return write


def placed(one, module, monkeypatch):
    """Return (text, left, top, right) of what a module writes into the next picture."""
    spy = Placed(module.imgui)
    with monkeypatch.context() as patch:
        patch.setattr(module, "imgui", spy)
        one.due = 1
        one.frame()
    return spy.found


def test_a_tool_keeps_its_share_and_leaves_the_picture_some(viewer):
    resize(viewer, 2400, 600)
    press(viewer, glfw.KEY_F2)
    share = viewer.drawer.width / 2400
    for wide in (1200, 2000, 1400, 2400):
        resize(viewer, wide, 600)
        (_, (room, _)), panel = viewer._area(), viewer.state.width
        assert viewer.drawer.width == pytest.approx(share * wide, abs=2.0)
        assert room > 0.25 * (wide - panel)
    resize(viewer, 500, 600)  # too small for it
    resize(viewer, 2400, 600)
    assert viewer.drawer.width == pytest.approx(share * 2400, abs=2.0)


def test_a_picked_pixel_stays_on_its_thing_when_the_picture_gets_another_size(viewer):
    viewer._push(viewer.scene.changed("camera.distance", 5.0))
    resize(viewer, 1200, 400)
    left, (wide, high) = viewer._area()
    viewer.desktop.move(left + wide // 2 + 70, high // 2 - 30)
    settle(viewer)
    viewer.desktop.button(0, glfw.PRESS, 0)
    viewer.desktop.button(0, glfw.RELEASE, 0)
    settle(viewer)
    press(viewer, glfw.KEY_F6)

    def found():
        viewer.moved, viewer.due = 0.0, 1
        viewer.frame()
        return viewer.drawer.tool.found["position_m"], viewer.pointer.picked

    position, at = found()
    resize(viewer, 1000, 600)
    other, then = found()
    assert then != at and other == pytest.approx(position, abs=0.02)  # two pixels of the sphere
    resize(viewer, 1200, 400)
    assert found()[1] == pytest.approx(at)


def test_all_keys_are_told_of_within_a_small_window_and_in_large_letters(viewer, monkeypatch):
    press(viewer, glfw.KEY_P)
    press(viewer, glfw.KEY_F1)
    for size in ((1280, 720), (640, 480)):
        resize(viewer, *size)
        found = {text: place for text, *place in placed(viewer, banner, monkeypatch)}
        for line in phrases.TEXT["pt"]["keys"]:
            for text in line:
                left, top, right = found[text]
                assert 0.0 <= left < right <= size[0] and 0.0 <= top < 0.97 * size[1]


def test_the_columns_of_the_data_sheet_stand_apart_in_large_letters(viewer, monkeypatch):
    press(viewer, glfw.KEY_P)
    resize(viewer, 1280, 720)
    press(viewer, glfw.KEY_F4)
    tool = viewer.drawer.tool
    said = {"verdict": "does not hold", "agrees": True, "worst": 0.0}
    claims = {
        name: {**said, "claimed": "form = normalised"} for name in ("reciprocal", "conserving")
    }
    counts = dict.fromkeys(("evaluations", "nan", "infinite", "negative"), 0)
    sheet = {"claims": claims, "broken": [], "hostile": counts}
    monkeypatch.setattr(tool.auditor, "sheet", lambda _: sheet)
    found = placed(viewer, datasheet, monkeypatch)
    signs = [i for i, one in enumerate(found) if one[0] == "✗"]
    assert len(signs) == 2
    for i in (signs[0] - 4, *signs):  # and what stands above them
        row = found[i : i + 4]
        assert len({round(top, 1) for _, _, top, _ in row}) == 1
        assert all(one[3] < other[1] for one, other in itertools.pairwise(row))
        assert row[-1][3] <= viewer.desktop.size[0]


def test_no_button_of_the_editor_is_cut_off(viewer, monkeypatch, tmp_path):
    path, words = tmp_path / "own.glsl", phrases.TEXT["pt"]["editor"]
    path.write_text("vec3 scatter(vec3 L, vec3 V) { return vec3(max(L.z, 0.0)); }\n")
    viewer._push(viewer.scene.changed("model", str(path)))
    press(viewer, glfw.KEY_F7)
    for wide in (720, 640):
        resize(viewer, wide, 400)
        spy = Spy()
        with monkeypatch.context() as patch:
            patch.setattr(editor, "imgui", spy)
            viewer.due = 1
            viewer.frame()
        assert all(spy.places[words[name]][2] < wide for name in ("save", "copy", "new", "revert"))
