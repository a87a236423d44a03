"""The commands as a user types them: what they print, what they leave, how they end."""

import contextlib
import json
import os
import re
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lumiar import Scene, capture, lesson
from lumiar.renderer import Renderer

SMALL = ("--size", "48x32", "--samples", "1")
OWN = "// model   Own\nvec3 scatter(vec3 L, vec3 V) { return vec3(%s) * max(L.z, 0.0); }\n"
SLOW = "float x = L.z; for (int i = 0; i < 65000; ++i) x = sin(x + exp(-x)); return vec3(x);"
LIMITS = "// model   Slow\nvec3 scatter(vec3 L, vec3 V) { %s }\n"


def pixels(path):
    with Image.open(path) as picture:
        return np.asarray(picture)


def leftovers(folder):
    return sorted(p.name for p in folder.iterdir() if p.name.startswith(".") or p.suffix == ".tmp")


def test_a_capture_without_anything_draws_the_default_scene(lumiar, tmp_path):
    assert lumiar("capture", *SMALL).stdout == "lumiar.png\n"
    assert pixels(tmp_path / "lumiar.png").shape == (32, 48, 3)
    assert leftovers(tmp_path) == []


def test_every_option_of_capture_counts(lumiar, tmp_path):
    base = ("capture", *SMALL, "-o")
    lumiar(*base, "base.png")
    for i, more in enumerate(
        (
            ("--model", "lambert"),
            ("--mesh", "teapot"),
            ("--shading", "flat", "--mesh", "sphere:subdivision=1"),
            ("--light", "point:intensity=20", "--light", "spot"),
            ("--set", "kd=1,0,0"),
            ("--set", "shininess=5", "--set", "ks=1"),
            ("--samples", "4"),
        )
    ):
        lumiar(*base, f"{i}.png", *more)
        assert (pixels(tmp_path / f"{i}.png") != pixels(tmp_path / "base.png")).any(), more


def test_a_picture_reopens_as_what_made_it(lumiar, tmp_path):
    mesh = tmp_path / "elsewhere" / "tri.off"
    mesh.parent.mkdir()
    mesh.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    (tmp_path / "own.glsl").write_text(OWN % "0.2, 0.7, 0.4")
    for i, more in enumerate(
        (
            ("--set", "kd=0.1,0.9,0.3", "--set", "camera.azimuth=70"),
            ("--mesh", mesh, "--model", "own.glsl"),
            ("--vary", "shininess=5,500", "--vary", "model=phong,blinn"),
        )
    ):
        lumiar("capture", *SMALL, *more, "-o", f"a{i}.png")
        lumiar("capture", f"a{i}.png", "-o", f"b{i}.png")
        assert (pixels(tmp_path / f"a{i}.png") == pixels(tmp_path / f"b{i}.png")).all()
        one, other = (lumiar("info", f"{name}{i}.png").stdout for name in "ab")
        assert one == other and one.startswith("size = ")


def test_a_sheet_with_a_light_of_its_own_reopens(lumiar, tmp_path):
    """The light lies beside the scene; where the user is lies another of that name, broken."""
    (tmp_path / "scene").mkdir()
    light = "// light   Own\nvec3 environment(vec3 direction) { return vec3(0.9, 0.5, 0.1); }\n"
    (tmp_path / "scene" / "own.glsl").write_text(light)
    (tmp_path / "own.glsl").write_text("// light   Broken\n")
    panels = (
        "[[panel]]\nset = { light = 'own.glsl', ka = 1 }\n[[panel]]\nset = { light = 'spot' }\n"
    )
    (tmp_path / "scene" / "s.toml").write_text(f"size = [40, 30]\n{panels}")
    lumiar("capture", "scene/s.toml", "-o", "a.png")
    lumiar("capture", "a.png", "-o", "b.png")
    lumiar("capture", tmp_path / "a.png", "-o", tmp_path / "c.png", cwd="/")
    a, b, c = (pixels(tmp_path / f"{name}.png") for name in "abc")
    assert np.array_equal(a, b) and np.array_equal(a, c)
    assert (np.ptp(a.astype(int), axis=2) > 100).any()  # sRGB of 0.9 and 0.1: 243 and 89


