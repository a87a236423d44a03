"""The data sheet in the real window: what the audit finds, the float error, the cost."""

import time

import pytest
from hand import spied
from test_window import SIZE, plain, press, save, settle, shown

from lumiar import audit, auditor, catalog, datasheet, measure, settings
from lumiar.desktop import glfw
from lumiar.window import Viewer

OFF = """// model   Lambert
// claims  positive, reciprocal
uniform vec3 albedo = vec3(0.5);  // color: rho
vec3 scatter(vec3 L, vec3 V) {
    return 1.001 * albedo * 0.31830988618 * max(L.z, 0.0) * step(0.0, V.z);
}
"""


@pytest.fixture
def viewer():
    scene = plain().set(model="lambert")._replace(lights=(settings.light("directional"),))
    with Viewer(scene, "en", hidden=True, size=SIZE) as one:
        settle(one)
        yield one


def open_sheet(one):
    press(one, glfw.KEY_F4)
    one.moved = 0.0
    return one.drawer.tool


def wait(one, known, seconds=60):
    """Turn the window until something is known, as `run` does."""
    end = time.monotonic() + seconds
    while not known():
        assert time.monotonic() < end
        one.frame(0.0 if one.due else 0.02)


def said(one, monkeypatch):
    return spied(one, monkeypatch, (datasheet,)).said


def test_the_sheet_tells_what_an_audit_finds_and_keeps_it(viewer, monkeypatch):
    before, tool = shown(viewer).tobytes(), open_sheet(viewer)
    assert "measuring …" in said(viewer, monkeypatch)
    wait(viewer, lambda: tool.sheet and tool.cost.evaluation and not viewer.due)
    with measure.Instrument() as instrument:
        found = audit.audit(viewer.scene.objects[0].model, instrument)
    assert tool.sheet["claims"] == found["claims"] and tool.sheet["hostile"] == found["hostile"]
    texts = said(viewer, monkeypatch)
    assert texts.count("✓") == 4 and "Lambert" in texts
    viewer.state.lang = "pt"
    assert "conserva energia" in said(viewer, monkeypatch)
    assert tool.cost.picture > 0.0 and min(tool.cost.evaluation) >= 0.0
    again = auditor.Auditor(tool.driver)  # as in a window that is opened later
    assert again.sheet(viewer.scene.objects[0].model) == tool.sheet
    press(viewer, glfw.KEY_F4)
    assert viewer.drawer.width == 0.0 and shown(viewer).tobytes() == before


def test_an_idle_window_with_its_sheet_open_draws_nothing(viewer):
    tool = open_sheet(viewer)
    wait(viewer, lambda: tool.sheet and tool.cost.evaluation)
    for _ in range(40):
        viewer.frame()
    viewer.awake = 0.0
    assert not any(viewer.frame() for _ in range(5))


def test_the_error_is_that_at_the_values_shown(viewer, tmp_path):
    path = tmp_path / "off.glsl"
    path.write_text(OFF)
    viewer._push(viewer.scene.changed("model", str(path)))
    tool = open_sheet(viewer)
    wait(viewer, lambda: tool.errors)
    assert tool.errors["scatter"]["max"] == pytest.approx(1e-3, rel=1e-3)
    viewer._push(viewer.scene.set(albedo=0.0))
    wait(viewer, lambda: tool.errors == {"scatter": None})
    path = tmp_path / "own.glsl"
    path.write_text(OFF.replace("Lambert", "Own"))
    viewer._push(viewer.scene.changed("model", str(path)))
    wait(viewer, lambda: tool.errors == {})


def test_another_model_ends_the_audit_of_the_first(viewer):
    tool = open_sheet(viewer)
    auditor_of = tool.auditor
    viewer._push(viewer.scene.set(model="ward"))
    viewer.frame()
    first, folder = auditor_of._child, auditor_of._folder
    assert first.poll() is None
    viewer._push(viewer.scene.set(model="strand"))
    viewer.frame()
    assert first.poll() is not None and auditor_of._folder != folder
    second = auditor_of._child
    viewer.release()
    assert second.poll() is not None and auditor_of._folder is None


def test_a_model_is_audited_as_it_is_in_the_window(tmp_path):
    text = OFF.replace("1.001", "40.0").replace("reciprocal", "conserving")
    (tmp_path / "off.glsl").write_text(text)
    model = catalog.read("model", str(tmp_path / "off.glsl"))
    (tmp_path / "off.glsl").write_text(OFF)  # saved since, but not read again
    one = auditor.Auditor("")
    while one.sheet(model) is None:
        time.sleep(0.05)
    assert one.sheet(model)["claims"]["conserving"]["verdict"] == "broken"
    fault = one.sheet(model._replace(text="no GLSL", path=str(tmp_path / "none.glsl")))
    while fault is None:
        time.sleep(0.05)
        fault = one.sheet(model._replace(text="no GLSL", path=str(tmp_path / "none.glsl")))
    assert "none.glsl:1: " in fault["fault"]


def test_a_broken_save_and_no_size_leave_the_sheet_alive(viewer, tmp_path, monkeypatch):
    path = tmp_path / "off.glsl"
    path.write_text(OFF)
    viewer._push(viewer.scene.changed("model", str(path)))
    tool = open_sheet(viewer)
    save(viewer, path, OFF.replace("albedo *", "nope *"))
    assert viewer.document.fault and "Lambert" in said(viewer, monkeypatch)
    glfw.set_window_size(viewer.desktop.window, 0, 0)
    viewer.frame()
    glfw.set_window_size(viewer.desktop.window, *SIZE)
    save(viewer, path, OFF)
    wait(viewer, lambda: tool.errors is not None)
