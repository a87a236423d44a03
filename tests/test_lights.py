"""Lights in scenes: their unit, their spectrum, their shadows, their samples, seen by the eye."""

import math
import re

import numpy as np
import pytest

from lumiar import catalog, compose, layout, reference, scenefile, units
from lumiar.errors import Mistake
from lumiar.picture import capture, radiance
from lumiar.scene import Scene

MODELS = catalog.names("model")
LAMPS = """\
[[light]]
kind = "point"
intensity = "800 lm"
temperature = 2700
shadows = true

[[light]]
kind = "directional"
irradiance = "1000 lx"
illuminant = "F2"

[[light]]
kind = "sky"
height = 40
samples = 64
visible = true

[[light]]
kind = "furnace"
radiance = 2.0
unit = "cd/m²"
"""


def parsed(text, path="scene.toml"):
    return scenefile.parse(text, path, Scene.default())


def below(light, **values):
    """Return a scene that looks straight down at a white plane one metre wide around the origin."""
    scene = Scene.default().set(
        mesh="plane:width=1", model="lambert", albedo=1.0, size=(33, 33), samples=1
    )
    scene = scene.set(camera__elevation=90.0, camera__fov=20.0)
    return scene.changed("light", light).set(**values)


def middle(scene, renderer):
    return radiance(scene, renderer)[16, 16].astype(float)


def test_a_light_says_its_unit_its_spectrum_and_what_else_it_is():
    point, directional, sky, furnace = parsed(LAMPS).lights
    assert (point.values["intensity"], point.unit, point.temperature) == (800.0, "lm", 2700.0)
    assert point.shadows and not sky.shadows
    assert (directional.unit, directional.illuminant) == ("lx", "F2")
    assert (sky.samples, sky.visible) == (64, True)
    assert (furnace.values["radiance"], furnace.unit) == (2.0, "cd/m^2")


def test_what_lights_say_survives_writing_and_reading():
    scene = parsed(LAMPS)
    assert parsed(scene.toml()).lights == scene.lights


def test_the_same_on_the_command_line():
    scene = Scene.default().changed("light", "point:intensity=800 lm:temperature=2700:shadows=true")
    assert scene.lights[0] == parsed(LAMPS).lights[0]
    assert scene.set(light__1__unit="cd").lights[0].unit == "cd"


def test_of_temperature_and_illuminant_the_last_one_holds():
    scene = Scene.default().changed("light", "point:temperature=2700:illuminant=D50")
    assert (scene.lights[0].temperature, scene.lights[0].illuminant) == (None, "D50")
    scene = scene.changed("light.1.temperature", 4000)
    assert (scene.lights[0].temperature, scene.lights[0].illuminant) == (4000.0, "")


@pytest.mark.parametrize(
    ("text", "line", "told"),
    [
        ('[[light]]\nkind = "point"\nintensity = "5 lx"', 3, "in lx; allowed: W/sr, cd, W, lm"),
        ('[[light]]\nkind = "point"\nunit = "parsec"', 3, "no unit 'parsec'"),
        ('[[light]]\nkind = "point"\nintensity = "many lm"', 3, "is no number with a unit"),
        ('[[light]]\nkind = "point"\nsamples = 4', 3, "point has no samples"),
        ('[[light]]\nkind = "sun"\nheight = 5\nunit = "W"', 4, "sun has no unit"),
        ('[[light]]\nkind = "studio"\nshadows = true', 3, "studio has no shadows"),
        ('[[light]]\nkind = "point"\nvisible = true', 3, "point has no visible"),
        ('[[light]]\nkind = "sky"\nimage = "a.hdr"', 3, "sky has no image"),
        ('[[light]]\nkind = "furnace"\nsamples = 5000', 3, "allowed: a whole number, 1 to 4096"),
        ('[[light]]\nkind = "point"\nilluminant = "D66"', 3, "no illuminant 'D66'"),
        ('[[light]]\nkind = "point"\ntemperature = 20', 3, "allowed: 500 to 100000"),
        (
            '[[light]]\nkind = "point"\ntemperature = 2700\nilluminant = "A"',
            4,
            "a temperature and an illuminant; leave one out",
        ),
        ('[[light]]\nkind = "environment"\nimage = "../a.hdr"', 3, "outside the folder"),
        ('ev100 = "bright"', 1, "ev100"),
        ('[[light]]\nkind = "point"\nintensity = "8 lm"\nunit = "cd"', 4, "has a unit of its own"),
        ('[[light]]\nkind = "point"\ncolor = 0\nintensity = "8 lm"', 4, "brighten its color"),
        ('[[light]]\nkind = "quad"\nwidth = 0\nradiance = "8 lm"', 4, "make it larger"),
        ('[[light]]\nkind = "environment"\nimage = "\\u0000.hdr"', 3, "no file has such a name"),
        ('[[object]]\nmesh = "\\u0000.obj"', 2, "no file has such a name"),
    ],
)
def test_what_a_light_cannot_be_is_told_in_one_line(text, line, told):
    with pytest.raises(Mistake) as mistake:
        parsed(text)
    assert f"scene.toml:{line}: " in str(mistake.value) and told in str(mistake.value)
    assert "\n" not in str(mistake.value)


