"""lumiar.formats.read: which files are opened, by whom they are read, what refuses them."""

import base64
import json
import os
import subprocess
import sys

import numpy as np
import pytest

from lumiar import formats
from lumiar.errors import Mistake, one_line

OBJ = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
OFF = b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
PLY = b"""ply\nformat ascii 1.0
element vertex 3\nproperty float x\nproperty float y\nproperty float z
element face 1\nproperty list uchar int vertex_index\nend_header
0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"""
STL = b"""solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0
endloop\nendfacet\nendsolid\n"""
TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
BUFFER = np.array(TRIANGLE, "<f4").tobytes()


def gltf(uri):
    return json.dumps({
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": uri}],
    }).encode()  # fmt: skip


GLTF = gltf("data:;base64," + base64.b64encode(BUFFER).decode())


def refused(path, *words):
    with pytest.raises(Mistake) as refusal:
        formats.read(path)
    message = one_line(refusal.value)  # as the command line shows it
    assert str(refusal.value).isprintable() and len(message) <= 300
    assert all(word in message for word in words), message
    return message


@pytest.mark.parametrize(
    ("name", "data"),
    [
        *(("m.obj", OBJ), ("M.OBJ", OBJ), ("a b.c.Obj", OBJ), ("m.off", OFF), ("m.ply", PLY)),
        *(("m.stl", STL), ("m.gltf", GLTF), ("m.glb", GLTF), ("\udcff\u00e9\n.obj", OBJ)),
    ],
)
def test_the_extension_picks_the_reader(tmp_path, name, data):
    path = tmp_path / name
    path.write_bytes(data)
    for given in (path, str(path), os.fsencode(path)):
        read = formats.read(given)
        assert read.positions[read.corners].tolist() == TRIANGLE
    read = formats.parse(data, str(path))
    assert read.positions[read.corners].tolist() == TRIANGLE


def test_the_home_folder_may_be_a_tilde(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "m.obj").write_bytes(OBJ)
    (tmp_path / "bad.obj").write_bytes(OBJ + b"f 1 2 4\n")
    (tmp_path / "m.gltf").write_bytes(gltf("m.bin"))
    (tmp_path / "m.bin").write_bytes(BUFFER)
    assert len(formats.read("~/m.obj").sizes) == 1
    assert len(formats.read("~/m.gltf").sizes) == 1
    assert refused("~/bad.obj").startswith("~/bad.obj:5: ")  # as the user wrote it


def test_what_is_no_mesh_file_is_not_opened(tmp_path):
    refused(tmp_path / "none.obj", "none.obj: ", "no such file")
    refused(tmp_path, "regular file")
    refused("/dev/zero", "/dev/zero: ", "regular file")
    refused("", "no such file")
    refused("a\0b.obj", "cannot be read")
    refused("\ud800.obj")
    refused("x" * 5000 + ".obj", "too long")
    (tmp_path / "loop.obj").symlink_to("loop.obj")
    refused(tmp_path / "loop.obj", "loop.obj: ")
    os.mkfifo(tmp_path / "pipe.obj")
    refused(tmp_path / "pipe.obj", "pipe.obj: ", "regular file")
    (tmp_path / "m.fbx").write_bytes(b"x")
    refused(tmp_path / "m.fbx", ".obj, .ply, .stl, .off, .gltf, .glb")
    refused(tmp_path / "m", "m: ", "no such file")
    (tmp_path / "m").write_bytes(OBJ)
    refused(tmp_path / "m", ".obj, .ply")
    for name in ("m.obj", "m.ply", "m.stl", "m.off", "m.gltf", "m.glb"):
        (tmp_path / name).write_bytes(b"")
        refused(tmp_path / name, f"{name}: ", "empty")
    with open(tmp_path / "huge.obj", "wb") as file:
        file.truncate((512 << 20) + 1)
    refused(tmp_path / "huge.obj", "536870913 bytes; allowed for a mesh file: up to 536870912")


def test_a_file_that_may_not_be_read(tmp_path):
    (tmp_path / "m.obj").write_bytes(OBJ)
    (tmp_path / "m.obj").chmod(0)
    me = os.geteuid()
    if me == 0:  # root may read every file: be nobody meanwhile
        os.seteuid(65534)
    try:
        refused(tmp_path / "m.obj", "ermission")
    finally:
        os.seteuid(me)