def test_a_picture_is_not_replaced_by_its_own_capture(lumiar, tmp_path):
    lumiar("capture", *SMALL, "-o", "a.png")
    assert "name another with -o" in lumiar("capture", "a.png", code=2).stderr


def test_linear_radiance_is_written_as_it_is(lumiar, tmp_path):
    more = (*SMALL, "--light", "ambient:radiance=1", "--model", "lambert", "--set", "albedo=0.5")
    lumiar("capture", *more, "-o", "a.npy")
    lumiar("capture", *more, "-o", "a.hdr")
    lumiar("capture", *more, "--set", "exposure=3", "-o", "b.npy")
    array = np.load(tmp_path / "a.npy")
    assert array.shape == (32, 48, 3) and array.dtype == np.float32
    assert array[16, 24] == pytest.approx(0.5, rel=1e-6)
    assert (np.load(tmp_path / "b.npy") == array).all()  # the exposure is for eyes
    lumiar("compare", "a.npy", "a.hdr", "--max-error", "0.005")


def test_a_sheet_has_a_picture_for_each_combination(lumiar, tmp_path):
    lumiar(
        "capture",
        *SMALL,
        "--vary",
        "shininess=5,50,500",
        "--vary",
        "kd=[1,0,0],[0,1,0]",
        "-o",
        "s.png",
    )
    found = pixels(tmp_path / "s.png").astype(int)
    red = ((found[..., 0] - found[..., 1]) > 60).any(0)
    green = ((found[..., 1] - found[..., 0]) > 60).any(0)
    assert not (red & green).any()  # two columns
    dark = (found.sum(2) < 250).any(1)
    rows = np.flatnonzero(np.diff(dark.astype(int)) == 1).size
    assert rows >= 3
    info = lumiar("info", "s.png").stdout
    assert info.count("[[panel]]") == 6 and "shininess = 500, kd = [0,1,0]" in info


def test_broken_pixels_are_told_and_strict_is_strict(lumiar, tmp_path):
    (tmp_path / "nan.glsl").write_text(OWN % "sqrt(-L.z)")
    done = lumiar("capture", "--model", "nan.glsl", *SMALL, "-o", "n.png")
    assert re.search(r"^lumiar: n\.png: \d+ pixels have no finite radiance", done.stderr)
    assert ((pixels(tmp_path / "n.png") == [255, 0, 255]).all(2)).sum() > 50
    lumiar("capture", "--model", "nan.glsl", *SMALL, "-o", "n.npy", "--strict", code=3)
    assert np.isnan(np.load(tmp_path / "n.npy")).any()
    lumiar("capture", *SMALL, "--strict")


