"""The built-in shapes, with the exact normals and tangents of the surfaces they stand for."""

import math
import os

import numpy as np

from .errors import Mistake
from .files import ASSETS
from .mesh import Mesh


def make(name, values):
    """Return the Mesh of a shape of `geometry.SHAPES`; values maps its parameters to numbers."""
    return globals()[f"_{name}"](**values)


def _sphere(subdivision, radius):
    """An icosahedron whose faces are split in four, again and again, each vertex on the sphere."""
    golden = (1.0 + math.sqrt(5.0)) / 2.0
    a, b, zero = np.ones(4), np.full(4, golden), np.zeros(4)
    s, t = np.array([1, 1, -1, -1]), np.array([1, -1, 1, -1])
    points = np.concatenate(
        [
            np.stack([zero, s * a, t * b], 1),
            np.stack([s * a, t * b, zero], 1),
            np.stack([s * b, zero, t * a], 1),
        ]
    )
    distance = np.linalg.norm(points[:, None] - points, axis=2)
    near = np.isclose(distance, 2.0)
    faces = [
        (i, j, k)
        for i in range(12)
        for j in range(i + 1, 12)
        for k in range(j + 1, 12)
        if near[i, j] and near[j, k] and near[i, k]
    ]
    triangles = np.array(faces)
    outward = np.linalg.det(points[triangles]) > 0.0
    triangles = np.where(outward[:, None], triangles, triangles[:, ::-1])
    points /= np.linalg.norm(points[0])
    for _ in range(subdivision):
        edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        edges, which = np.unique(edges @ [len(points), 1], return_inverse=True)
        ends = np.stack(np.divmod(edges, len(points)), axis=1)
        middle = points[ends].sum(1)
        m = which.reshape(-1, 3) + len(points)
        points = np.concatenate([points, middle / np.linalg.norm(middle, axis=1, keepdims=True)])
        v = triangles
        triangles = np.stack(
            [v[:, 0], m[:, 0], m[:, 2], m[:, 0], v[:, 1], m[:, 1], m[:, 2], m[:, 1], v[:, 2]],
            axis=1,
        )
        triangles = np.concatenate([triangles, m], axis=1).reshape(-1, 3)
    return Mesh(points * radius, points, triangles, closed=True)


def _uv_sphere(rings, segments, radius):
    theta = np.linspace(0.0, np.pi, rings + 1)[:, None]
    phi = _turn(segments)[None]
    # At the poles a vertex stands for the middle of its segment, so that its tangent does too.
    phi = np.where((theta == 0.0) | (theta == np.pi), phi + np.pi / segments, phi)
    sin, cos = np.sin(theta), np.cos(theta)
    sin[[0, -1]] = 0.0
    normals = _xyz(sin * np.sin(phi), cos, sin * np.cos(phi))
    tangents = _xyz(np.cos(phi), 0.0, -np.sin(phi))
    return _grid(normals * radius, normals, tangents, closed=True)


def _torus(major, minor, rings, segments):
    if minor > major:
        raise Mistake("torus: the tube would cut itself; make minor smaller than major")
    u, v = _turn(rings)[None], _turn(segments)[:, None]
    normals = _xyz(np.cos(v) * np.sin(u), np.sin(v), np.cos(v) * np.cos(u))
    centre = _xyz(major * np.sin(u), 0.0 * v, major * np.cos(u))
    tangents = _xyz(np.cos(u), 0.0 * v, -np.sin(u))
    return _grid((centre + minor * normals)[::-1], normals[::-1], tangents[::-1], closed=True)


def _torus_knot(p, q, tube, rings, segments):
    """A tube around the (p, q) knot on a torus of radii 1 and 1/2."""
    if math.gcd(p, q) != 1:
        raise Mistake(
            f"torus_knot: p = {p} and q = {q} share a factor; the knot needs coprime ones"
        )
    t = _turn(rings)
    turn, wave = np.exp(1j * p * t), np.exp(1j * q * t)
    # z = r e^(ipt) in the plane of the ring, r = 1 + cos(qt) / 2, and its first two derivatives
    r, r1, r2 = 1.0 + 0.5 * wave.real, -0.5 * q * wave.imag, -0.5 * q * q * wave.real
    z1, z2 = (r1 + 1j * p * r) * turn, (r2 + 2j * p * r1 - p * p * r) * turn
    curve = _xyz((r * turn).imag, 0.5 * wave.imag, (r * turn).real)
    speed = _xyz(z1.imag, 0.5 * q * wave.real, z1.real)
    bend = _xyz(z2.imag, -0.5 * q * q * wave.imag, z2.real)
    along = speed / np.linalg.norm(speed, axis=-1, keepdims=True)
    binormal = np.cross(speed, bend)
    binormal /= np.linalg.norm(binormal, axis=-1, keepdims=True)
    inward = np.cross(binormal, along)
    v = _turn(segments)[:, None, None]
    normals = np.cos(v) * inward + np.sin(v) * binormal
    tangents = np.broadcast_to(along, normals.shape)
    return _grid(curve + tube * normals, normals, tangents, closed=True)


def _plane(width, segments):
    """A square in the xz plane that faces up."""
    s = np.linspace(-0.5, 0.5, segments + 1)
    x, z = np.meshgrid(s, s)
    flat = np.broadcast_to([0.0, 1.0, 0.0], (*x.shape, 3))
    along = np.broadcast_to([1.0, 0.0, 0.0], (*x.shape, 3))
    return _grid(_xyz(x, 0.0 * x, z) * width, flat, along, closed=False)


