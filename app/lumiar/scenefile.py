"""Scenes as TOML text, in files of their own and inside the pictures that Lumiar makes."""

import os
from functools import partial
from typing import NamedTuple

from . import catalog, geometry, settings, tomltext
from .content import LIMIT, confine, digest, inside
from .errors import Mistake, nearest
from .files import ASSETS
from .parts import CAMERA, LIGHT, LIGHT_TEXTS, OBJECT, SCENE, Camera, Light, Object, Panel
from .tomltext import Place

SECTIONS = {"camera": 1, "object": 256, "light": 64, "panel": 256, "content": 1024}  # at most
LANGUAGES = ("en", "pt")
_KEYWORD = b"lumiar"  # of the PNG text chunk that holds the scene


class _File(NamedTuple):
    """A scene file being read: its text, its path, the digests it knows of files elsewhere."""

    text: str
    path: str
    content: dict

    @property
    def folder(self):
        return os.path.dirname(os.path.abspath(self.path))

    def at(self, key, section="", index=0):
        """Return the Place of a key."""
        return Place(self.text, self.path, key, section, index)


def system_language():
    """Return the language of LANGUAGES that the system speaks, else English."""
    names = ("LC_ALL", "LC_MESSAGES", "LANG")
    system = next((os.environ[name] for name in names if os.environ.get(name)), "")
    return next((lang for lang in LANGUAGES if system.lower().startswith(lang)), "en")


def shipped():
    """Return the scenes that come with Lumiar, {name: path}."""
    folder = os.path.join(ASSETS, "scenes")
    files = (f for f in sorted(os.listdir(folder)) if f.endswith(".toml"))
    return {f[:-5]: os.path.join(folder, f) for f in files}


def parse(text, path, base):
    """Return the scene of TOML text that came from `path`; raise Mistake naming path:line.

    What the text leaves out is as in the scene `base`.
    """
    data = tomltext.parse(text, path)
    file = _File(text, path, data.get("content", {}))
    _check_keys(data, [*SCENE, *SECTIONS, "title"], file.at)
    for section, most in SECTIONS.items():
        form = dict if section in ("camera", "content") else list
        given = data.get(section, form())
        tables = given if form is list else ()
        if not isinstance(given, form) or not all(isinstance(table, dict) for table in tables):
            sample = f"[{section}]" if form is dict else f"[[{section}]]"
            raise Mistake(f"{file.at(section)}'{section}' is a section; write {sample}")
        if form is list and len(given) > most:
            raise Mistake(f"{file.at(section)}{len(given)} of {section}; allowed: up to {most}")
    given = {k: settings.scene_value(k, v, file.at(k)) for k, v in data.items() if k in SCENE}
    if "title" in data:
        given["title"] = _words(data["title"], "title", file.at("title"))
    if "camera" in data:
        given["camera"] = _camera(file, data["camera"])
    if "object" in data:
        given["objects"] = tuple(_object(file, i, one) for i, one in enumerate(data["object"]))
        if not given["objects"]:
            raise Mistake(f"{file.at('object')}a scene needs an object; write [[object]]")
    if "light" in data:
        given["lights"] = tuple(_light(file, i, one) for i, one in enumerate(data["light"]))
    scene = base._replace(**given)
    panels = (_panel(file, i, one, scene) for i, one in enumerate(data.get("panel", ())))
    return scene._replace(panels=tuple(panels))