@pytest.mark.parametrize("rate", ["flat", "gouraud", "phong"])
def test_a_loop_cut_short_is_never_a_silent_picture(lumiar, tmp_path, rate):
    loop = "int n = 0; for (int i = 0; i < %d; ++i) n += int(V.z > -9.0); return vec3(n == %d);"
    base = ("capture", "--model", "loop.glsl", *SMALL, "--shading", rate, "-o", "l.npy")
    (tmp_path / "loop.glsl").write_text(LIMITS % loop % (65000, 65000))
    assert "steps" not in lumiar(*base).stderr
    whole = np.load(tmp_path / "l.npy")
    (tmp_path / "loop.glsl").write_text(LIMITS % loop % (70000, 70000))
    done = lumiar(*base)
    found = np.load(tmp_path / "l.npy")
    if "steps" in done.stderr:  # a software renderer that leaves the loop before its end
        assert (np.isnan(found).all(-1) == (whole != whole[0, 0]).any(-1)).all()
    else:
        np.testing.assert_array_equal(found, whole)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["captur"], "no verb 'captur'; did you mean 'capture'?"),
        (["capture", "--modle", "x"], "capture: no option --modle; did you mean '--model'?"),
        (["capture", "teapott"], "no scene 'teapott'; did you mean 'teapot'?"),
        (["capture", "gone.toml"], "gone.toml: no such file"),
        (["capture", "--model", "gone.glsl"], "--model: no file gone.glsl"),
        (["capture", "--mesh", "gone.obj"], "--mesh: no file gone.obj"),
        (["capture", "--set", "kd"], "write --set key=value"),
        (["capture", "--set", "kd=red"], 'kd = "red" is not possible; allowed: three numbers'),
        (["capture", "--set", "kq=1"], "--set: no value 'kq'; did you mean"),
        (["capture", "--vary", "kd"], "write --vary key=one,other"),
        (["capture", "--vary", "shading=flat,smooth"], 'shading = "smooth" is not possible'),
        (["capture", "--vary", "kd=1,0,0", "-o", "x.npy"], "x.npy: a sheet"),
        (["capture", "--size", "0x0"], "each 1 to 16384"),
        (["capture", "--size", "wide"], '--size: size = "wide" is not possible'),
        (["capture", "--size", "16384x16"], "more than this driver draws"),
        (["capture", "--samples", "3"], "allowed: 1, 4, 9, 16"),
        (["capture", "--timeout", "0"], "'0' is not a number of seconds above 0"),
        (["capture", "-o", "x.gif"], "x.gif: a picture ends in .png, .hdr, .npy"),
        (["capture", "-o", "gone/x.png"], "there is no folder"),
        (["capture", "-o", "/dev/full.png/x.png"], "there is no folder"),
        (["capture", "--light", "moon"], "--light: no light 'moon'"),
        (["capture", "--light", "point:intensty=3"], "did you mean 'intensity'?"),
        (["capture", "--shading", "smooth"], "allowed: one of flat, gouraud, phong"),
        (["source", "--object", "2"], "--object 2: allowed: 1 to 1"),
        (["info", "gone.obj"], "no file gone.obj"),
        (["info", "nothing"], "nothing: no file that Lumiar reads"),
        (["info"], "the following arguments are required: FILE"),
        (["compare", "a.png", "b.png"], "a.png: no such file"),
        (["compare", "a.png", "b.png", "--max-rmse", "-1"], "'-1' is not a number, 0 or more"),
        (["list", "modles"], "invalid choice: 'modles'"),
        (["capture", *["--light", "ambient"] * 65], "--light: 65 lights; allowed: up to 64"),
        (["capture", "demo", "--model", "lambert"], "--model: demo is a sheet of other scenes"),
        (["capture", "demo", "--mesh", "torus"], "--mesh: demo is a sheet of other scenes"),
        (["capture", "demo", "--shading", "flat"], "--shading: demo is a sheet of other scenes"),
        (["capture", "demo", "--light", "spot"], "--light: demo is a sheet of other scenes"),
        (["capture", "demo", "--set", "kd=1"], "draw one of them: phong-terms, "),
        (["capture", "demo", "--size", "9x9"], "--size: demo is a sheet of other scenes"),
        (["capture", "demo", "--samples", "1"], "--samples: demo is a sheet of other scenes"),
        (["capture", "demo", "--vary", "kd=0,1"], "--vary: demo is a sheet of other scenes"),
        (["capture", "--set", "camera.position=0,0,0"], "the eye stands on its target"),
        (["capture", "--set", "camera.target=1e17"], "the eye stands on its target"),
        (["capture", "--set", "object.².kd=1"], "no value 'object.².kd'"),
    ],
)
def test_a_mistake_is_one_line_and_exit_code_2(lumiar, tmp_path, arguments, told):
    assert told in lumiar(*arguments, code=2).stderr
    assert list(tmp_path.iterdir()) == []