@pytest.mark.parametrize(
    "spectrum", ["", ":temperature=2700", ":illuminant=F11", ":color=1,0.5,0.2"]
)
@pytest.mark.parametrize(
    ("light", "lux"),
    [
        ("point:position=0,2,0:intensity=800 lm", 800.0 / (4.0 * math.pi * 4.0)),
        ("point:position=0,2,0:intensity=100 cd", 25.0),
        ("point:position=1,1,0:intensity=100 cd", 100.0 / 2.0 / math.sqrt(2.0)),
        ("directional:direction=0,1,1:irradiance=1000 lx", 1000.0 / math.sqrt(2.0)),
        ("furnace:radiance=100 cd/m2", 100.0 * math.pi),
        ("spot:position=0,2,0:target=0,0,0:intensity=100 cd", 25.0),
    ],
)
def test_luminous_units_arrive_as_lux_whatever_the_spectrum(renderer, light, lux, spectrum):
    """E = I cos / d^2; the plane is white, so its luminance is E / pi."""
    found = units.luminance(middle(below(light + spectrum), renderer)) * math.pi
    assert found == pytest.approx(lux, rel=2e-6)


def test_watts_become_lumens_by_the_efficacy_of_their_spectrum(renderer):
    """A black body of 2856 K has 16.45 lm/W over all wavelengths (PHYSICS C.7)."""
    found = units.luminance(
        middle(below("point:position=0,2,0:intensity=100 W:temperature=2856"), renderer)
    )
    lux = 100.0 * 16.45 / (4.0 * math.pi * 4.0)
    assert found * math.pi == pytest.approx(lux, rel=1e-3)


def test_a_closed_black_sphere_gets_the_same_lux_everywhere(renderer):
    """A point light of Phi lm in the middle: Phi / (4 pi r^2), pi times a white coat's L."""
    scene = Scene.default().set(
        mesh="sphere:radius=2.5", model="lambert", albedo=1.0, size=(64, 64), samples=1
    )
    scene = scene.set(
        camera__position=(0.0, 0.0, 2.4), camera__target=(0.0, 0.0, 0.0), camera__fov=90
    )
    scene = scene.changed("light", "point:position=0,0,0:intensity=1234 lm:temperature=5000")
    for rate, exact in (("phong", 2e-3), ("gouraud", 1e-6)):  # facets stand nearer than the sphere
        lux = math.pi * units.luminance(radiance(scene.set(shading=rate), renderer).astype(float))
        true = 1234.0 / (4.0 * math.pi * 2.5**2)
        assert np.abs(lux / true - 1.0).max() < exact


def test_lights_of_several_units_add_up(renderer):
    lights = [
        "point:position=0,2,0:intensity=100 cd",
        "directional:direction=0,1,0:irradiance=50 lx",
    ]
    apart = [middle(below(light), renderer) for light in lights]
    both = below(lights[0])
    both = both._replace(lights=both.lights + below(lights[1]).lights)
    assert middle(both, renderer) == pytest.approx(sum(apart), rel=1e-6)


