"""A rig with all that it includes in place → one GLSL source, and where each line came from."""

import os
import re
from typing import NamedTuple

from .catalog import SOURCE_LIMIT
from .errors import Mistake
from .files import GLSL, read_text
from .glsltext import chunks, included, unreachable, without_comments

MAY_INCLUDE = {  # the floors of GLSL: which folders a file of a folder may include from
    "rigs": ("rigs", "models", "lights", "demos", "lib"),
    "models": ("lib",),
    "lights": ("lib",),
    "demos": ("lib",),
    "lib": ("lib",),
}
MAX_FILES, MAX_DEPTH = 256, 64
MAX_UNIFORMS, MAX_ARRAY = 1024, 4096  # beyond, a driver's compiler may crash instead of complaining

_HIDING = re.compile(r"\b(max|min|clamp)(?=\s*\()")  # what may drop a NaN
_LOOP = re.compile(r"\b(?:for|while)\b")


class Source(NamedTuple):
    """The GLSL text of one stage; lines[i] is the (file, line) that its line i + 1 came from."""

    text: str
    lines: tuple[tuple[str, int], ...]


def load(name):
    """Return (path, folder, text) of a file below glsl/."""
    path = os.path.join(GLSL, *name.split("/"))
    return path, name.split("/")[0], read_text(path, SOURCE_LIMIT, "a GLSL file")


def flatten(start, places, repeats, facts):
    """Return [(line, path, number)] of a file with all that it includes in place.

    places maps a name to the [(path, folder, text)] that stand in for it.
    """
    out, seen = [], set()

    def add(path, folder, text, chain):
        bare = without_comments(text).split("\n")
        for number, line in enumerate(text.split("\n"), 1):
            name = included(bare[number - 1])
            if name is not None:  # a name that holds `//` is whole in the raw line only
                include(name or included(line), f"{path}:{number}: ", folder, chain)
            elif folder == "rigs":
                out.extend((kept, path, number) for kept in marked(line, repeats, facts))
            else:
                out.append((line, path, number))

    def include(name, where, folder, chain):
        if not name:
            raise Mistake(f'{where}write #include "lib/….glsl", the name in double quotes')
        if folder == "rigs" and name in places:
            for path, kind, text in places[name]:
                add(path, kind, text, (*chain, path))
            return
        path = _resolve(name, where, folder)
        if path in chain:
            names = " -> ".join(os.path.basename(p) for p in (*chain, path))
            raise Mistake(f"{where}the files include each other in a circle: {names}")
        if len(chain) >= MAX_DEPTH or len(seen) >= MAX_FILES:
            limits = f"{MAX_DEPTH} files deep, {MAX_FILES} in all"
            raise Mistake(f"{where}too many files are included; allowed: {limits}")
        if path not in seen:
            seen.add(path)
            add(*load(name), (*chain, path))

    include(start, "", "rigs", ())
    return out


def _resolve(name, where, folder):
    """Return the path of an included file; refuse what leaves glsl/ or climbs its floors."""
    root = os.path.realpath(GLSL)
    path = os.path.realpath(os.path.join(root, *name.split("/")))
    plain = not os.path.isabs(name) and not re.search(r"[\\:~]|\.\.", name)
    if not plain or not path.startswith(root + os.sep):
        raise Mistake(f'{where}"{name}" leaves glsl/; include a file of it, such as lib/lobe.glsl')
    target = name.split("/")[0]
    if target not in MAY_INCLUDE[folder]:
        allowed = ", ".join(f"{f}/" for f in MAY_INCLUDE[folder])
        raise Mistake(f'{where}a file of {folder}/ may not include "{name}"; allowed: {allowed}')
    if not os.path.isfile(path):
        from .errors import nearest

        files = [f"{target}/{f}" for f in os.listdir(os.path.join(root, target))]
        raise Mistake(f'{where}no file "{name}"; {nearest(name, files)}')
    return path


def marked(line, repeats, facts):
    """Return what a line of a rig becomes: itself, nothing, or one copy for every light."""
    if "//" not in line:
        return [line]
    code, _, comment = line.rpartition("//")
    mark, _, words = comment.strip().partition(" ")
    if mark == "each" and words in repeats:
        return [re.sub(rf"\b{words}\b", name, code.rstrip()) for name in repeats[words]]
    terms = [term.split() for term in words.split(" and ")]
    if mark != "where" or not all(term and term[-1] in facts for term in terms):
        return [line]
    holds = all(facts[term[-1]] == (term[0] != "not") for term in terms)
    return [code.rstrip()] if holds else []


def finish(lines, strict=False):
    """Return the Source of flattened lines: what main() reaches, if compilers can bear it."""
    if strict:
        rigs = os.path.join(GLSL, "rigs", "")
        lines = [
            (line if path.startswith(rigs) else _HIDING.sub(r"rig_\1", line), path, number)
            for line, path, number in lines
        ]
    raw = [line for line, _, _ in lines]
    bare = without_comments("\n".join(raw)).split("\n")
    dropped = set()
    for first, last, *_ in unreachable(chunks("\n".join(bare))):
        while first and raw[first - 1].strip() and not bare[first - 1].strip():
            first -= 1  # the comment right above goes with what it explains
        dropped.update(range(first, last + 1))
    _check_limits([(*lines[i][1:], bare[i]) for i in range(len(lines)) if i not in dropped])
    out = [("#version 330 core", "", 0)]
    for i, (line, path, number) in enumerate(lines):
        if i not in dropped and (line.strip() or out[-1][0].strip()):
            # moderngl takes "#include" for a command of its own, even inside a comment
            out.append((line.replace("#include", "include"), path, number))
    text = "\n".join(line for line, _, _ in out)
    return Source(text + "\n", tuple((path, number) for _, path, number in out))


def loops(source):
    """Return whether there is a loop that is not a rig's own."""
    if not _LOOP.search(source.text):
        return False
    rigs = os.path.join(GLSL, "rigs", "")
    lines = zip(without_comments(source.text).split("\n"), source.lines, strict=False)
    return any(_LOOP.search(line) for line, (path, _) in lines if not path.startswith(rigs))


def _check_limits(lines):
    """Refuse (path, number, code) lines that are known to bring compilers down."""
    uniforms = 0
    for path, number, code in lines:
        uniforms += "uniform" in code
        if "[" in code:
            sizes = (part.partition("]")[0].strip() for part in code.split("[")[1:])
            big = next((n for n in sizes if n.isdecimal() and int(n) > MAX_ARRAY), None)
            if big:
                what = f"an array of {big}; allowed: up to {MAX_ARRAY} elements"
                raise Mistake(f"{path}:{number}: {what}")
        if uniforms > MAX_UNIFORMS:
            raise Mistake(f"{path}:{number}: more than {MAX_UNIFORMS} uniforms; use fewer")
    if sum(len(code) for _, _, code in lines) > SOURCE_LIMIT:
        raise Mistake(f"{path}:{number}: over {SOURCE_LIMIT >> 10} kB of GLSL after all includes")