def test_an_error_in_a_shader_names_its_line(lumiar, tmp_path):
    (tmp_path / "bad.glsl").write_text(
        "// model   Bad\n\nvec3 scatter(vec3 L, vec3 V) {\n    return nope;\n}\n"
    )
    told = lumiar("capture", "--model", "bad.glsl", code=2).stderr
    assert (
        told.startswith("lumiar: bad.glsl:4: the driver does not compile this: ") and "nope" in told
    )


def test_a_name_in_any_bytes_is_shown(lumiar, tmp_path):
    lumiar("info", b"no\xff\n\x1b[31m.obj", code=2)


def test_a_crash_of_the_driver_is_one_line(lumiar, tmp_path):
    """One legal line divides by zero inside Mesa's compiler; another driver may just compile it."""
    (tmp_path / "crash.glsl").write_text(
        LIMITS % "int b = (-2147483647 - 1) / -1; return vec3(float(b));"
    )
    done = subprocess.run(
        [sys.executable, "-m", "lumiar", "capture", "--model", "crash.glsl", *SMALL],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode in (0, 1)
    if done.returncode == 1:
        assert re.fullmatch(r"lumiar: the renderer ended with SIG\w+; .*\n", done.stderr)
    assert leftovers(tmp_path) == []


def start(tmp_path, *arguments):
    return subprocess.Popen(
        [sys.executable, "-m", "lumiar", *arguments],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def running(session):
    """Return the processes of a session that are alive, from Linux's /proc/PID/stat."""
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            state, _, _, its_session = path.read_text().rpartition(")")[2].split()[:4]
            if int(its_session) == session and state not in "ZX":
                found.append(int(path.parent.name))
    return found


def gone(session, seconds=10.0):
    """Return whether all of a session ends soon: a process closes its pipes before it has ended."""
    end = time.monotonic() + seconds
    while running(session) and time.monotonic() < end:
        time.sleep(0.02)
    return not running(session)


def test_a_hanging_shader_ends_at_the_timeout(lumiar, tmp_path):
    (tmp_path / "slow.glsl").write_text(LIMITS % SLOW)
    slow = ("capture", "--model", "slow.glsl", "--size", "2000x2000", "--timeout", "2")
    told = lumiar(*slow, code=1, timeout=20).stderr  # the picture would take minutes
    assert told == "lumiar: stopped after 2 s; --timeout SECONDS allows more\n"
    assert [p.name for p in tmp_path.iterdir()] == ["slow.glsl"]


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_a_hung_draw_at_once(tmp_path, number, code):
    (tmp_path / "slow.glsl").write_text(LIMITS % SLOW)
    process = start(tmp_path, "capture", "--model", "slow.glsl", "--size", "2000x2000")
    time.sleep(1.5)
    assert running(process.pid)
    process.send_signal(number)
    _, told = process.communicate(timeout=10)  # the picture would take minutes
    assert process.returncode == code
    assert told == f"lumiar: {'interrupted' if number == signal.SIGINT else 'terminated'}\n"
    assert [p.name for p in tmp_path.iterdir()] == ["slow.glsl"]
    assert gone(process.pid)


def test_a_killed_parent_leaves_no_renderer_behind(tmp_path):
    (tmp_path / "slow.glsl").write_text(LIMITS % SLOW)
    more = ("--size", "2000x2000", "--timeout", "1")
    with start(tmp_path, "capture", "--model", "slow.glsl", *more) as run:
        time.sleep(0.7)
        assert running(run.pid)
        run.kill()
        run.communicate()  # returns when the renderer, too, has closed its end of the pipes
    assert gone(run.pid)


def test_a_full_disk_leaves_the_old_picture(lumiar, tmp_path):
    lumiar("capture", *SMALL, "-o", "a.png")
    old = (tmp_path / "a.png").read_bytes()

    def little_room():
        resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))

    told = lumiar("capture", "-o", "a.png", code=1, preexec_fn=little_room).stderr
    assert told.startswith("lumiar: cannot write") and told.count("\n") == 1
    assert (tmp_path / "a.png").read_bytes() == old
    assert leftovers(tmp_path) == []


