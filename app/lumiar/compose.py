"""Model, lights and rate → the GLSL source of each stage, with only what the scene needs."""

import os
import re

from .catalog import read
from .files import GLSL
from .flatten import finish, flatten, load, loops, marked
from .glsltext import chunks, included, without_comments

STAGES = {
    "flat": {"vertex": "flat.vert", "geometry": "flat.geom", "fragment": "flat.frag"},
    "gouraud": {"vertex": "gouraud.vert", "fragment": "gouraud.frag"},
    "phong": {"vertex": "phong.vert", "fragment": "phong.frag"},
}
SHOWS = ("radiance", "normal", "position", "eye", "toward", "object")  # what a surface can show

_MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.MULTILINE)


def surface(
    model, lights, rate, constants, two_sided=True, transformed=True, shadows=(), shows="radiance"
):
    """Return the sources {stage: Source} that draw an object of one model under all lights.

    model and lights are catalog Shaders, a light as often as the scene has it; rate is flat,
    gouraud or phong. constants maps the choices and toggles (those of light i as `name_i`, from 1)
    to the value compiled in. What none of these needs is not in the text. two_sided lights the back
    of faces too; transformed moves the object from where its mesh lies. shadows holds the numbers
    of the lights that cast them, from 1. shows is one of SHOWS: instead of radiance the normal or
    the position in the world, the direction to the eye or to the first light in the local frame, or
    the number of the object. Raises Mistake naming file:line.
    """
    words = ("light", "rig_aimed", "rig_lit", "environment", "ambience", "arriving", "toward")
    kinds = {word: [] for word in words}
    lit = []  # the rig's text for lights with an extent or with shadows
    for i, light in enumerate(lights, 1):
        if "environment" in light.defines:
            kinds["environment"].append(f"environment_{i}")
            if not light.sampled:
                ambience = "ambience" if "ambience" in light.defines else "environment"
                kinds["ambience"].append(f"{ambience}_{i}")
        elif "arriving" in light.defines:
            kinds["arriving"].append(f"arriving_{i}")
        if "light" not in light.defines:
            continue
        if shows == "toward" and not kinds["toward"]:  # the first light only
            kinds["toward"].append(f"light_{i}")
        if light.sampled or i in shadows:
            word = "rig_lit" if light.sampled else "rig_aimed"
            kinds[word].append(f"{word}_{i}")
            lit.append(_lit(model, light, i, constants, i in shadows))
        else:
            kinds["light"].append(f"light_{i}")
    facts = {
        "two_sided": two_sided,
        "transformed": transformed,
        "tangent": "tangent" in model.needs,
        "opaque": not model.transmits,
        "surround": bool(kinds["environment"] or kinds["arriving"]) and "surround" in model.defines,
        "arriving": bool(kinds["arriving"]),
        "emitted": "emitted" in model.defines,
        "sampled": any(light.sampled for light in lights),
        "shadowed": bool(shadows),
        "aimed": bool(kinds["rig_aimed"]),
        **{word: word == shows for word in SHOWS},
    }
    frame = f"lib/frame_{'tangent' if facts['tangent'] else 'normal'}.glsl"
    places = {
        "MODEL": [(model.path, "models", _fixed(model, constants))],
        "LIGHTS": [
            (light.path, "lights", _renamed(light, i, constants))
            for i, light in enumerate(lights, 1)
        ],
        "LIT": lit,
        "FRAME": [load(frame)],
    }
    apart = _clashes(model, lights)
    return {
        stage: _watched(f"rigs/{file}", places, kinds, facts, *apart)
        for stage, file in STAGES[rate].items()
    }


def backdrop(light, number, constants):
    """Return the sources {stage: Source} that draw light `number` itself, as the eye sees it."""
    around = "environment" in light.defines
    words = ("environment",) if around else ("arriving", "reach")
    kinds = {"environment": [], "arriving": [], "reach": []}
    kinds |= {word: [f"{word}_{number}"] for word in words if word in light.defines}
    places = {"LIGHTS": [(light.path, "lights", _renamed(light, number, constants))]}
    facts = {"shape": not around, "far": not around and not kinds["reach"]}
    return {
        "vertex": finish(flatten("rigs/backdrop.vert", {}, {}, {})),
        "fragment": finish(flatten("rigs/backdrop.frag", places, kinds, facts)),
    }


