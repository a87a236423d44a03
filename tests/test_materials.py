"""Measured materials: their values, how they reach a scene, and where they come from."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from lumiar import catalog, materials, reference_terms
from lumiar.errors import Mistake
from lumiar.scene import Scene

ASSETS = Path(materials.FOLDER)
SLIDE = {  # F0, linear, from the lecture's table of typical values
    "water": (0.02,) * 3,
    "plastic_low": (0.03,) * 3,
    "plastic_high": (0.05,) * 3,
    "glass_high": (0.08,) * 3,
    "diamond": (0.17,) * 3,
    "gold": (1.00, 0.71, 0.29),
    "silver": (0.95, 0.93, 0.88),
    "copper": (0.95, 0.64, 0.54),
    "iron": (0.56, 0.57, 0.58),
    "aluminium": (0.91, 0.92, 0.92),
}


@pytest.mark.parametrize("name", materials.names())
def test_a_material_fits_its_model_and_names_its_source(name):
    one = materials.read(name)
    made = materials.applied(Scene.default().objects[0], name)
    assert made.model.name == one.model
    own = {p.name for p in made.model.parameters}
    assert all(made.values[k] == pytest.approx(v) for k, v in one.values.items() if k in own)
    assert set(one.title) == {"en", "pt"} and len(one.source) > 30
    assert f"{name}" in (ASSETS / "SOURCES.md").read_text()


@pytest.mark.parametrize("name", SLIDE)
def test_the_lectures_typical_values_are_there(name):
    assert tuple(materials.read(name).values["f0"]) == SLIDE[name]


@pytest.mark.parametrize("name", ["water", "glass", "diamond", "glass_high"])
def test_an_index_gives_the_typical_reflectance(name):
    values = materials.read(name).values
    n = values["eta"]
    assert ((n - 1) / (n + 1)) ** 2 == pytest.approx(values["f0"][0], abs=0.005)


def test_the_reflectance_at_82_degrees_follows_from_the_index():
    for name in materials.names():
        values = materials.read(name).values
        if "k" in values:
            eta, k = (np.array([values[key]]) for key in ("eta", "k"))
            F = reference_terms.F_conductor(np.array([[1.0 / 7.0]]), eta, k)
            assert np.abs(F - values["f82"]).max() < 1e-3


def test_the_model_stays_where_it_takes_what_counts():
    base = Scene.default()
    assert base.set(material="gold").objects[0].model.name == "rough_conductor"
    polished = base.set(model="conductor", material="gold").objects[0]
    assert polished.model.name == "conductor" and polished.values["k"][0] == 3.702
    rough = base.set(model="rough_dielectric", material="water").objects[0]
    assert rough.model.name == "rough_dielectric" and rough.values["eta"] == 1.333
    assert base.set(model="cook_torrance", material="gold").objects[0].model.name != "cook_torrance"


def test_what_is_set_beside_a_material_counts():
    one = Scene.default().set(alpha=0.4, material="copper").objects[0]
    assert one.values["alpha"] == 0.4 and one.values["eta"][0] == 0.22


def test_on_the_command_line_and_in_scenes(lumiar, tmp_path):
    lumiar("capture", "--material", "gold", "--size", "16x16", "-o", "a.png")
    (tmp_path / "s.toml").write_text("size = [16, 16]\n[[object]]\nmaterial = 'gold'\n")
    lumiar("capture", "s.toml", "-o", "b.png")
    lumiar("compare", "a.png", "b.png", "--max-rmse", "0")
    lumiar("capture", "a.png", "-o", "c.png")
    lumiar("compare", "a.png", "c.png", "--max-rmse", "0")
    told = lumiar("capture", "--material", "golf", code=2).stderr
    assert "--material: no material 'golf'; did you mean 'gold'?" in told
    told = lumiar("capture", "--model", "lambert", "--material", "gold", code=2).stderr
    assert "lambert takes none of the values of 'gold'" in told
    (tmp_path / "s.toml").write_text("[[object]]\nmaterial = 'golf'\n")
    assert "s.toml:2: object 1: no material 'golf'" in lumiar("capture", "s.toml", code=2).stderr
    assert "gold" in lumiar("list", "materials").stdout


def test_a_material_that_does_not_exist_is_refused():
    with pytest.raises(Mistake, match="no material 'tin'"):
        materials.read("tin")


def test_the_metals_are_made_from_the_committed_spectra():
    for path in ASSETS.glob("*.toml"):
        data = tomllib.loads(path.read_text())
        assert catalog.read("model", data["model"]).defaults().keys() & data["values"].keys()


def test_a_material_is_measured_with_the_values_it_has(lumiar):
    table = lumiar("measure", "rough_conductor", "--material", "silver", "--light", "45").stdout
    assert "# parameter 1.eta: 0.05, 0.056, 0.04 (unitless)" in table
    told = lumiar("measure", "lambert", "--material", "silver", code=2).stderr
    assert "lambert takes none of the values of 'silver'" in told