def test_memory_is_limited(tmp_path):
    """A child that eats memory is stopped, not the machine."""
    code = (
        "import sys; from lumiar import supervise; supervise.MEMORY = 300 << 20\n"
        "sys.exit(supervise.supervised(lambda: len([bytearray(10 << 20) for _ in range(100000)])))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert done.stderr.startswith("lumiar: stopped when it held ")


def test_what_the_killed_child_was_writing_goes(tmp_path):
    code = (
        "import os, signal, sys; from lumiar import files, supervise\n"
        "def job():\n"
        "    def chunks():\n"
        "        yield b'half'\n"
        "        os.kill(os.getpid(), signal.SIGKILL)\n"
        "    files.write_whole('out.png', chunks())\n"
        "sys.exit(supervise.supervised(job))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 1 and "SIGKILL" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_no_driver_is_one_line(lumiar):
    environment = {
        "LIBGL_DRIVERS_PATH": "/nonexistent",
        "__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent",
    }
    told = lumiar("capture", *SMALL, code=2, env=environment).stderr
    assert "OpenGL 3.3" in told and "apt install" in told


def test_an_old_driver_is_one_line(lumiar):
    told = lumiar("capture", *SMALL, code=2, env={"MESA_GL_VERSION_OVERRIDE": "3.0"}).stderr
    assert "OpenGL 3.3" in told


@pytest.mark.parametrize(
    ("rate", "stages"),
    [
        ("flat", ["vertex", "geometry", "fragment"]),
        ("gouraud", ["vertex", "fragment"]),
        ("phong", ["vertex", "fragment"]),
    ],
)
def test_source_is_what_is_compiled(lumiar, monkeypatch, rate, stages):
    """Every text that a picture of the same scene hands to the driver is printed, and no other."""
    handed, compiling = [], Renderer._compile

    def spy(self, sources):
        handed.append(sources)
        return compiling(self, sources)

    monkeypatch.setattr(Renderer, "_compile", spy)
    given = {"model": "lambert", "light": "point", "shading": rate, "rotation": (0.0, 20.0, 0.0)}
    capture(Scene.default().set(size=(8, 8), **given))
    surface = next(sources for sources in handed if "scatter" in str(sources))
    assert list(surface) == stages
    options = ("--model", "lambert", "--light", "point", "--shading", rate)
    printed = lumiar("source", *options, "--set", "rotation=0,20,0").stdout
    texts = (f"// ======== {stage} stage ========\n{surface[stage].text}\n" for stage in stages)
    assert printed == "".join(texts)


def test_info_tells_of_a_lesson_step_by_step(lumiar):
    """Phong is a model, too: both are told."""
    both = json.loads(lumiar("info", "phong", "--json").stdout)
    one = lesson.load("phong")
    assert both["kind"] == "model" and len(both["lesson"]["steps"]) == len(one.steps)
    alone = lumiar("info", lesson.shipped()["phong"]).stdout
    assert alone in lumiar("info", "phong").stdout
    for step in one.steps:
        assert step.title["en"] in alone and step.ask.get("en", "") in alone


def test_info_tells_of_models_meshes_scenes_and_pictures(lumiar, tmp_path):
    model = json.loads(lumiar("info", "phong", "--json").stdout)
    assert model["claims"] == {"positive": "", "reciprocal": "form = normalised"}
    assert {p["name"] for p in model["parameters"]} >= {"kd", "ks", "shininess", "form"}
    assert "k_d, diffuse share (unitless)" in lumiar("info", "phong").stdout
    (tmp_path / "quad.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\nf 1 1 2\n"
    )
    mesh = json.loads(lumiar("info", "quad.obj", "--json").stdout)
    assert (mesh["triangles"], mesh["vertices"], mesh["closed"]) == (2, 4, False)
    assert mesh["bounds"] == [[0, 0, 0], [1, 1, 0]]
    assert mesh["repaired"] == ["1 degenerate triangles left out"]
    assert "triangles       2" in lumiar("info", "quad.obj").stdout
    scene = json.loads(lumiar("info", "teapot", "--json").stdout)
    assert scene["kind"] == "mesh"  # a mesh and a scene share the name; the file tells them apart
    assert json.loads(lumiar("info", "phong-terms", "--json").stdout)["kind"] == "scene"
    assert lumiar("info", "spot").stdout.startswith("name            spot\nkind            light")


def test_list_names_everything(lumiar):
    text = lumiar("list").stdout
    for name in ("phong", "directional", "torus_knot", "suzanne", "phong-terms"):
        assert re.search(rf"^  {name}\b", text, re.MULTILINE), name
    data = json.loads(lumiar("list", "--json").stdout)
    assert set(data) == {"models", "lights", "meshes", "materials", "scenes", "lessons"}
    phong = next(model for model in data["models"] if model["name"] == "phong")
    shininess = next(p for p in phong["parameters"] if p["name"] == "shininess")
    assert (
        shininess["range"] == [1, 1000] and shininess["log"] and shininess["open"] == [False, True]
    )
    assert set(json.loads(lumiar("list", "lights", "--json").stdout)) == {"lights"}
    assert "O bule de Utah" in lumiar("list", "scenes", env={"LC_ALL": "pt_BR.UTF-8"}).stdout


def test_compare_is_a_gate(lumiar, tmp_path):
    lumiar("capture", *SMALL, "-o", "a.png")
    lumiar("capture", *SMALL, "--set", "kd=0.4,0.5,0.5", "-o", "b.png")
    same = json.loads(lumiar("compare", "a.png", "a.png", "--max-flip", "0", "--json").stdout)
    assert same == {"rmse": 0.0, "max": 0.0, "share": 0.0, "not_finite": 0, "flip": 0.0, "over": []}
    far = json.loads(lumiar("compare", "a.png", "b.png", "--json", "-o", "d.png").stdout)
    assert far["picture"] == "d.png" and far["white"] == far["max"]
    assert far["rmse"] > 0.01 and far["flip"] > 0.01 and 0.1 < far["share"] < 1.0
    for name, key in (("rmse", "rmse"), ("error", "max"), ("share", "share"), ("flip", "flip")):
        lumiar("compare", "a.png", "b.png", f"--max-{name}", far[key] * 1.01)
        done = lumiar("compare", "a.png", "b.png", f"--max-{name}", far[key] * 0.99, code=1)
        assert "over the limit" in done.stdout
    assert pixels(tmp_path / "d.png").shape == (32, 48, 3)


def test_black_radiance_is_compared_without_drama(lumiar, tmp_path):
    """HDR-FLIP of a black reference is not defined; the library ends the process over it."""
    for name, value in (("black", 0.0), ("white", 1.0)):
        np.save(tmp_path / f"{name}.npy", np.full((8, 8, 3), value, np.float32))
    same = json.loads(lumiar("compare", "black.npy", "black.npy", "--json").stdout)
    assert same["flip"] == same["rmse"] == 0.0
    other = json.loads(lumiar("compare", "black.npy", "white.npy", "--json").stdout)
    assert other["flip"] is None and other["rmse"] == 1.0
    assert "flip        not measured" in lumiar("compare", "black.npy", "white.npy").stdout
    told = lumiar("compare", "black.npy", "white.npy", "--max-flip", "1", code=2).stderr
    assert "--max-flip: FLIP is not measured here" in told


def test_flip_is_left_out_where_other_limits_decide(lumiar, tmp_path):
    for name, value in (("a", 0.25), ("b", 0.5)):
        np.save(tmp_path / f"{name}.npy", np.full((8, 8, 3), value, np.float32))
    limited = ("compare", "a.npy", "b.npy", "--json", "--max-rmse", "1")
    assert json.loads(lumiar(*limited).stdout)["flip"] is None
    assert json.loads(lumiar(*limited, "--max-flip", "1").stdout)["flip"] > 0.0
    assert json.loads(lumiar("compare", "a.npy", "b.npy", "--json").stdout)["flip"] > 0.0


def test_an_array_that_is_no_picture_is_one_line(lumiar, tmp_path):
    np.savez(tmp_path / "z.npz", a=np.zeros((2, 2, 3)))
    (tmp_path / "z.npz").rename(tmp_path / "z.npy")
    (tmp_path / "empty.npy").touch()
    np.save(tmp_path / "large.npy", np.full((2, 2, 3), 1e300))
    for name in ("z.npy", "empty.npy"):
        assert name in lumiar("compare", name, "large.npy", code=2).stderr
    assert lumiar("compare", "large.npy", "large.npy").stderr == ""


def test_a_sheet_of_one_picture_needs_no_columns(lumiar, tmp_path):
    (tmp_path / "one.toml").write_text('size = [40, 30]\n[[panel]]\ncaption = "alone"\n')
    lumiar("capture", "one.toml", "-o", "one.png")
    height, width, _ = pixels(tmp_path / "one.png").shape
    assert width > 40 and height > 30


def test_an_eye_very_far_away_sees_the_background(lumiar, tmp_path):
    far = ("capture", *SMALL, "--set", "camera.position=1e17", "--set", "background=0.25")
    assert lumiar(*far, "-o", "far.npy", "--strict").stderr == ""
    assert (np.load(tmp_path / "far.npy") == 0.25).all()


def test_a_mesh_whose_name_is_no_utf8_is_drawn_but_not_written_into_a_picture(lumiar, tmp_path):
    name = os.fsdecode(b"no\xff.obj")
    (tmp_path / name).write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    told = lumiar("capture", "--mesh", name, *SMALL, "-o", "a.png", code=2).stderr
    assert "a file name that is no UTF-8; rename the file" in told
    assert os.listdir(tmp_path) == [name]
    lumiar("capture", "--mesh", name, *SMALL, "-o", "a.npy")


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "utf-8"])
def test_any_encoding_of_the_terminal_will_do(lumiar, encoding):
    """Titles hold Greek letters, the help an ellipsis; what cannot be shown is spelled out."""
    env = {"PYTHONIOENCODING": encoding, "PYTHONUTF8": "0"}
    for arguments in (["list"], ["--help"], ["capture", "--help"], ["info", "phong-blinn"]):
        done = lumiar(*arguments, env=env, encoding=encoding)
        assert done.stdout and not done.stderr
    told = lumiar("capture", "--model", "β", code=2, env=env, encoding=encoding).stderr
    assert ("β" if encoding == "utf-8" else "\\u03b2") in told


