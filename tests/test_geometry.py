"""Meshes by name, and the cache of prepared ones."""

import os
import struct
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from lumiar import cache, geometry
from lumiar.errors import Mistake

TRIANGLE = "OFF\n3 1 0\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n"


@pytest.fixture(autouse=True)
def empty_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "lumiar"


def bytes_of(one):
    return [bytes(part) for part in one[:3]], one[3:]


@pytest.mark.parametrize("spec", ["sphere:subdivision=2", "teapot:segments=3", "suzanne", "file"])
@pytest.mark.parametrize("tangents", [False, True])
def test_a_mesh_is_the_same_from_the_cache(tmp_path, empty_cache, spec, tangents):
    if spec == "file":
        spec = str(tmp_path / "t.off")
        (tmp_path / "t.off").write_text(TRIANGLE)
    first = geometry.load(spec, tangents=tangents)
    assert len(list(empty_cache.iterdir())) == 1
    second = geometry.load(spec, tangents=tangents)
    assert bytes_of(first) == bytes_of(second)
    assert isinstance(second.vertices, memoryview)  # mapped, not read
    assert len(first.tangents) == (first.vertex_count * 16 if tangents else 0)


def test_the_second_time_needs_no_numpy(tmp_path):
    (tmp_path / "t.off").write_text(TRIANGLE)
    code = (
        "import sys; from lumiar import geometry; "
        "print(geometry.load(sys.argv[1]).triangle_count, 'numpy' in sys.modules)"
    )
    run = [sys.executable, "-c", code, str(tmp_path / "t.off")]
    assert subprocess.check_output(run, text=True) == "1 True\n"
    assert subprocess.check_output(run, text=True) == "1 False\n"


def test_the_cache_goes_by_content_not_by_name_or_time(tmp_path, empty_cache):
    path = tmp_path / "t.off"
    path.write_text(TRIANGLE)
    stamp = path.stat()
    assert geometry.load(str(path)).high == (2.0, 1.0, 0.0)
    path.write_text(TRIANGLE.replace("2 0 0", "3 0 0"))
    os.utime(path, ns=(stamp.st_atime_ns, stamp.st_mtime_ns))  # same name, size and time
    assert geometry.load(str(path)).high == (3.0, 1.0, 0.0)
    (tmp_path / "copy.off").write_text(TRIANGLE)
    geometry.load(str(tmp_path / "copy.off"))
    assert len(list(empty_cache.iterdir())) == 2


@pytest.mark.parametrize("uri", ["sub/t.bin", r"sub\/t.bin", r"sub/\u0074.bin", "sub/%74.bin"])
@pytest.mark.parametrize("kind", ["gltf", "glb"])
def test_a_gltf_is_its_buffers_too(tmp_path, uri, kind):
    """The .bin beside a file changes, the file does not; however its address is written."""
    import json

    def write(height):
        points = np.array([[0, 0, 0], [1, 0, 0], [0, height, 0]], "<f4").tobytes()
        (tmp_path / "sub" / "t.bin").write_bytes(points)

    (tmp_path / "sub").mkdir()
    tree = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": "HERE", "byteLength": 36}],
    }
    text = json.dumps(tree).replace("HERE", uri).encode()
    text += b" " * (-len(text) % 4)
    if kind == "glb":
        sizes = (2, len(text) + 20, len(text))
        text = struct.pack("<4s3I4s", b"glTF", *sizes, b"JSON") + text
    (tmp_path / f"t.{kind}").write_bytes(text)
    for height in (1.0, 5.0):
        write(height)
        assert geometry.load(str(tmp_path / f"t.{kind}")).high[1] == height


