"""Shadow rays: what the card says is hidden, against every triangle tried in float64."""

from pathlib import Path

import moderngl
import numpy as np
import oracle
import pytest

from lumiar import occluders
from lumiar.card import open_context

OCCLUSION = (Path(__file__).parent.parent / "glsl/rigs/occlusion.glsl").read_text()
LOOPS = (Path(__file__).parent.parent / "glsl/rigs/loops.glsl").read_text()
ASK = f"""#version 330 core
{OCCLUSION}{LOOPS}
uniform sampler2D origins, directions;
uniform int repeats;
out vec4 answer;
void main() {{
    vec4 o = texelFetch(origins, ivec2(gl_FragCoord.xy), 0);
    vec4 d = texelFetch(directions, ivec2(gl_FragCoord.xy), 0);
    float hidden = 0.0;
    for (int i = 0; i < repeats; ++i) hidden += rig_hidden(o.xyz, d.xyz, d.w) ? 1.0 : 0.0;
    answer = vec4(hidden, rig_cut_short(o.x) ? 1.0 : 0.0, 0.0, 0.0);
}}
"""
SCREEN = """#version 330 core
void main() {
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
"""
PLACE = """#version 330 core
uniform vec4 move;  // and scale
uniform vec3 eye;
in vec3 vertex, vertex_normal;
out vec3 position, normal, square, mixed, rise;
void main() {
    position = vertex * move.w + move.xyz;
    normal = vertex_normal;
    square = normal * normal;
    mixed = normal.yzx * normal.zxy;
    rise = normal * dot(normal, position);
    vec3 seen = (position - move.xyz) / move.w - eye, z = normalize(eye);
    vec3 x = normalize(cross(vec3(0.0, 1.0, 0.0), z)), y = cross(z, x);
    float depth = -dot(seen, z);
    gl_Position = vec4(3.0 * dot(seen, x), 3.0 * dot(seen, y), 1.1 * depth - 2.0, depth);
}
"""
SHADE = f"""#version 330 core
{OCCLUSION}
uniform vec3 L;
in vec3 position, normal, square, mixed, rise;
out vec4 answer;
void main() {{
    vec3 N = normalize(normal), along = normalize(dFdx(position));
    vec3 ground = cross(along, normalize(dFdy(position)));
    ground = normalize(dot(ground, N) < 0.0 ? -ground : ground);
    vec3 start = position + rig_bulge(position, square, mixed, rise, ground);
    bool plain = rig_hidden(rig_lifted(position, faceforward(ground, -L, ground), L), L, 1e30);
    answer = vec4(1.0, dot(N, L), rig_hidden(rig_lifted(start, ground, L), L, 1e30), plain);
}}
"""


class Card:
    """A context, the programs above in it, and the hierarchy that rays are asked about."""

    def __init__(self):
        self.context = open_context()
        self.ask = self.context.program(vertex_shader=SCREEN, fragment_shader=ASK)
        self.shade = self.context.program(vertex_shader=PLACE, fragment_shader=SHADE)

    def texture(self, size, data):
        texture = self.context.texture(size, 4, data, dtype="f4")
        texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        return texture

    def bind(self, program, made, **values):
        pairs = zip(made.sizes, (made.nodes, made.corners), strict=True)
        textures = [self.texture(*pair) for pair in pairs]
        for i, name in enumerate(("rig_nodes", "rig_corners")):
            textures[i].use(i)
            program[name].value = i
        for name, value in values.items():
            program[name].value = value
        return textures

    def drawn(self, array, size, before=(), **options):
        target = self.context.texture(size, 4, dtype="f4")
        depth = self.context.depth_renderbuffer(size)
        framebuffer = self.context.framebuffer([target], depth)
        framebuffer.use()
        framebuffer.clear()
        array.render(**options)
        answer = np.frombuffer(framebuffer.read(components=4, dtype="f4"), np.float32)
        for one in (framebuffer, target, depth, array, *before):
            one.release()
        return answer.reshape(-1, 4)

    def hidden(self, made, origins, directions, far=1e30, repeats=1):
        """Return (hidden, cut short) of rays, (n,) each; hidden counts the repeats."""
        n = len(origins)
        rows = -(-n // 64)
        rays = np.zeros((2, rows * 64, 4), np.float32)
        rays[0, :n, :3], rays[1, :n, :3], rays[1, :n, 3] = origins, directions, far
        textures = self.bind(self.ask, made, origins=2, directions=3, repeats=repeats)
        textures += [self.texture((64, rows), one.tobytes()) for one in rays]
        textures[2].use(2)
        textures[3].use(3)
        self.context.enable_only(moderngl.NOTHING)
        array = self.context.vertex_array(self.ask, [])
        return self.drawn(array, (64, rows), textures, vertices=3)[:n, :2].T


@pytest.fixture(scope="module")
def card():
    one = Card()
    yield one
    one.context.release()


def corners(mesh, scale=1.0, move=(0.0, 0.0, 0.0)):
    """Return the triangles (n, 3, 3) float32 of a mesh, scaled and moved."""
    positions, _, triangles = oracle.arrays(mesh)
    return (positions * scale + np.asarray(move)).astype(np.float32)[triangles]


def nodes(made):
    """Return the nodes (n, 2, 4) of a hierarchy, without what fills up the texture."""
    every = np.frombuffer(made.nodes, np.float32).reshape(-1, 2, 4)
    return every[: int(every[0, 0, 3])]


def crossings(p, o, d):
    """Return distances (rays, triangles) to the triangles' planes, and where, barycentric."""
    p, o, d = (a.astype(np.float64) for a in (p, o[:, None], d[:, None]))
    e1, e2, offset = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0], o - p[:, 0]
    normal = np.cross(e1, e2)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = -(offset * normal).sum(-1) / (d * normal).sum(-1)
        within = offset + t[..., None] * d
        u = (np.cross(within, e2) * normal).sum(-1) / (normal * normal).sum(-1)
        v = (np.cross(e1, within) * normal).sum(-1) / (normal * normal).sum(-1)
    return t, np.stack([u, v, 1.0 - u - v], axis=-1)