def dump(scene, folder):
    """Return the TOML text of a Scene, complete, with paths relative to `folder` where inside it.

    A file elsewhere is written with its full path, and its SHA-256 under [content]: only a scene
    that knows what is in a file may open it there.
    """
    content = {}

    def written(name, kind):
        if not os.path.isabs(name):
            return name
        if inside(name, folder):
            return os.path.relpath(os.path.realpath(name), os.path.realpath(folder))
        content[name] = digest(name, kind)
        return name

    def setting(key, value):
        kind = key.rpartition(".")[2]
        if kind == "light":  # as text, its parameters behind colons
            name, *rest = settings.light_parts(str(value))
            rest = (
                f"image={written(part[6:], 'image')}" if part.startswith("image=") else part
                for part in rest
            )
            return ":".join([written(name, kind), *rest])
        return written(value, kind) if kind in ("mesh", "model", "image") else value

    data = {key: getattr(scene, key) for key in SCENE}
    data["title"] = scene.title
    data["camera"] = {key: getattr(scene.camera, key) for key in CAMERA}
    data["object"] = [
        {
            "name": one.name,
            "mesh": written(one.mesh, "mesh"),
            "model": written(one.model.name, "model"),
            **{key: getattr(one, key) for key in OBJECT},
            **one.values,
        }
        for one in scene.objects
    ]
    data["light"] = [
        {
            "name": one.name,
            "kind": written(one.kind.name, "light"),
            **one.values,
            **_own(one, lambda name: written(name, "image")),
        }
        for one in scene.lights
    ]
    data["panel"] = [
        {
            "caption": panel.caption,
            "scene": written(panel.scene, "scene"),
            "set": {key: setting(key, value) for key, value in panel.values},
        }
        for panel in scene.panels
    ]
    data["content"] = content
    return tomltext.dumps(data)


def embedded(data, path):
    """Return the scene text that the bytes of a PNG carry; raise Mistake, naming path, if none."""
    if not data.startswith(b"\x89PNG\r\n\x1a\n"):
        raise Mistake(f"{path}: not a PNG picture; name one that Lumiar made, or a .toml scene")
    start = 8
    while start + 8 <= len(data):
        length = int.from_bytes(data[start : start + 4], "big")
        if data[start + 4 : start + 8] == b"iTXt":
            keyword, _, rest = data[start + 8 : start + 8 + length].partition(b"\0")
            if keyword == _KEYWORD and len(rest) <= LIMIT and rest[:4] == b"\0\0\0\0":
                try:
                    return rest[4:].decode()
                except UnicodeDecodeError:
                    break
        start += 12 + length
    raise Mistake(f"{path}: carries no scene; name a PNG that Lumiar made, or a .toml scene")


def chunk(text):
    """Return (type, contents) of the PNG chunk that carries the text of a scene."""
    try:
        return b"iTXt", _KEYWORD + b"\0\0\0\0\0" + text.encode()
    except UnicodeEncodeError as error:
        name = text[max(0, error.start - 20) : error.end + 20]
        raise Mistake(f"…{name}…: a file name that is no UTF-8; rename the file") from None


def _check_keys(data, allowed, where):
    for key in data:
        if key not in allowed:
            raise Mistake(f"{where(key)}unknown key '{key}'; {nearest(key, allowed)}")


def _words(value, key, where):
    """Return {language: line} for text that people read."""
    words = {"en": value} if isinstance(value, str) else value
    good = isinstance(words, dict) and all(
        k in LANGUAGES and isinstance(v, str) and len(v) <= 200 for k, v in words.items()
    )
    if not good:
        raise Mistake(f'{where}{key} is a line of text, or {{ en = "…", pt = "…" }}')
    return words


def _camera(file, data):
    where = partial(file.at, section="camera")
    _check_keys(data, CAMERA, where)
    camera = Camera(**{key: CAMERA[key].check(value, where(key)) for key, value in data.items()})
    if camera.position and camera.position == camera.target:
        raise Mistake(f"{where('target')}the eye stands on its target; move one of them")
    return camera


def _object(file, index, data):
    where = partial(file.at, section="object", index=index)
    names = _names(data, {"name": "", "mesh": "sphere", "model": "phong", "material": ""}, where)
    confine(names["mesh"], "mesh", file.folder, file.content, where("mesh"))
    confine(names["model"], "model", file.folder, file.content, where("model"))
    mesh = geometry.canonical(names["mesh"], file.folder, where("mesh"))
    model = catalog.read("model", names["model"], where("model"), file.folder)
    one = Object(model, model.defaults(), mesh, names["name"])
    if names["material"]:
        from . import materials

        one = materials.applied(one, names["material"], "model" in data, where("material"))
    model, values = one.model, dict(one.values)
    _check_keys(data, [*catalog.OWN_KEYS["model"], *model.defaults()], where)
    own = {}
    for key, value in data.items():
        if key in OBJECT:
            own[key] = settings.object_value(key, value, where(key))
        elif key not in names:
            values[key] = _given(model, key, value, where(key))
    return one._replace(values=values, **own)