@pytest.mark.parametrize("damage", ["cut", "empty", "noise", "longer", "folder"])
def test_a_damaged_entry_is_made_again(empty_cache, damage):
    first = bytes_of(geometry.load("sphere:subdivision=1"))
    (entry,) = empty_cache.iterdir()
    data = entry.read_bytes()
    entry.unlink()
    damaged = {"cut": data[: len(data) // 2], "empty": b"", "noise": b"x" * 500}
    damaged["longer"] = data + b"\0"
    if damage == "folder":
        entry.mkdir()
    else:
        entry.write_bytes(damaged[damage])
    assert bytes_of(geometry.load("sphere:subdivision=1")) == first


@pytest.mark.parametrize("part", range(7))
def test_one_flipped_bit_anywhere_in_an_entry_is_noticed(empty_cache, part):
    """Its sizes and its key; vertices, tangents, indices, facts and notes."""
    parts = [bytes([i]) * 100 for i in range(1, 6)]
    cache.put("key", parts)
    assert [bytes(one) for one in cache.get("key")[:5]] == parts
    (entry,) = empty_cache.iterdir()
    data = bytearray(entry.read_bytes())
    at = [20, data.index(b"'key'") + 2, *(data.index(bytes([i]) * 100) + 50 for i in range(1, 6))]
    data[at[part]] ^= 1
    entry.write_bytes(data)
    assert cache.get("key") is None
    cache.put("key", parts)
    assert [bytes(one) for one in cache.get("key")[:5]] == parts


@pytest.mark.parametrize("where", [0.2, 0.5, 0.9])
def test_a_mesh_with_a_damaged_entry_is_made_again(empty_cache, where):
    first = bytes_of(geometry.load("sphere:subdivision=1", tangents=True))
    (entry,) = empty_cache.iterdir()
    data = bytearray(entry.read_bytes())
    data[int(len(data) * where)] ^= 0x10
    entry.write_bytes(data)
    assert bytes_of(geometry.load("sphere:subdivision=1", tangents=True)) == first
    assert entry.read_bytes() != bytes(data)  # and stored once more


def test_the_cache_is_used_from_many_threads_at_once(empty_cache):
    def use(i):
        for _ in range(10):
            cache.put("shared", [bytes([i]) * 50_000])
            found = cache.get("shared")  # another thread may have put its own, whole
            assert found is not None and len(set(bytes(found[0]))) == 1 and len(found[0]) == 50_000

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(use, range(8)))
    assert [p.suffix for p in empty_cache.iterdir()] == [".bin"]


def test_without_a_place_for_the_cache_all_works(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert geometry.load("sphere:subdivision=1").triangle_count == 80


def test_many_at_once_agree(empty_cache):
    with ThreadPoolExecutor(8) as pool:
        made = list(pool.map(lambda _: bytes_of(geometry.load("torus:rings=9")), range(24)))
    assert all(one == made[0] for one in made)
    assert len([p for p in empty_cache.iterdir() if p.suffix == ".tmp"]) == 0


def test_the_cache_forgets_the_oldest(empty_cache, monkeypatch):
    monkeypatch.setattr(cache, "LIMIT", 30_000)
    for i in range(8):
        cache.put(i, [bytes(10_000)])
        os.utime(cache._path(i), (i, i))
    cache.put("last", [b"x"])
    kept = [i for i in range(8) if cache.get(i)]
    assert kept and kept == list(range(8 - len(kept), 8)) and len(kept) <= 3
    assert bytes(cache.get("last")[0]) == b"x"


def test_leftovers_are_swept(empty_cache):
    cache.put(1, [b"x"])
    old = empty_cache / ".gone.bin.123.tmp"
    old.write_bytes(b"half")
    os.utime(old, (0, 0))
    cache.put(2, [b"y"])
    assert not old.exists()


def test_shipped_meshes_have_a_name():
    one = geometry.load("suzanne")
    assert one.triangle_count == 14842 and one.places == 7503


@pytest.mark.parametrize(
    ("spec", "told"),
    [
        ("spere", "no mesh 'spere'; did you mean 'sphere'?"),
        (
            "sphere:subdivision=12",
            "subdivision = 12.0 is not possible; allowed: a whole number, 0 to 9",
        ),
        ("sphere:subdivision", 'subdivision = "" is not possible'),
        ("sphere:5", "sphere has no parameter '5'; allowed: radius, subdivision"),
        ("gone.stl", "no file /"),
        ("", "no mesh ''"),
        ("x.blend", "or a file that ends in .obj"),
    ],
)
def test_what_is_no_mesh_is_told(spec, told):
    with pytest.raises(Mistake) as mistake:
        geometry.load(spec, where="here: ")
    assert str(mistake.value).startswith("here: ") and told in str(mistake.value)


def cube(path, side, at=0.0):
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    sides = ["0 1 3 2", "4 6 7 5", "0 4 5 1", "2 3 7 6", "0 2 6 4", "1 5 7 3"]
    points = [" ".join(repr(at + side * (c - 0.5)) for c in corner) for corner in corners]
    path.write_text("\n".join(["OFF", "8 6 0", *points, *(f"4 {side}" for side in sides)]))
    return str(path)


def test_a_mesh_far_away_is_drawn_as_at_the_origin(tmp_path):
    here = geometry.load(cube(tmp_path / "here.off", 1.0))
    there = geometry.load(cube(tmp_path / "there.off", 1.0, at=1e7))
    arrays = [np.frombuffer(one.vertices, np.float32) for one in (here, there)]
    assert np.abs(arrays[0] - arrays[1]).max() < 1e-6 and there.closed
    assert (there.indices, here.notes) == (here.indices, ())
    assert there.notes[0].startswith("moved by (-10000000, -10000000, -10000000)")


@pytest.mark.parametrize("side", [1e-46, 1e-40, 1e-19])
def test_a_mesh_too_small_for_32_bits_is_refused(tmp_path, side):
    with pytest.raises(Mistake, match=r"small\.off: smaller than 1e-18"):
        geometry.load(cube(tmp_path / "small.off", side))


@pytest.mark.parametrize("side", [1e-17, 1e-6, 1e6, 1e17])
def test_a_mesh_of_any_other_size_has_the_normals_of_its_shape(tmp_path, side):
    one = geometry.load(cube(tmp_path / "any.off", side))
    normals = np.frombuffer(one.vertices, np.float32).reshape(-1, 6)[:, 3:]
    assert (np.sort(np.abs(normals), axis=1) == [0.0, 0.0, 1.0]).all() and one.closed
    assert one.radius == pytest.approx(side * 0.75**0.5)


def test_bounds_are_of_what_is_drawn(tmp_path):
    (tmp_path / "t.off").write_text(
        TRIANGLE.replace("3 1 0\n", "4 1 0\n").replace("3 0 1 2", "9 9 9\n3 0 1 2")
    )
    one = geometry.load(str(tmp_path / "t.off"))
    assert (one.low, one.high) == ((0.0, 0.0, 0.0), (2.0, 1.0, 0.0))
    assert one.centre == (1.0, 0.5, 0.0) and one.radius == pytest.approx(np.hypot(1.0, 0.5))
