"""What files hold, and what there is to choose from, as text or JSON."""

import json
import os

from . import catalog, geometry, lesson, materials, scenefile, settings
from .errors import Mistake, nearest
from .scene import Scene


def describe(name, as_json=False):
    """Return the text that tells what a file, or something shipped, holds.

    A model or light, a mesh, a lesson, a scene or a picture that carries one. Raises Mistake.
    """
    ending, ours = os.path.splitext(name)[1].lower(), geometry.shipped()
    shaders = (*catalog.names("model"), *catalog.names("light"))
    if ending in geometry.FORMATS or name.split(":")[0] in (*geometry.SHAPES, *ours):
        facts = _mesh(name)
        if name in shaders:  # a sphere is a light, too
            facts["light"] = _shader(_read_shader(name))
    elif ending == ".glsl" or name in shaders:
        facts = _shader(_read_shader(name))
        if name in lesson.shipped():
            facts["lesson"] = _lesson(lesson.load(name))
    elif lesson.is_lesson(name):
        facts = _lesson(lesson.load(name))
    elif ending in (".toml", ".png") or name in scenefile.shipped():
        return _scene(name, as_json)
    else:
        every = [*catalog.names("model"), *catalog.names("light"), *geometry.SHAPES]
        every += [*ours, *scenefile.shipped(), *lesson.shipped()]
        raise Mistake(f"{name}: no file that Lumiar reads; {nearest(name, every)}")
    return json.dumps(facts, indent=2, ensure_ascii=False) if as_json else _as_text(facts)


def everything(kind=None, as_json=False, lang="en"):
    """Return the list of what is shipped: models, lights, meshes, … lessons; all for kind None."""
    found = {
        "models": [_shader(catalog.read("model", n)) for n in catalog.names("model")],
        "lights": [_shader(catalog.read("light", n)) for n in catalog.names("light")],
        "meshes": [
            {"name": n, "parameters": [_parameter(p) for p in parameters]}
            for n, parameters in geometry.SHAPES.items()
        ]
        + [{"name": n, "file": path} for n, path in geometry.shipped().items()],
        "materials": [_material(n) for n in materials.names()],
        "scenes": [_titled(n) for n in scenefile.shipped()],
        "lessons": [{"name": n, "title": lesson.load(n).title} for n in lesson.shipped()],
    }
    found = {key: value for key, value in found.items() if kind in (None, key)}
    if as_json:
        return json.dumps(found, indent=2, ensure_ascii=False)
    lines = []
    for key, entries in found.items():
        lines.append(key)
        for entry in entries:
            about = entry.get("title", "")
            about = about.get(lang) or about.get("en", "") if isinstance(about, dict) else about
            names = ", ".join(
                [*(p["name"] for p in entry.get("parameters", ())), *entry.get("also", ())]
            )
            lines.append(f"  {entry['name']:14} {about}{': ' if about and names else ''}{names}")
    return "\n".join(lines)


def _material(name):
    one = materials.read(name)
    return {"name": name, "title": one.title, "model": one.model, "values": one.values}


def _read_shader(name):
    """Return the Shader of a model, or of a light if the file defines one."""
    try:
        return catalog.read("model", name)
    except Mistake as mistake:
        try:
            return catalog.read("light", name)
        except Mistake:
            raise mistake from None


def _shader(shader):
    return {
        "name": shader.name,
        "kind": shader.kind,
        "title": shader.header.get(shader.kind, ""),
        **{key: shader.header[key] for key in ("paper", "note") if key in shader.header},
        **(
            {"claims": shader.claims, "needs": [*shader.needs]}
            if shader.kind == "model"
            else {"also": settings.own_keys(shader)}
        ),
        "parameters": [_parameter(p) for p in shader.parameters],
    }


def _parameter(p):
    facts = {"name": p.name, "type": p.type, "widget": p.widget, "default": p.default}
    if p.widget == "choice":
        facts["choices"] = p.choices
    elif p.widget in ("slider", "color"):
        facts["range"] = [p.low, p.high]
        facts["open"] = [*p.open]
        facts["log"] = p.log
    return {**facts, "unit": "degrees" if p.degrees else p.unit, "text": p.text}


def _mesh(name):
    mesh = geometry.load(name)
    return {
        "name": name,
        "kind": "mesh",
        "triangles": mesh.triangle_count,
        "vertices": mesh.places,
        "drawn_vertices": mesh.vertex_count,
        "bounds": [[*mesh.low], [*mesh.high]],
        "closed": mesh.closed,
        "repaired": [*mesh.notes],
    }


def _scene(name, as_json):
    text = Scene.load(name).toml()
    if not as_json:
        return text.rstrip("\n")
    import tomllib

    return json.dumps({"name": name, "kind": "scene", **tomllib.loads(text)}, indent=2)


def _lesson(one):
    return {
        "name": one.name,
        "kind": "lesson",
        "title": one.title,
        "steps": [
            {"title": step.title, "asks": step.ask, "sliders": [*step.sliders]}
            for step in one.steps
        ],
    }


def _titled(name):
    return {"name": name, "title": Scene.load(name).title}


def _as_text(facts):
    lines = []
    for key, value in facts.items():
        if key == "parameters":
            lines.append("parameters" if value else "parameters none")
            for p in value:
                limits = ", ".join(p.get("choices", ())) or _range(p)
                text = p["text"] + (f" ({p['unit']})" if p["unit"] else "")
                lines.append(f"  {p['name']:12} {_value(p['default']):20} {limits:20} {text}")
        elif key == "steps":
            lines.append("steps")
            for number, step in enumerate(value, 1):
                asks = step["asks"].get("en", "")
                lines.append(
                    f"  {number:<3} {step['title'].get('en', '')}{' — ' * bool(asks)}{asks}"
                )
        elif key in ("light", "lesson"):  # of the same name
            lines += ["", *_as_text(value).split("\n")]
        elif isinstance(value, dict):
            lines += [f"{f'{key} {lang}':15} {text}" for lang, text in value.items()]
        elif key == "also":
            lines += [f"also {name:10} {allowed}" for name, allowed in value.items()]
        elif key == "claims":
            said = (f"{name} ({when})" if when else name for name, when in value.items())
            lines.append(f"{'claims':15} {', '.join(said) or 'none'}")
        else:
            lines.append(f"{key.replace('_', ' '):15} {_value(value)}")
    return "\n".join(lines)


def _range(p):
    if "range" not in p:
        return p["widget"]
    low, high = (f"{bound:g}" for bound in p["range"])
    return f"{low} to {high}{' and beyond' if any(p['open']) else ''}{' log' if p['log'] else ''}"


def _value(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.7g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_value, value)) if value else "none"
    return str(value)
