"""The probe in the real window: what `lumiar probe` prints is what stands there."""

import json

import pytest
from hand import Spy
from test_plots import click, point, tool
from test_window import drag, plain, press, save, settle

from lumiar import labels, panel, prober, readout, scenefile
from lumiar.desktop import glfw
from lumiar.window import Viewer

SIZE = (1300, 720)


@pytest.fixture
def viewer():
    with Viewer(plain(), "en", hidden=True, size=SIZE) as one:
        press(one, glfw.KEY_F6)
        yield one


def said(one, monkeypatch):
    """Draw once more, at rest, and return the Spy of the tool."""
    spy = Spy()
    one.moved, one.due = 0.0, 1
    one.frame()
    with monkeypatch.context() as patch:
        patch.setattr(panel, "draw", lambda scene, *_: scene)  # it writes with labels, too
        for module in (prober, labels):
            patch.setattr(module, "imgui", spy)
        one.due = 1
        one.frame()
    return spy


@pytest.mark.parametrize("lang", ["en", "pt"])
def test_the_table_is_the_one_that_the_command_prints(viewer, lumiar, tmp_path, monkeypatch, lang):
    viewer.state.lang = lang
    assert readout.captions.TEXT[lang]["probe"]["click"] in said(viewer, monkeypatch).said
    x, y = click(viewer, 0.55, 0.45)
    written = said(viewer, monkeypatch).said
    width, height = viewer.stage.shown.size
    scene = viewer.scene._replace(lang=lang)
    (tmp_path / "one.toml").write_text(scenefile.dump(scene, str(tmp_path)))
    where = ("--at", f"{x},{y}", "--size", f"{width}x{height}")
    printed = lumiar("probe", "one.toml", *where).stdout
    assert len(written) > 30 and all(text.strip() in printed for text in written)
    found = json.loads(lumiar("probe", "one.toml", *where, "--json").stdout)
    assert json.loads(readout.as_json(tool(viewer).found)) == found


def test_it_follows_what_changes_once_that_rests(viewer, monkeypatch):
    click(viewer, 0.55, 0.45)
    said(viewer, monkeypatch)
    first = tool(viewer).found
    viewer._push(viewer.scene.set(kd=(0.1, 0.1, 0.1)))
    viewer.frame()
    assert tool(viewer).found is first
    said(viewer, monkeypatch)
    second = tool(viewer).found
    assert second["luminance_cd_m2"] < first["luminance_cd_m2"]
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    said(viewer, monkeypatch)
    assert tool(viewer).found == first
    point(viewer, 0.3, 0.3)  # only a click counts
    assert tool(viewer).found["at_px"] == first["at_px"]


def test_a_click_beside_all_objects_reads_the_background(viewer, monkeypatch):
    click(viewer, 0.2, 0.05)
    assert "none: the background" in said(viewer, monkeypatch).said
    assert tool(viewer).found["object"] is None
    glfw.set_window_size(viewer.desktop.window, 800, 30)
    settle(viewer)
    said(viewer, monkeypatch)
    assert tool(viewer).found is None or tool(viewer).found["at_px"][1] < 30


def test_a_click_chooses_the_object(monkeypatch):
    one = plain().objects[0]
    objects = tuple(one._replace(position=(x, 0.0, 0.0)) for x in (-1.5, 1.5))
    with Viewer(plain()._replace(objects=objects), "en", hidden=True, size=(1400, 600)) as viewer:
        press(viewer, glfw.KEY_F6)
        for x, number in ((0.25, 0), (0.75, 1), (0.25, 0)):
            click(viewer, x, 0.5)
            said(viewer, monkeypatch)
            assert viewer.state.chosen == number
        press(viewer, glfw.KEY_F3)
        click(viewer, 0.75, 0.5)
        assert viewer.state.chosen == 1 and tool(viewer).drawn.pixel


def test_a_model_that_does_not_compile_leaves_the_last_reading(viewer, monkeypatch, tmp_path):
    path = tmp_path / "own.glsl"
    text = "// model   Own\nvec3 scatter(vec3 L, vec3 V) { return vec3(%s); }\n"
    path.write_text(text % "0.5")
    viewer._push(viewer.scene.changed("model", str(path)))
    click(viewer, 0.55, 0.45)
    said(viewer, monkeypatch)
    assert tool(viewer).found["lights"][0]["f_1_sr"] > 0.5
    save(viewer, path, text % "nope")
    said(viewer, monkeypatch)
    assert viewer.document.fault and tool(viewer).found["lights"][0]["f_1_sr"] > 0.5
    save(viewer, path, text % "0.25")
    said(viewer, monkeypatch)
    assert 0.2 < tool(viewer).found["lights"][0]["f_1_sr"] < 0.5


def test_the_text_is_copied(viewer, monkeypatch):
    copied = []
    monkeypatch.setattr(viewer.desktop, "_copied", copied.append)
    click(viewer, 0.55, 0.45)
    left, top, right, bottom = said(viewer, monkeypatch).places["copy as text"]
    at = ((left + right) / 2.0, (top + bottom) / 2.0)
    drag(viewer, at, at, steps=0)
    assert copied == [readout.text(tool(viewer).found, "", "en") + "\n"]