def directions(generator, n):
    """Return unit vectors (n, 3) float32, some along an axis, some in a plane of two of them."""
    d = generator.normal(size=(n, 3))
    d[: n // 8] = np.eye(3)[generator.integers(0, 3, n // 8)] * generator.choice(
        [-1, 1], (n // 8, 1)
    )
    d[n // 8 : n // 4, 1] = 0.0
    return oracle.unit(d).astype(np.float32)


MESHES = ("teapot:segments=2", "torus:rings=16:segments=8", "plane:segments=3", "box")
PLACES = ((1.0, 0.0), (1e-3, 0.0), (1e6, 0.0), (1.0, 100.0))


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("scale, away", PLACES)
def test_rays_are_hidden_where_a_triangle_cuts_them_in_float64(card, mesh, scale, away):
    """But for rays that pass an edge or end within a hundredth of a percent of its size."""
    generator = np.random.default_rng(7)
    move = np.array([1.0, -0.7, 0.3]) * away
    p = corners(mesh, scale, move)
    o = (generator.normal(size=(1500, 3)) * scale + move).astype(np.float32)
    d = directions(generator, 1500)
    far = np.where(generator.random(1500) < 0.5, 1e30, generator.random(1500) * 3.0 * scale)
    t, inside = crossings(p, o, d)
    inside, margin = inside.min(-1), 1e-4
    cut = (inside > 0.0) & (t > 0.0) & (t < far[:, None])
    near = (inside > -margin) & (t > -margin * scale) & (t < far[:, None] + margin * scale)
    clear = (inside > margin) & (t > margin * scale) & (t < far[:, None] - margin * scale)
    sure = cut.any(1) == near.any(1)
    sure |= clear.any(1)
    hidden, _ = card.hidden(occluders.build(p), o, d, far)
    assert sure.mean() > 0.99 and 0.01 < cut.any(1).mean() < 0.5
    assert (hidden == cut.any(1))[sure].all()


@pytest.mark.parametrize("scale, away", [*PLACES, (1.0, 1e4)])
def test_no_ray_slips_through_an_edge_or_a_corner_of_a_closed_mesh(card, scale, away):
    generator = np.random.default_rng(8)
    move = np.array([1.0, -0.7, 0.3]) * away
    for mesh in ("sphere:subdivision=2", "box:segments=3", "torus:rings=24:segments=12"):
        p = corners(mesh, scale, move)
        share = generator.random((len(p), 3, 1))
        edges = p * share + np.roll(p, 1, axis=1) * (1.0 - share)
        goals = np.concatenate([p.reshape(-1, 3), edges.reshape(-1, 3)]).astype(np.float64)
        middle = np.array([0.0, 0.0, 1.0]) if mesh[0] == "t" else np.zeros(3)
        for start in (middle, middle + np.array([0.05, -0.1, 0.15])):
            o = np.broadcast_to((start * scale + move).astype(np.float32), goals.shape)
            d = oracle.unit(goals - o).astype(np.float32)
            assert card.hidden(occluders.build(p), o, d)[0].all()


def test_a_ray_ends_where_its_light_stands(card):
    p = np.array([[[-1, -1, 0], [2, -1, 0], [-1, 2, 0]]], np.float32) + np.float32(0.125)
    for scale in (1e-3, 1.0, 1e6):
        made = occluders.build(p * scale)
        away = np.array([-1.0, 1.0, 1.0, 1.0, 1.0, 1.0]) * 3.0 * scale
        o = np.array([0.125, 0.125, 0.125]) * scale + away[:, None] * [0.0, 0.0, 1.0]
        d = np.array([[0, 0, 1.0]] + [[0, 0, -1.0]] * 5)
        far = np.array([1e30, 1e30, 3.01 * scale, 3.0 * scale, 2.99 * scale, 0.0])
        assert card.hidden(made, o, d, far)[0].tolist() == [1, 1, 1, 0, 0, 0]
        assert not card.hidden(made, o, -d)[0].any()


def test_what_no_ray_can_hit_is_left_out(card):
    good = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    line, point = good[[0, 1, 1]], good[[1, 1, 1]]
    broken = np.where(good > 0.0, np.float32(np.nan), good), good + np.float32(np.inf)
    made = occluders.build(np.stack([line, good, point, *broken]))
    assert made.triangles == 1
    ray = np.array([[0.2, 0.2, 1.0]]), np.array([[0.0, 0.0, -1.0]])
    assert card.hidden(made, *ray)[0].all()
    for nothing in (np.empty((0, 3, 3)), line[None]):
        made = occluders.build(nothing)
        assert made.triangles == 0
        assert not card.hidden(made, *ray)[0].any()


def chain(n):
    """Return triangles each of which lies within the next."""
    return np.eye(3)[None] * np.geomspace(1e-3, 1e3, n)[:, None, None]


@pytest.mark.parametrize(
    "p",
    [corners("suzanne"), corners("box"), chain(3000), np.repeat(np.eye(3)[None], 3000, 0)],
    ids=["suzanne", "box", "within each other", "all the same"],
)
def test_the_hierarchy_holds_each_triangle_once_and_every_box_what_is_below_it(p):
    made = occluders.build(p)
    low, high = nodes(made)[:, 0], nodes(made)[:, 1]
    count, link = high[:, 3].astype(int), low[:, 3].astype(int)
    here, leaf = np.arange(len(low)), count > 0
    assert count.max() <= 4 and count.sum() == made.triangles == len(p)
    assert (link[~leaf] > here[~leaf] + 1).all() and (link[~leaf] <= len(low)).all()
    held = np.frombuffer(made.corners, np.float32).reshape(-1, 4)[: 3 * len(p), :3].reshape(-1, 9)
    assert np.array_equal(
        np.unique(held, axis=0, return_counts=True)[1],
        np.unique(p.astype(np.float32).reshape(-1, 9), axis=0, return_counts=True)[1],
    )
    first = np.concatenate([[0], np.cumsum(count)])  # of the triangles of each node, in order
    assert (link[leaf] == first[:-1][leaf]).all()
    last = first[np.where(leaf, here + 1, link)]
    for i in here:
        inside = held[first[i] : last[i]].reshape(-1, 3)
        assert (inside.min(0) == low[i, :3]).all() and (inside.max(0) == high[i, :3]).all()


def test_a_ray_takes_few_steps(card):
    """So few that 500 rays into the teapot stay below the 65 535 that llvmpipe has for a pixel."""
    generator = np.random.default_rng(9)
    p = corners("teapot")
    o = generator.uniform(-1.0, 1.0, (256, 3))
    hidden, cut = card.hidden(occluders.build(p), o, directions(generator, 256), repeats=500)
    assert not cut.any() and (hidden > 0).mean() > 0.1
    assert set(np.unique(hidden)) == {0.0, 500.0}


CONVEX = ("sphere:subdivision=2", "sphere", "box", "cylinder:segments=12", "plane:segments=8")


@pytest.mark.parametrize("mesh", CONVEX)
@pytest.mark.parametrize("scale, away", [*PLACES, (1.0, 1e4)])
def test_a_convex_body_hides_no_light_from_its_bright_side_and_all_from_its_dark(
    card, mesh, scale, away
):
    """Down to grazing light, by positions that the card interpolates."""
    positions, normals, triangles = oracle.arrays(mesh)
    move = np.array([1.0, -0.7, 0.3]) * away
    made = occluders.build((positions * scale + move).astype(np.float32)[triangles])
    content = np.concatenate([positions, normals], axis=1).astype(np.float32).tobytes()
    buffers = [card.context.buffer(content), card.context.buffer(triangles.tobytes())]
    for L in ([1.0, 0.15, 0.1], [-0.3, 1.0, -0.8], [0.6, 0.001, 0.8]):
        values = {"move": (*move, scale), "eye": (1.0, 2.0, 4.0), "L": tuple(oracle.unit(L))}
        textures = card.bind(card.shade, made, **values)
        card.context.enable_only(moderngl.DEPTH_TEST)
        content = [(buffers[0], "3f 3f", "vertex", "vertex_normal")]
        array = card.context.vertex_array(card.shade, content, buffers[1])
        seen, cosine, hidden, plain = card.drawn(array, (96, 96), textures).T
        lit = (seen > 0.0) & (cosine > 0.0)
        assert seen.mean() > 0.1 and not hidden[lit].any()
        if mesh != "plane:segments=8" and away < 1e4:  # open; a pixel is as large as a rounding
            assert plain[(seen > 0.0) & (cosine < -0.3)].all()
    for buffer in buffers:
        buffer.release()
