"""`lumiar formfactor`: what it tells programs, readers and eyes; what it refuses, in one line."""

import json
import math

import numpy as np
import pytest
from PIL import Image

from lumiar import captions, cli
from lumiar import factor_table as table
from lumiar.errors import Mistake

UP = np.array([0.0, 0.0, 1.0])


def test_the_verb_tells_it_all_to_programs(capsys):
    command = ["formfactor", "--samples", "5000", "--json", "--from"]
    patch = [*command, "0,0,0", "--to", "-.5,-.5,1 .5,-.5,1 .5,.5,1 -.5,.5,1 -.5,-.5,1"]
    assert cli.run(patch) == 0
    told = json.loads(capsys.readouterr().out)
    assert len(told["to"]["corners"]) == 4  # the first one closed it
    assert told["F"]["closed_form"]["value"] == pytest.approx(0.23945647046077354, rel=1e-14)
    assert abs(told["F"]["closed_form_float32"]["relative"]) < 1e-6
    assert told["omega"]["nusselt"]["relative"] == pytest.approx(0.0, abs=1e-7)
    assert told["illuminance_of_1_cd_m2"] == pytest.approx(math.pi * 0.23945647046077354)
    both = [*command, "0,0,0 1,0,0 1,1,0 0,1,0", "--to", "0,0,0 1,0,0 1,0,2 0,0,2"]
    assert cli.run(both) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["F12"]["closed_form"]["value"] == pytest.approx(0.23285260279536189, rel=1e-11)
    assert told["A1_F12"] == pytest.approx(told["A2_F21"], rel=1e-12)
    assert told["from"]["front"] == [0, 0, 1] and told["to"]["front"] == [0, 1, 0]


def test_the_verb_tells_it_all_to_readers(capsys):
    down = ["formfactor", "--from", "0,0,0", "--normal=0,1,0", "--to", "-1,-1,1 1,-1,1 0,1,1"]
    assert cli.run([*down, "--samples", "2000"]) == 0
    said = capsys.readouterr().out
    for word in ("above the horizon", "closed form", "Nusselt's", "2000 rays", "lx"):
        assert word in said
    again = ["formfactor", "--from", "0,0,0 1,0,0 0,1,0", "--to", "0,0,1 1,0,1 0,1,1"]
    assert cli.run([*again, "--samples", "2000"]) == 0
    assert "reciprocity" in capsys.readouterr().out


def test_the_drawing_shows_sphere_and_disk_in_two_languages(tmp_path, capsys):
    """A polygon through the horizon, seen from a tilted patch."""
    path = tmp_path / "drawn.png"
    patch = ["formfactor", "--from", "0,0,0", "--normal", "1,0,2", "--samples", "2000"]
    wall = ["--to", "-1,1,-1 1,1,-1 0,1,1", "-o", str(path), "--lang", "pt"]
    assert cli.run([*patch, *wall]) == 0
    with Image.open(path) as picture:
        assert picture.size == (1600, 900)
        pixels = np.asarray(picture.convert("RGB"), float).mean(axis=2)
    for panel in (pixels[150:850, 80:900], pixels[130:520, 930:1560]):
        assert 0.03 < (panel < pixels[0, 0] - 5).mean() < 0.9
    assert not (pixels < pixels[0, 0] - 5)[:, [0, -1]].any()  # nothing runs out of the page
    english, portuguese = (captions.TEXT[lang]["nusselt"] for lang in ("en", "pt"))
    assert english.keys() == portuguese.keys() and not {*english.values()} & {*portuguese.values()}
    capsys.readouterr()


@pytest.mark.parametrize(
    "here, there, said",
    [
        ("0,0", "0,0,1 1,0,1 1,1,1", "--from: '0,0' is no x,y,z"),
        ("0,0,0", "0,0,1 1,0,1", "--to: 2 corners, fewer than 3"),
        ("0,0,0", "0,0,1 1,0,1 1,0,1 0,0,1", "fewer than 3 of them different|no area"),
        ("0,0,0", "0,0,1 1,0,1 2,0,1", "--to: the polygon has no area"),
        ("0,0,0", "0,0,1 1,0,1 1,1,1.1 0,1,1", "lie off a plane by .* split it"),
        ("0,0,0", "0,0,1 1,1,1 1,0,1 0,2,1", "its edges 1 and 3 cross"),
        ("0,0,0", "0,0,nan 1,0,1 1,1,1", "is not finite"),
        ("0,0,0", "0,0,1e300 1,0,1 1,1,1", "beyond 1e\\+09 m"),
        ("0.5,0.2,1", "0,0,1 1,0,1 1,1,1", "the point lies on the polygon"),
        (
            "0,0,0",
            " ".join(f"{math.cos(i)},{math.sin(i)},1" for i in range(300)),
            "up to 256|cross",
        ),
    ],
)
def test_what_is_no_polygon_is_told_in_one_line(here, there, said):
    with pytest.raises(Mistake, match=said):
        points = table.corners(here, "--from")
        table.patch(points[0], UP, table.polygon(table.corners(there, "--to"), "--to"), 100, 0)


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["--from", "0,0,0", "--normal", "0,0,0"], "--normal: has no length"),
        (["--from", "0,0,0 1,0,0 0,1,0", "--normal", "0,0,1"], "a polygon has its own"),
        (["--from", "0,0,0 1,0,0 0,1,0", "-o", "a.png"], "projection is a patch's"),
        (["--from", "0,0,0", "-o", "a.txt"], "ends in .png, .svg or .pdf"),
        (["--from", ""], "--from: nothing; write corners"),
        (["--from", "0,0,0", "--samples", "1"], "is not a whole number, 2 to"),
    ],
)
def test_options_that_cannot_be_are_told_in_one_line(arguments, said, capsys):
    assert cli.run(["formfactor", *arguments, "--to", "0,0,1 1,0,1 0,1,1"]) == 2
    assert said in capsys.readouterr().err
