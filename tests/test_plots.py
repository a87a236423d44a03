"""The plots in the real window: their numbers against the models in float64, their files, hands."""

import csv as csvs
import math
import time

import hand
import numpy as np
import pytest
from PIL import Image
from test_window import drag, plain, press, screen, settle

from lumiar import (
    catalog,
    charts,
    curves,
    facing,
    gonio,
    labels,
    panel,
    plotfiles,
    plotter,
    probe,
    readout,
    reference,
    reference_terms,
    tables,
)
from lumiar.desktop import glfw
from lumiar.difference import LUMINANCE
from lumiar.measure import Instrument
from lumiar.window import Viewer

SIZE = (900, 720)
CLOSE = 1e-5  # relative, of a model in float32


@pytest.fixture
def viewer():
    with Viewer(plain(), "en", hidden=True, size=SIZE) as one:
        press(one, glfw.KEY_F3)
        yield one


def tool(one):
    return one.drawer.tool


def spied(one, monkeypatch):
    """Draw once more and return the Spy of the tool."""
    return hand.spied(one, monkeypatch, (plotter, labels))


def press_on(one, monkeypatch, name):
    left, top, right, bottom = spied(one, monkeypatch).places[name]
    at = ((left + right) / 2.0, (top + bottom) / 2.0)
    drag(one, at, at, steps=0)


def point(one, x=0.6, y=0.4):
    """Move the mouse to a share of the picture; return the pixel of it."""
    left, (width, height) = one._area()
    pixel = int(x * width), int(y * height)
    one.desktop.move(left + pixel[0], pixel[1])
    settle(one)
    while one.state.wake < math.inf:  # looks are not taken faster than the machine bears
        time.sleep(max(0.0, one.state.wake - time.monotonic()))
        one.frame()
        settle(one)
    return pixel


def click(one, x=0.6, y=0.4):
    pixel = point(one, x, y)
    one.desktop.button(0, glfw.PRESS, 0)
    one.desktop.button(0, glfw.RELEASE, 0)
    settle(one)
    return pixel


def with_model(one, model, **values):
    one._push(one.scene.set(model=model, **values))
    settle(one)


def expected(one, L, V):
    """Return f (n, 3) of the model of the scene, float64."""
    what = one.scene.objects[0]
    L, V = np.broadcast_arrays(np.atleast_2d(L).astype(float), np.atleast_2d(V).astype(float))
    return getattr(reference, what.model.name)(L, V, **what.values) / np.abs(L[:, 2:])


@pytest.mark.parametrize("model", ["lambert", "phong", "cook_torrance"])
def test_a_curve_is_the_model_at_the_directions_that_are_marked(viewer, model, monkeypatch):
    with_model(viewer, model)
    pixel = click(viewer)
    drawn = tool(viewer).drawn
    L, V = drawn.pixel
    with Instrument(viewer.desktop.context) as instrument:
        found = probe.measured(viewer.stage.shown, pixel, viewer.stage.renderer, instrument)
    light = found["lights"][0]
    assert facing.theta(V) == found["theta_o_deg"] and facing.theta(L) == light["theta_i_deg"]
    assert facing.turn(L, V) == pytest.approx(light["azimuth_deg"], abs=1e-9)
    value = tool(viewer).value(drawn.models[0])
    assert value == pytest.approx(light["f_rgb_1_sr"]) == expected(viewer, L, V)[0]
    shown = f"f(L, V) = {readout.number(light['f_1_sr'])} sr⁻¹"
    assert shown in spied(viewer, monkeypatch).said  # as the probe says it
    (curve,) = drawn.shown
    angle, off = drawn.aim.angle(V)
    assert abs(angle) == facing.theta(V) and off == pytest.approx(0.0, abs=1e-4)
    detector = gonio.in_plane(np.zeros(1), drawn.aim.plane, curve.angles)[1]
    ways = gonio.directions(*detector.T)
    ways = ways / np.linalg.norm(ways, axis=1)[:, None]
    wanted = expected(viewer, drawn.aim.L, ways)
    assert np.allclose(curve.f, wanted, rtol=CLOSE, atol=1e-6 * wanted.max())
    at = [np.interp(angle, curve.angles, channel) for channel in curve.f.T]
    assert at == pytest.approx(list(value), rel=1e-2)  # between the angles that are measured