def _given(shader, key, value, where):
    """Return the checked value of a parameter; one that follows the time is not to be set."""
    parameter = shader.parameter(key)
    if parameter.widget == "time" and value != parameter.default:
        parameter.refuse_time(where)
    return parameter.check(value, where)


def _light(file, index, data):
    where = partial(file.at, section="light", index=index)
    names = _names(data, {"name": "", "kind": "directional"}, where)
    confine(names["kind"], "light", file.folder, file.content, where("kind"))
    kind = catalog.read("light", names["kind"], where("kind"), file.folder)
    _check_keys(data, [*catalog.OWN_KEYS["light"], *kind.defaults()], where)
    if "temperature" in data and "illuminant" in data:
        raise Mistake(f"{where('illuminant')}a temperature and an illuminant; leave one out")
    tinted = kind.tinted.name if kind.tinted else ""  # which may bring a unit along: "800 lm"
    if "unit" in data and isinstance(data.get(tinted), str):
        raise Mistake(f"{where('unit')}{tinted} has a unit of its own; leave one out")
    one = Light(kind, kind.defaults(), names["name"])
    for key, value in data.items():
        if key == "image":
            confine(str(value), key, file.folder, file.content, where(key))
        if key in (*LIGHT, *LIGHT_TEXTS) or (key == tinted and isinstance(value, str)):
            one = settings.light_with(one, key, value, where(key), file.folder)
        elif key not in names:
            one = one._replace(values={**one.values, key: _given(kind, key, value, where(key))})
    return settings.checked(one, lambda key: where(key if key in data else tinted or "kind"))


def _own(one, written):
    """Return {key: value} of those keys of a Light that say something; written shortens paths."""
    fresh = Light(one.kind, {})
    own = {key: getattr(one, key) for key in (*LIGHT_TEXTS, *LIGHT)}
    own["image"] = one.image and written(one.image)
    return {key: value for key, value in own.items() if value != getattr(fresh, key)}


def _panel(file, index, data, scene):
    where = partial(file.at, section="panel", index=index)
    _check_keys(data, ["caption", "scene", "set"], where)
    other = _names(data, {"scene": ""}, where)["scene"]
    if other and other not in shipped():
        confine(other, "scene", file.folder, file.content, where("scene"))
        other = os.path.join(file.folder, other)
    values, _ = settings_of(data.get("set", {}), scene, file.folder, file.content, where("set"))
    caption = _words(data.get("caption", {}), "caption", where("caption"))
    return Panel(caption, values, other)


def settings_of(given, scene, folder, content, where):
    """Return (checked (key, value) pairs, the scene with them) of a table `set` from a file.

    given    {key: value} as TOML has it
    folder   of the file: relative paths begin there, and no other files are opened but those whose
             digests `content` knows

    Raises Mistake, its line beginning with `where`.
    """
    if not isinstance(given, dict):
        raise Mistake(f"{where}set = {given!r}; write set = {{ key = value, … }}")
    values = []
    for key, value in settings.models_first(given.items()):
        kind = key.rpartition(".")[2]
        name, *rest = settings.light_parts(str(value)) if kind == "light" else [str(value)]
        named = [(name, kind)] if kind in ("mesh", "model", "light", "image") else []
        named += [(part[6:], "image") for part in rest if part.startswith("image=")]
        for path, what in named:
            confine(path, what, folder, content, where)
        value = tuple(value) if isinstance(value, list) else value
        value = settings.canonical(key, value, where, folder)
        scene = settings.changed(scene, key, value, where)
        values.append((key, value))
    return tuple(values), scene


def _names(data, defaults, where):
    """Return the texts among `data`; defaults maps their keys to what they are when left out."""
    for key in defaults:
        if not isinstance(data.get(key, ""), str):
            raise Mistake(f'{where(key)}{key} = {data[key]!r}; write text in quotes: "…"')
    return {key: data.get(key, fallback) for key, fallback in defaults.items()}
