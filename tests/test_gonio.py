"""The gonioreflectometer: its arms, its detector, its files, its pictures, and `lumiar measure`."""

import io
import json
import math
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from lumiar import captions, catalog, gonio, measure, measuring, panels, plots, tables
from lumiar.errors import Mistake

COLUMNS = [*tables.COLUMNS]
BOTH = """// model   Glow\n// sides   both
vec3 scatter(vec3 L, vec3 V) { return vec3(0.25); }\n"""


def rows(text):
    """Return the numbers of a CSV as NumPy reads them without any help."""
    return np.loadtxt(io.StringIO(text), delimiter=",", ndmin=2)


def unit(count, seed=3):
    w = np.random.default_rng(seed).normal(size=(count, 3))
    return w / np.linalg.norm(w, axis=1, keepdims=True)


@pytest.fixture(scope="module")
def instrument():
    with measure.Instrument() as one:
        yield one


def test_models_that_are_edited_again_and_again_leave_no_programs_behind(instrument):
    up = np.array([[0.0, 0.0, 1.0]])
    pairs = instrument.pairs(up, up)
    for i in (*range(measure.PROGRAMS + 3), 0):
        text = f"// model   Own\nvec3 scatter(vec3 L, vec3 V) {{ return vec3({i}.0); }}\n"
        one = catalog.parse("model", "own", "own.glsl", text)
        assert instrument.scatter(one, {}, pairs)[0, 0] == i
    assert len(instrument._programs) == measure.PROGRAMS
    instrument.forget(pairs)


def test_directions_are_unit_and_hit_right_angles_exactly():
    for theta, phi, expected in (
        (0, 77, (0, 0, 1)),
        (180, 0, (0, 0, -1)),
        (90, 0, (1, 0, 0)),
        (90, 270, (0, -1, 0)),
        (90, -90, (0, -1, 0)),
    ):
        assert (gonio.directions(theta, phi) == expected).all()
    theta, phi = np.meshgrid(np.linspace(0, 180, 91), np.linspace(-400, 400, 97))
    w, t, p = gonio.directions(theta, phi), np.radians(theta), np.radians(phi)
    assert np.linalg.norm(w, axis=-1) == pytest.approx(1.0, abs=1e-15)
    expected = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1)
    assert w == pytest.approx(expected, abs=1e-14)


def test_the_detector_in_the_plane_stands_at_the_mirror_where_its_angle_is_the_lights():
    light, detector = gonio.in_plane(np.array([35.0]), 20.0, np.array([-35.0, 35.0, 145.0]))
    L, V = gonio.directions(*light.T), gonio.directions(*detector.T)
    assert pytest.approx(L[0], abs=1e-15) == V[0]
    assert pytest.approx(L[1] * [-1, -1, 1], abs=1e-15) == V[1]
    assert pytest.approx(-L[2], abs=1e-15) == V[2]  # straight on, through the surface


def test_steps_land_where_they_are_written():
    assert gonio.steps(-90, 90, 0.1)[[0, 900, -1]].tolist() == [-90, 0, 90]
    assert gonio.steps(0, 10, 4).tolist() == [0, 4, 8]
    assert gonio.steps(5, 5, 1).tolist() == [5]


def test_all_directions_are_a_grid_of_theta_and_phi():
    light, detector = gonio.hemispherical(np.array([10.0, 50.0]), 0.0, 30.0)
    assert len(light) == 2 * 4 * 12
    grid = detector.reshape(2, 4, 12, 2)
    assert (grid[..., 0] == np.array([0, 30, 60, 90])[:, None]).all()
    assert (grid[..., 1] == np.arange(0, 360, 30)).all()


def test_an_aperture_changes_nothing_of_what_is_constant():
    arms = gonio.in_plane(np.array([0.0, 60.0]), 0.0, gonio.steps(-70, 70, 10))
    for aperture in (0.0, 1.0, 19.0):
        seen = gonio.measured(lambda L, V: np.full(V.shape, 0.7), *arms, aperture)
        assert seen == pytest.approx(0.7, rel=1e-15)