def test_ev100_shows_its_luminance_as_white(renderer):
    """1.2 2^EV100 cd/m^2 saturates (ISO 2720 with K = 12.5, q = 0.65)."""
    scene = below("furnace:radiance=1.2 cd/m2", background=0.0)
    for ev, expected in ((0.0, 255), (1.0, 188)):  # half of the light is 188 in sRGB
        pixels = capture(scene.set(ev100=ev), renderer=renderer).pixels
        assert pixels[3 * (16 * 33 + 16)] == expected
    shifted = capture(scene.set(ev100=2.0, exposure=1.0), renderer=renderer).pixels
    assert shifted[3 * (16 * 33 + 16)] == 188


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("rate", ["flat", "gouraud", "phong"])
def test_what_needs_no_extent_and_no_shadow_pays_nothing_for_them(model, rate):
    shader = catalog.read("model", model)
    lights = [catalog.read("light", name) for name in ("point", "directional", "spot", "studio")]
    sources = compose.surface(shader, lights, rate, shader.constants(shader.defaults()))
    words = r"\b(rig_(lit|pass|seed|hidden|ground|spread)|reach_\d|samples_\d|density_\d)\b"
    for source in sources.values():
        assert not re.search(words, source.text)


def test_the_exact_irradiance_takes_no_samples_where_the_brdf_is_constant():
    def text(model, shadows=()):
        shader = catalog.read("model", model)
        constants = shader.constants(shader.defaults())
        lights = [catalog.read("light", "furnace")]
        return compose.surface(shader, lights, "phong", constants, shadows=shadows)["fragment"].text

    assert "samples" not in text("lambert") and "irradiance_1(" in text("lambert")
    assert "samples_1" in text("lambert", (1,)) and "irradiance_1(" in text("lambert", (1,))
    assert "samples_1" in text("oren_nayar") and "irradiance_1(" not in text("oren_nayar")


def test_the_error_of_samples_falls_faster_than_their_number(renderer):
    """Independent ones have N^-0.5; Sobol's, scrambled after Owen, about N^-1 or better here."""
    scene = below("furnace:radiance=1", model="oren_nayar", sigma=0.0)
    inside, true = (slice(8, 25), slice(8, 25)), scene.objects[0].values["albedo"][0]
    errors = []
    for count in (4, 16, 64, 256):
        found = radiance(scene.changed("light.1.samples", count), renderer)[inside]
        errors.append(float(np.sqrt(np.mean((found / true - 1.0) ** 2))))
        assert found.mean() == pytest.approx(true, rel=4.0 * errors[-1] / 17.0)
    slope = np.polyfit(np.log([4, 16, 64, 256]), np.log(errors), 1)[0]
    assert slope < -0.9


def test_several_passes_make_the_same_picture(renderer, monkeypatch):
    scene = below("furnace:radiance=1:samples=96", model="oren_nayar", background=0.25)
    one = radiance(scene, renderer)
    monkeypatch.setattr(layout, "AT_ONCE", 20)
    assert layout.passes(scene) == 5
    several = radiance(
        scene.set(time=1.0), renderer
    )  # another Scene: what is drawn is kept by scene
    assert np.allclose(one, several, rtol=1e-5)


def test_samples_differ_from_pixel_to_pixel_and_not_from_run_to_run(renderer):
    scene = below("furnace:samples=4", model="oren_nayar")
    first, again = (radiance(s, renderer) for s in (scene, scene.set(time=1.0)))
    assert (first == again).all() and len(np.unique(first[10:20, 10:20, 0])) > 50


def test_one_pixel_is_that_of_the_picture(renderer):
    scene = below("furnace:samples=4", model="oren_nayar", camera__fov=70.0)
    whole = radiance(scene, renderer)
    assert renderer.pixel(scene, 16, 14) == pytest.approx(tuple(whole[14, 16]))
    assert renderer.pixel(scene, 0, 0, "normal") is None  # beside the plane


def test_a_picture_can_show_where_and_how_surfaces_lie(renderer):
    scene = below("directional:direction=0,1,0", camera__fov=70.0)
    shown = {
        what: np.frombuffer(b"".join(s for s, _ in renderer.strips(scene, shows=what)), "<f4")
        for what in ("normal", "position", "object", "toward", "eye")
    }
    shown = {what: data.reshape(33, 33, 3) for what, data in shown.items()}
    assert shown["normal"][16, 16] == pytest.approx((0, 1, 0), abs=1e-6)
    assert shown["position"][16, 16] == pytest.approx((0, 0, 0), abs=1e-6)
    assert shown["object"][16, 16, 0] == 1 and shown["object"][0, 0, 0] == 0
    assert shown["toward"][16, 16] == pytest.approx((0, 0, 1), abs=1e-6)
    assert shown["eye"][16, 16] == pytest.approx((0, 0, 1), abs=1e-6)
    assert (shown["normal"][0, 0] == 0).all()


