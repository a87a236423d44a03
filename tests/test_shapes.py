"""The built-in shapes: closed, wound outward, with normals and tangents of the true surfaces."""

import numpy as np
import pytest

from lumiar import geometry, mesh, shapes
from lumiar.errors import Mistake

CASES = {
    "sphere": {"subdivision": 3, "radius": 1.5},
    "uv_sphere": {"rings": 12, "segments": 20, "radius": 0.5},
    "torus": {"major": 2.0, "minor": 0.5, "rings": 40, "segments": 24},
    "torus_knot": {"p": 2, "q": 3, "tube": 0.2, "rings": 300, "segments": 24},
    "plane": {"width": 3.0, "segments": 4},
    "box": {"width": 2.0, "segments": 3},
    "cylinder": {"radius": 1.0, "height": 3.0, "segments": 48},
    "teapot": {"segments": 8},
}
VOLUMES = {  # of the true solids
    "sphere": 4 / 3 * np.pi * 1.5**3,
    "uv_sphere": 4 / 3 * np.pi * 0.5**3,
    "torus": 2 * np.pi**2 * 2.0 * 0.5**2,
    "box": 8.0,
    "cylinder": np.pi * 3.0,
}


def made(name, **changes):
    return shapes.make(name, {**CASES[name], **changes})


def edges(one):
    p = one.positions[one.triangles]
    return p, np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])


def test_every_shape_is_tried():
    assert set(CASES) == set(geometry.SHAPES)
    for name, parameters in geometry.SHAPES.items():
        defaults = {p.name: p.default for p in parameters}
        assert shapes.make(name, defaults).triangles.size


@pytest.mark.parametrize("name", CASES)
def test_normals_and_tangents_are_a_frame(name):
    one = made(name)
    assert np.allclose(np.linalg.norm(one.normals, axis=1), 1.0, atol=1e-12)
    along = mesh.tangent_frames(one)
    assert np.allclose(np.linalg.norm(along[:, :3], axis=1), 1.0, atol=1e-12)
    assert np.abs((along[:, :3] * one.normals).sum(1)).max() < 1e-12
    assert set(np.unique(along[:, 3])) <= {1.0, -1.0}


@pytest.mark.parametrize("name", CASES)
def test_triangles_are_wound_outward_and_have_area(name):
    one = made(name)
    _, face = edges(one)
    assert (np.linalg.norm(face, axis=1) > 0.0).all()
    assert ((face[:, None] * one.normals[one.triangles]).sum(2) > 0.0).all()


@pytest.mark.parametrize("name", CASES)
def test_closed_says_whether_it_is(name):
    one = made(name)
    places = mesh.weld(one.positions.astype(np.float32).astype(np.float64))
    assert mesh.is_closed(places[one.triangles]) == one.closed
    assert one.closed == (name not in ("plane", "teapot"))


@pytest.mark.parametrize("name", VOLUMES)
def test_the_volume_tends_to_that_of_the_solid(name):
    p, face = edges(made(name))
    volume = (p[:, 0] * face).sum() / 6.0
    assert volume == pytest.approx(VOLUMES[name], rel=0.08)


def test_normals_are_those_of_the_surface_not_of_the_triangles():
    sphere = made("sphere")
    assert np.allclose(sphere.normals, sphere.positions / 1.5, atol=1e-14)
    torus = made("torus")
    flat = torus.positions * [1, 0, 1]
    middle = 2.0 * flat / np.linalg.norm(flat, axis=1, keepdims=True)
    assert np.allclose(torus.normals, (torus.positions - middle) / 0.5, atol=1e-12)
    around = np.cross([0, 1, 0], torus.positions)
    around /= np.linalg.norm(around, axis=1, keepdims=True)
    assert np.allclose(torus.tangents[:, :3], around, atol=1e-12)


def test_the_knot_is_a_tube():
    one = made("torus_knot")
    axis = one.positions - 0.2 * one.normals  # every vertex is one radius away from the curve
    ring, _ = np.unique(axis.round(9), axis=0, return_counts=True)
    assert len(ring) == 300


@pytest.mark.parametrize(("subdivision", "triangles"), [(0, 20), (1, 80), (5, 20480), (6, 81920)])
def test_an_icosphere_has_twenty_times_four_to_the_n_faces(subdivision, triangles):
    one = made("sphere", subdivision=subdivision)
    assert len(one.triangles) == triangles and len(one.positions) == triangles // 2 + 2


def test_the_teapot_is_newells():
    one = made("teapot", segments=16)
    high, low = one.positions.max(0), one.positions.min(0)
    # Newell's points: x from -3 to 3.5 (spout), body of radius 2, height 3.15; here half as large
    assert np.allclose(high - low, [3.217, 1.575, 2.0], atol=2e-3)
    # analytic normals: those of twice as fine a mesh agree where the vertices are the same
    fine = made("teapot", segments=32)
    where = {tuple(p): n for p, n in zip(fine.positions.round(9), fine.normals, strict=True)}
    shared = [
        (n, where[tuple(p)]) for p, n in zip(one.positions.round(9), one.normals, strict=True)
    ]
    agreeing = sum(np.dot(a, b) > 1 - 1e-9 for a, b in shared) / len(shared)
    assert agreeing > 0.95  # seams between patches have a normal on each side
    tip = one.normals[np.argmax(one.positions[:, 1])]
    assert np.allclose(tip, [0, 1, 0], atol=1e-9)


def test_impossible_shapes_are_told():
    with pytest.raises(Mistake, match="make minor smaller"):
        made("torus", minor=3.0)
    with pytest.raises(Mistake, match="share a factor"):
        made("torus_knot", p=2, q=4)