def _box(width, segments):
    side = _plane(width, segments)
    x, y, z = np.eye(3)
    # Each side is the plane with its (x, y, z) turned onto three axes of the box.
    turns = [(x, y, z), (x, -y, -z), (x, z, -y), (-x, -z, -y), (-z, x, -y), (z, -x, -y)]
    sides = [_moved(side, np.array(turn), width / 2) for turn in turns]
    return _joined(sides, closed=True)


def _cylinder(radius, height, segments):
    phi = _turn(segments)[None]
    sin, cos = np.sin(phi), np.cos(phi)
    rows = np.array([[1.0], [-1.0]])
    normals = _xyz(sin, 0.0 * rows, cos)
    tangents = _xyz(cos, 0.0 * rows, -sin)
    wall = _grid(_xyz(radius * sin, rows * height / 2, radius * cos), normals, tangents, True)
    parts = [wall]
    for up in (1.0, -1.0):
        edge = np.array([[0.0], [1.0]]) * radius
        flat = np.broadcast_to([0.0, up, 0.0], (2, segments + 1, 3))
        along = np.broadcast_to([1.0, 0.0, 0.0], flat.shape)
        disk = _xyz(edge * sin, up * height / 2, edge * cos)
        order = slice(None, None, int(up))
        parts.append(_grid(disk[order], flat, along, closed=True))
    return _joined(parts, closed=True)


def _teapot(segments):
    """The Utah teapot from its 32 Bézier patches, half as large as Newell's and centred in height.

    Normals are the cross products of the partial derivatives. Where a side of a patch shrinks to
    a point (tip of the lid, middle of the bottom) S_u vanishes like v S_uv, which replaces it.
    """
    control = _teapot_patches()
    t = np.linspace(0.0, 1.0, segments + 1)
    s = 1.0 - t
    b = np.stack([s**3, 3 * t * s**2, 3 * t**2 * s, t**3], 1)
    d = np.stack([-3 * s**2, 3 * s**2 - 6 * t * s, 6 * t * s - 3 * t**2, 3 * t**2], 1)

    def surface(v, u):
        return np.einsum("vi,uj,pijk->pvuk", v, u, control)

    points, along, across = surface(b, b), surface(b, d), surface(d, b)
    gone = np.linalg.norm(along, axis=-1, keepdims=True) < 1e-9
    along = np.where(gone, surface(d, d), along)
    normals = np.cross(along, across)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    patches = zip(points[:, ::-1], normals[:, ::-1], along[:, ::-1], strict=True)
    return _joined([_grid(*patch, closed=False) for patch in patches], closed=False)


def _teapot_patches():
    """Return the control points (32, 4, 4, 3), y up."""
    with open(os.path.join(ASSETS, "meshes", "teapot.patches"), encoding="utf-8") as file:
        rows = [line.split() for line in file if not line.startswith("#")]
    count = int(rows[0][1])
    patches = np.array(rows[1 : count + 1], int).reshape(count, 4, 4)
    x, y, z = np.array(rows[count + 2 :], float).T
    return np.stack([x, z - z.max() / 2, -y], axis=1)[patches] / 2.0


def _turn(steps):
    """Return the steps + 1 angles of a full turn; the last is 0, to close the seam exactly."""
    return np.append(np.arange(steps) * (2.0 * np.pi / steps), 0.0)


def _xyz(x, y, z):
    return np.stack(np.broadcast_arrays(x, y, z), axis=-1)


def _grid(points, normals, tangents, closed):
    """Return the Mesh of (rows, columns, 3) arrays: rows run down, columns to the right, seen from
    outside. Triangles without area, as at a pole, are left out."""
    rows, columns = points.shape[:2]
    i = np.arange((rows - 1) * columns).reshape(rows - 1, columns)[:, :-1].ravel()
    low, right = i + columns, i + 1
    triangles = np.stack([i, low, right, right, low, low + 1], axis=1).reshape(-1, 3)
    points, normals, tangents = (a.reshape(-1, 3) for a in (points, normals, tangents))
    p = points[triangles]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    triangles = triangles[area > 1e-12 * area.max()]
    tangents = np.concatenate([tangents, np.ones((len(tangents), 1))], axis=1)
    return Mesh(points, normals, triangles, closed, tangents=tangents)


def _moved(mesh, axes, up):
    """Return a mesh lifted by `up` along y, then its x, y and z turned onto the rows of `axes`."""
    points = (mesh.positions + np.array([0.0, up, 0.0])) @ axes
    tangents = np.concatenate([mesh.tangents[:, :3] @ axes, mesh.tangents[:, 3:]], axis=1)
    return Mesh(points, mesh.normals @ axes, mesh.triangles, mesh.closed, tangents=tangents)


def _joined(meshes, closed):
    offsets = np.cumsum([0] + [len(m.positions) for m in meshes[:-1]])
    triangles = [m.triangles + o for m, o in zip(meshes, offsets, strict=True)]
    arrays = ([getattr(m, a) for m in meshes] for a in ("positions", "normals", "tangents"))
    points, normals, tangents = map(np.concatenate, arrays)
    return Mesh(points, normals, np.concatenate(triangles), closed, tangents=tangents)
