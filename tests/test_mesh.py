"""Polygons made into triangles with normals: corners, creases, seams, and what is broken."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lumiar import mesh
from lumiar.errors import Mistake
from lumiar.polygons import MAX_CONCAVE, Polygons, triangulate

CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def polygons(points, faces, **more):
    corners = np.array([c for face in faces for c in face])
    return Polygons(np.array(points, float), corners, np.array([len(f) for f in faces]), **more)


def area(points, triangles):
    p = points[triangles]
    return np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])


def test_a_cube_keeps_its_edges_and_a_sphere_loses_them():
    cube = mesh.build(polygons(CUBE, SIDES))
    assert (len(cube.triangles), len(cube.positions), cube.closed) == (12, 24, True)
    assert np.allclose(np.abs(cube.normals).max(1), 1.0)
    smooth = mesh.build(polygons(CUBE, SIDES), crease=180)
    assert len(smooth.positions) == 8
    assert np.allclose(smooth.normals, CUBE[[0, 1, 2, 3, 4, 5, 6, 7]] / np.sqrt(3), atol=1e-12)
    assert len(mesh.build(polygons(CUBE, SIDES), crease=89).positions) == 24
    assert len(mesh.build(polygons(CUBE, SIDES), crease=91).positions) == 8


def test_normals_do_not_depend_on_how_faces_are_cut():
    """The corner of a cube: weights by angle make the diagonals of its sides not matter."""
    for turn in range(4):
        turned = [side[turn:] + side[:turn] for side in SIDES]
        smooth = mesh.build(polygons(CUBE, turned), crease=180)
        at = {tuple(p): n for p, n in zip(smooth.positions, smooth.normals, strict=True)}
        for corner in CUBE:
            assert np.allclose(at[tuple(corner)], corner / np.sqrt(3), atol=1e-12)


def test_smooth_normals_of_a_round_surface_are_its_own():
    from lumiar import shapes

    ball = shapes.make("sphere", {"subdivision": 4, "radius": 1.0})
    built = mesh.build(polygons(ball.positions, ball.triangles.tolist()))
    assert len(built.positions) == len(ball.positions) and built.closed
    order = np.lexsort(built.positions.T), np.lexsort(ball.positions.T)
    cosine = (built.normals[order[0]] * ball.normals[order[1]]).sum(1)
    assert np.degrees(np.arccos(np.clip(cosine, -1, 1))).max() < 0.5


def test_a_crease_splits_only_where_it_is():
    """A roof: its ridge is sharp at 80 degrees, smooth at 100."""
    roof = [[0, 0, 0], [2, 0, 0], [2, 1, 1], [0, 1, 1], [2, 0, 2], [0, 0, 2]]
    faces = [[1, 0, 3, 2], [2, 3, 5, 4]]
    sharp = mesh.build(polygons(roof, faces), crease=80)
    smooth = mesh.build(polygons(roof, faces), crease=100)
    assert len(sharp.positions) == 8 and len(smooth.positions) == 6
    ridge = smooth.normals[np.isclose(smooth.positions[:, 1], 1.0)]
    assert np.allclose(np.abs(ridge), [0, 1, 0], atol=1e-12)


def test_seams_of_texture_do_not_show_in_the_normals():
    """A strip whose middle edge has two texture coordinates is split there, and stays smooth."""
    points = [[0, 0, 0], [1, 0.2, 0], [2, 0, 0], [0, 0, 1], [1, 0.2, 1], [2, 0, 1]]
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    faces = [[0, 3, 4, 1], [1, 4, 5, 2]]
    built = mesh.build(polygons(points, faces, uvs=uvs, uv_of=np.array([0, 3, 2, 1, 0, 3, 2, 1])))
    assert len(built.positions) == 8
    middle = built.normals[np.isclose(built.positions[:, 0], 1.0)]
    assert np.allclose(middle, [0, 1, 0], atol=1e-9)
    along = mesh.tangent_frames(built)
    assert (along[:, 0] > 0.9).all() and (along[:, 3] == -1.0).all()


def test_the_files_own_normals_are_used_unless_a_crease_is_given():
    normals = np.array([[0, 0, 1], [0, 1, 1]], float)
    one = polygons(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
        [[0, 1, 2]],
        normals=normals,
        normal_of=np.array([0, 1, 0]),
    )
    built = mesh.build(one)
    assert np.allclose(sorted(built.normals.tolist())[-1], [0, np.sqrt(0.5), np.sqrt(0.5)])
    assert np.allclose(mesh.build(one, crease=30).normals, [0, 0, 1])


def test_missing_and_broken_normals_are_computed():
    normals = np.array([[0, 0, 2], [0, 0, 0], [np.nan, 0, 1]], float)
    one = polygons(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
        [[0, 1, 2]],
        normals=normals,
        normal_of=np.array([0, 1, 2]),
    )
    built = mesh.build(one)
    assert np.allclose(built.normals, [0, 0, 1]) and "2 missing normals computed" in built.notes
    none = polygons(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
        [[0, 1, 2]],
        normals=normals,
        normal_of=np.array([-1, -1, -1]),
    )
    assert np.allclose(mesh.build(none).normals, [0, 0, 1])


def test_a_solid_turned_inside_out_is_turned_back():
    inside = [side[::-1] for side in SIDES]
    built = mesh.build(polygons(CUBE, inside))
    p = built.positions[built.triangles]
    assert ((p.mean(1) * area(built.positions, built.triangles)).sum(1) > 0).all()
    assert "faces turned to the outside" in built.notes
    assert ((built.normals * built.positions).sum(1) > 0).all()


def test_normals_that_point_into_a_solid_are_turned():
    normals = -CUBE / np.sqrt(3)
    corners = np.array([c for side in SIDES for c in side])
    built = mesh.build(polygons(CUBE, SIDES, normals=normals, normal_of=corners))
    assert ((built.normals * built.positions).sum(1) > 0).all()
    assert "normals turned to the outside" in built.notes


def test_an_open_mesh_follows_its_normals():
    up = polygons(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
        [[0, 2, 1]],
        normals=np.array([[0, 0, 1.0]]),
        normal_of=np.zeros(3, int),
    )
    built = mesh.build(up)
    assert (area(built.positions, built.triangles)[:, 2] > 0).all() and not built.closed


def test_a_triangle_wound_against_its_normals_is_turned_alone():
    """A quad that looks along z by its normals, one half of it wound the other way."""
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    up = {"normals": np.array([[0, 0, 1.0]]), "normal_of": np.zeros(6, int)}
    for faces in ([[0, 1, 2], [0, 3, 2]], [[0, 2, 1], [0, 2, 3]]):
        built = mesh.build(polygons(corners, faces, **up))
        assert np.allclose(area(built.positions, built.triangles), [0, 0, 1])
        assert (built.normals == [0, 0, 1]).all() and not built.closed
        assert built.notes == ("1 faces turned to the outside",)


@pytest.mark.parametrize("inside_out", [0, 1])
def test_of_two_solids_one_inside_out_makes_the_mesh_an_open_one(inside_out):
    """Its back faces can be seen, so they must not be left out."""
    sides = [SIDES, [side[::-1] for side in SIDES]]
    both = sides[inside_out] + [[8 + c for c in side] for side in sides[1 - inside_out]]
    points = np.concatenate([CUBE, CUBE + np.array([5, 0, 0])])
    assert not mesh.build(polygons(points, both)).closed
    alike = SIDES + [[8 + c for c in side] for side in SIDES]
    assert mesh.build(polygons(points, alike)).closed
    turned = mesh.build(polygons(points, [side[::-1] for side in alike]))
    assert turned.closed and turned.notes == ("faces turned to the outside",)


@pytest.mark.parametrize("away", [1e7, -3e12])
def test_a_mesh_far_away_keeps_its_shape(away):
    """A 32-bit float at 1e7 holds whole numbers only: a unit cube there would fall in on itself."""
    cube, step = CUBE / 2.0, np.spacing(abs(away))
    there = mesh.brought_near(polygons(cube + np.array([away, 0.0, 2 * away]), SIDES))
    assert np.abs(there.positions - cube).max() <= max(1e-6, 4 * step)
    assert len(there.notes) == 1 and there.notes[0].startswith(f"moved by ({-away:.9g}, 0, ")
    here = mesh.brought_near(polygons(cube + 100.0, SIDES))
    assert (here.positions == cube + 100.0).all() and here.notes == ()


@pytest.mark.parametrize("missing", ["nan", "inf", "1e300", "none", "all"])
def test_without_texture_coordinates_tangents_are_unit_all_the_same(missing):
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    uv_of = np.tile(np.arange(4), 6)
    if missing == "none":
        uv_of[2:9] = -1
    elif missing == "all":
        uv_of[:] = -1
    else:
        uvs[1] = float(missing)
    cube = mesh.build(polygons(CUBE, SIDES, uvs=uvs, uv_of=uv_of))
    along = mesh.tangent_frames(cube)
    assert np.allclose(np.linalg.norm(along[:, :3], axis=1), 1.0)
    assert np.allclose((along[:, :3] * cube.normals).sum(1), 0.0, atol=1e-12)
    assert np.isin(along[:, 3], [-1.0, 1.0]).all()


def test_degenerate_triangles_are_left_out_and_counted():
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0]]
    built = mesh.build(polygons(points, [[0, 1, 2], [0, 1, 1], [0, 3, 1]]))
    assert len(built.triangles) == 1 and "2 degenerate triangles left out" in built.notes
    with pytest.raises(Mistake, match=r"^x\.obj: .*nothing to draw"):
        mesh.build(polygons(points, [[0, 0, 3]]), name="x.obj")


def test_a_triangle_without_area_has_a_normal_all_the_same():
    built = mesh.build(
        polygons([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    )
    assert np.allclose(np.linalg.norm(built.normals, axis=1), 1.0)


def test_a_fan_of_ten_thousand_faces_is_quick():
    angle = np.linspace(0, 2 * np.pi, 10001)[:-1]
    rim = np.stack([np.cos(angle), np.zeros_like(angle), np.sin(angle)], 1)
    faces = [[0, 1 + (i + 1) % 10000, 1 + i] for i in range(10000)]
    built = mesh.build(polygons(np.concatenate([[[0, 3, 0]], rim]), faces))
    assert np.allclose(np.linalg.norm(built.normals, axis=1), 1.0)


SHAPES = {
    "arrow": [[0, 0], [2, -1], [1, 0], [2, 1]],
    "L": [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]],
    "star": [
        [np.cos(a) * r, np.sin(a) * r]
        for a, r in zip(np.arange(10) * np.pi / 5, [2, 0.6] * 5, strict=True)
    ],
    "comb": [
        [0, 0],
        [7, 0],
        [7, 3],
        [6, 3],
        [6, 1],
        [5, 1],
        [5, 3],
        [4, 3],
        [4, 1],
        [3, 1],
        [3, 3],
        [0, 3],
    ],
    "keyhole": [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0], [1, 1], [1, 3], [3, 3], [3, 1], [1, 1]],
}


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("turn", range(3))
@pytest.mark.parametrize("back", [False, True])
def test_concave_polygons_are_cut_inside_their_outline(name, turn, back):
    flat = np.array(SHAPES[name], float)[:: -1 if back else 1]
    points = np.roll(np.concatenate([flat, np.zeros((len(flat), 1))], 1), turn, axis=1)
    corner, notes = triangulate(polygons(points, [list(range(len(flat)))]))
    assert corner.shape == (len(flat) - 2, 3) and not notes
    x, y = flat.T
    outline = 0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()
    signed = np.roll(area(points, corner), -turn, axis=1)[:, 2] / 2.0
    assert signed.sum() == pytest.approx(outline)
    assert np.abs(signed).sum() == pytest.approx(abs(outline))  # no triangle lies outside


def test_polygons_of_all_sizes_stand_side_by_side():
    points = np.array(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0], [0.5, 0.2, 0]], float
    )
    faces = [[0, 1, 2, 3], [1, 4, 5, 2], [0, 1, 6], [0, 6, 2, 3]]
    corner, _ = triangulate(polygons(points, faces))
    assert len(corner) == 7
    assert (corner[-2:] >= 11).all()


@pytest.mark.parametrize(
    ("flat", "told"),
    [
        ([[0, 0], [2, 2], [2, 0], [0, 2], [-1, 1]], False),  # ears enough
        ([[4, 3], [3, 1], [4, 0], [2, 3], [4, 2]], True),
        ([[1, 3], [2, 0], [3, 1], [0, 1], [0, 4], [0, 3]], True),
    ],
)
def test_a_polygon_that_crosses_itself_is_cut_all_the_same(flat, told):
    """Whatever the cut, the areas with their signs sum to that of the outline (shoelace)."""
    points = np.array([[x, y, 0] for x, y in flat], float)
    corner, notes = triangulate(polygons(points, [list(range(len(flat)))]))
    assert len(corner) == len(flat) - 2
    x, y, _ = points.T
    outline = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()
    assert area(points, corner)[:, 2].sum() == pytest.approx(outline)
    assert notes == (("1 polygons that cross themselves cut as fans",) if told else ())


def test_a_huge_concave_polygon_is_refused():
    n = MAX_CONCAVE + 2
    angle = np.arange(n) * 2 * np.pi / n
    radius = np.where(np.arange(n) % 2, 1.0, 0.5)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], 1)
    with pytest.raises(Mistake, match=f"concave with {n} corners"):
        triangulate(polygons(points, [list(range(n))]))


def test_welding_joins_what_is_equal_and_nothing_else():
    points = np.array([[0.0, 0, 0], [-0.0, 0, 0], [1e-300, 0, 0], [0, 0, 0], [1, 2, 3]])
    place = mesh.weld(points)
    assert place[0] == place[1] == place[3] and len(set(place.tolist())) == 3


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(4, 60), st.integers(1, 80))
def test_any_triangles_give_unit_normals(seed, count, faces):
    rng = np.random.default_rng(seed)
    points = rng.integers(-3, 4, (count, 3)) * 10.0 ** rng.integers(-8, 9)
    soup = polygons(points, rng.integers(0, count, (faces, 3)).tolist())
    try:
        built = mesh.build(soup, crease=float(rng.uniform(0, 180)))
    except Mistake:
        return
    assert np.allclose(np.linalg.norm(built.normals, axis=1), 1.0)
    assert built.triangles.max() < len(built.positions)
    assert np.isin(built.positions, points).all()
    along = mesh.tangent_frames(built)
    assert np.allclose(np.linalg.norm(along[:, :3], axis=1), 1.0)
