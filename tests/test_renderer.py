"""The renderer against float64 NumPy, closed forms, and what must never happen silently."""

import math

import numpy as np
import oracle
import pytest

from lumiar import camera, layout, settings, stock
from lumiar import renderer as module
from lumiar.errors import Mistake
from lumiar.parts import Panel
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
    return layout.arrange(scene, [renderer._stock.mesh(one)[0] for one in scene.objects])


def captured(scene, renderer, program, names):
    """Return what a program sends on from every vertex or face, by transform feedback."""
    spot = placed(scene, renderer)[0]
    for name, value in layout.uniforms(scene, spot).items():
        if name in program:
            program[name].write(value)
    entry = renderer._stock.mesh(spot.object)
    count = entry[0].vertex_count if names == ["rig_front"] else 3 * entry[0].triangle_count
    out = renderer.context.buffer(reserve=12 * count)
    array = renderer.context.vertex_array(
        program,
        [
            (entry[1], "3f 3f" if "rig_vertex_normal" in program else "3f 12x", "rig_vertex")
            + (("rig_vertex_normal",) if "rig_vertex_normal" in program else ())
        ],
        *([entry[3]] if names == ["rig_face"] else []),
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


@pytest.fixture
def current(renderer):
    """Make the renderer's context the current one, which another renderer may have been."""
    with renderer.context:
        yield renderer


PLACES = [{}, {"rotation": (20, 35, -10), "scale": (1.3, 0.8, 1.1), "position": (0.2, -0.1, 0.3)}]


@pytest.mark.parametrize("place", PLACES, ids=["as it lies", "moved"])
@pytest.mark.parametrize("form", ["slide", "normalised"])
@pytest.mark.parametrize("model", ["lambert", "phong", "blinn"])
def test_gouraud_evaluates_the_model_at_each_vertex(current, model, form, place):
    renderer = current
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
def test_flat_evaluates_the_model_once_per_face(current, model, mesh, place):
    renderer = current
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


def mean(scene, renderer):
    return radiance(scene, renderer).reshape(-1, 3).mean(0)


@pytest.mark.parametrize("model", ["lambert", "phong", "blinn"])
def test_every_slider_toggle_and_choice_changes_the_picture(renderer, model):
    scene = lit(model=model, size=(48, 48))
    before = radiance(scene, renderer)
    for parameter in scene.objects[0].model.parameters:
        old = scene.objects[0].values[parameter.name]
        if parameter.widget == "toggle":
            new = not old
        elif parameter.widget == "choice":
            new = next(c for c in parameter.choices if c != old)
        else:
            new = 0.3 if parameter.widget == "color" else old * 2.5
        after = radiance(scene.changed(parameter.name, new), renderer)
        assert np.abs(after - before).max() > 1e-3, parameter.name


@pytest.mark.parametrize("kind", list(LIGHTS))
def test_every_value_of_a_light_changes_the_picture(renderer, kind):
    scene = lit(kind, size=(48, 48))
    before = radiance(scene, renderer)
    for parameter in scene.lights[0].kind.parameters:
        old = scene.lights[0].values[parameter.name]
        new = [v * 0.5 + 0.2 for v in old] if isinstance(old, tuple) else old * 0.7
        after = radiance(scene.changed(f"light.1.{parameter.name}", new), renderer)
        assert np.abs(after - before).max() > 1e-3, parameter.name


def test_one_scale_for_all_models(renderer):
    """Lambert with albedo 1 under irradiance pi, seen and lit head-on, has radiance 1."""
    scene = Scene.default().set(
        model="lambert",
        albedo=1.0,
        mesh="plane",
        light="directional:direction=0,1,0",
        camera__position=(0, 5, 0),
        camera__up=(0, 0, 1),
        size=(8, 8),
        background=0.0,
    )
    scene = scene.changed("irradiance", math.pi)
    assert np.abs(radiance(scene, renderer)[4, 4] - 1.0).max() < 1e-6


def test_a_point_light_obeys_the_inverse_square(renderer):
    """A facing Lambert surface at distance d has radiance rho I / (pi d^2)."""
    scene = Scene.default().set(
        model="lambert",
        albedo=0.5,
        mesh="plane:width=0.01",
        size=(5, 5),
        samples=1,
        camera__position=(0, 0.02, 0),
        camera__up=(0, 0, 1),
        camera__fov=10,
    )
    for distance in (0.1, 1.0, 3.0, 50.0):
        lit_scene = scene.changed("light", f"point:position=0,{distance},0:intensity=7")
        expected = 0.5 * 7.0 / (math.pi * distance**2)
        assert radiance(lit_scene, renderer)[2, 2, 0] == pytest.approx(expected, rel=2e-6)


def test_lights_add(renderer):
    alone = [radiance(lit(name), renderer) for name in LIGHTS]
    empty = radiance(lit("ambient").set(radiance=0.0), renderer)
    both = radiance(lit(), renderer)
    assert np.abs(sum(alone) - 3 * np.where(empty > 0, empty, 0) - both).max() < 1e-5


def test_many_lights_of_one_kind(renderer):

    one = lit("point")
    many = one._replace(lights=one.lights * 12)
    lit_pixels = radiance(one, renderer)[20:60, 30:60]
    assert np.allclose(radiance(many, renderer)[20:60, 30:60], 12 * lit_pixels, rtol=1e-5)


def test_exposure_is_in_stops_and_the_tone_curves_are_as_published(renderer):
    scene = lit("ambient", model="lambert", albedo=0.5, size=(16, 16))
    level = radiance(scene, renderer)[8, 8].astype(np.float64)
    for ev in (-2.0, 0.0, 1.5):
        for tone in ("none", "reinhard", "aces"):
            linear = level * 2.0**ev
            if tone == "reinhard":
                linear = linear / (1.0 + linear @ [0.2126, 0.7152, 0.0722])
            if tone == "aces":
                linear = linear * (2.51 * linear + 0.03) / (linear * (2.43 * linear + 0.59) + 0.14)
            expected = srgb(np.clip(linear, 0.0, 1.0)) * 255.0
            pixels = capture(scene.set(exposure=ev, tone=tone), renderer=renderer).pixels
            found = np.frombuffer(pixels, np.uint8).reshape(16, 16, 3)[8, 8]
            assert np.abs(found - expected).max() <= 0.51, (ev, tone)


def srgb(linear):
    """IEC 61966-2-1:1999."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


@pytest.mark.parametrize("samples", [4, 16])
def test_samples_average_radiance_not_srgb(renderer, samples):
    """An edge pixel is the mean of the radiance of its samples, drawn one by one, larger."""
    side = math.isqrt(samples)
    scene = lit("directional", size=(24, 24), samples=samples)
    large = radiance(scene.set(size=(24 * side, 24 * side), samples=1), renderer)
    expected = large.reshape(24, side, 24, side, 3).mean((1, 3))
    assert np.abs(radiance(scene, renderer) - expected).max() < 1e-5


def test_strips_do_not_show(renderer, monkeypatch):
    scene = lit(size=(50, 37), samples=4)
    whole = capture(scene, renderer=renderer).pixels
    linear = radiance(scene, renderer)
    monkeypatch.setattr(module, "STRIP", 50 * 4 * 7)
    assert capture(scene, renderer=renderer).pixels == whole
    assert np.abs(radiance(scene, renderer) - linear).max() < 5e-6  # interpolation rounds anew


@pytest.mark.parametrize("samples", [16, 1100])  # in one pass, in several
def test_a_picture_shown_some_rows_at_a_time_is_the_picture(renderer, samples):
    lamp = settings.light(f"sphere:samples={samples}:radius=1")
    scene = lit(size=(50, 37), samples=4)._replace(lights=(lamp,))
    with renderer.context as context:
        canvas = context.framebuffer([context.texture(scene.size, 4)])
    for top in range(0, 37, 8):
        renderer.show(scene, canvas, top, 8)
    expected = capture(scene, renderer=renderer).pixels
    with renderer.context:
        assert canvas.read(components=3) == expected
        renderer.free_framebuffer(canvas)


def test_the_picture_is_upright_and_not_mirrored(renderer):
    """A small sphere up and to the right of the target is up and to the right in the picture."""
    scene = lit("ambient", camera__position=(0, 0, 10), camera__target=(0, 0, 0), fit=0.3)
    scene = scene.set(position=(1.0, 0.6, 0.0), background=0.0)
    rows, columns = np.nonzero(radiance(scene, renderer).sum(2) > 0.01)
    assert rows.mean() < 80 * 0.4 and columns.mean() > 96 * 0.6


def test_both_sides_of_an_open_mesh_are_lit(renderer):
    for rate in RATES:
        scene = lit("directional", mesh="plane", model="lambert", shading=rate, size=(16, 16))
        scene = scene.changed("light", "directional:direction=0,1,0")
        above = scene.set(camera__elevation=60)
        below = scene.changed("light", "directional:direction=0,-1,0").set(camera__elevation=-60)
        expected = radiance(above, renderer)[8, 8, 0]
        assert expected > 0.5 and radiance(below, renderer)[8, 8, 0] == pytest.approx(
            expected, 1e-5
        )


def test_the_inside_of_a_solid_is_seen_from_within(renderer):
    scene = lit("ambient", mesh="box", model="lambert", albedo=0.5, background=0.0)
    scene = scene.set(camera__position=(0, 0, 0.5), camera__target=(0, 0, -1), camera__fov=60)
    assert radiance(scene, renderer).min() > 0.05


@pytest.mark.parametrize("rate", RATES)
def test_a_mirrored_object_keeps_its_outside(renderer, rate):
    """A sphere scaled by -1 along x is the same sphere."""
    scene = lit("directional", model="phong", shading=rate, mesh="torus", size=(40, 40))
    mirrored = scene.set(scale=(-1, 1, 1))
    difference = np.abs(radiance(scene, renderer) - radiance(mirrored, renderer))
    assert np.quantile(difference, 0.97) < (0.2 if rate == "flat" else 1e-3)


def test_fit_brings_any_mesh_to_size(renderer):
    scene = lit("directional", size=(40, 40), camera__position=(0, 0, 6), camera__target=(0, 0, 0))
    small = scene.set(mesh="sphere:radius=0.001", fit=1.0)
    large = scene.set(mesh="sphere:radius=1000", fit=1.0)
    assert np.abs(radiance(small, renderer) - radiance(large, renderer)).max() < 1e-3


@pytest.mark.parametrize("radius", [1e-6, 1e-3, 1.0, 1e3, 1e6])
@pytest.mark.parametrize("rate", RATES)
def test_the_camera_frames_a_mesh_of_any_size(renderer, radius, rate):
    scene = lit("directional", mesh=f"sphere:radius={radius}", shading=rate, background=0.0)
    found = radiance(scene, renderer).sum(2)
    reference = radiance(scene.set(mesh="sphere"), renderer).sum(2)
    assert np.abs(found - reference).max() < 2e-3


NAN = """\
// model   Broken
uniform float edge = 0.5;  // [0, 1]: where it breaks
vec3 scatter(vec3 L, vec3 V) { return vec3(L.z > edge ? sqrt(-L.z) : 1.0 / (L.z - L.z)); }
"""


def test_broken_pixels_are_counted_and_magenta(renderer, tmp_path):
    path = tmp_path / "nan.glsl"
    path.write_text(NAN)
    scene = lit("directional", model=str(path), size=(32, 32))
    picture = capture(scene, renderer=renderer)
    pixels = np.frombuffer(picture.pixels, np.uint8).reshape(32, 32, 3)
    magenta = (pixels == [255, 0, 255]).all(2)
    broken = ~np.isfinite(radiance(scene, renderer)).all(2)
    assert picture.broken == broken.sum() > 300
    assert (magenta == broken).all()


@pytest.mark.parametrize(
    ("body", "line"),
    [("return vec3(nope);", 3), ("return vec3(1.0)", 4), ("return 1.0;", 3), ("vec3 L;", 3)],
)
@pytest.mark.parametrize("rate", RATES)
def test_a_shader_error_names_file_and_line(renderer, tmp_path, body, line, rate):
    path = tmp_path / "bad.glsl"
    path.write_text(f"// model   Bad\nvec3 scatter(vec3 L, vec3 V) {{\n    {body}\n}}\n")
    scene = lit("directional", model=str(path), shading=rate)
    with pytest.raises(Mistake) as told:
        radiance(scene, renderer)
    assert str(told.value).startswith(f"{path}:{line}: the driver does not compile this: ")


def test_the_driver_tells_its_name_after_drawing_too(renderer):
    radiance(lit().set(size=(8, 8)), renderer)
    assert all(renderer.name.split(", OpenGL "))


def test_a_size_beyond_the_driver_is_refused(renderer):
    with pytest.raises(Mistake, match="more than this driver draws"):
        next(renderer.strips(lit().set(size=(16384, 16), samples=4)))


def test_time_reaches_a_model_that_asks_for_it(renderer, tmp_path):
    path = tmp_path / "glow.glsl"
    path.write_text(
        "// model   Glow\nuniform float age = 0.0;  // time: since the start (s)\n"
        "vec3 scatter(vec3 L, vec3 V) { return vec3(exp2(-age)) * max(L.z, 0.0); }\n"
    )
    scene = lit("directional", model=str(path), background=0.0)
    early, late = (mean(scene.set(time=t), renderer) for t in (0.0, 2.0))
    assert late == pytest.approx(early / 4.0, rel=1e-5)


@pytest.mark.parametrize("rate", RATES)
def test_tangents_reach_a_model_that_asks_for_them(renderer, tmp_path, rate):
    """T, B, N are orthonormal, and T of a torus runs around its axis."""
    path = tmp_path / "frame.glsl"
    path.write_text(
        "// model   Frame\n// needs   tangent\nvec3 scatter(vec3 L, vec3 V) { return L * L; }\n"
    )
    scene = lit("directional", model=str(path), mesh="torus", shading=rate, background=0.0)
    scene = scene.set(irradiance=1.0, color=1.0)
    found = radiance(scene, renderer).reshape(-1, 3)
    seen = found.sum(1) > 0.0
    assert np.abs(found[seen].sum(1) - 1.0).max() < 5e-5
    upright = radiance(scene.set(direction=(0, 1, 0)), renderer).reshape(-1, 3)
    assert upright[seen][:, 0].max() < (2e-3 if rate == "flat" else 1e-5)


def test_several_objects_hide_each_other(renderer):

    scene = lit("ambient", model="lambert", background=0.0, size=(32, 32))
    near = scene.objects[0]._replace(
        position=(0.0, 0.0, 2.0),
        values={"albedo": (1.0, 0.0, 0.0), "form": "normalised"},
    )
    far = near._replace(
        position=(0.0, 0.0, -2.0), values={**near.values, "albedo": (0.0, 1.0, 0.0)}
    )
    for order in ((near, far), (far, near)):
        both = scene._replace(objects=order).set(camera__azimuth=0, camera__elevation=0)
        middle = radiance(both, renderer)[16, 16]
        assert middle[0] > 0.1 and middle[1] == 0.0


def test_the_same_scene_gives_the_same_bytes(renderer):
    scene = lit(mesh="teapot:segments=4", size=(64, 64), samples=4)
    first = capture(scene, renderer=renderer).pixels
    with module.Renderer() as other:
        assert capture(scene, renderer=other).pixels == first


def test_what_was_compiled_is_kept():
    with module.Renderer() as renderer:
        scene = lit(size=(8, 8))
        radiance(scene, renderer)
        compiled = len(renderer._programs)
        radiance(scene.set(shininess=7.0, kd=0.1, exposure=1.0), renderer)
        assert len(renderer._programs) == compiled
        radiance(scene.set(form="normalised"), renderer)
        assert len(renderer._programs) == compiled + 1


def test_what_is_released_twice_is_released_once():
    renderer = module.Renderer()
    radiance(lit(size=(8, 8)), renderer)
    renderer.release()
    renderer.release()
    with module.Renderer() as other:
        other.release()


def test_after_a_scene_that_fails_the_one_before_is_drawn_as_it_was(renderer, monkeypatch):
    from lumiar import occluders, settings

    def fails(triangles):
        raise Mistake("too many")

    lights = (settings.light("sky"), settings.light("point:shadows=true"))
    good = lit(size=(24, 24))._replace(lights=lights)
    first = radiance(good, renderer)
    with monkeypatch.context() as patch:
        patch.setattr(occluders, "build", fails)
        with pytest.raises(Mistake, match="too many"):
            radiance(good.set(position=(1, 0, 0)), renderer)
    assert first.any() and (radiance(good, renderer) == first).all()


def test_progress_rises_to_one(renderer, monkeypatch):
    scene = lit(size=(50, 37))
    sheet = scene._replace(panels=(Panel(), Panel(), Panel()))
    for one, calls, strip in ((scene, 1, 50 * 100), (scene, 6, 50 * 7), (sheet, 3, 50 * 7)):
        monkeypatch.setattr(module, "STRIP", strip)
        told = []
        capture(one, renderer=renderer, progress=told.append)
        assert len(told) == calls and told == sorted(told) and told[0] > 0.0 and told[-1] == 1.0


def test_progress_of_linear_radiance_rises_to_one(renderer, monkeypatch, tmp_path):
    monkeypatch.setattr(module, "STRIP", 50 * 7)
    told = []
    capture(lit(size=(50, 37)), str(tmp_path / "a.npy"), renderer, told.append)
    assert len(told) > 6 and told == sorted(told) and told[-1] == 1.0


@pytest.mark.parametrize(
    "values",
    [{"scale": 1e10}, {"scale": 1e-12}, {"fit": 1e6}, {"fit": 1e-6}, {"fit": 1e6, "scale": 1e10}],
    ids=str,
)
@pytest.mark.parametrize("rate", RATES)
def test_the_camera_frames_an_object_of_any_scale(renderer, values, rate):
    """The same picture, and no pixel of it broken."""
    scene = lit("directional", mesh="torus", rotation=(20, 0, 30), shading=rate, background=0.0)
    found, expected = (radiance(one, renderer) for one in (scene.set(**values), scene))
    off = np.abs(found - expected).max(2)
    assert np.mean(off > 2e-3) < 2e-3 and np.isfinite(found).all()  # an edge may cover a pixel more


@pytest.mark.parametrize("side", [1e-16, 1e-9, 1e9, 1e16])
def test_fit_frames_a_mesh_file_of_any_size(renderer, tmp_path, side):
    scene = lit("directional", fit=1.0, background=0.0)
    found = radiance(scene.set(mesh=cubes(tmp_path / "any.off", side)), renderer)
    expected = radiance(scene.set(mesh=cubes(tmp_path / "one.off", 1.0)), renderer)
    off = np.abs(found - expected).max(2)
    assert np.mean(off > 1e-4) < 2e-3 and np.isfinite(found).all() and expected.max() > 0.3


def cubes(path, side, turned=()):
    """Write one cube, or with `turned`, one for each of it, inside out where it says so."""
    faces = ["0 1 3 2", "4 6 7 5", "0 4 5 1", "2 3 7 6", "0 2 6 4", "1 5 7 3"]
    points, sides = [], []
    for i, inside_out in enumerate(turned or (False,)):
        points += [
            f"{side * (x + 2 * i)!r} {side * y!r} {side * z!r}"
            for x in (0, 1)
            for y in (0, 1)
            for z in (0, 1)
        ]
        for face in faces:
            first, *rest = (str(int(c) + 8 * i) for c in face.split())
            sides.append(" ".join(["4", first, *rest[:: -1 if inside_out else 1]]))
    path.write_text("\n".join(["OFF", f"{len(points)} {len(sides)} 0", *points, *sides]) + "\n")
    return str(path)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("turned", [(True, False), (False, True), (True, True)])
def test_a_solid_inside_out_is_lit_like_its_right_neighbour(renderer, tmp_path, rate, turned):
    scene = lit(shading=rate, model="lambert", size=(96, 48), background=0.0)
    right = radiance(scene.set(mesh=cubes(tmp_path / "right.off", 1.0, (False, False))), renderer)
    found = radiance(scene.set(mesh=cubes(tmp_path / "some.off", 1.0, turned)), renderer)
    assert np.mean(np.abs(found - right).max(2) > 1e-5) < 5e-3 and right.max() > 0.1  # its edges


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("second", ["1//1 3//1 4//1", "1//1 4//1 3//1"])
def test_a_quad_is_lit_evenly_however_its_triangles_are_wound(renderer, tmp_path, rate, second):
    corners = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 1\n"
    (tmp_path / "quad.obj").write_text(f"{corners}f 1//1 2//1 3//1\nf {second}\n")
    scene = lit("directional", model="lambert", shading=rate, background=0.0)
    found = radiance(scene.set(mesh=str(tmp_path / "quad.obj")), renderer)
    seen = found[found.sum(2) > 0.0]
    values = scene.lights[0].values  # albedo / pi E cos
    cosine = 0.5 / math.hypot(*values["direction"])
    expected = np.multiply(values["color"], values["irradiance"]) * cosine * 0.8 / math.pi
    assert len(seen) > 2000 and np.abs(seen - expected).max() < 1e-5


def spotted(light, renderer):
    """Return the radiance of a small plane at the origin, under a light from above."""
    scene = Scene.default().set(model="lambert", mesh="plane:width=1e-3", size=(5, 5), samples=1)
    scene = scene.set(camera__position=(0, 0.002, 0), camera__up=(0, 0, 1), camera__fov=5)
    return radiance(scene.changed("light", light), renderer)[2, 2, 0]


@pytest.mark.parametrize(
    ("inner", "outer"), [(0.0, 0.01), (0.25, 0.5), (0.5, 0.5), (0.0, 0.0), (89, 90)]
)
@pytest.mark.parametrize("place", [(0, 2, 0), (1.3, 2.1, -0.7), (30, 40, 5)])
def test_on_its_axis_a_spot_is_a_point_light_however_narrow(renderer, inner, outer, place):
    at = f"position={place[0]},{place[1]},{place[2]}:intensity=9"
    spot = f"spot:{at}:target=0,0,0:inner={inner}:outer={outer}"
    if outer == 0.0:
        assert np.isfinite(spotted(spot, renderer))  # nothing, or a ray
    else:
        assert spotted(spot, renderer) == pytest.approx(spotted(f"point:{at}", renderer), rel=1e-5)


@pytest.mark.parametrize("angle", [0.2, 0.3, 0.375, 0.45, 0.55])
def test_a_narrow_spot_falls_as_its_paper_says(renderer, angle):
    """Smoothstep in the cosine (Pharr et al., sec. 12.2.1), of which float32 holds no digit."""
    off = 2.0 * math.tan(math.radians(angle))
    spot = f"spot:position=0,2,0:target={off},0,0:intensity=9:inner=0.25:outer=0.5"
    inner, outer, cosine = (math.cos(math.radians(a)) for a in (0.25, 0.5, angle))
    t = min(max((cosine - outer) / (inner - outer), 0.0), 1.0)
    share = spotted(spot, renderer) / spotted("point:position=0,2,0:intensity=9", renderer)
    assert share == pytest.approx(t * t * (3.0 - 2.0 * t), abs=2e-3)


@pytest.mark.parametrize("rate", RATES)
def test_a_spot_on_its_own_target_breaks_no_pixel(renderer, rate):
    scene = lit("spot", shading=rate).set(target=(0.5, 1.5, 1))
    scene = scene.changed("spot.position", (0.5, 1.5, 1))
    assert np.isfinite(radiance(scene, renderer)).all()


@pytest.mark.parametrize("width", [1000, 20000])
def test_a_wide_floor_does_not_cut_into_what_stands_on_it(renderer, width):
    ball = lit("directional", camera__distance=4, camera__target=(0, 0, 0), background=0.0)
    seen = radiance(ball, renderer).sum(2) > 0.0
    floor = ball.objects[0]._replace(position=(0.0, -1.0, 0.0))

    def on(width):
        both = ball._replace(objects=(*ball.objects, floor._replace(mesh=f"plane:width={width}")))
        return radiance(both, renderer)

    assert seen.sum() > 1000
    assert np.abs(on(width) - on(100))[seen].max() < 1e-5


FRAME = """\
// model   Frame
// needs   tangent
vec3 scatter(vec3 L, vec3 V) { return 0.5 + 0.5 * L; }
"""


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("mesh", ["plane", "torus", "teapot"])
def test_a_mirrored_object_is_lit_as_in_a_mirror(renderer, tmp_path, rate, mesh):
    """Scaled by -1 along x, seen and lit from x = 0: the mirrored picture, its bitangents too."""
    (tmp_path / "frame.glsl").write_text(FRAME)
    scene = lit("directional", model=str(tmp_path / "frame.glsl"), mesh=mesh, shading=rate)
    scene = scene.set(direction=(0, 0.8, 0.6), irradiance=1, color=1, background=0.0)
    scene = scene.set(camera__azimuth=0, camera__elevation=40, camera__target=(0, 0, 0))
    scene = scene.set(camera__distance=8, size=(64, 64))
    found = radiance(scene.set(scale=(-1, 1, 1)), renderer)
    expected = radiance(scene, renderer)[:, ::-1]
    assert (expected.sum(2) > 0.0).sum() > 100 and np.ptp(expected[..., 1]) > 0.1
    off = np.abs(found - expected).max(2)
    assert np.mean(off > 1e-3) < (0.02 if mesh == "teapot" else 5e-3)  # pixels on edges


def test_a_mesh_file_that_changed_is_drawn_anew(renderer, tmp_path):
    path = tmp_path / "t.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    scene = lit("ambient", mesh=str(path), model="lambert", camera__distance=6, background=0.0)
    scene = scene.set(camera__target=(0, 0, 0), camera__azimuth=0)
    small = (radiance(scene, renderer) > 0.0).sum()
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1.25 0\n3 0 1 2\n")
    for again in (scene.set(exposure=0.0), scene):
        assert (radiance(again, renderer) > 0.0).sum() == pytest.approx(1.25 * small, rel=0.1)


def test_a_hundred_meshes_are_not_all_kept():
    with module.Renderer() as renderer:
        scene = lit("directional", size=(16, 16), shading="flat")
        first = radiance(scene.set(mesh="uv_sphere:rings=2"), renderer)
        for rings in range(3, 103):
            radiance(scene.set(mesh=f"uv_sphere:rings={rings}:segments=4"), renderer)
            assert len(renderer._stock.meshes) <= stock.MESHES + 1
            assert len(renderer._stock.arrays) <= stock.MESHES + 8
        assert (radiance(scene.set(mesh="uv_sphere:rings=2"), renderer) == first).all()


def test_lights_that_surround_add_up_for_the_eye_as_in_a_mirror(renderer):
    from lumiar import settings

    texts = ("furnace:radiance=1", "sun:height=0:azimuth=0", "furnace:radiance=2")
    lights = tuple(settings.light(f"{text}:visible=true") for text in texts)
    scene = lit(size=(33, 33), background=0.05)._replace(lights=lights).set(camera__fov=2.0)
    scene = scene.set(camera__position=(0, 0, -9), camera__target=(0, 0, 0), scale=0.01)
    aside = scene.set(object__1__position=(5, 0, 0))  # behind the object is the sun
    one, hidden = radiance(aside, renderer), radiance(scene, renderer)
    assert one[0, 0] == pytest.approx((3.0, 3.0, 3.0))
    assert one[16, 16, 0] > 1e4 and hidden[16, 16, 0] < 10.0
    alone = radiance(aside._replace(lights=lights[1:2]), renderer)[16, 16]
    assert one[16, 16] - alone == pytest.approx((3.0 - 0.05,) * 3, abs=0.05)


def test_a_model_may_call_things_as_the_library_of_a_light_does(renderer, tmp_path):
    from lumiar import settings

    header = "// model   Own\nuniform float k = 0.5;  // [0, 1]: factor (1/sr)\n"
    names = "const float PI = 3.0;\nstruct Blade { float a; };\n#define FAN_SLACK 1.0\n"
    names += "float azimuth(float y, float x) { return 0.0 * y; }\n"
    main = "vec3 scatter(vec3 L, vec3 V) { return vec3(k * max(L.z, 0.0)MORE); }\n"
    used = " + azimuth(L.y, L.x) + Blade(PI).a - 3.0 * FAN_SLACK"
    lights = tuple(settings.light(text) for text in ("quad:shadows=true", "sky", "sphere"))
    pictures = []
    for i, text in enumerate((main.replace("MORE", ""), names + main.replace("MORE", used))):
        (tmp_path / f"{i}.glsl").write_text(header + text)
        scene = lit(model=str(tmp_path / f"{i}.glsl"), size=(16, 16))
        pictures.append(radiance(scene._replace(lights=lights), renderer))
    assert pictures[0].any() and (pictures[0] == pictures[1]).all()
