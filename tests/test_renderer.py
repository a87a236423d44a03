"""The renderer against float64 NumPy, closed forms, and what must never happen silently."""

import math
import struct

import numpy as np
import oracle
import pytest

from lumiar import camera, layout
from lumiar import renderer as module
from lumiar.errors import Mistake
from lumiar.picture import capture, radiance
from lumiar.scene import Scene

RATES = ("flat", "gouraud", "phong")
LIGHTS = {
    "directional": "directional:direction=0.3,0.8,0.5:color=1,0.9,0.7",
    "point": "point:position=1.5,2,1:intensity=9",
    "spot": "spot:position=-1,2.5,1.5:target=0.2,0,0:intensity=30:inner=8:outer=25",
    "ambient": "ambient:radiance=0.7:color=0.4,0.5,1",
}


def lit(*names, **values):
    """Return a scene under the lights named, one sample per pixel."""
    from lumiar import settings

    lights = tuple(settings.light(LIGHTS[name]) for name in names or LIGHTS)
    scene = Scene(Scene.default().objects, lights, samples=1, size=(96, 80))
    return scene.set(**values)


def placed(scene, renderer):
    return layout.arrange(scene, [renderer._mesh(one)[0] for one in scene.objects])


def captured(scene, renderer, program, names):
    """Return what a program sends on from every vertex or face, by transform feedback."""
    spot = placed(scene, renderer)[0]
    for name, value in {
        "rig_clip": module._columns(spot.clip, 4),
        "rig_world": module._columns(spot.world, 4),
        "rig_turn": module._columns(camera.normal_matrix(spot.world), 3),
        "rig_eye": struct.pack("3f", *spot.eye),
        **module._uniforms(spot.object.model, spot.object.values, scene, ""),
        **{
            key: value
            for i, light in enumerate(scene.lights, 1)
            for key, value in module._uniforms(light.kind, light.values, scene, f"_{i}").items()
        },
    }.items():
        if name in program:
            program[name].write(value)
    entry = renderer._mesh(spot.object)
    count = entry[0].vertex_count if names == ["rig_front"] else 3 * entry[0].triangle_count
    out = renderer.context.buffer(reserve=12 * count)
    array = renderer.context.vertex_array(
        program,
        [
            (entry[2], "3f 3f" if "rig_vertex_normal" in program else "3f 12x", "rig_vertex")
            + (("rig_vertex_normal",) if "rig_vertex_normal" in program else ())
        ],
        *([entry[4]] if names == ["rig_face"] else []),
    )
    frame = renderer.context.framebuffer([renderer.context.texture((4, 4), 4)])
    frame.use()  # transform feedback draws nothing, and still needs somewhere to draw
    array.transform(
        out, module.moderngl.POINTS if names == ["rig_front"] else module.moderngl.TRIANGLES
    )
    return np.frombuffer(out.read(), np.float32).reshape(count, 3).astype(np.float64)


def world(spot, points, normals):
    """Return points and unit normals of an object in the scene, in float64."""
    matrix = np.array(spot.world).reshape(4, 4)
    turn = np.linalg.inv(matrix[:3, :3]).T
    return points @ matrix[:3, :3].T + matrix[:3, 3], oracle.unit(normals @ turn.T)


PLACES = [{}, {"rotation": (20, 35, -10), "scale": (1.3, 0.8, 1.1), "position": (0.2, -0.1, 0.3)}]


@pytest.mark.parametrize("place", PLACES, ids=["as it lies", "moved"])
@pytest.mark.parametrize("form", ["slide", "normalised"])
@pytest.mark.parametrize("model", ["lambert", "phong", "blinn"])
def test_gouraud_evaluates_the_model_at_each_vertex(renderer, model, form, place):
    scene = lit(model=model, form=form, shading="gouraud", mesh="sphere:subdivision=3", **place)
    spot = placed(scene, renderer)[0]
    source = layout.sources(scene, spot)["vertex"].text
    program = renderer.context.program(vertex_shader=source, varyings=["rig_front"])
    found = captured(scene, renderer, program, ["rig_front"])
    points, normals, _ = oracle.arrays("sphere:subdivision=3")
    expected = oracle.radiance(
        scene, spot.object, *world(spot, points, normals), np.array(spot.eye)
    )
    assert_close(found, expected)


