"""Files are written whole or not at all, whoever else writes them at the same time."""

import os
import subprocess
from concurrent.futures import ThreadPoolExecutor

import pytest

from lumiar import files

SIZE = 200_000


def test_a_file_that_many_write_at_once_is_always_whole(tmp_path):
    path = tmp_path / "one.bin"
    files.write_whole(path, [bytes([0]) * SIZE])
    seen = []

    def write(letter):
        for _ in range(6):
            files.write_whole(path, [bytes([letter])] * (SIZE // 1000) + [bytes([letter]) * SIZE])
            seen.append(path.read_bytes())

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(write, range(1, 9)))
    assert len(seen) == 48
    assert all(len(data) == SIZE + SIZE // 1000 and len(set(data)) == 1 for data in seen)
    assert os.listdir(tmp_path) == ["one.bin"]


def test_what_fails_halfway_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "one.bin"
    files.write_whole(path, [b"old"])

    def chunks():
        yield b"half"
        raise OSError("the disk is full")

    with pytest.raises(OSError, match="the disk is full"):
        files.write_whole(path, chunks())
    assert path.read_bytes() == b"old" and os.listdir(tmp_path) == ["one.bin"]


def test_a_process_of_its_own_takes_no_module_from_the_current_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LUMIAR_SUPERVISOR", "99")
    for name in ("random", "json", "lumiar"):  # as a student may call what he writes
        (tmp_path / f"{name}.py").write_text("raise SystemExit(3)")
    code = "import os, random, json, lumiar; assert 'LUMIAR_SUPERVISOR' not in os.environ"
    command, environment = files.python("-c", code)
    assert subprocess.run(command, env=environment).returncode == 0
