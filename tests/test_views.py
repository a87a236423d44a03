"""Views: the values are closed forms, the colours a published map, the scale can be read."""

import math

import numpy as np
import pytest
from matplotlib import colormaps
from PIL import Image

from lumiar import falsecolour, image, picture, scale, settings, units, views
from lumiar.errors import Mistake
from lumiar.scene import Scene
from lumiar.views import View

SIZE = (48, 40)
NAN = "// model   Broken\nvec3 scatter(vec3 L, vec3 V) { return vec3(sqrt(V.z - 2.0)); }\n"


def lit(*lights, **values):
    """Return a small scene of Lambert's sphere under lights."""
    scene = Scene.default()._replace(size=SIZE, samples=1)
    scene = scene._replace(lights=tuple(settings.light(text) for text in lights))
    return scene.set(**{"model": "lambert", **values})


def seen(scene, text, renderer):
    return views.seen(scene, views.chosen(text), renderer)


def test_luminance_is_that_of_the_picture(renderer):
    scene = lit("point:color=1,0.5,0.2", "ambient", samples=4, model="phong")
    expected = picture.radiance(scene, renderer) @ [0.2126729, 0.7151522, 0.0721750]
    found = seen(scene, "luminance", renderer)
    np.testing.assert_allclose(found.values, units.EFFICACY * expected, rtol=1e-6)
    assert found.values.dtype == np.float32 and not found.surface.all() and found.surface.any()


def test_illuminance_follows_the_cosine_whatever_the_surface(renderer):
    scene = lit("directional:direction=1,2,2:irradiance=500 lx", model="ward")
    normals = seen(scene, "normal", renderer).values
    found = seen(scene, "illuminance", renderer)
    expected = 500.0 * np.maximum(normals @ (np.array([1.0, 2.0, 2.0]) / 3.0), 0.0)
    np.testing.assert_allclose(found.values, expected, atol=5e-3)
    assert np.isnan(found.values[~found.surface]).all()


def test_watts_differ_from_lumens_by_the_efficacy_of_each_light(renderer):
    """Of a black body at 2856 K, all wavelengths: 16.45 lm/W (PHYSICS C.7)."""
    warm = "directional:direction=0,0,1:irradiance=100 lx:temperature=2856"
    scene = lit(warm, "point:position=3,0,0")
    watts, lux = (seen(scene, name, renderer).values for name in ("irradiance", "illuminance"))
    alone = [
        seen(lit(one), "illuminance", renderer).values for one in (warm, "point:position=3,0,0")
    ]
    np.testing.assert_allclose(lux, alone[0] + alone[1], rtol=1e-5)
    np.testing.assert_allclose(watts, alone[0] / 16.45 + alone[1] / units.EFFICACY, rtol=1e-3)


def test_albedo_is_the_share_that_a_white_sky_sends_to_the_eye(renderer):
    found = seen(lit("point", albedo=(0.3, 0.3, 0.3)), "albedo", renderer)
    assert found.values[found.surface] == pytest.approx(0.3, rel=0.1)
    assert found.values[found.surface].mean() == pytest.approx(0.3, rel=2e-3)
    dim = seen(lit(model="black_body", emissivity=0.25, temperature=1500), "albedo", renderer)
    assert dim.values[dim.surface].mean() == pytest.approx(0.75, rel=2e-3)


def test_normals_have_length_one_and_face_the_eye(renderer):
    found = seen(lit("point", camera__azimuth=0, camera__elevation=0), "normal", renderer)
    normals = found.values[found.surface]
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, rtol=1e-5)
    assert normals[:, 2].min() > 0.0
    assert np.abs(found.values[20, 24]) == pytest.approx([0, 0, 1], abs=0.1)


def test_the_error_of_the_same_is_nothing_and_of_the_half_the_half(renderer):
    scene = lit("point:intensity=60")
    assert not seen(scene, "error:shading=phong", renderer).values.any()
    half = seen(scene, "error:light.1.intensity=30", renderer)
    whole = seen(scene, "luminance", renderer)
    on = whole.surface
    np.testing.assert_allclose(half.values[on], 0.5 * whole.values[on], rtol=1e-4, atol=1e-5)


def test_a_light_that_is_seen_itself_hides_no_irradiance(renderer):
    hidden, shown = (
        lit(f"furnace:visible={visible}:samples=1", background=(0, 0, 0))
        for visible in ("false", "true")
    )
    assert seen(shown, "luminance", renderer).surface.all()
    assert seen(shown, "luminance", renderer).values[0, 0] == pytest.approx(units.EFFICACY)
    both = [seen(one, "illuminance", renderer).values for one in (hidden, shown)]
    np.testing.assert_array_equal(*both)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("luminance", View("luminance")),
        ("error:shading=flat", View("error", (("shading", "flat"),))),
        ("error:kd=1,0,0,ks=[0,0,1]", View("error", (("kd", "1,0,0"), ("ks", "0,0,1")))),
        (
            "error:light=point:position=2,3,4:intensity=80,samples=1",
            View("error", (("light", "point:position=2,3,4:intensity=80"), ("samples", "1"))),
        ),
    ],
)
def test_views_are_named_with_what_they_change(text, expected):
    assert views.chosen(text) == expected


@pytest.mark.parametrize("text", ["light", "error", "error:", "error:flat", "albedo:x=1", ""])
def test_what_is_no_view_is_a_mistake(text):
    with pytest.raises(Mistake):
        views.chosen(text)