def _lit(model, light, number, constants, shadowed):
    """Return (path, folder, text) of the rig's part for one light, its names numbered."""
    values = {**model.defaults(), **constants}
    exact = "irradiance" in light.defines and model.covers("constant", values)
    both = {"sample_scatter", "scatter_pdf"} <= model.defines
    facts = {
        "extended": light.sampled,
        "exact": exact and light.sampled,
        "summed": light.sampled and (shadowed or not exact),
        "balanced": both and not exact and {"density", "arriving"} <= light.defines,
        "hidden": shadowed,
        "near": "reach" in light.defines,
    }
    path, folder, text = load("rigs/lit.glsl")
    lines = (next(iter(marked(line, {}, facts)), "") for line in text.split("\n"))
    text = "\n".join(lines).replace("RIG_NUMBER", str(number))
    names = _declared(_fixed(light, constants, f"_{number}")) | _declared(text)
    return path, folder, _suffixed(text, names, number)


def measured(model, constants, what, strict=False):
    """Return the sources {stage: Source} that evaluate a model, a pair of directions per pixel.

    what is "scatter", "surround" (in a white furnace), "timed" (scatter again and again), "density"
    (scatter_pdf), "facet" (F_facet at N.V), "sampled" or "weighed" (the direction or the weight
    that sample_scatter makes of V and of u, in place of L). strict lets no NaN get lost in max, min
    or clamp.
    """
    places = {"MODEL": [(model.path, "models", _fixed(model, constants))]}
    words = ("scatter", "surround", "timed", "density", "facet", "weighed")
    facts = {word: word == what for word in words}
    facts |= {"strict": strict, "sampled": what in ("sampled", "weighed")}
    return {
        "vertex": finish(flatten("rigs/screen.vert", {}, {}, {})),
        "fragment": _watched("rigs/measure.frag", places, {}, facts),
    }


def estimated(model, light, constants, drawn, points):
    """Return the sources {stage: Source} that estimate what pieces of a surface reflect of a light.

    constants as `surface` takes them, the light being number 1. drawn says how directions are:
    "exact" (none, the light's `irradiance`), "light", "even" over the hemisphere, "cosine", "model"
    (its sample_scatter), or "both" (light and model); points of which kind, "random", "stratified"
    or "spread" (rigs/spread.glsl).
    """
    places = {
        "MODEL": [(model.path, "models", _fixed(model, constants))],
        "LIGHTS": [(light.path, "lights", _renamed(light, 1, constants))],
    }
    words = ("light", "arriving", "density", "irradiance")
    kinds = {word: [f"{word}_1"] if word in light.defines else [] for word in words}
    facts = {word: word == drawn for word in ("exact", "even", "cosine", "both")}
    facts |= {"aimed": drawn in ("light", "both"), "drawn": drawn in ("model", "both")}
    facts["met"] = drawn in ("even", "cosine", "model", "both")
    facts |= {"spread": points == "spread", "stratified": points == "stratified"}
    return {
        "vertex": finish(flatten("rigs/screen.vert", {}, {}, {})),
        "fragment": finish(flatten("rigs/estimate.frag", places, kinds, facts)),
    }


def screen(rig, constants):
    """Return the sources {stage: Source} of a rig that fills the screen, such as "present"."""
    shader = read("rig", os.path.join(GLSL, "rigs", f"{rig}.frag"))
    places = {"RIG": [(shader.path, "rigs", _fixed(shader, constants))]}
    return {
        "vertex": finish(flatten("rigs/screen.vert", {}, {}, {})),
        "fragment": finish(flatten("RIG", places, {}, {})),
    }