@pytest.mark.parametrize("place", PLACES, ids=["as it lies", "moved"])
@pytest.mark.parametrize("model", ["lambert", "phong", "blinn"])
@pytest.mark.parametrize("mesh", ["sphere:subdivision=2", "sphere:subdivision=7"])
def test_flat_evaluates_the_model_once_per_face(renderer, model, mesh, place):
    scene = lit(model=model, shading="flat", mesh=mesh, **place)
    spot = placed(scene, renderer)[0]._replace(closed=False)  # back faces too
    sources = layout.sources(scene, spot)
    program = renderer.context.program(
        vertex_shader=sources["vertex"].text,
        geometry_shader=sources["geometry"].text,
        varyings=["rig_face"],
    )
    found = captured(scene, renderer, program, ["rig_face"])
    assert (found[0::3] == found[1::3]).all() and (found[0::3] == found[2::3]).all()
    points, _, triangles = oracle.arrays(mesh)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    points, normals = world(spot, corners.mean(1), normals)
    eye = np.array(spot.eye)
    side = ((eye - points) * normals).sum(1)
    normals *= np.sign(side)[:, None]
    expected = oracle.radiance(scene, spot.object, points, normals, eye)
    sure = np.abs(side) > 1e-4  # seen edge-on, either side may be the one
    assert_close(found[0::3][sure], expected[sure])


@pytest.mark.parametrize("place", PLACES, ids=["as it lies", "moved"])
@pytest.mark.parametrize("model", ["lambert", "phong", "blinn"])
@pytest.mark.parametrize("rate", RATES)
def test_each_rate_agrees_at_every_pixel(renderer, rate, model, place):
    scene = lit(model=model, shading=rate, mesh="sphere:subdivision=2", **place)
    found = radiance(scene, renderer).reshape(-1, 3).astype(np.float64)
    spot = placed(scene, renderer)[0]
    points, normals, triangles = oracle.arrays("sphere:subdivision=2")
    points, normals = world(spot, points, normals)
    eye = np.array(spot.eye)
    target = camera.viewpoint(scene.camera, 1.2, *sphere_of(spot))[1]
    directions = oracle.rays(eye, target, scene.camera.up, scene.camera.fov, scene.size)
    which, weights = oracle.hits(eye, directions, points[triangles])
    inside = (which >= 0) & (weights.min(1) > 0.01)  # edges may go to either side
    faces, w = triangles[which[inside]], weights[inside][..., None]
    at = (points[faces] * w).sum(1)
    if rate == "flat":
        corners = points[faces]
        n = oracle.unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        expected = oracle.radiance(scene, spot.object, corners.mean(1), n, eye)
    elif rate == "gouraud":
        every = oracle.radiance(scene, spot.object, points, normals, eye)
        expected = (every[faces] * w).sum(1)
    else:
        expected = oracle.radiance(
            scene, spot.object, at, oracle.unit((normals[faces] * w).sum(1)), eye
        )
    assert inside.sum() > 1500
    worst = np.abs(found[inside] - expected).max() / expected.max()
    assert worst < 1e-5, f"off by {worst:.2e} of the brightest pixel"


def sphere_of(spot):
    reach = max(map(abs, spot.object.scale)) * spot.geometry.radius
    return camera.point(spot.world, spot.geometry.centre), reach


def assert_close(found, expected, limit=1e-5):
    """Each value within 1e-5 of float64, relative to itself or to 1e-3 of the largest."""
    scale = np.maximum(np.abs(expected), 1e-3 * np.abs(expected).max())
    worst = np.max(np.abs(found - expected) / scale)
    assert worst < limit, f"off by {worst:.2e}"