def test_a_lobe_in_3d_is_the_same_model(viewer):
    with_model(viewer, "cook_torrance")
    tool(viewer).kind = "lobe"
    settle(viewer)
    (lobe,), aim = tool(viewer).drawn.shown, tool(viewer).drawn.aim
    theta, phi = np.meshgrid(lobe.theta, lobe.phi + aim.phi, indexing="ij")
    wanted = expected(viewer, aim.L, gonio.directions(theta.ravel(), phi.ravel()))
    assert np.allclose(lobe.f.reshape(-1, 3), wanted, rtol=CLOSE, atol=1e-6 * wanted.max())


def test_a_lobe_that_is_black_is_drawn_as_none_and_comes_back(viewer):
    tool(viewer).kind = "lobe"
    bright = viewer.scene
    settle(viewer)
    lit = screen(viewer).tobytes()
    viewer._push(bright.set(model="lambert", albedo="0,0,0"))
    settle(viewer)
    assert screen(viewer).tobytes() != lit and tool(viewer).kind == "lobe"
    viewer._push(bright)
    settle(viewer)
    assert viewer.scene == bright


def test_a_slider_and_undo_change_the_curve_at_once(viewer):
    before = tool(viewer).drawn.shown[0].f
    with_model(viewer, "phong", shininess=5.0)
    changed = tool(viewer).drawn.shown[0].f
    assert (changed != before).any()
    press(viewer, glfw.KEY_Z, glfw.MOD_CONTROL)
    assert (tool(viewer).drawn.shown[0].f == before).all()


def test_the_plot_follows_the_mouse_and_a_click_holds_it(viewer, monkeypatch):
    assert tool(viewer).drawn.pixel is None
    first = point(viewer)
    seen = tool(viewer).drawn.pixel
    assert seen and tool(viewer).sight.pixel == first
    point(viewer, 0.5, 0.5)
    assert tool(viewer).drawn.pixel != seen
    held = click(viewer)
    seen = tool(viewer).drawn.pixel
    point(viewer, 0.5, 0.5)
    assert tool(viewer).drawn.pixel == seen and tool(viewer).sight.pixel == held == first
    picture = screen(viewer)
    click(viewer, 0.2, 0.05)
    assert tool(viewer).drawn.pixel is None
    assert "There is no surface at that pixel." in spied(viewer, monkeypatch).said
    left = viewer._area()[0]
    ring = slice(held[1] - 9, held[1] + 10), slice(left + held[0] - 9, left + held[0] + 10)
    assert (screen(viewer)[ring] != picture[ring]).any()
    point(viewer, 0.5, 0.5)
    assert tool(viewer).drawn.pixel


def test_an_angle_by_hand_is_the_lights(viewer, monkeypatch):
    point(viewer)
    left, top, right, bottom = spied(viewer, monkeypatch).places["##_theta"]
    y = (top + bottom) / 2.0
    drag(viewer, (left + 0.5 * (right - left), y), (left + 0.75 * (right - left), y))
    aim = tool(viewer).drawn.aim
    assert tool(viewer).drawn.pixel is None and 55.0 < aim.theta < 80.0
    mirror = tool(viewer).drawn.shown[0]
    peak = mirror.angles[np.argmax(mirror.f[:, 1])]
    assert peak == pytest.approx(aim.theta, abs=8.0)  # of Phong's lobe, before the cosine
    marked = {mark.letter: mark.angle for mark in charts.marks(aim, None)}
    assert marked == pytest.approx({"L": -aim.theta, "R": aim.theta})