def _watched(file, places, kinds, facts, names=(), paths=()):
    """Return the Source of a rig, which looks out for loops cut short if it draws any.

    names are those that files of such paths are to call otherwise, see `_clashes`.
    """

    def source(looping):
        lines = flatten(file, places, kinds, {**facts, "looping": looping})
        if names:
            texts = _suffixed("\n".join(line for line, _, _ in lines), names, "lib").split("\n")
            pairs = zip(lines, texts, strict=True)
            lines = [(new if path in paths else old, path, n) for (old, path, n), new in pairs]
        return finish(lines, facts.get("strict", False))

    plain = source(False)
    return source(True) if loops(plain) or places.get("LIT") else plain


def _clashes(model, lights):
    """Return (names, paths): what a model declares that is in the library of the lights, too, and
    the files that are to call it otherwise: a model need not know what lights are made of."""
    own, theirs = library(model.text), {}
    for light in lights:
        theirs |= {name: one for name, one in library(light.text).items() if name not in own}
    declared = _declared(model.text) if theirs else set()
    words = re.compile(rf"\b({'|'.join(declared) or '(?!)'})\b")
    texts = [text for _, _, text in theirs.values() if words.search(text)]
    names = declared & set().union(*map(_declared, texts))
    return names, {path for path, _, _ in theirs.values()} | {light.path for light in lights}


def library(text):
    """Return {name: (path, folder, text)} of the files that GLSL includes, directly or not."""
    found, waiting = {}, [text]
    while waiting:
        for name in map(included, without_comments(waiting.pop()).split("\n")):
            plain = name and re.fullmatch(r"lib/\w+\.glsl", name)  # others are refused later
            if plain and name not in found and os.path.isfile(os.path.join(GLSL, name)):
                found[name] = load(name)
                waiting.append(found[name][2])
    return found


def _fixed(shader, constants, suffix=""):
    """Return the text of a shader with its choices and toggles turned into constants."""
    lines = shader.text.split("\n")
    for parameter in shader.parameters:
        if not parameter.constant and parameter.name + suffix not in constants:
            continue
        name, value = parameter.name, constants.get(parameter.name + suffix, parameter.default)
        comment = lines[parameter.line - 1].partition("//")[2]
        if parameter.widget == "toggle":
            code = f"const bool {name} = {'true' if value else 'false'};"
        elif parameter.widget == "choice":
            words = [f"{name}_{choice}".upper() for choice in parameter.choices]
            values = [f"{word} = {i}" for i, word in enumerate(words)]
            chosen = words[parameter.choices.index(value)]
            code = f"const int {', '.join(values)}, {name} = {chosen};"
        else:
            code = f"const {parameter.type} {name} = {value};"
        lines[parameter.line - 1] = f"{code}  //{comment}"
    return "\n".join(lines)


def _renamed(light, index, constants):
    """Return the text of light number `index`, all that it declares with `_index` appended."""
    text = _fixed(light, constants, f"_{index}")
    return _suffixed(text, _declared(text), index)


def _declared(text):
    """Return the names that GLSL declares, functions, constants and macros."""
    bare = without_comments(text)
    return {name for chunk in chunks(bare) for name in chunk.names} | set(_MACRO.findall(bare))


def _suffixed(text, declared, index):
    """Return GLSL in which the declared names have `_index` appended wherever they stand."""
    pattern = re.compile(rf"(?<![.\w])({'|'.join(sorted(declared))})\b")
    field = re.compile(pattern.pattern + r"(?!\s*[;,\[])")  # in a struct: types, not fields
    lines, in_struct = [], False
    for line in text.split("\n"):
        code, slashes, comment = line.partition("//")
        in_struct = in_struct or re.search(r"\bstruct\b", code) is not None
        if included(code) is None:
            inside, brace, outside = code.partition("}") if in_struct else ("", "", code)
            inside, outside = (
                field.sub(rf"\1_{index}", inside),
                pattern.sub(rf"\1_{index}", outside),
            )
            code = inside + brace + outside
        in_struct = in_struct and "}" not in code
        lines.append(code + slashes + comment)
    return "\n".join(lines)
