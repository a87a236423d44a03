"""The house of CONTRIBUTING.md: who may import whom, and how large a file may grow."""

import ast
import re
from pathlib import Path

import pytest

from lumiar import catalog, glsltext, parts

ROOT = Path(__file__).parent.parent
APP = ROOT / "app" / "lumiar"
FLOORS = [  # lowest first; a module imports only from floors below its own
    "errors",
    "files portuguese",
    "parameter cache supervise polygons reference_terms camera tomltext driverlog glsltext "
    "difference contract image sheet gonio captions spectrum claims arguments factors scale "
    "occluders history words notation watch phrases banner trial clock timing study bilingual "
    "colorimetry judge comparing",
    "catalog mesh reference_energy tables panels units estimates card legend slide readout labels "
    "advice chart codearea plates",
    "ledger formats shapes plots factor_table reference flatten daylight widgets desktop auditor "
    "figures",
    "geometry compose parts materials hemisphere surroundings page",
    "settings factor_card layout content variants navigate overlay deviation uses",
    "scenefile stock hands handles targets facing",
    "scene editing contrast pointer sight charts",
    "renderer lesson opening texts solids rows compare",
    "picture options measure views report beside estimate easel editor gate tryout sections shelf",
    "hostile measuring falsecolour reflectance deck presenter stage film stopwatch panel "
    "document gallery",
    "examine probe bench curves plotfiles comparison snapshot",
    "audit filming datasheet studies plotter prober bargains",
    "drawer",
    "window",
    "verbs benching",
    "lab",
    "cli",
]
FLOOR = {name: i for i, names in enumerate(FLOORS) for name in names.split()}
GL = {"moderngl", "glcontext"}
HOMES = {  # a heavy library and the modules that may know it
    "moderngl": {"card", "stock", "renderer"},
    "glcontext": {"card"},
    "PIL": {"image", "sheet", "legend", "slide", "film"},
    "isal": {"image", "cache"},
    "flip_evaluator": {"difference"},
    "matplotlib": {"panels", "plots"},
    "imgui_bundle": {
        "labels",
        "widgets",
        "sections",
        "panel",
        "presenter",
        "overlay",
        "banner",
        "gallery",
        "comparison",
        "codearea",
        "editor",
        "desktop",
        "drawer",
        "window",
        "datasheet",
        "plotter",
        "prober",
        "solids",
        "charts",
        "filming",
        "bargains",
        "rows",
        "shelf",
        "handles",
    },
    "glfw": {"desktop"},
}
MODULES = sorted(p for p in APP.rglob("*.py") if p.name not in ("__init__.py", "__main__.py"))


PACKAGES = ("formats", "studies")  # folders of modules on one floor, which may know each other


def module_name(path):
    return path.parent.name if path.parent.name in PACKAGES else path.stem


def imports(path):
    """Yield (top-level library or module of ours, whether it is ours) for each import."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from ((alias.name, False) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            name = node.module or ""
            ours = node.level > 0 or name.split(".")[0] == "lumiar"
            name = name.removeprefix("lumiar").lstrip(".")
            names = [name] if name else [alias.name for alias in node.names]
            yield from ((n, ours) for n in names)


def test_the_floors_are_those_of_contributing():
    """A row of its table names modules in backquotes, each before what it is for."""
    rows = re.findall(r"^\| (\d+) \| (.*) \|$", (ROOT / "CONTRIBUTING.md").read_text(), re.M)
    table = {int(floor): re.findall(r"`(\w+)/?`", modules) for floor, modules in rows}
    assert {i: sorted(modules) for i, modules in table.items()} == {
        i: sorted(names.split()) for i, names in enumerate(FLOORS)
    }


def test_what_parameters_may_not_be_named_is_what_scenes_are_made_of():
    """`catalog` stands below `parts`, and so has to say the names once more."""
    assert tuple(parts.SCENE) == catalog.SCENE_KEYS
    assert {*catalog.OWN_KEYS["model"]} == {*parts.Object._fields, "material"} - {"values"}
    assert {*catalog.OWN_KEYS["light"]} == {*parts.Light._fields} - {"values"}


def test_every_module_has_a_floor():
    assert {module_name(path) for path in MODULES} == set(FLOOR)


@pytest.mark.parametrize("path", MODULES, ids=lambda p: p.stem)
def test_imports_only_from_below(path):
    own = module_name(path)
    for name, ours in imports(path):
        first = name.split(".")[0]
        if ours and first in FLOOR and first != own:
            inside = own in PACKAGES and (APP / own / f"{first}.py").exists()
            assert inside or FLOOR[first] < FLOOR[own], f"{own} imports {first}"
        if not ours and first in HOMES:
            assert own in HOMES[first], f"{own} imports {first}"
        assert first not in ("trimesh", "pyrr"), f"{own} imports {first}"


@pytest.mark.parametrize("path", MODULES, ids=lambda p: p.stem)
def test_a_module_is_short_and_says_what_it_is(path):
    text = path.read_text()
    assert text.count("\n") <= 300
    assert ast.get_docstring(ast.parse(text))
    for node in ast.parse(text).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_"):
            assert ast.get_docstring(node), f"{path.name}: {node.name} has no docstring"


@pytest.mark.parametrize(
    "path",
    sorted(p for f in ("models", "studies") for p in (ROOT / "glsl" / f).glob("*.glsl")),
    ids=lambda p: f"{p.parent.name}-{p.stem}",
)
def test_a_model_fits_on_a_page(path):
    text = path.read_text()
    assert text.count("\n") <= 60
    code = glsltext.without_comments(text)  # papers are about textures
    assert not re.search(r"(?m)^(in|out)\s+vec|gl_|texture|dFd[xy]|fwidth", code)


def test_nothing_is_left_open():
    for folder in ("app", "glsl", "tests"):
        for path in (ROOT / folder).rglob("*"):
            if (
                path.suffix in (".py", ".glsl", ".vert", ".frag", ".geom")
                and path.name != Path(__file__).name
            ):
                assert not re.search(r"TODO|FIXME|XXX|NotImplementedError", path.read_text()), path


def test_every_asset_folder_names_its_sources():
    for folder in ("meshes", "fonts", "spectra", "sky", "environments", "lessons"):
        sources = (ROOT / "assets" / folder / "SOURCES.md").read_text()
        for path in (ROOT / "assets" / folder).iterdir():
            if path.name not in ("SOURCES.md", "LICENSE.txt"):
                assert path.name in sources


def test_readme_is_short():
    assert (ROOT / "README.md").read_text().count("\n") <= 150