@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"])
def test_closed_streams_change_no_picture(lumiar, tmp_path, closed):
    lumiar("capture", *SMALL, "-o", "open.png")
    base = f"exec {sys.executable} -m lumiar"
    for arguments in (f"capture {' '.join(SMALL)} -o closed.png", "list", "--help"):
        done = subprocess.run(
            f"{base} {arguments} {closed}", shell=True, cwd=tmp_path, capture_output=True
        )
        assert (done.returncode, done.stderr) == (0, b"")
    assert (tmp_path / "closed.png").read_bytes() == (tmp_path / "open.png").read_bytes()


def test_captions_follow_the_language(lumiar, tmp_path):
    for name, option, language in (
        ("en", (), "C"),
        ("pt", (), "pt_BR.UTF-8"),
        ("asked-en", ("--lang", "en"), "pt_BR.UTF-8"),
        ("asked-pt", ("--lang", "pt"), "C"),
    ):
        env = {"LC_ALL": "", "LC_MESSAGES": "", "LANG": language}
        lumiar("capture", "phong-terms", *SMALL, *option, "-o", f"{name}.png", env=env)
    en, pt, asked_en, asked_pt = (
        pixels(tmp_path / f"{name}.png") for name in ("en", "pt", "asked-en", "asked-pt")
    )
    assert np.array_equal(en, asked_en) and np.array_equal(pt, asked_pt)
    assert not np.array_equal(en, pt)


