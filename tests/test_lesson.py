"""Lessons: they parse, draw, read well in both languages, and say what is true."""

import json
import math
import re
from dataclasses import dataclass

import numpy as np
import pytest
from PIL import Image

from lumiar import deck, lesson, picture, plots, slide
from lumiar.errors import Mistake
from lumiar.scene import Scene

SHIPPED = {name: lesson.load(name) for name in lesson.shipped()}
STEPS = [
    pytest.param(one, step, id=f"{one.name}-{i}")
    for one in SHIPPED.values()
    for i, step in enumerate(one.steps, 1)
]
SLIDES = [
    pytest.param(one, page, lang, id=f"{page.name}-{lang}")
    for one in SHIPPED.values()
    for page in deck.slides(one)
    for lang in lesson.LANGUAGES
]
MOVED = {
    "ka": "1,0,0",
    "kd": "1,0,0",
    "ks": "0,1,0",
    "shininess": "3",
    "direction": "-1,0.2,0.5",
    "form": "normalised",
    "shading": "gouraud",
    "model": "lambert",
    "mesh": "sphere:subdivision=1",
    "camera.azimuth": "-50",
    "camera.elevation": "60",
}
HEAD = 'title = "One"\n[[step]]\ntitle = "First"\ncaption = "Look."\n'
PLAIN = 'plain = "x"\n'


def drawn(scene, renderer):
    found = picture.capture(scene._replace(size=(64, 36), samples=1), renderer=renderer)
    assert found.broken == 0
    return found.pixels


@pytest.mark.parametrize("one, step", STEPS)
def test_every_text_stands_in_every_language(one, step):
    words = [one.title, *(getattr(step, key) for key in lesson._LENGTHS)]
    if len(step.shots) > 1:
        words += [shot.caption for shot in step.shots]
    for text in words:
        assert not text or set(text) == set(lesson.LANGUAGES)
    for text in (one.title, step.title, step.caption, step.source):
        assert text and text["en"] != "" != text["pt"]
    for text in (step.caption, step.ask, step.reveal):
        assert not text or text["en"] != text["pt"]


@pytest.mark.parametrize("one, step", STEPS)
def test_every_step_draws_and_what_it_compares_differs(one, step, renderer):
    pictures = [drawn(shot.scene, renderer) for shot in step.shots]
    assert len(set(pictures)) == len(pictures)


@pytest.mark.parametrize("one, step", STEPS)
def test_every_slider_changes_a_picture_of_its_step(one, step, renderer):
    for key in step.sliders:
        changed = [shot.scene.changed(key, MOVED[key]) for shot in step.shots]
        pairs = zip(step.shots, changed, strict=True)
        assert any(drawn(a.scene, renderer) != drawn(b, renderer) for a, b in pairs), key


@pytest.mark.parametrize("one, step", STEPS)
def test_a_question_leaves_its_answer_open(one, step):
    assert bool(step.ask) == bool(step.reveal)
    hidden = len(step.shots) - len(step.shown)
    assert hidden == int(bool(step.ask) and len(step.shots) > 1)


@pytest.mark.parametrize("one, step", STEPS)
def test_formulas_are_latex_and_text(one, step):
    assert set(step.formula) == set(step.plain)
    for latex in step.formula.values():
        width, height, coverage = plots.formula(latex, 50)
        assert len(coverage) == width * height and max(coverage) > 200


@pytest.mark.parametrize("one, page, lang", SLIDES)
def test_slides_read_from_the_back_and_fit_their_boxes(one, page, lang):
    """Letters of 34 in 1080 are what a slide of 32 points has; nothing enters a margin."""
    nothing = [b""] * len(page.step.shots)
    for size in ((1920, 1080), (1280, 720), (1024, 768), (640, 360)):
        pixels, letters = deck.page(one, page, lang, size, nothing)
        assert letters >= 34, size
        seen = np.frombuffer(pixels, np.uint8).reshape(size[1], size[0], 3)
        u = min(size[0] / 1920, size[1] / 1080)
        edge, foot = int(56 * u), int((slide.FOOT + 2) * u)
        end = size[1] - int((slide.FOOT + 18) * u)
        for strip in (seen[:, :edge], seen[:, -edge:], seen[end:-foot], seen[: int(20 * u)]):
            assert (strip == slide.PAPER).all(), size


def test_the_shipped_lesson_says_true_numbers():
    """Half widths of cos^α β; the albedo of Phong's lobe over π for light at 89°, by quadrature."""
    phong = SHIPPED["phong"]
    texts = [t.replace(",", ".") for s in phong.steps for t in s.reveal.values()]

    def said(number):
        return sum(bool(re.search(rf"(?<![\d.]){re.escape(number)}", t)) for t in texts) == 2

    for power, digits in ((10, 0), (100, 1)):
        assert said(f"{math.degrees(math.acos(0.5 ** (1 / power))):.{digits}f}°")
    theta, phi = np.meshgrid(
        (np.arange(2000) + 0.5) * math.pi / 4000, (np.arange(2000) + 0.5) * math.pi / 1000
    )
    light = math.radians(89)
    R = -math.sin(light), math.cos(light)
    RV = np.clip(R[0] * np.sin(theta) * np.cos(phi) + R[1] * np.cos(theta), 0, None)
    cell = (math.pi / 4000) * (math.pi / 1000) * np.sin(theta)
    albedo = (RV**10 * np.cos(theta) * cell).sum() / (math.pi * math.cos(light))
    assert said(f"{100 * albedo:.0f} %")
    off = [1 - math.cos(b) ** 10 / math.cos(b / 2) ** 40 for b in map(math.radians, (10, 40))]
    assert off[0] < 1e-3 and round(off[1], 1) == 0.2


