"""Measured materials by name: values for the parameters of a model, each with its source."""

import os
from typing import NamedTuple

from . import catalog, tomltext
from .errors import Mistake, nearest
from .files import ASSETS, read_text

FOLDER = os.path.join(ASSETS, "materials")
LIMIT = 1 << 16  # bytes of a material file


class Material(NamedTuple):
    """A material: title maps a language to a line, values hold what a model may take."""

    name: str
    title: dict
    model: str
    source: str
    values: dict


def names():
    """Return the names of the materials that come with Lumiar."""
    return sorted(f[:-5] for f in os.listdir(FOLDER) if f.endswith(".toml"))


def read(name, where=""):
    """Return the Material of that name; raise Mistake, beginning with `where`, if there is none."""
    if name not in names():
        raise Mistake(f"{where}no material '{name}'; {nearest(name, names())}")
    path = os.path.join(FOLDER, f"{name}.toml")
    data = tomltext.parse(read_text(path, LIMIT, "a material"), path)
    return Material(name, data["title"], data["model"], data["source"], data["values"])


def applied(one, name, keep=False, where=""):
    """Return an Object made of a material, of its own model if that suits, else the material's.

    A model suits if it takes all values that the material's own model does; with `keep` it stays in
    any case, and what it has no parameter for is left out. Raises Mistake where nothing is left.
    """
    material = read(name, where)
    own = catalog.read("model", material.model, where)
    fitting = _fitting(material, one.model, where)
    if not keep and not fitting.keys() >= _fitting(material, own, where).keys():
        one = one._replace(model=own, values=own.defaults())
        fitting = _fitting(material, own, where)
    if not fitting:
        raise Mistake(
            f"{where}{one.model.name} takes none of the values of '{name}', which are "
            f"{', '.join(material.values)}; leave the model out for {material.model}"
        )
    return one._replace(values={**one.values, **fitting})


def _fitting(material, model, where):
    """Return the values of a material that a model has a parameter of that kind for."""
    found = {}
    for parameter in model.parameters:
        value = material.values.get(parameter.name)
        wanted = 3 if parameter.type == "vec3" else 1
        if value is not None and wanted == (len(value) if isinstance(value, list) else 1):
            found[parameter.name] = parameter.check(value, f"{where}{material.name}: ")
    return found