@pytest.mark.parametrize("aperture", [0.5, 10.0, 45.0])
def test_the_mean_of_directions_over_a_cone_is_its_axis_times_half_of_one_plus_cos(aperture):
    _, detector = gonio.hemispherical(np.array([0.0]), 0.0, 15.0, 180.0)
    arms = np.zeros_like(detector), detector
    seen = gonio.measured(lambda L, V: V, *arms, aperture, opaque=False)
    expected = gonio.directions(*detector.T) * (1.0 + math.cos(math.radians(aperture))) / 2.0
    assert seen == pytest.approx(expected, abs=0.02 * math.sin(math.radians(aperture)))
    axial = (seen * gonio.directions(*detector.T)).sum(axis=1)  # exact: rings of equal area
    assert axial == pytest.approx((1.0 + math.cos(math.radians(aperture))) / 2.0, abs=1e-14)


def test_nothing_comes_through_an_opaque_surface():
    arms = gonio.in_plane(np.array([30.0]), 0.0, np.array([89.0, 90.0]))
    seen = gonio.measured(lambda L, V: np.ones(V.shape), *arms, 10.0)[:, 0]
    assert seen[1] == pytest.approx(0.5, abs=1 / 64) and 0.5 < seen[0] < 0.65
    assert (gonio.measured(lambda L, V: np.ones(V.shape), *arms, 10.0, opaque=False) == 1.0).all()


def test_noise_has_the_deviation_asked_for_and_follows_its_seed():
    truth = np.linspace(0.1, 5.0, 90_000).reshape(-1, 3)
    one, same, other = (gonio.noisy(truth, 0.03, np.random.default_rng(s)) for s in (1, 1, 2))
    relative = one / truth - 1.0
    assert relative.std() == pytest.approx(0.03, rel=0.02)  # 5 deviations of the estimate
    assert abs(relative.mean()) < 5 * 0.03 / math.sqrt(truth.size)
    assert (one == same).all() and (one != other).all()


def test_lobes_are_resolved_where_they_stand():
    """A rough conductor of alpha 0.001 has a peak a thousandth of a radian wide."""
    bent = math.degrees(math.asin(math.sin(math.radians(37.0)) / 1.5))  # Snell
    above, all_around = gonio.lobe_angles(37.0), gonio.lobe_angles(37.0, 180.0, 1.5)
    for angles, peaks in ((above, (37.0, -37.0)), (all_around, (37.0, -37.0, 143.0, 180.0 - bent))):
        for peak in peaks:
            near = np.sort(np.abs(angles - peak))
            assert near[0] < 1e-9 and near[4] < 0.003
    assert np.abs(above).max() == 89.99 and np.abs(all_around).max() == 180.0


def test_lamberts_scatter_is_its_albedo_times_cos_over_pi(lumiar):
    done = lumiar("measure", "lambert", "--set", "albedo=0.2,0.5,0.8", "--light", "0,45,60,90")
    found = rows(done.stdout)
    assert found.shape == (4 * 181, 11)
    theta, scatter, brdf = np.radians(found[:, 0]), found[:, 4:7], found[:, 7:10]
    expected = np.outer(np.cos(theta), [0.2, 0.5, 0.8]) / math.pi
    assert scatter == pytest.approx(expected, rel=1e-6, abs=1e-7)
    grazing = found[:, 0] == 90.0
    assert np.isnan(brdf[grazing]).all() and (scatter[grazing] == 0.0).all()
    assert brdf[~grazing] == pytest.approx(
        np.broadcast_to(np.array([0.2, 0.5, 0.8]) / math.pi, (3 * 181, 3)), rel=1e-6
    )


