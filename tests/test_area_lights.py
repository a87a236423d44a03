"""Quads, polygons, disks and spheres against closed forms, Lambert's formula and chance."""

import functools
import math
import re

import moderngl
import numpy as np
import pytest

from lumiar import catalog, compose, flatten

WIDTH = 1024  # of the picture whose pixels are the configurations
MAIN = """
#include "rigs/strict.glsl"
#include "LIGHTS"
uniform sampler2D test_rows;
uniform int test_height;
out vec4 test_result;
vec4 test_row(int i) {
    return texelFetch(test_rows, ivec2(gl_FragCoord.xy) + ivec2(0, i * test_height), 0);
}
void main() {
    SET
    test_result = RESULT;
}
"""
VERTEX = """#version 330 core
void main() {
    gl_Position = vec4(vec2[3](vec2(-1, -1), vec2(3, -1), vec2(-1, 3))[gl_VertexID], 0, 1);
}
"""
FACTS = (
    "vec4(irradiance(place, way).x, arriving(place, way).x, density(place, way), reach(place, way))"
)
DRAWN = "vec4(light(place, u).direction, light(place, u).irradiance.x)"
PI = math.pi


@functools.lru_cache(maxsize=32)
def program_of(context, name, result, corners):
    """Return the program that makes a result of a light, and what each row of numbers is."""
    kind = catalog.read("light", name)
    text = compose._fixed(kind, {"corners": corners} if corners else {})
    free = [p for p in kind.parameters if not p.constant and p.name != "color"]
    text = re.sub(r"(?m)^uniform (\w+) (\w+) = [^;]*;", r"\1 \2;", text)  # set for every pixel
    sizes = {p.name: "xyz" if p.type == "vec3" or p.tinted else "x" for p in free}
    slots = [*sizes, "place", "way", "u"]
    lines = [f"{name} = test_row({i}).{size};" for i, (name, size) in enumerate(sizes.items())]
    lines += [f"vec3 {name} = test_row({slots.index(name)}).xyz;" for name in ("place", "way")]
    lines += [f"vec2 u = test_row({len(slots) - 1}).xy;"]
    main = MAIN.replace("SET", "\n    ".join(lines)).replace("RESULT", result)
    places = {"MAIN": [("test", "rigs", main)], "LIGHTS": [(kind.path, "lights", text)]}
    source = flatten.finish(flatten.flatten("MAIN", places, {}, {}), strict=True).text
    return context.program(vertex_shader=VERTEX, fragment_shader=source), slots