def test_a_visible_light_is_the_background(renderer):
    scene = Scene.default().set(size=(32, 32), samples=1, background=0.0)
    scene = scene.changed("light", "furnace:radiance=0.5:visible=true")
    found = radiance(scene, renderer)
    assert found[0, 0] == pytest.approx((0.5, 0.5, 0.5))
    assert found[16, 16] != pytest.approx((0.5, 0.5, 0.5), abs=1e-3)


def test_what_only_mirrors_sees_lights_that_surround(renderer):
    scene = Scene.default().set(size=(32, 32), samples=1).changed("light", "furnace:radiance=2")
    scene = scene.set(model="conductor", form="schlick", f0=1.0)
    assert radiance(scene, renderer)[16, 16] == pytest.approx((2.0, 2.0, 2.0), rel=1e-5)


AREAS = {
    "quad": "quad:position=0,1,0:target=0,0,0:width=1:height=1",
    "disk": "disk:position=0,1,0:target=0,0,0:radius=0.5",
    "sphere": "sphere:position=0,1,0:radius=0.5",
    "polygon": "polygon:corners=four:a=-0.5,1,-0.5:b=0.5,1,-0.5:c=0.5,1,0.5:d=-0.5,1,0.5",
}
FACTORS = {  # of a patch below the middle at a distance of 1; PHYSICS A.3, Howell's B-12, B-37
    "quad": 0.23945647046077354,
    "polygon": 0.23945647046077354,
    "disk": 0.25 / 1.25,
    "sphere": 0.25,
}


@pytest.mark.parametrize("name", AREAS)
def test_a_lambertian_surface_gets_the_exact_irradiance(renderer, name):
    """E = pi F L, from the form factor of the closed forms."""
    scene = below(AREAS[name] + ":radiance=100 cd/m2")
    lux = math.pi * units.luminance(middle(scene, renderer))
    assert lux == pytest.approx(100.0 * math.pi * FACTORS[name], rel=1e-5)


@pytest.mark.parametrize("name", AREAS)
def test_what_is_sampled_converges(renderer, name):
    """Oren-Nayar without roughness is Lambert: its samples tend to the exact irradiance."""
    scene = below(AREAS[name] + ":radiance=1", model="oren_nayar", sigma=0.0)
    converges(scene, radiance(scene.set(model="lambert"), renderer)[INSIDE], renderer)


def test_what_the_model_draws_converges_to_the_same(renderer):
    """A rough metal under a quad, against a sum over the quad in float64 at every pixel."""
    scene = below(AREAS["quad"] + ":radiance=1", model="rough_conductor")
    values, nodes = scene.objects[0].values, (np.arange(48) + 0.5) / 48.0 - 0.5
    x, z = np.meshgrid(nodes, nodes)
    lamp = np.stack([x, np.ones_like(x), z], axis=-1).reshape(-1, 3)
    shown = np.frombuffer(b"".join(s for s, _ in renderer.strips(scene, shows="position")), "<f4")
    places = shown.reshape(33, 33, 3)[INSIDE].astype(float)
    eye = 1.04 * math.sqrt(0.5) / math.sin(math.radians(10.0)) * np.array([0.0, 1.0, 0.0])
    true = np.empty((*places.shape[:2], 3))
    for i, j in np.ndindex(places.shape[:2]):
        to_lamp, to_eye = lamp - places[i, j], eye - places[i, j]
        square = (to_lamp**2).sum(axis=1, keepdims=True)
        L = to_lamp / np.sqrt(square)
        V = np.broadcast_to(to_eye / np.linalg.norm(to_eye), L.shape)
        # world y is the normal; the metal is isotropic, so any turn about it will do
        f = reference.rough_conductor(L[:, [2, 0, 1]], V[:, [2, 0, 1]], **values)
        true[i, j] = (f * L[:, 1:2] / square).mean(axis=0)  # an area of 1, its cosine
    converges(scene, true, renderer)


INSIDE = (slice(10, 23), slice(10, 23))


def converges(scene, true, renderer):
    """Assert that the error falls faster than the -0.5 of independent samples."""
    counts, errors = (8, 32, 128), []
    for count in counts:
        found = radiance(scene.changed("light.1.samples", count), renderer)[INSIDE]
        errors.append(float(np.sqrt(np.mean((found / true - 1.0) ** 2))))
    assert errors[-1] < 0.02
    assert np.polyfit(np.log(counts), np.log(errors), 1)[0] < -0.6


