"""`lumiar bench`: a report that is whole after each study, goes on, and is compared."""

import csv
import json
import shutil

import numpy as np
import pytest

from lumiar import bench, benching, catalog, ledger, measure, studies, study


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """Return the folder of a report of one study, and what was told while it was made."""
    folder, told = tmp_path_factory.mktemp("bench"), []
    costs = bench.Bench.costs
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bench.Bench, "costs", lambda self, jobs, _: costs(self, jobs, 0.05))
        benching.run(("fresnel",), str(folder), True, lambda *one: told.append(one))
    return folder, told


def test_the_report_tells_what_it_was_made_on(quick):
    report = ledger.read(str(quick[0] / "report.json"))
    for key in (*benching.SAME, "date", "python"):
        assert key in report["made"]
    assert report["made"]["renderer"] and report["made"]["cpu"] and report["made"]["quick"] is True


def test_the_table_and_the_csv_hold_every_point(quick):
    report = ledger.read(str(quick[0] / "report.json"))
    rows = [*csv.DictReader((quick[0] / "points.csv").read_text().splitlines())]
    assert len(rows) == len(report["studies"][0]["points"])
    for lang in ("en", "pt"):
        text = ledger.table(report["studies"][0], lang)
        for row in report["studies"][0]["points"]:
            names = report["studies"][0]["words"]
            assert names[row["variant"]][lang] in text and names[row["case"]][lang] in text
    assert [kind for kind, _ in quick[1]] == ["made", "begun", "done"]


def test_errors_are_the_same_to_the_digit(quick):
    module = studies.load("fresnel")
    with bench.Bench(quick=True) as one:
        one.instrument.costs = lambda jobs, *_: [measure.timing.Timing(1, 1, 1, 1, 1)] * len(jobs)
        errors = [p.error for p in module.run(one)]
    report = ledger.read(str(quick[0] / "report.json"))
    assert errors == [p.error for p in ledger.points(report)]


def test_an_interrupted_bench_goes_on_with_what_is_missing(quick, tmp_path, monkeypatch):
    shutil.copy(quick[0] / "report.json", tmp_path)
    monkeypatch.setattr(studies, "NAMES", ("fresnel", "planted"))
    timing = measure.timing.Timing(1.0, 0.9, 1.1, 0.5, 9)

    class Planted:
        TITLE, SECONDS = {"en": "Planted", "pt": "Plantado"}, (1.0, 1.0)
        METRICS, WORDS = {"absolute": study.SHARE}, {}

        @staticmethod
        def run(_bench):
            yield from study.points("case", "bad", {"absolute": 0.5}, timing)
            yield study.Shown("case", "bad", np.full((2, 3, 3), 0.5), np.ones((2, 3)))
            yield study.Remark("Bad.", "Ruim.")

    monkeypatch.setattr(studies, "load", lambda name: {"planted": Planted}[name])
    told = []
    report = benching.run(
        ("fresnel", "planted"), str(tmp_path), True, lambda *one: told.append(one)
    )
    assert [one["name"] for one in report["studies"]] == ["fresnel", "planted"]
    assert [*dict(told)] == ["kept", "made", "begun", "done"]
    assert report == json.loads((tmp_path / "report.json").read_text())
    (row,) = report["studies"][1]["pictures"]
    assert (tmp_path / row["file"]).exists() and (tmp_path / row["error_file"]).exists()
    assert "Ruim." in ledger.table(report["studies"][1], "pt")
    text = (tmp_path / "report.html").read_text()
    assert "Ruim." in text and text.count("data:image/webp") == 2


def test_a_report_of_another_machine_is_not_gone_on_with(quick, tmp_path):
    report = ledger.read(str(quick[0] / "report.json"))
    report["made"]["cpu"] = "another"
    (tmp_path / "report.json").write_bytes(ledger.as_json(report))
    told = []
    made = {**report["made"], "cpu": "this one"}
    fresh = benching._resumed(str(tmp_path), ("fresnel",), made, lambda *one: told.append(one))
    assert fresh["studies"] == [] and told == [("new", "of another cpu")]


@pytest.mark.parametrize("name", studies.NAMES)
def test_every_study_says_what_it_shows_in_both_languages(name):
    module = studies.load(name)
    assert module.SECONDS[0] >= module.SECONDS[1] > 0.0
    for said in (module.TITLE, *module.WORDS.values()):
        assert said.keys() == {"en", "pt"} and all(said.values())
    assert set(module.METRICS) <= set(module.WORDS)


def test_a_planted_slow_and_wrong_model_is_beaten_on_the_card():
    """A true run: the same formula once, eight times over, and wrong."""
    head = "// model   Planted\nvec3 scatter(vec3 L, vec3 V) {\n"
    once = "float x = pow(L.z, 5.0);"
    bodies = {
        "good": once + "return vec3(x);",
        "slow": once + "for (int i = 0; i < 7; ++i) x = pow(L.z + x, 5.0); return vec3(x);",
    }
    jobs = {
        name: (catalog.parse("model", name, "planted.glsl", f"{head}{body}\n}}\n"), {})
        for name, body in bodies.items()
    }
    with bench.Bench(quick=True) as one:
        costs = one.costs(jobs, 0.2)
    found = [
        *study.points("case", "good", {"absolute": 0.0}, costs["good"]),
        *study.points("case", "slow", {"absolute": 0.5}, costs["slow"]),
    ]
    good, slow = study.marked(found, {"absolute": study.SHARE})
    assert good.pareto and not slow.pareto


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["fresnell"], "no study 'fresnell'; did you mean 'fresnel'?"),
        (["--compare", "none.json"], "none.json: no such file"),
        (["--compare", "other.json"], "other.json: no report of `lumiar bench`"),
        (["-o", "other.json"], "other.json: is a file; name a folder"),
    ],
)
def test_a_mistake_is_one_line(lumiar, tmp_path, arguments, told):
    (tmp_path / "other.json").write_text('{"schema": 1, "studies": 3}')
    assert told in lumiar("bench", *arguments, code=2).stderr