@pytest.mark.parametrize("kind", plotter.KINDS)
def test_every_plot_is_drawn_read_at_the_mouse_and_written(viewer, monkeypatch, tmp_path, kind):
    monkeypatch.chdir(tmp_path)
    with_model(viewer, "rough_conductor")
    click(viewer)
    before = screen(viewer)
    tool(viewer).kind = kind
    tool(viewer).others.append((viewer.scene.objects[0].model, {"alpha": 0.6}, "rougher"))
    tool(viewer).others[0][1].update(
        {k: v for k, v in viewer.scene.objects[0].values.items() if k != "alpha"}
    )
    viewer.moved = 0.0
    settle(viewer)
    left = viewer.desktop.size[0] - round(viewer.drawer.width)
    assert (screen(viewer)[:, left:] != before[:, left:]).any() or kind == "polar"
    viewer.desktop.move(left + 0.6 * viewer.drawer.width, 150)
    settle(viewer)
    press_on(viewer, monkeypatch, "save CSV")
    if kind in ("polar", "fresnel"):  # which take a second each
        press_on(viewer, monkeypatch, "save PNG")
        while tool(viewer).painting:
            time.sleep(0.05)
            viewer.frame()
        with Image.open("lumiar-plot-001.png") as picture:
            assert len(np.unique(np.asarray(picture.convert("L")))) > 20
    drawn = tool(viewer).drawn
    assert [one.label for one in drawn.shown] == ["Rough conductor", "rougher"]
    if kind in plotfiles.LOBES:
        table = tables.read("lumiar-plot-001.csv")
        f = np.concatenate([one.f.reshape(-1, 3) for one in drawn.shown])
        assert np.allclose(table.brdf, f, rtol=1e-5, atol=1e-9)
        assert set(table.model) == {1, 2} and table.light[0, 0] == pytest.approx(drawn.aim.theta)
    else:
        rows = (tmp_path / "lumiar-plot-001.csv").read_text().splitlines()
        header = next(line for line in rows if line.startswith("# columns: "))
        assert "[degrees]" in header and "[unitless]" in header
        numbers = [[*map(float, row)] for row in csvs.reader(rows) if row[0][0] != "#"]
        wanted = np.concatenate([one.values for one in drawn.shown])
        assert np.allclose(np.array(numbers)[:, 1:4], wanted, rtol=1e-6)


def test_the_fresnel_curve_is_that_of_the_file(viewer, monkeypatch):
    tool(viewer).kind = "fresnel"
    settle(viewer)
    assert any("no Fresnel term" in line for line in spied(viewer, monkeypatch).said)
    assert tool(viewer).drawn.shown == ()
    cosine = np.maximum(np.cos(np.radians(curves.ANGLES)), 0.0)[:, None]
    for form, known in (
        ("exact", lambda values: reference_terms.F_dielectric(cosine, values["eta"])),
        ("schlick", lambda values: reference_terms.F_schlick(cosine, np.array(values["f0"]))),
        ("constant", lambda values: np.array(values["f0"]) + 0.0 * cosine),
    ):
        with_model(viewer, "cook_torrance", fresnel=form)
        (shown,) = tool(viewer).drawn.shown
        wanted = known(viewer.scene.objects[0].values) * np.ones(3)
        assert np.allclose(shown.values, wanted, rtol=CLOSE, atol=2e-6)
    for mirror in ("conductor", "dielectric", "rough_dielectric", "plastic"):
        with_model(viewer, mirror)
        (shown,) = tool(viewer).drawn.shown
        assert shown.values[-1] == pytest.approx(1.0, abs=1e-3)  # all is mirrored at grazing


def test_albedos_are_summed_while_nothing_moves(viewer):
    with_model(viewer, "lambert", albedo=(0.5, 0.25, 0.125))
    tool(viewer).kind, viewer.due = "albedo", 1  # as a click does
    viewer.frame()
    assert len(tool(viewer).drawn.shown[0].angles) < 3
    viewer.moved = 0.0
    settle(viewer)
    (shown,) = tool(viewer).drawn.shown
    assert len(shown.angles) == 20 and shown.values == pytest.approx(
        np.tile([0.5, 0.25, 0.125], (20, 1)), rel=1e-4
    )