def shaded(light, height, size, renderer):
    """Return positions (h, w, 3) and illuminance (h, w) of a floor with a square above it."""
    text = f"""
size = [96, 96]
samples = 1
camera = {{ position = [0, 9, 0.001], target = [0, 0, 0], fov = 20 }}
[[object]]
mesh = "plane:width=6"
model = "lambert"
albedo = 1.0
[[object]]
mesh = "plane:width={size}"
model = "lambert"
albedo = 0.0
position = [0, {height}, 0]
"""
    scene = parsed(text).changed("light", light)
    shown = np.frombuffer(b"".join(s for s, _ in renderer.strips(scene, shows="position")), "<f4")
    return shown.reshape(96, 96, 3), units.luminance(radiance(scene, renderer)) * math.pi


def test_a_hard_shadow_is_as_wide_as_rays_say(renderer):
    """A square of side 1 at height 1 under a point at height 3 has a shadow of side 1.5."""
    place, lux = shaded("point:position=0,3,0:intensity=90 cd:shadows=true", 1.0, 1.0, renderer)
    wide = np.abs(place[..., [0, 2]]).max(axis=2)
    floor = place[..., 1] < 0.5
    assert (lux[floor & (wide < 0.74)] == 0.0).all()
    lit = floor & (wide > 0.76)
    distance = np.linalg.norm(place - [0, 3, 0], axis=2)
    assert np.allclose(lux[lit], (90.0 * 3.0 / distance**3)[lit], rtol=1e-5)


@pytest.mark.parametrize("model", ["lambert", "oren_nayar"])
def test_the_shadow_of_a_light_with_an_extent_is_soft(renderer, model):
    """What is seen of a quad past an edge goes evenly from all to nothing across the penumbra."""
    text = f"""
size = [33, 33]
samples = 1
camera = {{ position = [0, 8, 0.001], target = [0, 0, 0], fov = 22 }}
[[object]]
mesh = "plane:width=4"
model = "{model}"
albedo = 1.0
[[object]]
mesh = "plane:width=4"
model = "lambert"
albedo = 0.0
position = [2, 1, 0]
"""
    light = "quad:position=0,2,0:target=0,0,0:width=0.5:height=0.5:radiance=1:samples=256"
    scene = parsed(text).changed("light", light)
    bare = scene._replace(objects=scene.objects[:1], camera=scene.camera._replace(fov=22.0))
    shadowed = radiance(scene.changed("light.1.shadows", True), renderer)
    free = radiance(bare, renderer)
    share = (shadowed[16, :, 0] / free[16, :, 0])[:16]  # the other half is the square itself
    assert share[0] == pytest.approx(1.0, rel=3e-2 if model == "oren_nayar" else 1e-6)
    place = np.frombuffer(b"".join(s for s, _ in renderer.strips(bare, shows="position")), "<f4")
    x = place.reshape(33, 33, 3)[16, :16, 0]
    seen = np.clip((0.25 - x - 0.25 - x) / 1.0 + 0.5, 0.0, 1.0)  # of the quad's width, from x
    penumbra = (seen > 0.05) & (seen < 0.95)
    assert penumbra.sum() >= 1 and np.abs(share - seen)[penumbra].max() < 0.06


def test_nothing_in_between_leaves_exact_light_exact(renderer):
    scene = below(AREAS["sphere"] + ":radiance=1:samples=4")
    with_shadows = radiance(scene.changed("light.1.shadows", True), renderer)
    assert np.allclose(with_shadows, radiance(scene, renderer), rtol=1e-5)


def test_passes_hide_no_shadow(renderer, monkeypatch):
    light = "sphere:position=0,3,0:radius=0.3:radiance=9:samples=64:shadows=true"
    _, one = shaded(light, 1.0, 1.0, renderer)
    monkeypatch.setattr(layout, "HIDDEN", 10)
    _, several = shaded(light, 1.0, 1.0, renderer)
    assert np.abs(one - several).mean() < 0.02 * one.mean()


