"""GLSL that crashes or stalls a driver, and forty broken saves: the window goes on as it was."""

import os
import random
import time

import pytest
from test_editor import rest
from test_window import MODEL, plain, press, settle, shown

from lumiar import arguments, catalog, files, trial, verbs
from lumiar.desktop import glfw
from lumiar.document import Document
from lumiar.trial import Trial
from lumiar.window import Viewer

SIZE = (720, 300)
CRASH = MODEL % " * float((-2147483647 - 1) / -1)"  # SIGFPE in the compiler of Mesa
TREE = "float f0(float x) { return sin(x); }\n" + "".join(
    f"float f{i}(float x) {{ return f{i - 1}(x) * f{i - 1}(x + {i}.0); }}\n" for i in range(1, 15)
)
STALL = TREE + MODEL % " * f14(L.x)"  # 16384 sines in one expression: many seconds of compiling
SLOW = MODEL.replace("return", "for (int i = 0; i < 8000; i++) L = sin(L + exp(V)); return") % ""


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    path = tmp_path / "own.glsl"
    path.write_text(MODEL % "")
    return path


def opened(path):
    return Viewer(plain().changed("model", str(path)), "en", hidden=True, size=SIZE)


def save(one, path, data):
    """Save a file and wait until the window has made up its mind about it."""
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    one._reload([str(path)])
    settle(one)


@pytest.mark.parametrize(
    ("text", "limit", "said"),
    [
        (CRASH, 8.0, "crashes the driver (SIGFPE)"),
        (STALL, 0.8, "hangs the driver"),
        (SLOW, 8.0, "too slow"),
    ],
)
def test_what_crashes_or_stalls_a_driver_leaves_the_window(own, monkeypatch, text, limit, said):
    monkeypatch.setattr(trial, "LIMIT", limit)
    monkeypatch.setattr(trial, "SLOW", 1.0)
    with opened(own) as viewer:
        settle(viewer)
        before, child = shown(viewer), viewer.trial._child.pid
        save(viewer, own, text)
        fault = viewer.document.fault
        assert fault.startswith(f"{own}: ") and said in fault and "\n" not in fault
        assert (shown(viewer) == before).all() and viewer.scene.objects[0].model.text == MODEL % ""
        assert (viewer.trial._child.pid == child) == (text == SLOW)  # else it was replaced
        viewer._push(viewer.scene.set(k=0.9))  # the last good one stays alive meanwhile
        settle(viewer)
        assert (shown(viewer) != before).any() and viewer.document.fault == fault
        viewer.document.undo()
        save(viewer, own, MODEL % " * 1.0")
        assert not viewer.document.fault and (shown(viewer) == before).all()


def test_the_mouse_is_not_kept_waiting(own, monkeypatch):
    monkeypatch.setattr(trial, "LIMIT", 0.5)
    with opened(own) as viewer:
        settle(viewer)
        own.write_text(STALL)
        viewer._reload([str(own)])
        frames = 0
        while viewer.trial.busy:
            viewer.desktop.move(300, 100 + frames % 50)
            assert viewer.frame()
            frames += 1
        assert frames > 3 and viewer.document.settle() is None


def test_a_model_that_crashes_named_at_the_start_opens_and_recovers(own):
    own.write_text(CRASH)
    load = lambda: verbs._viewed(arguments.parse("view", [str(own)]))  # noqa: E731
    with Viewer(Document(load(), "own", load=load), "en", hidden=True, size=SIZE) as viewer:
        settle(viewer)
        neutral = shown(viewer)
        assert f"{own}: crashes the driver" in viewer.document.fault and neutral.any()
        assert viewer.document.history.able == ()  # no way back to it
        press(viewer, glfw.KEY_F7)
        assert viewer.drawer.tool.path == str(own)
        press(viewer, glfw.KEY_F7)
        save(viewer, own, MODEL % "")
        assert not viewer.document.fault and (shown(viewer) != neutral).any()
        assert viewer.document.history.able == ()


def test_reading_all_again_tries_again(own, monkeypatch):
    with opened(own) as viewer:
        settle(viewer)
        monkeypatch.setattr(viewer.trial, "_patience", -1.0)
        monkeypatch.setattr(viewer.trial, "expect", lambda *_: None)
        save(viewer, own, MODEL % " * 0.5")
        assert "too slow" in viewer.document.fault
        monkeypatch.setattr(viewer.trial, "_patience", 1e9)
        save(viewer, own, MODEL % " * 0.5")
        assert "too slow" in viewer.document.fault  # what is known is not tried again
        press(viewer, glfw.KEY_F5)
        assert not viewer.document.fault
        assert viewer.scene.objects[0].model.text == MODEL % " * 0.5"


def test_what_is_dropped_or_typed_is_tried_first_too(own):
    bad = own.parent / "bad.glsl"
    bad.write_text(CRASH)
    with opened(own) as viewer:
        settle(viewer)
        before = shown(viewer)
        viewer.desktop.events.append(("drop", [str(bad)]))
        settle(viewer)
        assert f"{bad}: crashes the driver" in viewer.document.fault
        viewer.document.gate.edit(str(own), CRASH, 0.0)
        rest(viewer)
        assert f"{own}: crashes the driver" in viewer.document.fault
        assert (shown(viewer) == before).all() and viewer.scene.objects[0].model.path == str(own)


