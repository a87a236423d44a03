"""A renderer in float64 NumPy, to hold the real one against: rays, triangles, angles, no GLSL."""

import numpy as np

from lumiar import geometry, reference


def arrays(spec, crease=None):
    """Return (positions, normals, triangles) of a mesh as the card gets them, in float64."""
    mesh = geometry.load(spec, crease=crease)
    vertices = np.frombuffer(mesh.vertices, np.float32).reshape(-1, 6).astype(np.float64)
    return vertices[:, :3], vertices[:, 3:], np.frombuffer(mesh.indices, np.uint32).reshape(-1, 3)


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def local(w, normals):
    """Return directions in a frame about each normal (Gram-Schmidt from the least aligned axis)."""
    axis = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    tangent = unit(axis - normals * (axis * normals).sum(1, keepdims=True))
    bitangent = np.cross(normals, tangent)
    return np.stack([(w * a).sum(1) for a in (tangent, bitangent, normals)], axis=1)


def incident(light, points):
    """Return (directions to the light, irradiance on a facing surface) at points."""
    values = {k: np.asarray(v, np.float64) for k, v in light.values.items()}
    if light.kind.name == "directional":
        toward = np.broadcast_to(unit(values["direction"]), points.shape)
        return toward, np.broadcast_to(values["irradiance"] * values["color"], points.shape)
    offset = values["position"] - points
    distance = np.linalg.norm(offset, axis=1, keepdims=True)
    toward = offset / distance
    intensity = values["intensity"] * np.ones_like(distance)
    if light.kind.name == "spot":
        axis = unit(values["position"] - values["target"])
        cosine = toward @ axis
        inner, outer = (np.cos(np.radians(values[k])) for k in ("inner", "outer"))
        t = np.clip((cosine - outer) / (inner - outer), 0.0, 1.0)
        intensity = intensity * (3.0 * t**2 - 2.0 * t**3)[:, None]
    return toward, intensity * values["color"] / distance**2


def radiance(scene, one, points, normals, eye):
    """Return (n, 3) radiance toward the eye at points of an object with these unit normals."""
    values = dict(one.values)
    view = local(unit(eye - points), normals)
    view[:, 2] = np.maximum(view[:, 2], 1e-3)  # as opaque surfaces are seen where normals lean away
    total = np.zeros_like(points)
    model = getattr(reference, one.model.name)
    for light in scene.lights:
        if light.kind.name == "ambient":
            share = np.asarray(values.get("ka", values.get("albedo")))
            if one.model.name == "lambert" and values["form"] == "slide":
                share = share * np.pi  # f = k_d reflects pi times the light, whatever its kind
            color = np.asarray(light.values["color"])
            total += share * light.values["radiance"] * color
        else:
            toward, irradiance = incident(light, points)
            total += irradiance * model(local(toward, normals), view, **values)
    return total


def rays(eye, target, up, fov, size):
    """Return (h * w, 3) directions through the middles of the pixels, rows from the top."""
    width, height = size
    back = unit(np.subtract(eye, target))
    right = unit(np.cross(up, back))
    above = np.cross(back, right)
    half = np.tan(np.radians(fov) / 2.0)
    x = (2.0 * (np.arange(width) + 0.5) / width - 1.0) * half * width / height
    y = (1.0 - 2.0 * (np.arange(height) + 0.5) / height) * half
    x, y = np.meshgrid(x, y)
    return unit(x[..., None] * right + y[..., None] * above - back).reshape(-1, 3)


def hits(eye, directions, corners):
    """Return (nearest triangle or -1, barycentric coordinates) of rays; T. Möller and B. Trumbore,
    "Fast, minimum storage ray-triangle intersection", 1997. corners is (F, 3, 3)."""
    e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    best = np.full(len(directions), np.inf)
    which = np.full(len(directions), -1)
    weights = np.zeros((len(directions), 3))
    offset = np.asarray(eye) - corners[:, 0]
    q = np.cross(offset, e1)
    for i in range(len(corners)):
        p = np.cross(directions, e2[i])
        det = p @ e1[i]
        with np.errstate(divide="ignore", invalid="ignore"):
            u = (p @ offset[i]) / det
            v = (directions @ q[i]) / det
            t = (e2[i] @ q[i]) / det
        nearer = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0) & (t < best)
        best[nearer], which[nearer] = t[nearer], i
        weights[nearer] = np.stack([1 - u - v, u, v], axis=1)[nearer]
    return which, weights