def test_a_table_says_what_it_holds(lumiar, tmp_path):
    options = ("--light", "30", "--azimuth", "15", "--aperture", "2", "--noise", "0.01")
    done = lumiar("measure", "oren_nayar", *options, "--seed", "7", "--detector", "-60:60:5")
    head = [line for line in done.stdout.splitlines() if line.startswith("#")]
    text = "\n".join(head)
    assert head[0] == "# Lumiar measurement"
    for said in (
        "program: Lumiar 0.1.0",
        "model 1: Oren-Nayar",
        "Nayar",
        "parameter 1.sigma: 30 (degrees)",
        "parameter 1.albedo: 0.8, 0.8, 0.8 (unitless)",
        "parameter 1.form: qualitative (choice)",
        "light: 30 degrees",
        "azimuth: 15 degrees",
        "-60:60:5 degrees",
        "aperture: 2 degrees",
        "noise: 0.01 of the value, Gaussian, seed 7",
        "theta_l [degrees]",
        "scatter_r [1/sr]",
    ):
        assert said in text, said
    for parameter in catalog.read("model", "oren_nayar").parameters:
        assert f"parameter 1.{parameter.name}: " in text


@pytest.mark.parametrize("ending", ["csv", "npz"])
def test_a_table_reads_back_as_it_was(lumiar, tmp_path, ending):
    name = f"m.{ending}"
    more = ("--light", "20,70,90", "--azimuth", "33", "--hemisphere", "30", "--noise", "0.1")
    assert lumiar("measure", "ward", "phong", *more, "-o", name).stdout == f"{name}\n"
    found = tables.read(tmp_path / name)
    assert found.header["model 2"] == "Phong" and "parameter 1.alpha_x" in found.header
    assert found.scatter.dtype == np.float32 and found.scatter.shape == (2 * 3 * 4 * 12, 3)
    data = b"".join(tables.written(found, f".{ending}"))
    assert data == (tmp_path / name).read_bytes()
    again = tmp_path / f"again.{ending}"
    again.write_bytes(data)
    for one, other in zip(found, tables.read(again), strict=True):
        assert np.array_equal(one, other)


def test_an_npz_holds_the_same_as_a_csv(lumiar, tmp_path):
    for name in ("m.csv", "m.npz"):
        lumiar("measure", "blinn", "--noise", "0.05", "-o", name)
    table, arrays = rows((tmp_path / "m.csv").read_text()), np.load(tmp_path / "m.npz")
    for i, name in enumerate(COLUMNS[:4]):
        assert arrays[name] == pytest.approx(table[:, i])
    assert (arrays["scatter"] == table[:, 4:7].astype(np.float32)).all()
    assert arrays["brdf"] == pytest.approx(table[:, 7:10], rel=1e-8)
    header = json.loads(str(arrays["header"]))
    assert header["model 1"] == "Blinn" and header["file 1"] == "blinn"


def test_a_seed_repeats_the_noise(lumiar):
    measured = [
        lumiar("measure", "lambert", "--noise", "0.05", "--seed", seed).stdout for seed in (1, 1, 2)
    ]
    assert measured[0] == measured[1] != measured[2]


def test_a_model_with_values_of_its_own(lumiar):
    both = "measure", "lambert:albedo=0.5", "lambert", "--set", "albedo=0.1", "--detector", "0:0:1"
    found = rows(lumiar(*both, "--light", "0").stdout)
    assert found[:, 4] == pytest.approx(np.array([0.5, 0.1]) / math.pi, rel=1e-6)
    assert found[:, -1].tolist() == [1, 2]


