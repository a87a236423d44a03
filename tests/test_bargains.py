"""A study in the real window: its points, what of them the scene stands on, reports of any kind."""

import os

import pytest
from hand import Spy
from test_window import plain, press, settle

from lumiar import Scene, bargains, ledger, study
from lumiar.desktop import glfw
from lumiar.study import Metric
from lumiar.timing import Timing
from lumiar.uses import used
from lumiar.window import Viewer

METRICS = {"rmse": Metric(0.002, 1e-6)}
RATES = ("flat", "gouraud", "phong")


def points():
    """Return the points of a shading-rate study, an error of zero and a cost of nothing among."""
    found = []
    for m in (5.0, 500.0):
        for i, rate in enumerate(RATES):
            for n in (80, 5120, 20480):
                cost = 0.0 if (rate, n) == ("flat", 80) else n * (1 + i) / 1000.0
                timing = Timing(cost, cost - 0.1, cost + 0.1, 0.0, 9)
                facts = {"exponent": m, "triangles": float(n)}
                error = 0.0 if (rate, n) == ("phong", 20480) else (3.0 - i) / n
                case, variant = f"m = {m:g}", f"{rate} {n}"
                found += study.points(case, variant, {"rmse": error}, timing, "ms", False, facts)
    return [p._replace(study="shading-rate") for p in study.marked(found, METRICS)]


def write(folder, found):
    os.makedirs(folder / "bench", exist_ok=True)
    one = {
        "name": "shading-rate",
        "title": {"en": "Shading rate", "pt": "Taxa"},
        "metrics": {key: metric._asdict() for key, metric in METRICS.items()},
        "words": {"phong 20480": {"en": "Phong, fine", "pt": "Phong, fina"}},
        "points": [study.as_row(p) for p in found],
        "advice": ledger.advised(found, METRICS, {}),
        "remarks": [{"en": "Remarked.", "pt": "Observado."}],
        "pictures": [],
    }
    made = {"renderer": "a card", "date": "2026-11-22"}
    report = {"schema": ledger.SCHEMA, "made": made, "studies": [one]}
    (folder / "bench" / "report.json").write_bytes(ledger.as_json(report))


@pytest.fixture
def viewer(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, points())
    with Viewer(plain(), "en", hidden=True, size=(900, 700)) as one:
        press(one, glfw.KEY_F9)
        yield one


def said(one, monkeypatch):
    """Draw, then once more as at rest, and return what the tool wrote then."""
    one.due, spy = 2, Spy()
    settle(one)
    with monkeypatch.context() as patch:
        patch.setattr(bargains, "imgui", spy)
        settle(one)
    return spy.said


def test_the_study_that_the_scene_is_of_is_shown_with_the_scene_marked(viewer, monkeypatch):
    tool = viewer.drawer.tool
    assert tool.chosen == ("shading-rate", "m = 5", "rmse") and len(tool.points) == 9
    words = said(viewer, monkeypatch)
    assert "this scene: Phong, fine" in words and "Remarked." in words
    assert any(text.startswith("Phong, fine") for text in words)  # advised: it has no error
    assert sum(text.endswith(" ms") for text in words) == 9


def test_what_is_marked_follows_the_scene_and_the_language(viewer, monkeypatch):
    viewer.document.push(plain().set(shading="gouraud", mesh="sphere:subdivision=4"))
    viewer.state.lang = "pt"
    words = said(viewer, monkeypatch)
    assert "esta cena: gouraud 5120" in words and "Observado." in words


def test_reports_that_are_none_or_gone_are_said_and_a_new_one_is_read(
    viewer, monkeypatch, tmp_path
):
    path = tmp_path / "bench" / "report.json"
    path.write_text("{}")
    assert "no report of `lumiar bench`" in said(viewer, monkeypatch)[0]
    path.write_text('{"schema": 1, "made": {}, "studies": [{"name": "lobes", "points": []}]}')
    assert "parts of it are missing" in said(viewer, monkeypatch)[0]
    write(tmp_path, points()[:9])
    assert len(said(viewer, monkeypatch)) > 9
    path.unlink()
    monkeypatch.setattr(bargains, "SHIPPED", ("nowhere",))
    assert said(viewer, monkeypatch) == ["no report here: run `lumiar bench`"]


def test_any_scene_may_come_while_it_is_open(viewer, monkeypatch):
    for scene in (Scene.load("lights"), Scene.load("teapot")):
        viewer.document.push(scene._replace(samples=1))
        assert any(text.endswith(" ms") for text in said(viewer, monkeypatch))


def find(scene, name, cases, variants):
    timing = Timing(1.0, 1.0, 1.0, 0.0, 1)
    found = [
        study.points(case, variant, {"e": 0.1}, timing, parameters=facts)[0]
        for case, facts in cases.items()
        for variant in variants
    ]
    (thing,) = scene.objects
    mine = used(name, found, thing, 20480, scene.shading, scene.lights)
    return {(p.case, p.variant) for p in mine}


def test_a_study_marks_what_the_model_of_the_scene_is():
    sigmas = {f"sigma {s}": {"sigma": s} for s in (10.0, 30.0)}
    forms = ("lambert", "qualitative", "full", "eon")
    rough = Scene.default().set(model="oren_nayar", form="full", sigma=12.0)
    assert find(rough, "diffuse", sigmas, forms) == {("sigma 10.0", "full")}
    assert find(Scene.default(), "diffuse", sigmas, forms) == set()
    cases, ways = {"phong": None, "oren_nayar": None}, ("lumiar", "printed")
    assert find(rough, "precision", cases, ways) == {("oren_nayar", "lumiar")}
    torrance = Scene.default().set(model="cook_torrance", fresnel="schlick")
    cases, forms = {"glass": None, "metals": None}, ("exact", "schlick")
    assert find(torrance, "fresnel", cases, forms) == {("glass", "schlick")}
    metal = Scene.default().set(model="rough_conductor")
    assert find(metal, "fresnel", cases, forms) == {("metals", "exact")}
    assert find(metal, "unheard of", cases, forms) == set()
