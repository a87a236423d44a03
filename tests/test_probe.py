"""The probe reads known answers: closed forms of simple scenes, published efficacies."""

import json
import math

import numpy as np
import pytest

from lumiar import measure, probe, readout, settings, units
from lumiar.errors import Mistake
from lumiar.scene import Scene

SIZE = (65, 65)  # its middle pixel is the middle of the picture


@pytest.fixture(scope="module")
def instrument():
    with measure.Instrument() as one:
        yield one


@pytest.fixture
def probed(renderer, instrument):
    def look(scene, x=32, y=32):
        return probe.measured(scene, (x, y), renderer, instrument)

    return look


def lit(*lights, **values):
    """Return a scene under lights, by default of Lambert's plane from straight above."""
    values = {"mesh": "plane", "model": "lambert", "camera__elevation": 60.0, **values}
    scene = Scene.default()._replace(size=SIZE)
    scene = scene._replace(lights=tuple(settings.light(text) for text in lights))
    return scene.set(**values)


def cosine(found, toward):
    """Return the cosine between the normal and a direction, float64."""
    return np.dot(found["normal"], toward) / np.linalg.norm(toward)


@pytest.mark.parametrize("pixel", [(32, 32), (12, 40), (45, 25)])
def test_a_point_light_of_candelas_gives_lux_by_the_laws_of_distance_and_cosine(probed, pixel):
    found = probed(lit("point:position=0.3,2,-0.4:intensity=100 cd"), *pixel)
    toward = np.subtract((0.3, 2.0, -0.4), found["position_m"])
    expected = 100.0 * cosine(found, toward) / (toward @ toward)
    assert found["illuminance_lx"] == pytest.approx(expected, rel=1e-5)
    angle = math.degrees(math.acos(cosine(found, toward)))
    assert found["lights"][0]["theta_i_deg"] == pytest.approx(angle, abs=1e-3)


def test_lumens_in_a_black_sphere_give_the_same_lux_everywhere(probed):
    """E = Phi / (4 pi r^2) at its vertices: points of the flat faces between them lie nearer."""
    scene = lit(
        "point:position=0,0,0:intensity=800 lm",
        **{"mesh": "sphere:subdivision=3:radius=2", "shading": "gouraud"},
        **{"albedo": (0, 0, 0), "camera__position": (0.1, 0.2, 0.3), "camera__fov": 90.0},
    )
    for pixel in ((32, 32), (3, 60), (50, 10)):
        found = probed(scene, *pixel)
        expected = 800.0 / (4.0 * math.pi * 2.0**2)
        assert found["illuminance_lx"] == pytest.approx(expected, rel=1e-6)
        assert found["luminance_cd_m2"] == found["luminous_exitance_lm_m2"] == 0.0


def test_parallel_light_given_in_lux_is_that_on_what_faces_it(probed):
    found = probed(lit("directional:direction=0,1,0:irradiance=1000 lx"))
    assert found["illuminance_lx"] == pytest.approx(1000.0, rel=1e-6)
    tilted = probed(lit("directional:direction=0,1,1:irradiance=1000 lx"))
    assert tilted["illuminance_lx"] == pytest.approx(1000.0 * math.sqrt(0.5), rel=1e-6)
    assert tilted["lights"][0]["theta_i_deg"] == pytest.approx(45.0, abs=1e-4)


def test_lambert_sends_the_same_luminance_and_an_exitance_of_pi_times_it(probed):
    found = probed(lit("directional:direction=0,1,0:irradiance=1000 lx", albedo=(0.5, 0.5, 0.5)))
    assert found["luminance_cd_m2"] == pytest.approx(500.0 / math.pi, rel=1e-6)
    assert found["luminous_exitance_lm_m2"] == pytest.approx(500.0, rel=1e-6)
    assert found["exitance_exact"]
    assert found["lights"][0]["f_1_sr"] == pytest.approx(0.5 / math.pi, rel=1e-6)
    assert found["lights"][0]["albedo"] == pytest.approx(0.5, rel=1e-5)
    assert found["albedo_to_eye"] == pytest.approx(0.5, rel=1e-5)