def test_a_crash_that_was_typed_is_not_repeated_when_the_window_is_restored(own):
    with opened(own) as viewer:
        viewer.document.gate.edit(str(own), CRASH, 0.0)
    scene = plain().changed("model", str(own))
    with Viewer(Document(scene, restored=True), "en", hidden=True, size=SIZE) as again:
        settle(again)
        assert "crashes the driver" in again.document.fault
        press(again, glfw.KEY_F7)
        assert again.drawer.tool.sheets[str(own)].text == CRASH and own.read_text() == MODEL % ""


def test_where_no_process_can_be_started_all_is_compiled_directly(own, monkeypatch):
    monkeypatch.setattr(files.sys, "executable", "/nowhere/python")
    with opened(own) as viewer:
        settle(viewer)
        before = shown(viewer)
        assert not viewer.trial.works
        save(viewer, own, MODEL % " * nope")
        assert f"{own}:4: " in viewer.stage.fault and (shown(viewer) == before).all()
        save(viewer, own, MODEL % "")
        assert not viewer.stage.fault and (shown(viewer) == before).all()


def test_where_nothing_can_be_drawn_there_all_is_compiled_directly(own, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", "")
    monkeypatch.setattr(trial, "CODE", "raise SystemExit(3)")
    with opened(own) as viewer:
        settle(viewer)
        assert not viewer.trial.works and shown(viewer).any()


def test_the_process_ends_with_the_window(own):
    with opened(own) as viewer:
        settle(viewer)
        child = viewer.trial._child
    assert child.poll() is not None


def test_what_is_known_is_not_tried_again(own):
    model = catalog.read("model", str(own))
    scene = plain().changed("model", str(own))
    judge = Trial()
    try:
        judge.ask(scene, [model])
        judge.wait()
        assert judge.line(model) == "" and judge.line(model._replace(text="other")) is None
    finally:
        judge.release()


def broken(chance):
    """Return a text that no model can be, by chance: bytes."""
    text = (MODEL % "").encode()
    lines = text.splitlines(keepends=True)
    return chance.choice(
        (
            lambda: text[: chance.randrange(len(text) - 12)],
            lambda: chance.randbytes(chance.randrange(1, 4000)),
            lambda: b"",
            lambda: b"// " + b"x" * 10_000_000,
            lambda: b"".join(lines[:3]) + b"vec3 scatter(vec3 L, vec3 V) { for (;;) {} }",
            lambda: b"".join(lines[:3]) + b"while (true) L += V;",
            lambda: b'#include "lib/nothing.glsl"\n' + text,
            lambda: b'#include "models/phong.glsl"\n' + text,
            lambda: b'#include "../../secret.glsl"\n' + text,
            lambda: text + lines[-1],
            lambda: text[:90] + b"\0" + text[90:],
            lambda: text.replace(b"\n", b"\r\n").replace(b"return", b"retrun"),
            lambda: b"\xef\xbb\xbf" + text.replace(b"tint *", b"tint"),
            lambda: text.replace(b"max", b"scatter"),  # calls itself
            lambda: text.replace(b"[0, 1]", b"[1, 0]"),
            lambda: CRASH.encode(),
        )
    )()


def test_forty_broken_saves(own, capfd):
    """Each leaves the last picture and says one line that names the file; the good text mends."""
    chance, seen = random.Random(1975), []
    with opened(own) as viewer:
        settle(viewer)
        first = shown(viewer)
        for number in range(40):
            data = broken(chance)
            if number % 8 == 7:
                own.unlink()
                viewer.frame()
            save(viewer, own, data)
            fault = viewer.document.fault
            assert fault.startswith(f"{own}:") and "\n" not in fault and len(fault) <= 300, data
            assert fault.isprintable() and (shown(viewer) == first).all(), (data[:300], fault)
            seen.append(fault)
        save(viewer, own, b"\xef\xbb\xbf" + (MODEL % "").replace("\n", "\r\n").encode())
        assert not viewer.document.fault and (shown(viewer) == first).all()
        assert viewer.scene.objects[0].values["k"] == 0.5
    assert len({fault.partition(": ")[2] for fault in seen}) > 10
    assert "Traceback" not in capfd.readouterr().err


def test_a_save_is_tried_while_it_settles(own):
    """By the time that it counts, the window already knows."""
    with opened(own) as viewer:
        settle(viewer)
        own.write_text(MODEL % " * 0.5")
        os.utime(own, ns=(time.time_ns(), time.time_ns() + 1000))
        viewer.frame()
        viewer.frame()
        assert viewer.trial.busy and not viewer.document.gate.waiting
        viewer.trial.wait()
        viewer._reload([str(own)])
        assert not viewer.document.gate.waiting
        assert viewer.scene.objects[0].model.text == MODEL % " * 0.5"
