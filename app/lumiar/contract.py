"""What a model or a light may not do, told with its line, which drivers often cannot name."""

import re

from .errors import Mistake

FORBIDDEN = {
    r"gl_\w+": "one text serves every shading rate, so nothing of OpenGL's own; leave it out",
    r"discard|dFdx|dFdy|fwidth": "works at one shading rate only; leave it out",
    r"texture(?:[A-Z1-3]\w*)?|texelFetch\w*|[iu]?sampler[1-3C]\w*": "no textures; write a formula",
    r"(?<=#)\s*(?:version|extension|line)": "the rigs say that; leave the line out",
    r"rig_\w+": "names that begin with rig_ belong to the rigs; rename it",
}
BUILT_IN = re.compile(
    r"abs|a?(?:sin|cos|tan)h?|all|any|ceil|clamp|cross|degrees|determinant|distance|dot|equal|exp2?|"
    r"faceforward|floatBitsTo\w+|floor|fract|\w+BitsToFloat|(?:greater|less)Than(?:Equal)?|"
    r"inverse(?:sqrt)?|isinf|isnan|length|log2?|matrixCompMult|max|min|mix|modf?|normalize|not|"
    r"notEqual|outerProduct|pow|radians|reflect|refract|round(?:Even)?|sign|smoothstep|sqrt|step|"
    r"transpose|trunc"
)
RIGS = {"main", "Frame", "to_local", "from_local", "tangent_frame"}
_BRACKETS = {"}": "{", ")": "(", "]": "["}
_ANY = re.compile("|".join(rf"(?P<_{i}>(?<![\w.])(?:{p})\b)" for i, p in enumerate(FORBIDDEN)))
_START = r"(?:^|[;{}])[ \t]*"  # of a declaration
_STAGE = re.compile(
    _START + r"(?:(?:flat|smooth|noperspective|centroid|layout\s*\([^()]*\))\s+)*"
    r"(?:(?:in|out)(?:\s+(?:highp|mediump|lowp))?|varying|attribute)\s+\w+\s*(?:\w+\s*[;=[,]|\{)",
    re.M,
)
_HEAD = re.compile(
    _START + r"((?:(?:highp|mediump|lowp)\s+)?\w+)\s+(\w+)\s*\(([^()]*)\)\s*\{", re.M
)
_ENDLESS = re.compile(
    r"\b(?:for\s*\(\s*[^;()]*;\s*(?:true)?\s*;[^()]*\)|while\s*\(\s*true\s*\))\s*"
)
_LEAVES = re.compile(r"\b(?:break|return)\b")


def check(code, path, wanted):
    """Return the names of the functions that comment-free GLSL defines; raise Mistake.

    wanted maps the names of the contract to how they are declared.
    """

    def refuse(at, why):
        raise Mistake(f"{path}:{code.count(chr(10), 0, at) + 1}: {why}")

    _check_brackets(code, refuse)
    if found := _ANY.search(code):
        why = tuple(FORBIDDEN.values())[int(found.lastgroup[1:])]
        refuse(found.start(), f"'{found.group().strip()}': {why}")
    for found in _STAGE.finditer(code):
        if code.count("(", 0, found.end()) == code.count(")", 0, found.end()):  # no parameter
            refuse(found.end() - 1, "a model has no inputs or outputs; it is given L and V")
    names = set()
    for found in _HEAD.finditer(code):
        result, name, parameters = found.groups()
        if BUILT_IN.fullmatch(name) or name in RIGS:
            whose = "the rigs" if name in RIGS else "GLSL"
            refuse(found.start(2), f"'{name}' is a function of {whose}; rename yours")
        if name in wanted and _types(result, parameters) != _signature(wanted[name]):
            refuse(found.start(2), f"write {wanted[name]}")
        names.add(name)
    for found in _ENDLESS.finditer(code):
        if not _LEAVES.search(_body(code, found)):
            refuse(found.start(), "a loop without an end; give it a condition or a break")
    return frozenset(names)


def _check_brackets(code, refuse):
    open_ones = []
    for found in re.finditer(r"[][(){}]", code):
        bracket = found.group()
        if bracket in _BRACKETS.values():
            open_ones.append(found)
        elif not open_ones or open_ones.pop().group() != _BRACKETS[bracket]:
            refuse(found.start(), f"'{bracket}' closes nothing; look for what is missing before it")
    if open_ones:
        refuse(open_ones[-1].start(), f"'{open_ones[-1].group()}' is never closed")


def _types(result, parameters):
    """Return the types of a function: what it returns, then what it takes."""
    words = [
        re.sub(r"\b(?:const|in|highp|mediump|lowp)\b", "", p).split() for p in parameters.split(",")
    ]
    return (result.split()[-1], *(" ".join(w[:-1]) if len(w) > 1 else "".join(w) for w in words))


def _signature(declaration):
    result, _, rest = declaration.partition(" ")
    return _types(result, rest.partition("(")[2].rstrip(")"))


def _body(code, head):
    """Return what a loop repeats: a block in braces, or up to its semicolon; of do, what is before.

    head is the match of its `for (…)` or `while (…)`.
    """
    before, start = code[: head.start()].rstrip(), head.end()
    if code[start : start + 1] == ";" and before.endswith("}"):  # do { … } while (true);
        return before[_opening(before) :]
    if code[start : start + 1] != "{":
        return code[start : code.find(";", start)]
    depth = 0
    for found in re.finditer(r"[{}]", code[start:]):
        depth += 1 if found.group() == "{" else -1
        if depth == 0:
            return code[start : start + found.end()]
    return code[start:]


def _opening(code):
    """Return where the block begins that ends a code."""
    depth = 0
    for found in reversed([*re.finditer(r"[{}]", code)]):
        depth += 1 if found.group() == "}" else -1
        if depth == 0:
            return found.start()
    return 0