def test_a_sheet_reopens_in_the_language_it_was_made_in(lumiar, tmp_path):
    made = ("capture", "phong-terms", *SMALL)
    lumiar(*made, "--lang", "pt", "-o", "asked.png", env={"LC_ALL": "C"})
    lumiar(*made, "-o", "spoken.png", env={"LC_ALL": "pt_BR.UTF-8"})
    for name in ("asked", "spoken"):
        lumiar("capture", f"{name}.png", "-o", "again.png", env={"LC_ALL": "C"})
        assert np.array_equal(pixels(tmp_path / "again.png"), pixels(tmp_path / "asked.png"))


def test_help_and_version(lumiar):
    assert lumiar("--help").stdout.startswith("usage: lumiar VERB")
    assert lumiar().stdout == lumiar("help").stdout
    assert re.fullmatch(r"lumiar \d+\.\d+\.\d+\n", lumiar("--version").stdout)
    for verb in ("capture", "info", "source", "compare", "measure", "lesson", "list"):
        assert f"usage: lumiar {verb}" in lumiar(verb, "--help").stdout


def test_a_closed_pipe_is_no_drama(tmp_path):
    command = f"{sys.executable} -m lumiar source | head -1"
    done = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout.startswith("// ====") and done.stderr == ""


def test_progress_is_told_when_it_takes_long(lumiar, tmp_path):
    (tmp_path / "slow.glsl").write_text(LIMITS % SLOW.replace("65000", "40"))
    done = lumiar("capture", "--model", "slow.glsl", "--size", "1600x1600", "--samples", "16")
    assert re.search(r"lumiar: lumiar\.png:  ?\d+%, \d+ s left\n", done.stderr)


