"""Pictures and furnaces as lights: lookups, sampling, and images that cannot be used."""

import math
import os
import subprocess
import sys

import lamps
import numpy as np
import pytest

from lumiar import image, surroundings, units
from lumiar.errors import Mistake


@pytest.fixture(scope="module")
def context(renderer):
    with renderer.context:
        yield renderer.context


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Write an array (height, width, 3) as a .hdr and return its path."""
    folder = tmp_path_factory.mktemp("hdr")

    def write(pixels, name="one"):
        pixels = np.ascontiguousarray(pixels, "<f4")
        path = folder / f"{name}.hdr"
        size = (pixels.shape[1], pixels.shape[0])
        path.write_bytes(b"".join(image.hdr(size, [pixels.tobytes()])))
        return str(path)

    return write


def some_pixels(high=8, wide=16):
    """Return pixels with a range of a million, and exact in a .hdr."""
    rng = np.random.default_rng(7)
    pixels = np.exp2(rng.integers(-3, 4, (high, wide, 3)))
    pixels[high // 2, wide // 3] = 2.0**17
    pixels[-2:, : wide // 2] = 0.0
    return pixels


def looked_up(pixels, directions, turn=0.0):
    """Return the radiance of directions in float64: bilinear, around and up to the poles."""
    high, wide = pixels.shape[:2]
    x, y, z = (directions / np.linalg.norm(directions, axis=1)[:, None]).T
    across = (0.5 - (np.arctan2(x, z) - turn) / (2.0 * math.pi)) % 1.0 * wide - 0.5
    down = np.arctan2(np.hypot(x, z), y) / math.pi * high - 0.5
    column, row = np.floor(across).astype(int), np.floor(down).astype(int)
    s, t = (across - column)[:, None], (down - row)[:, None]
    left, right = column % wide, (column + 1) % wide
    above, below = np.clip(row, 0, high - 1), np.clip(row + 1, 0, high - 1)
    upper = (1 - s) * pixels[above, left] + s * pixels[above, right]
    lower = (1 - s) * pixels[below, left] + s * pixels[below, right]
    return (1 - t) * upper + t * lower


def test_the_middle_of_the_picture_is_z_and_its_left_x(context, written):
    pixels = np.zeros((32, 64, 3))
    pixels[15:17, 31:33] = (1, 0, 0)
    pixels[15:17, 15:17] = (0, 1, 0)
    pixels[0] = (0, 0, 1)
    light = lamps.light("environment", written(pixels))
    found = lamps.seen(context, light, [(0, 0, 1), (1, 0, 0), (0, 1, 0), (-1, 0, 0)])
    assert found == pytest.approx(np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)]), abs=1e-6)
    light = lamps.light("environment", written(pixels), turn=90.0, radiance=3.0)
    assert lamps.seen(context, light, [(1, 0, 0)])[0] == pytest.approx((3, 0, 0), abs=1e-6)


def test_a_direction_sees_in_mitsuba_what_it_sees_here(context, written):
    """Its rows reach from pole to pole, ours half a pixel less: a smooth picture."""
    mi = pytest.importorskip("mitsuba", reason="an optional program to compare with")
    mi.set_variant("scalar_rgb")
    y, x = np.mgrid[0:64, 0:128] * math.pi / 64.0
    pixels = 2.0 + np.stack([np.sin(x), np.cos(x), np.cos(y)], 2)
    path = written(pixels, "smooth")
    scene = mi.load_dict({"type": "scene", "one": {"type": "envmap", "filename": path}})
    emitter = scene.emitters()[0]
    directions, expected = lamps.even(50), []
    for direction in directions:
        seen = mi.SurfaceInteraction3f()
        seen.wi = mi.Vector3f((-direction).tolist())
        expected.append(np.ravel(emitter.eval(seen)))
    found = lamps.seen(context, lamps.light("environment", path), directions)
    assert np.abs(found - expected).max() < 0.05


@pytest.mark.parametrize("turn", [0.0, -123.0])
@pytest.mark.parametrize("size", [(8, 16), (1, 1), (1, 9), (5, 1), (33, 47)])
def test_a_direction_sees_the_picture_between_its_pixels(context, written, size, turn):
    pixels = some_pixels(*size) if size[0] > 2 else np.full((*size, 3), 2.0)
    light = lamps.light("environment", written(pixels), turn=turn)
    directions = np.concatenate([lamps.even(2000), [(0, 1, 0), (0, -1, 0), (0, 0, -1)]])
    directions = directions.astype(np.float32)
    expected = looked_up(pixels, directions.astype(float), math.radians(turn))
    found = lamps.seen(context, light, directions)
    slope = 1e-5 * pixels.max()  # of a bright pixel's edge, times the rounding of the place
    assert np.abs(found - expected).max() < slope


@pytest.mark.parametrize("turn", [0.0, 77.0])
def test_directions_fall_as_their_density_says(context, written, turn):
    pixels = np.minimum(some_pixels(), 64.0)
    light = lamps.light("environment", written(pixels), turn=turn)
    assert lamps.chance_of_such(context, light, 100_000, (16, 8), turn=math.radians(turn)) > 0.005


@pytest.mark.parametrize("name", ["studio", "venice", "bright", "black", "one", "large"])
def test_the_density_is_a_density_and_leaves_nothing_out(context, written, name):
    made = {
        "bright": lambda: some_pixels(),
        "black": lambda: np.zeros((4, 8, 3)),
        "one": lambda: np.full((1, 1, 3), 5.0),
        "large": lambda: np.random.default_rng(1).random((300, 700, 3)) ** 9,
    }
    path = written(made[name](), name) if name in made else name
    light = lamps.light("environment", path)
    directions = lamps.even(100_000)
    radiance = lamps.seen(context, light, directions)
    density = lamps.seen(context, light, directions, "density")[:, 0]
    assert 4.0 * math.pi * density.mean() == pytest.approx(1.0, abs=3e-3)
    assert (density > 0.0).all() and np.isfinite(radiance).all()
    expected = 4.0 * math.pi * radiance.mean(axis=0)
    drawn, density, irradiance = lamps.drawn(context, light, lamps.jittered(200, 200))
    assert np.isfinite(irradiance).all() and (density > 0.0).all()
    assert np.abs(np.linalg.norm(drawn, axis=1) - 1.0).max() < 1e-6
    assert irradiance.mean(axis=0) == pytest.approx(expected, rel=2e-2)


def test_an_irradiance_is_the_radiance_over_the_density(context):
    light = lamps.light("environment", "studio", turn=20.0)
    directions, density, irradiance = lamps.drawn(context, light, lamps.jittered(64, 64))
    radiance = lamps.seen(context, light, directions)
    wrong = np.abs(radiance / density[:, None] - irradiance).max(1) > 1e-4 * irradiance.max(1)
    assert wrong.mean() < 1e-3  # rounded, a direction on an edge may be in the next cell
    assert (lamps.seen(context, light, directions, "arriving") == radiance).all()


def test_chances_of_light_are_in_proportion_to_it(context):
    """Beside a lamp that is 89 % of the light, samples differ by less than half of their mean."""
    light = lamps.light("environment", "studio")
    _, _, irradiance = lamps.drawn(context, light, lamps.jittered(100, 100))
    found = irradiance @ units.LUMINANCE
    assert found.std() < 0.5 * found.mean()


def test_a_furnace_lights_a_surface_with_pi_times_its_radiance(context):
    light = lamps.light("furnace", radiance=2.5)
    directions, density, irradiance = lamps.drawn(context, light, lamps.jittered(100, 100))
    assert np.allclose(irradiance, 2.5 / density[:, None])
    normal = np.array([0.6, 0.0, 0.8])
    sampled = (irradiance * np.maximum(directions @ normal, 0.0)[:, None]).mean(axis=0)
    assert sampled == pytest.approx(2.5 * math.pi * np.ones(3), rel=1e-3)
    exact = lamps.seen(context, light, [normal], "exact")
    assert exact == pytest.approx(np.full((1, 3), 2.5 * math.pi))
    around = lamps.seen(context, light, lamps.even(10))
    assert (around == 2.5).all() and np.allclose(4.0 * math.pi * density, 1.0)
    cells = lamps.chance_of_such(context, light, 50_000, (12, 12))
    assert cells > 0.005


def test_images_come_with_lumiar_and_without_one_there_is_a_default():
    found = surroundings.shipped()
    assert surroundings.DEFAULT in found and len(found) >= 2
    for name, path in found.items():
        given = surroundings.given(lamps.light("environment", name))
        assert given == surroundings.given(lamps.light("environment", path))
        assert given["picture"].size[0] == 2 * given["picture"].size[1]
        assert os.path.getsize(path) < 300_000
    given = surroundings.given(lamps.light("environment"))
    assert given == surroundings.given(lamps.light("environment", surroundings.DEFAULT))


def test_an_image_is_read_once_until_it_changes(written):
    light = lamps.light("environment", written(some_pixels(), "kept"))
    first = surroundings.given(light)
    assert surroundings.given(light)["picture"] is first["picture"]
    written(2.0 * some_pixels(4, 8), "kept")
    again = surroundings.given(light)["picture"]
    assert again.size == (8, 4)
    assert again.data == (2.0 * some_pixels(4, 8)).astype(np.float32).tobytes()


def test_a_light_that_asks_for_nothing_is_given_nothing():
    assert surroundings.given(lamps.light("furnace")) == {}
    for name in ("sky", "sun", "environment"):
        light = lamps.light(name)
        assert set(surroundings.given(light)) == set(light.kind.given)


def test_an_image_that_cannot_be_used_is_told(tmp_path, written, monkeypatch):
    def told(name):
        with pytest.raises(Mistake) as caught:
            surroundings.given(lamps.light("environment", str(name)))
        return str(caught.value)

    assert "no file" in told(tmp_path / "none.hdr")
    assert "did you mean 'studio'" in told("studoi") and "venice" in told("studoi")
    (tmp_path / "a.png").write_bytes(b"")
    assert ".hdr" in told(tmp_path / "a.png")
    (tmp_path / "bad.hdr").write_bytes(b"no picture")
    assert "not a picture" in told(tmp_path / "bad.hdr")
    assert "column 3, row 2" in told(written(1.0 + _one_at(1, 2), "hot"))
    assert "9000 x 1 pixels" in told(written(np.ones((1, 9000, 3)), "long"))
    monkeypatch.setattr(surroundings, "LIMIT", 31)
    assert "8 x 4 pixels" in told(written(np.ones((4, 8, 3)), "wide"))


def _one_at(y, x):
    pixels = np.zeros((4, 8, 3))
    pixels[y, x] = 2.0**100
    return pixels


def test_a_sky_needs_no_numpy():
    code = (
        "import sys; from lumiar import catalog, parts, surroundings as s\n"
        "for name in ('sky', 'sun'):\n"
        "    kind = catalog.read('light', name); s.given(parts.Light(kind, kind.defaults()))\n"
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