def test_watts_are_lumens_over_the_efficacy_of_each_lights_spectrum(probed):
    """Of black bodies at 2856 K and 6650 K, all wavelengths: 16.45 and 95.43 lm/W (PHYSICS C.7)."""
    light = "directional:direction=0,1,0:irradiance=1000 lx"
    found = probed(lit(f"{light}:temperature=2856", f"{light}:temperature=6650", light))
    warm, hot, plain = found["lights"]
    assert warm["irradiance_W_m2"] == pytest.approx(1000.0 / 16.45, rel=1e-3)
    assert hot["irradiance_W_m2"] == pytest.approx(1000.0 / 95.43, rel=1e-3)
    assert plain["irradiance_W_m2"] == pytest.approx(1000.0 / units.EFFICACY, rel=1e-6)
    assert found["illuminance_lx"] == pytest.approx(3000.0, rel=1e-5)
    watts = sum(light["irradiance_W_m2"] for light in found["lights"])
    assert found["irradiance_W_m2"] == pytest.approx(watts)
    assert found["radiance_W_m2_sr"] == pytest.approx(0.8 * watts / math.pi, rel=1e-5)


def test_the_shares_of_the_lights_are_of_the_whole(probed):
    scene = lit("point:intensity=60:color=1,0.5,0.2", "ambient:radiance=0.4")
    found = probed(scene, 20, 40)
    for share, key in (("luminance", "luminance_cd_m2"), ("illuminance", "illuminance_lx")):
        assert sum(light[f"share_of_{share}"] for light in found["lights"]) == pytest.approx(1.0)
        assert sum(light[key] for light in found["lights"]) == pytest.approx(found[key], rel=1e-6)
    assert all(0.0 < light["share_of_luminance"] < 1.0 for light in found["lights"])
    alone = probed(scene._replace(lights=scene.lights[:1]), 20, 40)
    assert alone["luminance_cd_m2"] == pytest.approx(found["lights"][0]["luminance_cd_m2"])
    assert alone["lights"][0]["share_of_illuminance"] == 1.0


def test_f_times_irradiance_is_the_radiance_of_a_light_from_one_direction(probed):
    scene = lit("point:position=1,2,1.5", mesh="sphere", model="ward", rotation=(10, 20, 30))
    found = probed(scene, 40, 30)
    (light,) = found["lights"]
    expected = np.multiply(light["f_rgb_1_sr"], light["irradiance_rgb"])
    assert light["radiance_rgb"] == pytest.approx(list(expected), rel=1e-4)


def test_the_angles_are_those_of_the_geometry(probed):
    eye, lamp = (1.0, 2.0, 3.0), (-2.0, 1.5, 1.0)
    scene = lit(f"point:position={','.join(map(str, lamp))}", camera__position=eye)
    found = probed(scene, 25, 45)
    N, place = np.array(found["normal"]), np.array(found["position_m"])
    V, L = (np.subtract(there, place) for there in (eye, lamp))
    assert found["distance_m"] == pytest.approx(np.linalg.norm(V), rel=1e-6)
    assert found["theta_o_deg"] == pytest.approx(
        math.degrees(math.acos(cosine(found, V))), abs=1e-3
    )
    flat = [w - N * (w @ N) for w in (V, L)]
    turn = np.dot(*flat) / np.prod([np.linalg.norm(w) for w in flat])
    turn = math.degrees(math.acos(turn))
    assert found["lights"][0]["azimuth_deg"] == pytest.approx(turn, abs=1e-3)


@pytest.mark.parametrize("model", ["ward", "transparency"])
def test_in_a_furnace_the_albedo_toward_the_eye_is_what_is_seen(probed, model):
    found = probed(lit("furnace", model=model, mesh="sphere"), 45, 20)
    assert found["albedo_to_eye_rgb"] == pytest.approx(found["radiance_rgb"], rel=1e-2)


def test_a_mirror_sends_back_what_fresnel_says_though_no_image_of_a_point_is_drawn(probed):
    """Grey metal of n = 0.18, k = 3 at 45 degrees: R = (Rs + Rp) / 2 of its complex index."""
    metal = {"model": "conductor", "eta": (0.18, 0.18, 0.18), "k": (3.0, 3.0, 3.0)}
    found = probed(lit("directional:direction=0,1,1", **metal))
    index, c = 0.18 + 3.0j, math.sqrt(0.5)
    t = np.sqrt(1.0 - 0.5 / index**2)
    Rs, Rp = (abs((a - b) / (a + b)) ** 2 for a, b in ((c, index * t), (t, index * c)))
    R = (Rs + Rp) / 2
    assert found["lights"][0]["albedo"] == pytest.approx(R, rel=1e-4)
    share = found["luminous_exitance_lm_m2"] / found["illuminance_lx"]
    assert share == pytest.approx(R, rel=1e-4)
    assert found["luminance_cd_m2"] == 0.0


