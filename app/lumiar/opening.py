"""Files brought into the window: scenes page by page, what is dropped, what is saved anew."""

import os

from . import catalog, geometry, scenefile, settings
from .errors import Mistake
from .files import cache_folder, read_text, write_whole
from .scene import Scene

DEPTH = 3  # sheets within sheets
ROOT = os.path.abspath(os.sep)


def pages(scene):
    """Return [({language: caption}, Scene)]: a scene alone, or one for each picture of a sheet."""
    return _pages(scene, scene.title, DEPTH)


def _pages(scene, caption, depth):
    if not scene.panels:
        return [(caption, scene)]
    if not depth:
        raise Mistake(f"sheets within sheets; allowed: {DEPTH} levels")
    found = []
    for i, panel in enumerate(scene.panels, 1):
        one = Scene.load(panel.scene) if panel.scene else scene._replace(panels=(), title={})
        one = settings.all_changed(one, panel.values, f"panel {i}: ")
        found += _pages(one, panel.caption or one.title, depth - 1)
    return found


def dropped(scene, path, chosen=0):
    """Return the scene with a mesh, a model, a light or an .hdr picture in it that came as a file.

    chosen: index of the object that takes a mesh or a model. A scene, or a picture that carries
    one, takes the place of all. Raises Mistake.
    """
    kind = os.path.splitext(path)[1].lower()
    if kind in geometry.FORMATS:
        return scene.changed(f"object.{chosen + 1}.mesh", path)
    if kind == ".hdr":
        others = (light for light in scene.lights if "environment" not in light.kind.defines)
        around = settings.light("environment:visible=true", "")
        around = settings.light_with(around, "image", path)
        return scene._replace(lights=(*others, around))
    if kind != ".glsl":
        return Scene.load(path)
    try:
        catalog.read("model", path)
    except Mistake as not_a_model:
        try:
            light = settings.light(path)
        except Mistake:
            raise not_a_model from None
        return scene._replace(lights=(*scene.lights, light))
    return scene.changed(f"object.{chosen + 1}.model", path)


def is_scene(path):
    """Return whether a path ends as that of a scene, or of a picture that may carry one."""
    return path.lower().endswith((".toml", ".png"))


def shaders(scene):
    """Return the Shaders of all objects and lights of a scene."""
    return *(one.model for one in scene.objects), *(one.kind for one in scene.lights)


def uses_time(scene):
    """Return whether a model or a light of a scene changes with its time."""
    return any(p.widget == "time" for shader in shaders(scene) for p in shader.parameters)


def sources(scene):
    """Return the paths of the files that a scene is made from, beside its own."""
    meshes = (one.mesh for one in scene.objects if os.path.isabs(one.mesh))
    return dict.fromkeys((*(shader.path for shader in shaders(scene)), *meshes))


def renewed(scene, shaders, memory):
    """Return the scene with the shaders of {path: Shader} in place of older ones.

    What was set by hand is kept, even while a broken save leaves its line out: memory, a dict of
    ours, holds it until then.
    """
    objects = tuple(
        _renewed(one, "model", shaders.get(one.model.path), memory.setdefault(("object", i), {}))
        for i, one in enumerate(scene.objects)
    )
    lights = tuple(
        _renewed(one, "kind", shaders.get(one.kind.path), memory.setdefault(("light", i), {}))
        for i, one in enumerate(scene.lights)
    )
    if objects == scene.objects and lights == scene.lights:
        return scene
    return scene._replace(objects=objects, lights=lights)


def _renewed(one, field, shader, memory):
    old = getattr(one, field)
    if shader is None or shader.source == old.source:
        return one
    given = {(old.path, p.name): one.values[p.name] for p in old.parameters}
    fresh = {(old.path, p.name): p.default for p in old.parameters}
    for key, value in given.items():
        memory.pop(key, None)
        if value != fresh[key]:
            memory[key] = value
    values = shader.defaults()
    for parameter in shader.parameters:
        try:
            kept = memory.get((shader.path, parameter.name), parameter.default)
            values[parameter.name] = parameter.check(kept)
        except Mistake:
            continue  # its domain has changed: the new default stays
    return one._replace(**{field: shader}, values=values)


def reread(scene):
    """Return the scene with all its shaders as their files are; raise Mistake."""
    kinds = {shader.path: (shader.kind, shader.name) for shader in shaders(scene)}
    fresh = {path: catalog.read(*kind, edited=True) for path, kind in kinds.items()}
    return renewed(scene, fresh, {})


def renamed(scene, path, copy):
    """Return the scene with the Shaders of one path as those of another, which holds the same."""

    def other(one, field):
        shader = getattr(one, field)
        renamed = shader._replace(name=copy, path=copy)
        return one._replace(**{field: renamed}) if shader.path == path else one

    objects = tuple(other(one, "model") for one in scene.objects)
    return scene._replace(objects=objects, lights=tuple(other(one, "kind") for one in scene.lights))


def keep(scene):
    """Write the scene where `kept` finds it again; do nothing where the disk refuses.

    As if for a file in the root folder, so that every path lies inside, whatever changes there.
    """
    try:
        os.makedirs(cache_folder(), exist_ok=True)
        write_whole(_kept(), [scenefile.dump(scene, ROOT).encode()])
    except (OSError, UnicodeEncodeError, Mistake):
        return  # a file of it is gone, or its name is no UTF-8


def kept():
    """Return the scene of the last window; raise Mistake if there is none."""
    if not os.path.exists(_kept()):
        raise Mistake("--restore: no window has been open yet; name a scene instead")
    text = read_text(_kept(), scenefile.LIMIT, "a scene file")
    return scenefile.parse(text, os.path.join(ROOT, "restored"), Scene.default())


def _kept():
    return os.path.join(cache_folder(), "window.toml")