def test_models_are_compared_and_taken_away_again(viewer, monkeypatch):
    with_model(viewer, "phong", kd=(0.3, 0.3, 0.3))
    press_on(viewer, monkeypatch, "##add")
    press_on(viewer, monkeypatch, "blinn")
    press_on(viewer, monkeypatch, "##add")
    press_on(viewer, monkeypatch, "this one, as it is now")
    names = ["Phong", "Blinn", "Phong, kept"]
    assert [one.label for one in tool(viewer).drawn.models] == names
    first, blinn, kept = tool(viewer).drawn.shown
    assert (first.f == kept.f).all() and blinn.f[0, 0] != first.f[0, 0]
    with_model(viewer, "phong", kd=(0.1, 0.1, 0.1))
    assert (tool(viewer).drawn.shown[2].f == kept.f).all()
    press_on(viewer, monkeypatch, "with the same values")
    assert tool(viewer).drawn.models[1].values["kd"] == (0.1, 0.1, 0.1)
    press_on(viewer, monkeypatch, "1/×")
    press_on(viewer, monkeypatch, "1/×")
    assert [one.label for one in tool(viewer).drawn.models] == ["Phong"]


def test_the_clipboard_takes_the_table(viewer, monkeypatch):
    copied = []
    monkeypatch.setattr(viewer.desktop, "_copied", copied.append)
    press_on(viewer, monkeypatch, "copy CSV")
    assert copied and copied[0].startswith(f"# {tables.MAGIC}\n") and "degrees" in copied[0]


def test_what_is_awkward_is_survived(viewer, tmp_path, monkeypatch):
    point(viewer)
    path = tmp_path / "own.glsl"
    text = "// model   Own\nvec3 scatter(vec3 L, vec3 V) { return vec3(%s); }\n"
    path.write_text(text % "0.5")
    viewer._push(viewer.scene.changed("model", str(path)))
    settle(viewer)
    good = tool(viewer).drawn.shown[0].f
    path.write_text(text % "nope")
    viewer._reload([str(path)])
    settle(viewer)
    assert viewer.document.fault and (tool(viewer).drawn.shown[0].f == good).all()
    tool(viewer).others.append((catalog.read("model", str(path)), None, "broken"))
    settle(viewer)
    assert any(f"{path}:2: " in line for line in spied(viewer, monkeypatch).said)
    assert len(tool(viewer).drawn.shown) == 1
    glfw.set_window_size(viewer.desktop.window, 0, 0)
    viewer.frame()
    glfw.set_window_size(viewer.desktop.window, 400, 60)
    settle(viewer)


def test_both_sides_both_languages_and_a_class(monkeypatch):
    with Viewer(plain().set(model="rough_dielectric"), "pt", hidden=True, size=SIZE) as viewer:
        press(viewer, glfw.KEY_F3)
        assert np.abs(tool(viewer).drawn.shown[0].angles).max() == 180.0
        said = spied(viewer, monkeypatch)
        assert "Aponte para a imagem, ou clique nela: aqui estão L e V desse ponto." in said.said
        press(viewer, glfw.KEY_P)
        for kind in plotter.KINDS:
            tool(viewer).kind = kind
            settle(viewer)
        press(viewer, glfw.KEY_P)
        viewer._push(viewer.scene._replace(lights=()))
        point(viewer, 0.5, 0.5)
        assert any("de toda a volta" in line for line in spied(viewer, monkeypatch).said)


def test_a_plane_through_the_normal_and_the_eye(viewer):
    """Hand-made directions: L to the east, V to the north-west, and one in the plane itself."""
    L, V = gonio.directions(30.0, 0.0), gonio.directions(40.0, 135.0)
    aim = curves.aimed(L, V)
    assert aim.theta == pytest.approx(30.0) and aim.angle(V)[0] == pytest.approx(40.0)
    angle, off = aim.angle(L)
    assert angle == pytest.approx(-30.0)
    sine = math.sin(math.radians(30.0)) * math.sin(math.radians(45.0))
    assert off == pytest.approx(math.degrees(math.asin(sine)))
    assert curves.aimed(L, (0.0, 0.0, 1.0)).plane == pytest.approx(0.0)
    flat = curves.aimed(L, gonio.directions(20.0, 180.0))
    assert flat.angle(L) == pytest.approx((-30.0, 0.0), abs=1e-9)
    assert flat.angle(gonio.directions(20.0, 180.0))[0] == pytest.approx(20.0)
    assert LUMINANCE.sum() == pytest.approx(1.0) and panel.State().chosen == 0