def test_the_angle_of_a_light_with_an_extent_is_that_of_its_middle(probed):
    corners = "corners=three:a=1,2,0:b=2,2,0:c=1.5,3,1"
    middles = {"sphere:position=1,2,1": (1, 2, 1), f"polygon:{corners}": (1.5, 7 / 3, 1 / 3)}
    found = probed(lit(*middles, "sun:height=30"))
    for light, middle in zip(found["lights"], middles.values(), strict=False):
        angle = math.acos(cosine(found, np.subtract(middle, found["position_m"])))
        assert light["theta_i_deg"] == pytest.approx(math.degrees(angle), abs=1e-3)
    assert found["lights"][2]["theta_i_deg"] == pytest.approx(60.0, abs=1e-3)


def test_what_loses_nothing_sends_out_all_that_arrives(probed):
    """The energy-preserving Oren-Nayar model with albedo 1: M = E under any light."""
    white = {"albedo": (1, 1, 1), "form": "energy_preserving", "roughness": 0.7}
    lights = ("directional:direction=1,1,0", "ambient", "furnace")
    found = probed(lit(*lights, model="oren_nayar", **white))
    for light in found["lights"]:
        key = "luminous_exitance_lm_m2"
        assert light[key] == pytest.approx(light["illuminance_lx"], rel=2e-3), light["kind"]
    assert found["exitance_exact"]


def test_a_black_body_gives_what_stefan_and_boltzmann_say(probed):
    """M = sigma T^4, and 92.08 lm/W at 5778 K (PHYSICS C.7); lights add nothing to it."""
    found = probed(lit("directional", model="black_body", temperature=5778))
    assert found["exitance_W_m2"] == pytest.approx(5.670374419e-8 * 5778.0**4, rel=1e-4)
    assert found["luminance_cd_m2"] / found["radiance_W_m2_sr"] == pytest.approx(92.08, rel=1e-3)
    assert found["emitted_cd_m2"] == pytest.approx(found["luminance_cd_m2"])


def test_where_nothing_is_the_background_is_read(probed):
    found = probed(lit("ambient", mesh="sphere", background=(0.2, 0.2, 0.2)), 0, 0)
    assert found["object"] is None and found["lights"] == []
    assert found["luminance_cd_m2"] == pytest.approx(0.2 * units.EFFICACY)
    assert found["radiance_W_m2_sr"] == pytest.approx(0.2)
    assert found["illuminance_lx"] is None
    furnace = lit("furnace:visible=true", mesh="sphere")
    assert probed(furnace, 0, 0)["radiance_W_m2_sr"] == pytest.approx(1.0)


def test_the_object_is_named_and_numbered(probed):
    scene = lit("ambient", mesh="sphere:radius=0.1")
    far = scene.objects[0]._replace(name="far", mesh="plane:width=50")
    scene = scene._replace(objects=(*scene.objects, far)).set(
        **{"object.2.position": (0, -1, 0), "camera.target": (0, 0, 0), "camera.distance": 1.0}
    )
    assert probed(scene)["object"]["number"] == 1
    beside = probed(scene, 5, 60)["object"]
    assert (beside["number"], beside["name"], beside["model"]) == (2, "far", "lambert")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        *[("0,0", (0, 0)), ("1,1", (1, 1)), ("639,479", (639, 479)), ("10.7,20.2", (10, 20))],
        *[("0.5,0.5", (320, 240)), ("0.0,0", (0, 0)), ("1.0,1.0", (639, 479)), ("0,1", (0, 1))],
    ],
)
def test_places_are_pixels_or_shares(text, expected):
    assert probe.place(text, (640, 480)) == expected


@pytest.mark.parametrize("text", ["640,0", "-1,5", "-0.1,0.5", "3", "a,b", "1,2,3", "nan,0.5", ""])
def test_a_place_out_of_the_picture_is_a_mistake(text):
    with pytest.raises(Mistake, match="--at"):
        probe.place(text, (640, 480))


def test_the_command_prints_a_table_or_json(lumiar):
    at = ("probe", "--at", "0.5,0.5", "--size", "64x64", "--light", "point:intensity=100 cd")
    found = json.loads(lumiar(*at, "--json").stdout)
    assert found["at_px"] == [32, 32] and found["lights"][0]["kind"] == "point"
    table = lumiar(*at, "--set", "lang=pt").stdout
    assert "iluminância" in table and f"{found['illuminance_lx']:.5g} lx" in table


def test_a_table_tells_what_is_no_number(probed):
    found = probed(lit("point:intensity=100 cd"))
    table = readout.text({**found, "irradiance_W_m2": math.nan}, "a scene", "en")
    assert "nan W/m²" in table


def test_json_has_null_for_what_is_no_number():
    found = {"a": [1.0, math.nan], "b": {"c": math.inf, "d": None}}
    assert json.loads(readout.as_json(found)) == {"a": [1.0, None], "b": {"c": None, "d": None}}