def test_slides_in_order_carry_their_scenes(lumiar, tmp_path):
    (tmp_path / "tiny.toml").write_text(
        HEAD + "formula = 'a^2'\nplain = \"a²\"\n"
        '[[step]]\ntitle = "Second"\ncaption = "And now?"\nask = "Why?"\nreveal = "So."\n'
        'compare = [{ caption = "a" }, { caption = "b", set = { kd = [1, 0, 0] } }]\n'
    )
    done = lumiar("lesson", "tiny.toml", "-o", "out", "--size", "640x360", "--lang", "pt")
    names = ["tiny-01.png", "tiny-02-ask.png", "tiny-02-reveal.png"]
    assert done.stdout.split() == [f"out/{name}" for name in names]
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == names
    assert len({(tmp_path / "out" / name).read_bytes() for name in names}) == 3
    first, asked, told = (Scene.load(name, str(tmp_path / "out")) for name in names)
    assert not first.panels and not asked.panels and len(told.panels) == 2
    x, y, *_ = slide.places((640, 360), 2)[1]
    for name, hidden in zip(names[1:], (True, False), strict=True):
        with Image.open(tmp_path / "out" / name) as shown:
            corner = shown.getpixel((x + 2, y + 2))
        assert (corner == slide.TINTS[slide.ASK]) == hidden
    lumiar("capture", "out/tiny-02-reveal.png", "-o", "again.png")


@dataclass
class Case:
    text: str
    line: int
    says: str


CASES = [
    Case("title = 3\n[[step]]\n", 1, "title = 3; write title"),
    Case('title = "One"\n', 1, "a lesson needs [[step]]"),
    Case('title = "One"\nstep = 3\n', 2, "write [[step]]"),
    Case('title = "One"\n[[step]]\ntitle = "a"\n', 2, "a step needs caption"),
    Case(HEAD + 'captoin = "x"\n', 5, "did you mean 'caption'?"),
    Case(HEAD + 'formula = "x"\n', 5, "formula without plain"),
    Case(HEAD + 'reveal = "x"\n', 5, "reveal without ask"),
    Case(HEAD + 'scene = "phong-trems"\n', 5, "phong-terms"),
    Case(HEAD + 'scene = "../other.toml"\n', 5, "outside the folder"),
    Case(HEAD + "scene = 4\n", 5, "scene = 4"),
    Case(HEAD + "set = { shinines = 4 }\n", 5, "shininess"),
    Case(HEAD + "set = { shininess = -4 }\n", 5, "shininess"),
    Case(HEAD + 'set = { mesh = "/etc/x.obj" }\n', 5, "outside the folder"),
    Case(HEAD + "set = 1\n", 5, "set = 1"),
    Case(HEAD + 'sliders = ["kx"]\n', 5, "no value 'kx'"),
    Case(HEAD + 'sliders = "ka"\n', 5, "sliders = "),
    Case(HEAD + f"sliders = {json.dumps(['ka'] * 9)}\n", 5, "9 sliders"),
    Case(HEAD + 'compare = [{ caption = "a" }]\n', 5, "1 pictures compared"),
    Case(HEAD + "compare = [{}, {}]\n", 5, "picture 1: needs caption"),
    Case(HEAD + 'compare = [{ caption = "a" }, { caption = "b", sett = {} }]\n', 5, "picture 2: "),
    Case(HEAD + "compare = 2\n", 5, "compare is a list"),
    Case(HEAD + 'ask = ""\nreveal = "b"\n', 5, "ask.en is empty"),
    Case(HEAD + 'ask = { fr = "quoi" }\nreveal = "b"\n', 5, "ask.fr"),
    Case(HEAD + f'ask = "{"x " * 200}"\nreveal = "b"\n', 5, "allowed: 1 to 260 letters"),
    Case(HEAD + '[[step]]\ntitle = "b"\ncaption = "c"\nset = { kx = 1 }\n', 8, "step 2: no value"),
    Case('title = "One"\nstep = []\n', 2, "0 steps"),
    Case("title = \n", 1, "not TOML"),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.says)
def test_what_is_wrong_is_said_in_one_line(case):
    with pytest.raises(Mistake) as mistake:
        lesson.parse(case.text, "lesson.toml")
    said = str(mistake.value)
    assert said.startswith(f"lesson.toml:{case.line}: "), said
    assert case.says in said and "\n" not in said


@pytest.mark.parametrize(
    "more, says",
    [
        ("formula = '\\frac{1'\n" + PLAIN, "formula: "),
        ("formula = '\\nothing'\n" + PLAIN, "formula: "),
        (f"formula = '{'{' * 140}{'}' * 140}'\n" + PLAIN, "formula: "),
        (f'formula = "x"\nask = "{"w" * 90}"\nreveal = "b"\n' + PLAIN, "www…' has no room"),
    ],
)
def test_what_no_slide_can_show_is_said_before_anything_is_drawn(lumiar, tmp_path, more, says):
    (tmp_path / "bad.toml").write_text(HEAD + more)
    said = lumiar("lesson", "bad.toml", "-o", "out", code=2).stderr
    assert said.startswith("lumiar: bad.toml:5: step 1: ") and says in said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "arguments, says",
    [
        (("phnog",), "did you mean 'phong'?"),
        (("gone.toml",), "gone.toml: no such file"),
        (("phong", "--size", "64x36"), "64x36: too small"),
        (("phong", "-o", "file"), "file: is a file"),
        (("phong", "--lang", "fr"), "fr"),
    ],
)
def test_the_verb_refuses_what_it_cannot_do(lumiar, tmp_path, arguments, says):
    (tmp_path / "file").write_text("")
    assert says in lumiar("lesson", *arguments, code=2).stderr
