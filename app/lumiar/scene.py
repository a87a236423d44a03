"""All that determines one image."""

import os
from typing import NamedTuple

from . import catalog, geometry, scenefile, settings
from .errors import Mistake, nearest
from .files import read_bytes, read_text
from .parts import Camera, Light, Object, Panel

PICTURE_LIMIT = 1 << 30  # bytes of a picture that may carry a scene


class Scene(NamedTuple):
    """All that determines one image, or, with panels, one sheet of images.

    Domains and units of the values stand in `parts.SCENE`; title maps a language to a line.
    """

    objects: tuple[Object, ...]
    lights: tuple[Light, ...]
    camera: Camera = Camera()
    size: tuple[int, int] = (768, 768)
    samples: int = 4
    shading: str = "phong"
    background: tuple[float, float, float] = (0.05, 0.05, 0.05)
    exposure: float = 0.0
    ev100: float | None = None
    tone: str = "none"
    time: float = 0.0
    title: dict = {}  # noqa: RUF012  never changed in place
    lang: str = "system"
    columns: int = 0
    panels: tuple[Panel, ...] = ()

    @property
    def gain(self):
        """The factor on the radiance before the tone curve."""
        if self.ev100 is None:
            return 2.0**self.exposure
        from . import units

        return 2.0**self.exposure * units.exposure(self.ev100)

    @staticmethod
    def default():
        """Return the scene used where none is named: a sphere under one directional light."""
        model = catalog.read("model", "phong")
        kinds = [catalog.read("light", kind) for kind in ("directional", "ambient")]
        lights = tuple(Light(kind, kind.defaults()) for kind in kinds)
        return Scene((Object(model, model.defaults()),), lights)

    @staticmethod
    def load(name, folder="", where=""):
        """Return the Scene that a name stands for.

        A shipped scene by name, or the path (from `folder`) of a scene file, of a picture that
        Lumiar made, or of a mesh or model, which is put into the default scene. Raises Mistake
        naming file:line, or beginning with `where`.
        """
        ours = scenefile.shipped()
        path = ours.get(name) or os.path.join(folder, os.path.expanduser(name))
        kind = os.path.splitext(path)[1].lower()
        base = Scene.default()
        if kind == ".toml":
            return scenefile.parse(read_text(path, scenefile.LIMIT, "a scene file"), path, base)
        if kind == ".png":
            text = scenefile.embedded(read_bytes(path, PICTURE_LIMIT, "a picture"), path)
            return scenefile.parse(text, path, base)
        if kind in geometry.FORMATS or kind == ".glsl":
            key = "model" if kind == ".glsl" else "mesh"
            return base.changed(key, name, where, folder)
        advice = "or a file: a .toml scene, a .png that Lumiar made, a mesh or a .glsl model"
        raise Mistake(f"{where}no scene '{name}'; {nearest(name, ours)}, {advice}")

    def changed(self, key, value, where="", folder=""):
        """Return the scene with one value changed by its name; see `settings.changed`."""
        return settings.changed(self, key, value, where, folder)

    def set(self, **values):
        """Return the scene with values changed by name, a dot written as two underscores.

        For example scene.set(mesh="teapot", shininess=80, camera__fov=20).
        """
        pairs = [(key.replace("__", "."), value) for key, value in values.items()]
        return settings.all_changed(self, pairs)

    def toml(self, folder=""):
        """Return the scene as TOML text for a file in `folder`; see `scenefile.dump`."""
        return scenefile.dump(self, folder or os.getcwd())