def test_what_has_two_sides_is_measured_on_both(lumiar, tmp_path):
    (tmp_path / "glow.glsl").write_text(BOTH)
    found = rows(lumiar("measure", "glow.glsl", "lambert", "--light", "120,10").stdout)
    glow, lambert = (found[found[:, -1] == i] for i in (1, 2))
    assert glow.shape[0] == 2 * 361 and (glow[:, 4:7] == 0.25).all()
    assert lambert.shape[0] == 181 and (lambert[:, 0] == 10).all()
    assert glow[:, 7] == pytest.approx(0.25 / np.abs(np.cos(np.radians(glow[:, 0]))), rel=1e-6)
    told = lumiar("measure", "lambert", "--detector", "-120:90:5", code=2).stderr
    assert "120 degrees from the normal is below the surface" in told


@pytest.mark.parametrize("name", ["ward", "rough_dielectric", "dielectric", "lambert"])
def test_exact_pairs_come_back_in_their_order(lumiar, tmp_path, instrument, name):
    L, V = unit(1000), unit(1000, 4)
    np.savez(tmp_path / "in.npz", L=L, V=V)
    lumiar("measure", name, "--directions", "in.npz", "--out", "out.npz")
    out, model = np.load(tmp_path / "out.npz"), catalog.read("model", name)
    pairs = instrument.pairs(L, V)
    assert set(out.files) == {"scatter"} | ({"surround"} & model.defines)
    for what in out.files:
        expected = getattr(instrument, what)(model, model.defaults(), pairs)
        assert out[what].shape == (1000, 3) and out[what].dtype == np.float32
        assert (out[what] == expected).all()
    if name == "dielectric":  # smooth glass returns all that a white furnace sends
        assert out["surround"] == pytest.approx(1.0, abs=1e-6)


def test_exact_pairs_may_be_none_or_more_than_a_million(lumiar, tmp_path):
    L = np.tile([0.0, 0.6, 0.8], (1_100_000, 1))
    L[::3] = [0.0, -0.8, 0.6]
    for count in (0, 1, len(L)):
        np.savez(tmp_path / "in.npz", L=L[:count], V=L[:count])
        more = ("--set", "albedo=1", "--directions", "in.npz", "--out", "out.npz")
        lumiar("measure", "lambert", *more)
        found = np.load(tmp_path / "out.npz")["scatter"]
        assert found.shape == (count, 3)
        expected = np.maximum(np.repeat(L[:count, 2:], 3, axis=1), 0.0) / math.pi
        assert np.allclose(found, expected, rtol=1e-6, atol=0.0)