def test_files_hold_the_values_and_pictures_the_scene(renderer, tmp_path):
    scene, view = lit("point", "ambient:radiance=0.1"), View("illuminance")
    for name in ("a.npy", "a.hdr", "a.png"):
        assert falsecolour.write(scene, str(tmp_path / name), view, renderer) == 0
    values = np.load(tmp_path / "a.npy")
    found = seen(scene, "illuminance", renderer)
    np.testing.assert_array_equal(values, found.values)
    np.testing.assert_allclose(
        image.read(str(tmp_path / "a.hdr"))[0],
        np.nan_to_num(values)[..., None].repeat(3, 2),
        rtol=0.01,
    )
    again = Scene.load(str(tmp_path / "a.png"))
    assert again.lights == scene.lights and again.size == SIZE
    with Image.open(tmp_path / "a.png") as page:
        assert page.width >= SIZE[0] and page.height > SIZE[1] + 30
        left = (page.width - SIZE[0]) // 2
        drawn = np.asarray(page)[: SIZE[1], left : left + SIZE[0]]
    assert (drawn[~found.surface] == scale.EMPTY).all()
    order = np.argsort(values[found.surface])
    green = drawn[found.surface][order, 1].astype(int)  # which grows along the map
    assert green[-1] > 200 and (np.diff(green) >= 0).all()
    with pytest.raises(Mistake, match="negative"):
        falsecolour.write(scene, str(tmp_path / "n.hdr"), View("normal"), renderer)


def test_what_is_no_number_is_counted_and_magenta(renderer, tmp_path):
    (tmp_path / "broken.glsl").write_text(NAN)
    scene = lit("point", model=str(tmp_path / "broken.glsl"))
    broken = falsecolour.write(scene, str(tmp_path / "a.png"), View("luminance"), renderer)
    assert broken == seen(scene, "luminance", renderer).surface.sum() > 0
    with Image.open(tmp_path / "a.png") as page:
        assert np.asarray(page)[SIZE[1] // 2, page.width // 2].tolist() == [255, 0, 255]
    assert falsecolour.write(scene, str(tmp_path / "b.png"), View("illuminance"), renderer) == 0


def test_the_panels_of_a_sheet_share_one_scale(lumiar, tmp_path):
    vary = ("--vary", "albedo=[0.1,0.1,0.1],[0.8,0.8,0.8]", "--view", "luminance")
    small = ("--model", "lambert", "--size", "200x200", "--samples", "1", "--light", "ambient")
    lumiar("capture", *small, *vary, "-o", "sheet.png")
    with Image.open(tmp_path / "sheet.png") as page:
        dark, bright = (page.getpixel((x, 108)) for x in (108, 316))  # amid each picture
    assert dark[1] < 80 < 200 < bright[1]
    lumiar("capture", *small, *vary, "-o", "sheet.npy", code=2)


def test_the_map_is_viridis():
    """That of matplotlib, and lightness grows along it as a scale for all eyes must."""
    steps = np.linspace(0.0, 1.0, 256)[None]
    ours = scale.colours(steps, scale.Scale(0.0, 1.0, 0.2), steps >= 0.0)[0]
    theirs = np.array(colormaps["viridis"].colors) * 255.0
    assert np.abs(ours - theirs).max() < 3.0
    linear = np.where(ours / 255 <= 0.04045, ours / 3294.6, ((ours / 255 + 0.055) / 1.055) ** 2.4)
    assert (np.diff((linear @ [0.2126, 0.7152, 0.0722])[::8]) > 0.0).all()


@pytest.mark.parametrize("high", [1e-7, 3.7e-3, 0.37, 1.0, 1.1, 1.3, 99.0, 1234.0, 8e4, 2.3e7])
def test_a_linear_scale_holds_all_and_its_marks_are_true(high):
    ruler = scale.fitting(np.linspace(0.0, high, 1000))
    assert not ruler.log and ruler.low == 0.0 and high <= ruler.high * (1 + 1e-6) < 1.6 * high
    marks = ruler.ticks()
    assert 4 <= len(marks) <= 9
    raised = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    for share, label in marks:
        value = float(label.replace("·10", "e").translate(raised))
        assert value == pytest.approx(share * ruler.high, abs=1e-9 * high)
        assert len(label) <= 8


def test_three_decades_make_a_scale_logarithmic():
    assert not scale.fitting(np.geomspace(1.0, 500.0, 100)).log
    ruler = scale.fitting(np.geomspace(0.01, 1e4, 1000))
    assert ruler.log and ruler.low <= 0.0125 and ruler.high == pytest.approx(1e4)
    marks = dict((label, share) for share, label in ruler.ticks() if label)
    assert marks["1"] == pytest.approx(
        -math.log10(ruler.low) / math.log10(ruler.high / ruler.low), abs=1e-6
    )
    assert {"0.1", "1", "10", "100", "1000", "10000"} <= marks.keys()


@pytest.mark.parametrize("values", [[0.0], [], [5.0, 5.0], [1.0, 1.0 + 1e-7], [1e-30], [3e38]])
def test_every_picture_has_a_scale(values):
    ruler = scale.fitting(np.array(values))
    assert ruler.low < ruler.high < math.inf and len(ruler.ticks()) > 3