def test_the_eye_sees_a_lamp_in_its_place(renderer):
    """A sphere light is as wide as an object's sphere, hides what is behind, and is hidden."""
    base = Scene.default().set(
        size=(33, 33), samples=1, background=0.0, model="lambert", albedo=0.0
    )
    base = base.set(
        camera__position=(0.0, 0.0, 8.0), camera__target=(0.0, 0.0, 0.0), camera__fov=20
    )
    lamp = "sphere:position=0,0,{}:radius=0.5:radiance=3:visible=true"
    before = radiance(base.changed("light", lamp.format(2)), renderer)
    behind = radiance(base.changed("light", lamp.format(-2)), renderer)
    assert before[16, 16] == pytest.approx((3.0, 3.0, 3.0)) and behind[16, 16].max() == 0.0
    alone = radiance(base.set(scale=0.01).changed("light", lamp.format(0)), renderer)[..., 0] > 0.0
    sphere = base.set(scale=0.5, albedo=1.0, mesh="sphere:subdivision=6")
    sphere = sphere.changed("light", "furnace:radiance=1")
    shape = radiance(sphere, renderer)[..., 0] > 0.5
    assert np.count_nonzero(alone != shape) <= 12  # of pixels on the rim


def test_what_mirrors_shows_the_lamps(renderer):
    scene = below("quad:position=0,2,0:target=0,0,0:width=3:height=3:radiance=5")
    scene = scene.set(model="conductor", form="schlick", f0=1.0)
    assert middle(scene, renderer) == pytest.approx((5.0, 5.0, 5.0), rel=1e-5)


@pytest.mark.parametrize("rate", ["flat", "gouraud", "phong"])
@pytest.mark.parametrize(
    "light", [*AREAS.values(), "sky", "environment", "furnace", "sun:height=60"]
)
def test_every_rate_draws_every_extent_and_shadow(renderer, rate, light):
    """On the same plane, of which all rates know the middle, up to what samples differ."""
    scene = below(light + ":samples=64:shadows=true", shading=rate, model="oren_nayar", sigma=20.0)
    scene = scene.set(mesh="plane:width=0.2:segments=2")
    found = middle(scene, renderer)
    assert np.isfinite(found).all() and found.min() > 0.0
    assert found == pytest.approx(middle(scene.set(shading="phong"), renderer), rel=0.25)


@pytest.mark.parametrize("mesh", ["sphere:subdivision=3", "uv_sphere:rings=8:segments=12", "box"])
@pytest.mark.parametrize("direction", ["1,0.2,0.3", "0.5,1,-0.2", "-0.3,0.1,-1"])
def test_a_convex_body_alone_throws_no_shadow_on_itself(renderer, mesh, direction):
    """What the light does not reach faces away from it: coarse facets must not show either."""
    scene = Scene.default().set(mesh=mesh, model="lambert", size=(128, 128), samples=1)
    scene = scene.changed("light", f"directional:direction={direction}")
    bare, shadowed = (radiance(s, renderer) for s in (scene, scene.set(light__1__shadows=True)))
    assert np.allclose(bare, shadowed, rtol=1e-5, atol=1e-7)


def test_many_shadows_are_compiled_in_a_moment(renderer):
    """The rays' loops, copied for each of 16 lights, took compilers minutes: there is one copy."""
    lights = "".join(
        f"[[light]]\nkind = 'point'\nposition = [{i - 8}, 3, 1]\nintensity = 9\nshadows = true\n"
        for i in range(16)
    )
    scene = parsed("size = [16, 16]\n" + lights)
    shader = scene.lights[0].kind
    sources = compose.surface(
        scene.objects[0].model, [shader] * 16, "phong", {}, shadows=range(1, 17)
    )
    assert sources["fragment"].text.count("rig_blocked(") == 2  # the function, and one call
    apart = [scene._replace(lights=(one,)) for one in scene.lights]
    together = radiance(scene, renderer).astype(float)
    floor = radiance(scene._replace(lights=()), renderer)
    assert np.allclose(
        sum(radiance(s, renderer) - floor for s in apart) + floor, together, atol=1e-5
    )


def test_a_sliver_above_the_horizon_is_not_dark_for_want_of_a_sample(renderer):
    """With nothing in between, shadows change nothing, however few directions find the sliver."""
    light = "quad:position=0,0.1,1:target=0,0.1,0:width=1:height=3:radiance=1:samples={}"
    for count in (1, 4, 16):
        bare = radiance(below(light.format(count)), renderer)
        shadowed = radiance(below(light.format(count) + ":shadows=true"), renderer)
        assert np.allclose(bare, shadowed, rtol=1e-5)