def test_eight_at_once_make_the_same_bytes(tmp_path):
    runs = [start(tmp_path, "capture", *SMALL, "-o", f"{i}.png") for i in range(8)]
    assert [run.wait(60) for run in runs] == [0] * 8
    assert len({(tmp_path / f"{i}.png").read_bytes() for i in range(8)}) == 1
    for run in runs:
        run.communicate()


def test_a_cached_mesh_needs_only_what_it_needs(lumiar, tmp_path):
    lumiar("capture", "--mesh", "suzanne", *SMALL)
    heavy = "numpy matplotlib PIL trimesh pyrr glfw imgui_bundle tomllib json asyncio shutil"
    heavy += " lumiar.mesh"
    code = (
        "import sys; from lumiar import cli\n"
        "cli.run(['capture', '--mesh', 'suzanne', '--size', '48x32'])\n"
        f"print([m for m in '{heavy}'.split() if m in sys.modules])"
    )
    run = [sys.executable, "-c", code]
    done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.split("\n")[1] == "[]"


def test_as_a_library(tmp_path):
    picture = capture(Scene.default().set(size=(40, 30), mesh="teapot"))
    assert picture._repr_png_().startswith(b"\x89PNG")
    assert picture.size == (40, 30) and len(picture.pixels) == 40 * 30 * 3
    capture(Scene.load("teapot").set(size=(40, 30)), tmp_path / "t.png")
    assert pixels(tmp_path / "t.png").shape == (30, 40, 3)
    capture(Scene.default().set(size=(8, 8)), str(tmp_path / "t.hdr"))
    assert (tmp_path / "t.hdr").read_bytes().startswith(b"#?RADIANCE")
    assert os.listdir(tmp_path)
