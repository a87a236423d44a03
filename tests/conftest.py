"""What the tests share: one renderer, a cache of their own, and the command line as a process."""

import os
import subprocess
import sys

import pytest

from lumiar.renderer import Renderer


@pytest.fixture(scope="session", autouse=True)
def own_cache(tmp_path_factory):
    """Keep the tests out of the user's mesh cache, and the user's habits out of the tests."""
    os.environ.pop("PYTHONUNBUFFERED", None)
    os.environ["XDG_CACHE_HOME"] = str(tmp_path_factory.mktemp("cache"))


@pytest.fixture(scope="session")
def renderer():
    with Renderer() as one:
        yield one


@pytest.fixture
def lumiar(tmp_path):
    """Run `lumiar ARGUMENTS` as a user would, in a folder of its own; without a display."""

    def run(*arguments, code=0, cwd=tmp_path, timeout=120, env=None, **options):
        process = subprocess.run(
            [sys.executable, "-m", "lumiar", *map(str, arguments)],
            cwd=cwd,
            env={**os.environ, "DISPLAY": "", "WAYLAND_DISPLAY": "", **(env or {})},
            capture_output=True,
            text=True,
            timeout=timeout,
            **options,
        )
        assert process.returncode == code, (process.returncode, process.stdout, process.stderr)
        assert "Traceback" not in process.stderr
        if code == 2:
            line = process.stderr.removesuffix("\n")
            assert "\n" not in line and line.startswith("lumiar: ") and len(line) <= 320, line
        return process

    return run
