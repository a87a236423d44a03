"""The README is typed as written: its commands, its model, its scene and its Python."""

import os
import re
import shlex
import shutil
import sys
from pathlib import Path
from subprocess import CalledProcessError, check_call

import pytest
from PIL import Image

from lumiar import Scene, capture, cli

README = Path(__file__).parents[1].joinpath("README.md").read_text(encoding="utf-8")
LINES = re.findall(r"^    lumiar (.*?)(?: +#.*)?$", README, re.MULTILINE)
BLOCKS = {
    language: re.findall(rf"^```{language}\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
    for language in ("glsl", "toml", "python")
}
QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the files that the README's reader is said to have."""
    folder = tmp_path_factory.mktemp("reader")
    (folder / "bunny.obj").write_text(QUAD)
    (folder / "minnaert.glsl").write_text(BLOCKS["glsl"][0])
    (folder / "mine.glsl").write_text(BLOCKS["glsl"][0])
    (folder / "scene.toml").write_text(BLOCKS["toml"][0])
    Image.new("RGB", (8, 8), (10, 20, 30)).save(folder / "expected.png")
    shutil.copy(folder / "expected.png", folder / "found.png")
    return folder


def test_there_is_something_to_type():
    assert len(LINES) >= 11
    assert all(BLOCKS.values())


@pytest.mark.parametrize("line", LINES)
def test_commands(line, folder, monkeypatch):
    monkeypatch.chdir(folder)
    assert cli.run(shlex.split(line)) == 0


def test_the_scene(folder, monkeypatch):
    monkeypatch.chdir(folder)
    assert capture(Scene.load("scene.toml")).size == (640, 480)


def test_the_python(folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setenv("PATH", os.path.dirname(sys.executable), prepend=os.pathsep)
    for block in BLOCKS["python"]:
        names = {}
        exec(block, names)
        for name in names.keys() & {"test_my_shader_looks_as_it_did"}:
            shutil.copy(folder / "minnaert.png", folder / "expected.png")
            with pytest.raises(CalledProcessError):  # the sheet is no picture of this size
                names[name]()
            check_call(["lumiar", "capture", "--model", "mine.glsl", "-o", "expected.png"])
            names[name]()


def test_it_is_short():
    assert len(README.splitlines()) <= 150