def test_a_long_name_leaves_room_for_what_is_wrong(tmp_path):
    path = tmp_path / ("n" * 100) / ("o" * 100) / ("p" * 100) / "m.obj"
    path.parent.mkdir(parents=True)
    path.write_bytes(OBJ + b"f 1 2 4\n")
    refused(path, "m.obj:5: ", "vertex 4 of 3", "write 1 to 3")


def test_files_beside_a_gltf_file(tmp_path):
    folder = tmp_path / "in"
    (folder / "sub").mkdir(parents=True)
    for name in ("m.bin", "a b.bin", "sub/m.bin", "%41.bin", "é.bin", "../out.bin"):
        (folder / name).write_bytes(BUFFER)
    (folder / "short.bin").write_bytes(BUFFER[:-1])
    (folder / "link.bin").symlink_to("sub/m.bin")
    (folder / "out.bin").symlink_to("../out.bin")
    os.mkfifo(folder / "pipe.bin")
    path = folder / "m.gltf"
    for uri in ("m.bin", "./m.bin", "sub/m.bin", "a%20b.bin", "a b.bin", "link.bin", "%2541.bin",
                "%C3%A9.bin", "é.bin"):  # fmt: skip
        path.write_bytes(gltf(uri))
        assert formats.read(path).positions.tolist() == TRIANGLE
    for uri in (
        *("../out.bin", "%2e%2e/out.bin", "sub/../../out.bin", "out.bin", "..\\out.bin", "C:m.bin"),
        *(str(folder / "m.bin"), f"file://{folder}/m.bin", "http://localhost/m.bin", "/dev/zero"),
        *("none.bin", "short.bin", "pipe.bin", "sub", ".", "", "m.bin%00", "m.bin?x", "m.bin#x"),
        *("~/m.bin", "$HOME/m.bin", "\ud800.bin", "%ff.bin", "x" * 5000),
    ):
        path.write_bytes(gltf(uri))
        assert refused(path).startswith(f"{path}: buffer 0")
    path.write_bytes(gltf("none.bin"))
    refused(path, "none.bin", "no such file")


def test_the_files_beside_a_gltf_file_are_limited_together(tmp_path, monkeypatch):
    document = json.loads(gltf("a.bin"))
    document["buffers"] = [{"byteLength": 36, "uri": uri} for uri in ("a.bin", "./a.bin", "b.bin")]
    document["bufferViews"] = [{"buffer": i, "byteLength": 36} for i in range(3)]
    document["accessors"] = [{**document["accessors"][0], "bufferView": i} for i in range(3)]
    document["meshes"][0]["primitives"] = [{"attributes": {"POSITION": i}} for i in range(3)]
    path = tmp_path / "m.gltf"
    path.write_bytes(json.dumps(document).encode())
    for name in "ab":
        (tmp_path / f"{name}.bin").write_bytes(BUFFER.ljust(1 << 20))
    assert len(formats.read(path).sizes) == 3
    monkeypatch.setattr(formats, "LARGEST", 2 << 20)
    assert len(formats.read(path).sizes) == 3  # a.bin counts once
    monkeypatch.setattr(formats, "LARGEST", (2 << 20) - 1)
    refused(path, "b.bin")


def test_too_little_memory_is_a_mistake_too(tmp_path, monkeypatch):
    def hungry(*_):
        raise MemoryError

    (tmp_path / "m.obj").write_bytes(OBJ)
    monkeypatch.setattr("lumiar.formats.obj.read", hungry)
    refused(tmp_path / "m.obj", "memory")


LIMITED = """
import resource, sys
from lumiar import formats, errors
from lumiar.formats import obj, off, ply, stl, gltf, check, text
resource.setrlimit(resource.RLIMIT_AS, (1500 << 20, 1500 << 20))
try:
    formats.read(sys.argv[1])
except errors.Mistake as mistake:
    print(mistake)
"""


@pytest.mark.parametrize(("name", "begin"), [("m.obj", b"v 0 0 0\n"), ("m.glb", b"glTF\2\0\0\0")])
def test_the_largest_files_of_nothing_take_under_1500_MB(tmp_path, name, begin):
    """Of address space: all memory, the program's own and NumPy's threads included."""
    path = tmp_path / name
    path.write_bytes(begin)
    with open(path, "r+b") as file:
        file.truncate(512 << 20)  # zeros, which take no room on the disk
    command = [sys.executable, "-c", LIMITED, str(path)]
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    ended = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=30)
    assert ended.stderr == ""
    assert ended.stdout.startswith(f"{path}:")
    assert "memory" not in ended.stdout
