"""The page of `lumiar bench`: whole in itself, in two languages, with every point and picture."""

import base64
import html
import html.parser
import io
import itertools
import re

import numpy as np
import pytest
from PIL import Image

from lumiar import benching, chart, ledger, page, plates, study
from lumiar.notation import number
from lumiar.study import Metric, Shown
from lumiar.timing import Timing

METRICS = {"off": Metric(0.01, 1e-6)}
WORDS = {
    "off": {"en": "largest error", "pt": "maior erro"},
    "easy": {"en": "an easy case", "pt": "um caso fácil"},
    "<b>": {"en": '<script>alert(1)</script> & "more"', "pt": "<i>'mais'</i>"},
    **{f"rays {n}": {"en": f"{n} rays", "pt": f"{n} raios"} for n in (4, 16, 64)},
}
COSTS = {"<b>": (1.0, 0.02), "exact": (2.0, 0.0), "dear": (9.0, 0.02)}
COSTS |= {f"rays {n}": (n / 2.0, 0.5 / n) for n in (4, 16, 64)}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return (report, text of its page) of a study with pictures and one without errors."""
    folder = str(tmp_path_factory.mktemp("page"))
    found, shown = [], []
    for name, (cost, error) in COSTS.items():
        timing = Timing(cost, 0.95 * cost, 1.05 * cost, 0.5, 9)
        found += study.points("easy", name, {"off": error}, timing, default=name == "exact")
    found += study.points("lone", "only", {"off": 0.125}, Timing(7.5, 7.0, 8.0, 0.5, 9))
    for i, name in enumerate(("<b>", "exact")):
        off = np.full((8, 8), 0.1**i) * np.linspace(0.0, 1.0, 8)
        shown.append(
            benching._pictures("one", Shown("easy", name, np.full((8, 8, 3), 0.5), off), folder)
        )
    counted = []
    for n in (1, 10, 100):
        timing = Timing(0.1 * n, 0.09 * n, 0.11 * n, 0.0, 9)
        counted += study.points(
            "lights", f"lamps {n}", {"time": None}, timing, "ms", False, {"n": n}
        )
    studies = [
        _study("one", found, METRICS, shown, [{"en": "Remarked.", "pt": "Observado."}]),
        _study("two", counted, {"time": Metric(0.0, 0.0)}, [], []),
    ]
    facts = dict.fromkeys((*benching.SAME, "python"), "so & so") | {
        "date": "2026-11-22T12:59:43+00:00"
    }
    report = {"schema": ledger.SCHEMA, "made": facts, "studies": studies}
    pictures = plates.drawn(studies, folder)
    return report, page.html(report, pictures), pictures


def _study(name, found, metrics, shown, remarks):
    found = study.marked(found, metrics)
    return {
        "name": name,
        "title": {"en": f"Study {name}", "pt": f"Estudo {name}"},
        "metrics": {key: metric._asdict() for key, metric in metrics.items()},
        "words": WORDS,
        "points": [study.as_row(p) for p in found],
        "advice": ledger.advised(found, metrics, WORDS),
        "remarks": remarks,
        "pictures": shown,
    }


class Parsed(html.parser.HTMLParser):
    """Elements of a page: those that are open, what points elsewhere, texts by language, rows."""

    VOID = ("meta", "input", "img", "br")

    def __init__(self, text):
        super().__init__()
        self.open, self.links, self.texts, self.rows, self.tags, self.ids = (
            [],
            [],
            {},
            [],
            [],
            set(),
        )
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.handle_startendtag(tag, attributes)
        if tag == "tr":
            self.rows.append("")
        if tag not in self.VOID:
            self.open.append((tag, dict(attributes).get("lang") if tag != "html" else None))

    def handle_startendtag(self, tag, attributes):
        self.tags.append(tag)
        for name, value in attributes:
            if name == "id":
                self.ids.add(value)
            if name in ("src", "href", "srcset", "data", "action", "poster"):
                self.links.append(value)

    def handle_endtag(self, tag):
        assert self.open.pop()[0] == tag

    def handle_data(self, text):
        lang = next((lang for _, lang in reversed(self.open) if lang), None)
        self.texts.setdefault(lang, []).append(text)
        if any(tag == "tr" for tag, _ in self.open):
            self.rows[-1] += text


@pytest.fixture(scope="module")
def parsed(made):
    return Parsed(made[1])


def test_every_element_is_closed_and_nothing_is_loaded_from_outside(made, parsed):
    assert parsed.open == []
    for link in parsed.links:
        assert link.startswith("data:image/webp;base64,") or link.removeprefix("#") in parsed.ids
    assert not re.search(r"https?:|//[a-z]|url\(|@import|<link|<iframe", made[1])


def test_texts_of_a_report_do_not_become_elements(parsed):
    assert parsed.tags.count("script") == 1 and "i" not in parsed.texts
    assert any("<script>alert(1)</script>" in text for text in parsed.texts["en"])
    assert any("<i>'mais'</i>" in text for text in parsed.texts["pt"])


def test_both_languages_say_as_much(parsed):
    english, portuguese = (" ".join(parsed.texts[lang]) for lang in ("en", "pt"))
    for a, b in (("Study one", "Estudo one"), ("Remarked.", "Observado."), ("error", "erro")):
        assert a in english and b in portuguese
    assert len(parsed.texts["pt"]) == pytest.approx(len(parsed.texts["en"]), abs=4)


def test_every_point_is_in_a_table(made, parsed):
    for one in made[0]["studies"]:
        for row in one["points"]:
            name = one["words"].get(row["variant"], {}).get("en", row["variant"])
            wanted = [name, f"{number(row['cost'])} {row['unit']}"]
            wanted += [] if row["error"] is None else [number(row["error"])]
            assert any(all(text in line for text in wanted) for line in parsed.rows), wanted


def test_advice_stands_above_the_plot(made):
    said = made[0]["studies"][0]["advice"][0]
    assert "exact" in said["en"][0].lower()
    assert all(
        made[1].index(html.escape(text)) < made[1].index('class="front"') for text in said["pt"][:1]
    )


def test_errors_of_a_case_are_on_one_scale(made):
    _, text, pictures = made
    maps = [plate for plate in pictures.values() if plate.ruler]
    assert len(pictures) == 4 and len({plate.ruler for plate in maps}) == 1
    assert all(plate.address in text for plate in pictures.values())
    bright = []
    for plate in maps:
        data = base64.b64decode(plate.address.split(",")[1])
        bright.append(np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), float).sum(2).max())
    assert bright[0] > 2.0 * bright[1]  # the errors are ten times as large


def test_a_picture_that_is_gone_is_left_out(made, tmp_path):
    report = made[0]
    assert plates.drawn(report["studies"], str(tmp_path)) == {}
    assert "<img" not in page.html(report, {})


def marks(values):
    names = {"en": "a variant's name", "pt": "nome de uma variante"}
    return [
        chart.Mark(x, y, (0.9 * x, 1.1 * x), i, names, "tip", i % 2 == 0) for i, (x, y) in values
    ]


def test_equal_ratios_are_equal_distances_and_zero_stands_at_the_start():
    axis = chart.fitted([0.0, 1.0, 10.0, 100.0], 300.0)
    steps = np.diff([axis.at(x) for x in (1.0, 10.0, 100.0)])
    assert steps[0] == pytest.approx(steps[1]) and steps[0] > 0.0
    assert 0.0 <= axis.at(0.0) == axis.at(-1.0) < axis.at(1.0) < axis.at(100.0) <= axis.at(np.inf)
    assert axis.ticks()[0] == (0.0, "0")


@pytest.mark.parametrize("low, high", [(1.0, 1.0), (0.9, 1.1), (2e-9, 3e5), (1e-7, 2e-7), (3, 80)])
def test_an_axis_has_from_three_to_eight_ticks(low, high):
    axis = chart.fitted([low, high], 300.0)
    assert axis.low <= low and high <= axis.high
    places = [axis.at(value) for value, _ in axis.ticks()]
    assert 2 <= len(places) <= 8 and places == sorted(places)
    assert all(b - a > 15.0 for a, b in itertools.pairwise(places))


def test_labels_overlap_neither_each_other_nor_marks():
    rng = np.random.default_rng(1)
    values = enumerate(np.exp(rng.normal(0.0, 1.5, (25, 2))).tolist())
    text = chart.svg(marks(values), ({"en": "x", "pt": "x"},) * 2)[0]
    places = re.findall(r'class="c\d[^"]*" transform="translate\(([\d.]+) ([\d.]+)', text)
    places = np.array(places, float)
    assert len(places) == 25
    for lang in chart.LANGUAGES:
        part = text.split(f'<g lang="{lang}">')[1].split("</g>")[0]
        found = re.findall(r'class="label[^"]*" x="([-\d.]+)" y="([\d.]+)">([^<]*)', part)
        boxes = [
            (float(x), float(y), 0.5 * chart.SIZE * len(html.unescape(t))) for x, y, t in found
        ]
        assert boxes
        for x, y, wide in boxes:
            assert x > 0.0 and x + wide < chart.WIDTH
            inside = (places[:, 0] > x) & (places[:, 0] < x + wide)
            assert not (inside & (abs(places[:, 1] - y + 4.0) < 6.0)).any()
        for (x, y, wide), (u, v, _) in itertools.permutations(boxes, 2):
            assert abs(y - v) >= chart.SIZE - 2.0 or u < x or u > x + wide


def test_the_front_goes_down_from_the_cheapest_to_the_most_exact():
    values = enumerate([(1.0, 0.1), (5.0, 0.05), (2.0, 0.01), (3.0, 0.5), (4.0, 0.001)])
    text = chart.svg(marks(values), ({"en": "x", "pt": "x"},) * 2)[0]
    way = re.search(r'class="front" d="([^"]*)"', text)[1]
    down = [float(y) for y in re.findall(r"V([\d.]+)", way)]
    right = [float(x) for x in re.findall(r"H([\d.]+)", way)]
    assert len(down) == 3 and down == sorted(down) and right == sorted(right)


def test_numbers_are_written_as_people_do():
    cases = {0.036: "0.036", 1.6e-5: "1.6·10⁻⁵", 1e-6: "10⁻⁶", 1800000.0: "1.8·10⁶", 0.0: "0"}
    assert {value: number(value, 2) for value in cases} == cases
    assert number(0.9996, 2) == "1" and number(-0.25, 2, "pt") == "-0,25"
    assert number(9.999e-5, 2) == "10⁻⁴" and number(1234.5, 5) == "1234.5"
    assert number(float("inf")) == "∞"