def test_what_are_no_directions_is_told_in_one_line(lumiar, tmp_path):
    good, bad = unit(5), unit(5)
    bad[3] *= 1.001
    nan = np.where(np.arange(5)[:, None] == 2, np.nan, unit(5))
    cases = {
        "lacks": ({"L": good}, "no array 'V'"),
        "shape": ({"L": good.T, "V": good.T}, "save float64 (n, 3)"),
        "flat": ({"L": good[0], "V": good[0]}, "save float64 (n, 3)"),
        "differ": ({"L": good, "V": good[:4]}, "5 L but 4 V"),
        "long": ({"L": good, "V": bad}, "V[3] ="),
        "nan": ({"L": nan, "V": good}, "L[2] = (nan, nan, nan) is not of length 1"),
        "huge": ({"L": good * 1e300, "V": good}, "L[0] ="),
        "words": ({"L": np.full((5, 3), "a"), "V": good}, "save float64"),
        "objects": ({"L": np.full((5, 3), None), "V": good}, "Python objects"),
        "complex": ({"L": good + 0j, "V": good}, "complex128"),
    }
    for name, (arrays, said) in cases.items():
        np.savez(tmp_path / f"{name}.npz", **arrays)
        with pytest.raises(Mistake) as told:
            tables.pairs(tmp_path / f"{name}.npz")
        assert said in str(told.value), name
    np.savez(tmp_path / "whole.npz", L=good, V=good)
    whole = (tmp_path / "whole.npz").read_bytes()
    (tmp_path / "text.npz").write_text("L, V\n")
    (tmp_path / "empty.npz").touch()
    for cut in (1, 30, len(whole) // 2, len(whole) - 1):
        (tmp_path / "cut.npz").write_bytes(whole[:cut])
        with pytest.raises(Mistake, match="damaged, or no"):
            tables.pairs(tmp_path / "cut.npz")
    flipped = bytearray(whole)
    flipped[len(whole) // 3] ^= 255
    (tmp_path / "flipped.npz").write_bytes(flipped)
    for name in ("text", "empty", "flipped", "long", "none"):
        more = ("--directions", f"{name}.npz", "--out", "out.npz")
        assert lumiar("measure", "ward", *more, code=2).stderr.count("\n") == 1
    assert not (tmp_path / "out.npz").exists()


def test_a_damaged_table_is_told_with_its_line(tmp_path, instrument):
    one = measured(instrument, "lambert", lights=(0.0, 40.0), detector=(-90.0, 90.0, 45.0))
    lines = b"".join(tables.written(one, ".csv")).decode().splitlines()
    first = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    path = tmp_path / "m.csv"

    def told(changed):
        path.write_text("\n".join(changed) + "\n")
        with pytest.raises(Mistake) as mistake:
            tables.read(path)
        return str(mistake.value)

    def with_row(text):
        return [*lines[: first + 2], text, *lines[first + 3 :]]

    where = f"{path}:{first + 3}: "
    assert told(with_row("0,0,1")).startswith(where)
    assert told(with_row(lines[-1].replace("0", "o"))).startswith(where)
    assert told(with_row("nan," + lines[-1].partition(",")[2])).startswith(where)
    assert told(lines[1:]).startswith(f"{path}:1: no measurement")
    assert told(["theta,f", "1,2"]).startswith(f"{path}:1: no measurement")
    assert "its columns are not" in told(lines[: first - 1])
    assert told([]).startswith(f"{path}:1: ")
    assert told([*lines[:-1], lines[-1][:-20]]).startswith(f"{path}:{len(lines)}: ")
    path.write_bytes(b"PK\3\4 no archive")
    with pytest.raises(Mistake, match="damaged"):
        tables.read(path)
    np.savez(tmp_path / "x.npz", a=1)
    with pytest.raises(Mistake, match="no array 'theta_l'"):
        tables.read(tmp_path / "x.npz")
    arrays = dict.fromkeys([*COLUMNS[:4], "scatter", "model", "header"], np.zeros(3))
    np.savez(tmp_path / "y.npz", **arrays)
    with pytest.raises(Mistake, match="no measurement"):
        tables.read(tmp_path / "y.npz")


def measured(instrument, *specs, **setup):
    setup = measuring.Setup(**{"lights": (0.0, 60.0), **setup})
    return measuring.measurement(instrument, measuring.chosen(specs, []), setup)


def test_the_angle_in_the_plane_is_found_again(instrument):
    one = measured(instrument, "lambert", azimuth=130.0, detector=(-80.0, 80.0, 20.0))
    assert one.angles.tolist() == [*range(-80, 81, 20)] * 2
    other = measured(instrument, "lambert", azimuth=60.0, step=30.0)
    theta, phi = other.detector.T
    inside = (theta == 0.0) | (phi == 60.0) | (phi == 240.0)
    assert (np.isfinite(other.angles) == inside).all()
    assert (other.angles[phi == 240.0] == theta[phi == 240.0]).all()
    assert (other.angles[phi == 60.0] == -theta[phi == 60.0]).all()


def test_the_albedo_shown_is_that_of_closed_forms(instrument):
    lambert, glass = measuring.chosen(["lambert:albedo=0.3,0.6,0.9", "dielectric"], [])
    found = measuring.albedo(instrument, lambert)
    assert found.values == pytest.approx(np.tile([0.3, 0.6, 0.9], (len(found.angles), 1)), rel=1e-5)
    assert not found.surround
    mirror = measuring.albedo(instrument, glass)
    assert mirror.surround and mirror.values == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize(
    "ending, magic", [("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")]
)
def test_pictures_are_drawn_the_same_twice(lumiar, tmp_path, ending, magic):
    for name in ("a", "b"):
        lumiar("measure", "ward", "--light", "45", "--plot", f"{name}.{ending}")
    data = (tmp_path / f"a.{ending}").read_bytes()
    assert data.startswith(magic) and data == (tmp_path / f"b.{ending}").read_bytes()


def test_every_option_of_a_picture_counts(lumiar, tmp_path):
    lumiar("measure", "phong", "-o", "phong.csv", "--light", "60")
    base = ("measure", "blinn", "--light", "60", "--plot")
    found = set()
    for i, more in enumerate(
        (
            ("--lang", "en"),
            ("--lang", "pt"),
            ("--lang", "en", "--set", "shininess=20"),
            ("--lang", "en", "--aperture", "10"),
            ("--lang", "en", "--noise", "0.3"),
            ("--lang", "en", "--overlay", "phong.csv"),
            ("--lang", "en", "--azimuth", "40", "--set", "ks=0.9"),
            ("--lang", "en", "--light", "30"),
        )
    ):
        lumiar(*base, f"{i}.png", *more)
        with Image.open(tmp_path / f"{i}.png") as picture:
            assert picture.size == (1600, 1050)
            found.add(picture.tobytes())
    assert len(found) == 8
    lumiar(*base, "system.png", env={"LC_ALL": "pt_BR.UTF-8"})
    assert (tmp_path / "system.png").read_bytes() == (tmp_path / "1.png").read_bytes()


def test_names_with_any_sign_are_drawn(lumiar, tmp_path):
    (tmp_path / "odd.glsl").write_text(
        f"// model   $\\frac{{1 {'long ' * 60}\u4e2d\n"
        "vec3 scatter(vec3 L, vec3 V) { return vec3(V.x > 0.5 ? sqrt(-L.z) : 1.0 / L.z); }\n"
    )
    assert lumiar("measure", "odd.glsl", "lambert", "--plot", "a.png").stderr == ""
    (tmp_path / "black.glsl").write_text(
        "// model   Black\nvec3 scatter(vec3 L, vec3 V) { return vec3(0.0); }\n"
    )
    assert lumiar("measure", "black.glsl", "--plot", "b.svg").stderr == ""


def test_both_languages_have_the_same_words():
    assert captions.TEXT["en"].keys() == captions.TEXT["pt"].keys()
    for key, text in captions.TEXT["en"].items():
        other = captions.TEXT["pt"][key]
        assert type(text) is type(other) and len(text) > 0
        assert str(text).count("{") == str(other).count("{")


def test_a_data_sheet_is_one_page():
    angles, f = np.linspace(-89, 89, 90), np.full((90, 3), 0.2)
    albedo = panels.Albedo("Even", np.array([0.0, 45.0, 89.0]), np.full((3, 3), 0.6), np.zeros(3))
    curves = tuple(panels.Curve("Even", light, angles, f) for light in (0.0, 30.0, 60.0, 80.0))
    claims = (("positive", "yes", "holds", True), ("reciprocal", "yes", "broken", False))
    sheet = plots.Sheet("Even", "Nobody, 1800", claims, curves, albedo, (("cost", "3 ns"),))
    pages = [plots.data_sheet(sheet, bytes(12 * 8 * 3), (12, 8), lang) for lang in ("en", "pt")]
    assert pages[0] != pages[1]
    with Image.open(io.BytesIO(pages[0])) as page:
        assert page.size == (2000, 1125) and page.format == "PNG"


@pytest.mark.parametrize(
    "arguments, said",
    [
        ("", "required"),
        ("wrad", "no model 'wrad'; did you mean 'ward'?"),
        ("ward --set alpha=0.1", "no value 'alpha'; did you mean 'alpha_"),
        ("ward:alpha=0.1", "has no parameter 'alpha'"),
        ("ward --set alpha_x=7", "alpha_x = 7.0 is not possible; allowed: 0.001 to 1"),
        ("ward --set alpha_x", "write --set key=value"),
        ("ward --light 200", "'200' is not a number, 0 to 180"),
        ("ward --light 91", "91 degrees from the normal is below the surface"),
        ("ward --light nan", "'nan' is not a number"),
        ("ward --detector 10", "as in -90:90:1"),
        ("ward --detector -10:10:0", "as in -90:90:1"),
        ("ward --detector -90:90:1 --hemisphere 5", "not allowed with"),
        ("ward --hemisphere 0.05", "take larger steps"),
        ("ward --detector -90:90:0.0001", "take larger steps"),
        ("ward --noise -1", "'-1' is not a number, 0 to 10"),
        ("ward --seed x", "'x' is not a whole number"),
        ("ward --aperture 100", "0 to 90"),
        ("ward -o m.txt", "ends in .csv or .npz"),
        ("ward -o nowhere/m.csv", "there is no folder"),
        ("ward --plot m.jpg", "ends in .png, .svg or .pdf"),
        ("ward --overlay m.csv", "add --plot"),
        ("ward --overlay none.csv --plot a.png", "none.csv: no such file"),
        ("ward --overlay other.csv --light 35 --plot a.png", "write --light 10"),
        ("ward --directions p.npz", "--out scatter.npz"),
        ("ward --directions p.npz --out a.csv", "--out scatter.npz"),
        ("ward --directions p.npz --out p.npz", "would replace"),
        ("ward phong --directions p.npz --out o.npz", "2 models; name one"),
        ("ward --directions p.npz --out o.npz --noise 0", "--noise: --directions measures exactly"),
        ("ward --directons p.npz", "did you mean '--directions'?"),
    ],
)
def test_a_mistake_is_one_line_and_leaves_nothing(lumiar, tmp_path, arguments, said):
    made = []
    if "other" in arguments:
        lumiar("measure", "lambert", "--light", "10", "-o", "other.csv")
        made = ["other.csv"]
    told = lumiar("measure", *arguments.split(), code=2)
    assert said in told.stderr and told.stderr.count("\n") == 1 and told.stdout == ""
    assert [p.name for p in tmp_path.iterdir()] == made


def test_a_model_that_does_not_compile_is_told_by_line(lumiar, tmp_path):
    (tmp_path / "own.glsl").write_text(
        "// model   Own\nvec3 scatter(vec3 L, vec3 V) {\n    return vec3(nothing);\n}\n"
    )
    told = lumiar("measure", "own.glsl", "-o", "a.csv", code=2).stderr
    assert "own.glsl:3: " in told and not (tmp_path / "a.csv").exists()


def test_pairs_that_are_not_finite_are_told(lumiar, tmp_path):
    (tmp_path / "own.glsl").write_text(
        "// model   Own\nvec3 scatter(vec3 L, vec3 V) { return vec3(sqrt(L.z)); }\n"
    )
    np.savez(tmp_path / "p.npz", L=[[0, 0, 1], [0, 0, -1], [0, 0, -1]], V=np.eye(3))
    told = lumiar("measure", "own.glsl", "--directions", "p.npz", "--out", "o.npz").stderr
    assert told == "lumiar: o.npz: 2 of 3 pairs are not finite\n"
    found = np.load(tmp_path / "o.npz")["scatter"]
    assert found[0].tolist() == [1, 1, 1] and np.isnan(found[1:]).all()


def test_matplotlib_is_imported_for_pictures_only(tmp_path):
    for arguments in (["capture", "--size", "8x8"], ["measure", "lambert", "-o", "a.csv"]):
        code = (
            "import sys; from lumiar import cli\n"
            f"assert cli.run({arguments}) == 0\n"
            "assert not {'matplotlib', 'mpl_toolkits'} & sys.modules.keys()"
        )
        subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True)