@pytest.fixture(scope="module")
def made(renderer):
    """Return made(light, result, corners, **rows) → (n, 4) from GLSL that hides no NaN."""

    def run(name, result, corners="", **rows):
        program, slots = program_of(renderer.context, name, result, corners)
        rows = {name: np.asarray(value, np.float32) for name, value in rows.items()}
        count = max(len(value) for value in rows.values() if value.ndim == 2)
        high = -(-count // WIDTH)
        data = np.ones((len(slots), high * WIDTH, 4), np.float32)  # radiance 1
        for name, value in rows.items():
            if name in slots:
                data[slots.index(name), :count, : value.shape[-1] if value.ndim else 4] = value
        texture = context.texture((WIDTH, high * len(slots)), 4, data.tobytes(), dtype="f4")
        texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        texture.use(0)
        program["test_rows"].value, program["test_height"].value = 0, high
        framebuffer = context.framebuffer([context.texture((WIDTH, high), 4, dtype="f4")])
        framebuffer.use()
        array = context.vertex_array(program, [])
        array.render(moderngl.TRIANGLES, vertices=3)
        result = np.frombuffer(framebuffer.read(components=4, dtype="f4"), np.float32)
        renderer.free_framebuffer(framebuffer)
        for one in (array, texture):
            one.release()
        return result.reshape(-1, 4)[:count].astype(float)

    with renderer.context as context:
        yield run


def dot(a, b):
    return (a * b).sum(-1)


def unit(v):
    return v / np.sqrt(dot(v, v))[..., None]


def single(v):
    """Return what of numbers arrives in float32, in the widest type there is."""
    return np.asarray(v, np.float32).astype(np.longdouble)


def lambert(corners, front, place, normal):
    """Return irradiance over radiance: J. H. Lambert's sum over the edges above the horizon.

    corners: (n, k, 3), counter-clockwise seen from the front; front, place, normal: (n, 3);
    longdouble, whose digits outlast the cancellation.
    """
    p, k = corners - place[:, None], corners.shape[1]
    z, total = dot(p, normal[:, None]), 0.0
    leave, enter = np.zeros_like(place), np.zeros_like(place)

    def edge(a, b):
        across = np.cross(a, b)
        length = np.sqrt(dot(across, across))
        theta = np.arctan2(length, dot(a, b))
        return theta * dot(across, normal) / np.where(length > 0.0, length, 1.0)

    for i in range(k):
        a, b, low, high = p[:, i], p[:, i - 1], z[:, i] <= 0.0, z[:, i - 1] <= 0.0
        share = z[:, i] / np.where(z[:, i] == z[:, i - 1], 1.0, z[:, i] - z[:, i - 1])
        cut = a + (b - a) * share[:, None]
        s, t = np.where(low[:, None], cut, a), np.where(high[:, None], cut, b)
        enter = np.where((low & ~high)[:, None], cut, enter)
        leave = np.where((high & ~low)[:, None], cut, leave)
        total = total + np.where(low & high, 0.0, edge(s, t))
    total = total + edge(leave, enter)
    return np.where(dot(front, p[:, 0]) < 0.0, 0.5 * total, 0.0).astype(float)


def configurations(rng, count, size, near, far):
    """Return (toward, front, normal): centre, front and horizon of lights of a size seen from 0.

    A third stands near the horizon; none is seen from behind, or within 3 degrees of its plane.
    """
    d, front, normal = (unit(rng.normal(size=(count, 3))) for _ in range(3))
    range_ = np.exp(rng.uniform(math.log(near), math.log(far), count))
    low = (
        unit(np.cross(normal, d))
        + normal * rng.uniform(-0.4, 0.6, (count, 1)) * np.minimum(size / range_, 1.0)[:, None]
    )
    d = np.where((np.arange(count) % 3 == 0)[:, None], unit(low), d)
    front = unit(front - d * np.maximum(dot(front, d) + 0.05, 0.0)[:, None])
    return d * range_[:, None], front, normal


def worst(found, true, sure):
    """Return the largest relative error among the sure ones, of which there are some."""
    assert sure.sum() > 20
    return np.abs(found[sure] / true[sure] - 1.0).max()


def quad_corners(position, target, turn, width, height):
    """Return the corners (n, 4, 3) and front (n, 3) that a quad's header describes, longdouble."""
    front = unit(target - position)
    level = unit(np.cross(np.array([0.0, 1.0, 0.0]), front))
    up = np.cross(front, level)
    x = level * np.cos(turn) + up * np.sin(turn)
    y = np.cross(front, x)
    ends = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    return np.stack([position + 0.5 * (i * width * x + j * height * y) for i, j in ends], 1), front


@pytest.mark.parametrize("size", [2.0, 0.3, 1e-2, 1e-3, 1e-4])
@pytest.mark.parametrize(("near", "far"), [(0.05, 0.3), (0.3, 3.0), (3.0, 100.0)])
def test_a_quad_has_its_irradiance_at_every_size_and_distance(made, size, near, far):
    """Within 1e-5 where it rises by 0.03: an error of 1e-7 is 3e-6 of that, and counts thrice."""
    toward, front, normal = configurations(np.random.default_rng(1), 1000, size, near, far)
    turn, narrow = np.linspace(-3.0, 3.0, 1000)[:, None], np.where(np.arange(1000) % 4, 1.0, 0.1)
    rows = {"position": toward, "target": toward + front, "turn": turn}
    rows |= {"width": np.full((1000, 1), size), "height": size * narrow[:, None]}
    found = made("quad", FACTS, place=np.zeros((1000, 3)), way=normal, **rows)[:, 0]
    corners, front = quad_corners(*(single(value) for value in rows.values()))
    normal = single(normal)
    true = lambert(corners, front, np.zeros_like(front), normal)
    rise = (dot(corners, normal[:, None]) / np.sqrt(dot(corners, corners))).max(1)
    above = -dot(front, corners[:, 0])
    assert worst(found, true, (rise > 0.03) & (above > 0.02 * size)) < 1e-5
    assert (found[true == 0.0] == 0.0).all()


def test_a_polygon_has_its_irradiance(made):
    """It lies in a plane of equal y, so that rounding cannot bend it."""
    rng, count = np.random.default_rng(4), 6
    place, front, normal = configurations(rng, 1000, 1.0, 0.1, 3.0)
    place = np.abs(place) * [1.0, -1.0, 1.0]
    step = np.cumsum(rng.uniform(0.5, 1.5, (1000, count)), 1)
    angle = step / (step[:, -1:] + 1.0) * 2.0 * PI
    border = np.stack([0.5 * np.cos(angle), 0.0 * angle, 0.5 * np.sin(angle)], 2)
    rows = {name: border[:, min(i, count - 1)] for i, name in enumerate("abcdef")}
    found = made("polygon", FACTS, "six", place=place, way=normal, **rows)[:, 0]
    border, place, normal = single(border), single(place), single(normal)
    front = np.broadcast_to(single([0.0, -1.0, 0.0]), place.shape)
    true = lambert(border, front, place, normal)
    p = border - place[:, None]
    rise = (dot(p, normal[:, None]) / np.sqrt(dot(p, p))).max(1)
    assert worst(found, true, (rise > 0.03) & (place[:, 1] < -0.02)) < 1e-5


def rim_sum(centre, front, radius, normal, points=160):
    """Return irradiance over radiance of disks, (n,): Lambert's contour integral."""
    other = np.cross(front, centre)
    y = unit(other + 1e-12 * np.cross(front, normal))
    x = np.cross(y, front)  # away from the place or toward it
    z, gx, gy = (dot(normal, v) for v in (centre, radius * x, radius * y))
    tilt, middle = np.hypot(gx, gy), np.arctan2(gy, gx)
    half = np.arccos(np.clip(-z / tilt, -1.0, 1.0))
    at, weight = np.polynomial.legendre.leggauss(points)
    total = 0.0
    for first in (-2.0 * PI, -PI, 0.0, PI):  # what is near the place ends a part
        a, b = (np.clip(v, middle - half, middle + half) for v in (first, first + PI))
        t = 0.5 * (a + b)[:, None] + 0.5 * (b - a)[:, None] * at
        c, s = np.cos(t)[..., None], np.sin(t)[..., None]
        p = centre[:, None] + radius[:, None] * (c * x[:, None] + s * y[:, None])
        way = radius[:, None] * (c * y[:, None] - s * x[:, None])
        part = dot(np.cross(p, way), normal[:, None]) / dot(p, p)
        total = total + 0.5 * (b - a) * (part * weight).sum(1)
    p, q = (
        centre + radius * (np.cos(t)[:, None] * x + np.sin(t)[:, None] * y)
        for t in (middle + half, middle - half)
    )
    across = np.cross(p, q)
    length = np.sqrt(dot(across, across))
    chord = np.arctan2(length, dot(p, q)) * dot(across, normal) / np.maximum(length, 1e-30)
    total = total + np.where(half < PI, chord, 0.0)
    return np.where((z > -tilt) & (dot(front, centre) < 0.0), -0.5 * total, 0.0).astype(float)


@pytest.mark.parametrize("radius", [1.0, 0.1, 1e-2, 1e-3])
@pytest.mark.parametrize(("near", "far"), [(0.05, 0.3), (0.3, 10.0)])
def test_a_disk_has_its_irradiance(made, radius, near, far):
    toward, front, normal = configurations(np.random.default_rng(2), 300, radius, near, far)
    rows = {"position": toward, "target": toward + front, "radius": np.full((300, 1), radius)}
    found = made("disk", FACTS, place=np.zeros((300, 3)), way=normal, **rows)[:, 0]
    position, target, radius, normal = map(single, (*rows.values(), normal))
    front = unit(target - position)
    true = rim_sum(*(v.astype(float) for v in (position, front, radius, normal)))
    tilt = radius[:, 0] * np.sqrt(np.maximum(1.0 - dot(front, normal) ** 2, 0.0))
    rise = (dot(normal, position) + tilt) / np.sqrt(dot(position, position))
    above = -dot(front, position)
    sure = (rise > 0.03) & (
        above > 0.05 * np.maximum(np.sqrt(dot(position, position)), radius[:, 0])
    )
    assert worst(found, true, sure) < 1e-5
    assert (found[true == 0.0] == 0.0).all()


@pytest.mark.parametrize("share", [1e-4, 1e-3, 1e-2, 0.1, 0.5, 0.9, 0.999])
def test_a_sphere_has_the_irradiance_of_snyder(made, share):
    """J. Snyder, "Area light sources for real-time graphics", 1996, summed with more digits.

    An error of 1e-7 in the height of the axis is 1e-7 / share of the radius.
    """
    toward, _, normal = configurations(np.random.default_rng(3), 1000, 0.1, 0.05, 10.0)
    radius = share * np.sqrt(dot(toward, toward))
    level = unit(np.cross(np.cross(normal, toward), normal))
    height = np.linspace(-0.999, 1.5, 1000)[:, None] * share / math.sqrt(1.0 - min(share, 0.9) ** 2)
    toward = unit(level + height * normal) * np.sqrt(dot(toward, toward))[:, None]
    rows = {"position": toward, "radius": radius[:, None]}
    found = made("sphere", FACTS, place=np.zeros((1000, 3)), way=normal, **rows)[:, 0]
    toward, radius, normal = (single(v) for v in (toward, radius, normal))
    range_ = np.sqrt(dot(toward, toward))
    z, s = dot(normal, toward) / range_, radius / range_
    omega, x = np.arccos(z), np.sqrt(1.0 / s**2 - 1.0)
    y = np.clip(-x / np.tan(omega), -1.0, 1.0)
    root = np.sin(omega) * np.sqrt(1.0 - y * y)
    true = s * s * (z * np.arccos(y) - x * root) + np.arctan2(root, x)
    true = np.where(z > s, PI * s * s * z, np.where(z < -s, 0.0, true)).astype(float)
    sure = (z + s) / s > 0.1
    assert worst(found, true, sure) < 1e-5 + 2e-6 / share
    assert worst(found, true, z > 0.3) < 2e-6 if (z > 0.3).sum() > 20 else True


@pytest.mark.parametrize(
    ("name", "rows", "facts"),
    [  # J. Howell's catalog B-3, B-4, C-41; A. van Oosterom and J. Strackee; cap of 30 degrees
        ("quad", {"position": [0, 1, 0], "target": [0, 0, 0]}, {0: 0.23945647046077354 * PI}),
        ("quad", {"position": [0, 10, 0], "target": [0, 0, 0]}, {0: 0.0031725255325554263 * PI}),
        ("quad", {"position": [0.5, 1, 0.5], "target": [0.5, 0, 0.5]}, {0: 0.138531605994893 * PI}),
        (
            "quad",
            {"position": [1, 0.5, 0.5], "target": [0, 0.5, 0.5]},
            {0: 0.055734197002553502 * PI},
        ),
        ("quad", {"position": [0, 1, 0], "target": [0, 0, 0]}, {2: 1 / 0.80543168316132317}),
        ("quad", {"position": [0, 100, 0], "target": [0, 0, 0]}, {2: 1 / 9.9997500072914323e-5}),
        ("quad", {"position": [0, 0.5, 0], "target": [0, 0, 0]}, {2: 1.5 / PI}),
        ("disk", {"position": [0, 1, 0], "target": [0, 0, 0], "radius": 1}, {0: 0.5 * PI, 3: 1.0}),
        ("disk", {"position": [0, 1, 0], "target": [0, 0, 0], "radius": 0.75}, {0: 0.36 * PI}),
        ("sphere", {"position": [0, 2, 0], "radius": 1}, {0: PI / 4, 2: 1 / 0.84178721447693293}),
        ("sphere", {"position": [0, 1, 0], "radius": 1e-4}, {0: PI * 1e-8, 3: 0.9999}),
        ("sphere", {"position": [2, 0, 0], "radius": 1}, {0: PI / 6 - 0.75**0.5 / 2}),
        ("sphere", {"position": [0, 1, 0], "radius": 2}, {0: PI, 1: 1.0, 2: 0.25 / PI, 3: 3.0}),
    ],
)
def test_a_closed_form_is_met(made, name, rows, facts):
    way = [[0.0, 1.0, 0.0]]
    rows = {"width": 1.0, "height": 1.0, "turn": 0.0, **rows}
    for index, true in facts.items():
        way = [[0.0, 1.0, 0.0]]
        found = made(name, FACTS, place=np.zeros((1, 3)), way=way, **rows)[0, index]
        assert found == pytest.approx(true, rel=1e-6), index


@pytest.mark.parametrize(("corners", "count"), [("three", 3), ("five", 5)])
def test_a_polygon_has_its_solid_angle(made, corners, count):
    """An octant of the sphere, and a cone of five sides: L'Huilier's excess of its triangles."""
    border = [[1.0, 0, 0], [0, 0, 1.0], [0, 1.0, 0]]
    true = PI / 2.0
    if count == 5:
        turn = 2.0 * PI / 5.0
        border = [[math.cos(i * turn), 1.0, math.sin(i * turn)] for i in range(5)]
        long, short = math.pi / 4.0, math.acos(0.5 + 0.5 * math.cos(turn))
        s = long + 0.5 * short
        tans = math.tan(s / 2.0) * math.tan((s - short) / 2.0) * math.tan((s - long) / 2.0) ** 2
        true = 20.0 * math.atan(math.sqrt(tans))
    way = [np.mean(border, 0) / np.linalg.norm(np.mean(border, 0))]
    found = made(
        "polygon",
        "vec4(density(place, way))",
        corners,
        place=np.zeros((1, 3)),
        way=way,
        **corner_rows(*border),
    )
    assert 1.0 / found[0, 0] == pytest.approx(true, rel=1e-6)


def corner_rows(*border):
    """Return the rows of a polygon with these corners."""
    return {name: border[min(i, len(border) - 1)] for i, name in enumerate("abcdef")}


QUAD = {"position": [0.3, 2.0, 0.1], "target": [0, 0, 0], "turn": 0.4, "width": 1.5, "height": 0.7}
SIX = corner_rows(*([math.cos(i), 2.0, math.sin(i)] for i in range(6)))
LIGHTS = [
    ("quad", "", QUAD),
    ("quad", "", {**QUAD, "position": [0.6, 0.1, 0.2], "target": [0.6, 0.0, 0.2]}),
    ("quad", "", {**QUAD, "width": 1e-3, "height": 1e-3}),
    ("polygon", "six", SIX),
    ("disk", "", {"position": [0.3, 2.0, 0.1], "target": [0.3, 0.0, 0.1], "radius": 0.5}),
    ("disk", "", {"position": [1.0, 0.4, 0.1], "target": [1.0, 0.0, 0.1], "radius": 1.0}),
    ("sphere", "", {"position": [0.3, 2.0, 0.1], "radius": 0.5}),
    ("sphere", "", {"position": [0.3, 2.0, 0.1], "radius": 1.9}),
]


def chance_of_more(statistic, freedom):
    """Return the probability of a larger chi-square (E. Wilson and M. Hilferty, 1931)."""
    z = ((statistic / freedom) ** (1 / 3) - (1 - 2 / (9 * freedom))) / math.sqrt(2 / (9 * freedom))
    return 0.5 * math.erfc(z / math.sqrt(2.0))


@pytest.mark.parametrize(("name", "corners", "rows"), LIGHTS)
def test_directions_fall_as_their_density_says(made, name, corners, rows):
    """In cells of a plane across the middle direction, over which the density is finely summed."""
    place, cells, fine, count = np.zeros((1, 3)), 12, 16, 10_000
    u = np.random.default_rng(5).random((count, 2))
    drawn = made(name, DRAWN, corners, place=place, u=u, **rows)
    way, weight = drawn[:, :3], drawn[:, 3]
    assert np.abs(np.sqrt(dot(way, way)) - 1.0).max() < 1e-6
    middle = unit(way.mean(0))
    across = unit(np.cross(middle, [0.0, 0.0, 1.0]))
    basis = np.stack([across, np.cross(middle, across)], 1)
    spots = way @ basis / (way @ middle)[:, None]
    low, high = spots.min(0), spots.max(0)
    low, wide = low - 0.05 * (high - low), 1.1 * (high - low)
    steps = (np.arange(cells * fine) + 0.5) / (cells * fine)
    at = np.stack(np.meshgrid(steps, steps, indexing="ij"), 2).reshape(-1, 2) * wide + low
    looks = middle + at @ basis.T
    facts = made(name, FACTS, corners, place=place, way=unit(looks), **rows)
    mass = facts[:, 2] / dot(looks, looks) ** 1.5 * wide.prod() / (cells * fine) ** 2
    assert mass.sum() == pytest.approx(1.0, abs=2e-3)
    assert (facts[facts[:, 2] == 0.0, 1] == 0.0).all()
    assert (facts[:, 1] == 0.0).mean() - (facts[:, 2] == 0.0).mean() < 2e-3
    expected = count * mass.reshape(cells, fine, cells, fine).sum(axis=(1, 3)).ravel()
    cell = ((spots - low) / wide * cells).astype(int)
    seen = np.bincount(cell[:, 0] * cells + cell[:, 1], minlength=cells * cells)
    rare = expected < 20.0
    seen, expected = np.append(seen[~rare], seen[rare].sum()), np.append(expected[~rare], 0.0)
    expected[-1] = count - expected.sum()
    statistic = ((seen - expected) ** 2 / np.maximum(expected, 10.0)).sum()
    assert chance_of_more(statistic, len(seen) - 1) > 1e-3
    facts = made(name, FACTS, corners, place=place, way=way, **rows)
    np.testing.assert_allclose(weight * facts[:, 2], 1.0, rtol=2e-5)
    assert weight.max() / weight.min() < 2.0


@pytest.mark.parametrize(("name", "corners", "rows"), LIGHTS)
def test_the_mean_over_u_is_the_irradiance(made, name, corners, rows):
    x = (np.arange(128) + 0.5) / 128
    u = np.stack(np.meshgrid(x, x), 2).reshape(-1, 2)
    drawn = made(name, DRAWN, corners, place=np.zeros((1, 3)), u=u, **rows)
    middle = unit(drawn[:, :3].mean(0))
    normals = unit(np.array([middle, [0.3, 1.0, -0.2], [1.0, 0.4, 0.0], [0.0, 0.2, 1.0]]))
    exact = made(name, FACTS, corners, place=np.zeros((1, 3)), way=normals, **rows)[:, 0]
    mean = [(drawn[:, 3] * np.maximum(drawn[:, :3] @ N, 0.0)).mean() for N in normals]
    np.testing.assert_allclose(mean, exact, rtol=1e-4, atol=1e-4 * exact[0])


@pytest.mark.parametrize(("name", "corners", "rows"), [LIGHTS[i] for i in (0, 3, 4, 6)])
def test_hard_places_are_lit_without_nan_and_from_the_front_only(made, name, corners, rows):
    """On the light, in its plane, inside, at its edge and corner, far; and lights of no size."""
    base = {**rows, "position": [0, 1, 0], "target": [0, 0, 0]}
    if name == "polygon":
        base = corner_rows([-0.5, 1, -0.5], [0.5, 1, -0.5], [0.5, 1, 0.5], [-0.5, 1, 0.5])
        line = corner_rows(*([0.1 * i, 1.0, 0.0] for i in range(6)))
        kinds = [base, line, corner_rows([0, 1, 0]), {**base, "b": base["a"]}]
    else:
        kinds = [{**base, "width": 1.0, "height": 1.0, "turn": 0.0, "radius": 0.5}]
        sizes = ({"width": 0.0}, {"height": 0.0, "radius": 0.0}, {"width": 1e6, "radius": 1e6})
        more = ({"target": [0, 1, 0]}, {"target": [1, 1, 0]}, {"width": 1e-10, "radius": 1e-10})
        kinds += [{**kinds[0], **changed} for changed in (*sizes, *more)]
    places = [(0, 1, 0), (0.5, 1, 0), (0.5, 1, 0.5), (2, 1, 0), (0.1, 1.3, 0.1), (0, 3, 0)]
    places += [(0.1, 1 - 1e-7, 0.1), (0.5, 1 - 1e-7, 0.5), (0, 0.5, 0), (1e6, 0, 0), (0, -1e6, 0)]
    ways = [(0, 1, 0), (0, -1, 0), (1, 0, 0), (0, 0, 1), (0.6, 0.8, 0), (-0.6, 0, 0.8)]
    spots = [(0, 0), (0, 1 - 6e-8), (1 - 6e-8, 0), (1 - 6e-8, 1 - 6e-8), (0.5, 0.5), (0.3, 0.7)]
    grid = [(p, w, u) for p in places for w in ways for u in spots]
    place, way, u = (np.array(column, float) for column in zip(*grid, strict=True))
    for kind in kinds:
        drawn = made(name, DRAWN, corners, place=place, u=u, **kind)
        facts = made(name, FACTS, corners, place=place, way=way, **kind)
        assert np.isfinite(drawn).all() and np.isfinite(facts).all()
        assert np.abs(np.sqrt(dot(drawn[:, :3], drawn[:, :3])) - 1.0).max() < 1e-5
        assert (facts[:, :3] >= 0.0).all() and (facts[:, 0] < PI * (1.0 + 1e-6)).all()
        if name != "sphere" and kind is kinds[0]:
            behind = place[:, 1] >= 1.0
            assert not drawn[behind, 3].any() and not facts[behind, :3].any()


@pytest.mark.parametrize(("name", "corners", "rows"), [LIGHTS[i] for i in (0, 3, 4, 6)])
def test_reach_is_the_distance_to_the_light(made, name, corners, rows):
    u = np.random.default_rng(6).random((200, 2))
    way = made(name, DRAWN, corners, place=np.zeros((1, 3)), u=u, **rows)[:, :3]
    far = made(name, FACTS, corners, place=np.zeros((1, 3)), way=way, **rows)[:, 3]
    point = way * far[:, None]
    if name == "sphere":
        off = np.sqrt(dot(point - rows["position"], point - rows["position"])) - 0.5
        assert (far < 2.04).all()
    elif name == "polygon":
        off = point[:, 1] - 2.0
    else:
        axis = np.subtract(rows["target"], rows["position"])
        off = (point - rows["position"]) @ axis
    assert np.abs(off).max() < 2e-5
