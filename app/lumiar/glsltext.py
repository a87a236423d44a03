"""GLSL text taken apart: comments, include lines, top-level declarations and what they use."""

import re
from typing import NamedTuple

from .errors import Mistake

_WORD = re.compile(r"[A-Za-z_]\w*")
_BRACKET = re.compile(r"[][(){}]")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_ALWAYS = {"layout", "in", "out", "flat", "smooth", "noperspective", "centroid", "precision"}


class Chunk(NamedTuple):
    """One or more declarations on whole lines, first to last by index from 0.

    names are what they declare, words every identifier in them; kept says that they stay whether
    used or not.
    """

    first: int
    last: int
    names: set
    words: set
    kept: bool


def without_comments(text):
    """Return GLSL text without its comments, all lines in place."""
    return _COMMENT.sub(lambda found: "\n" * found.group().count("\n"), text)


def check_comments(text, path):
    """Raise Mistake for a comment that is never closed, or that swallows the line below it."""
    for found in _COMMENT.finditer(text):
        comment = found.group()
        if comment.startswith("/*") and not (comment.endswith("*/") and len(comment) > 3):
            why = "this comment is never closed by */"
        elif comment.startswith("//") and comment.endswith("\\"):
            why = "a comment that ends in \\ swallows the line below; end it otherwise"
        else:
            continue
        raise Mistake(f"{path}:{text.count(chr(10), 0, found.start()) + 1}: {why}")


def check_letters(code, path):
    """Raise Mistake for what comment-free GLSL cannot have: drivers then name another place."""
    if found := re.search(r"[^\0-\x7f]", code):
        letter, line = found.group(), code.count("\n", 0, found.start()) + 1
        why = "accents and other signs are for comments alone; write it with plain letters"
        raise Mistake(f"{path}:{line}: '{letter}' (U+{ord(letter):04X}): {why}")


def included(line):
    """Return the name in an include line, "" if it is written wrongly, None for any other line."""
    if "#" not in line:
        return None
    before, _, rest = line.partition("#")
    word, _, name = rest.lstrip().partition("include")
    if before.strip() or word or name[:1] not in ("", " ", "\t", '"', "<"):
        return None
    name = name.strip()
    return name[1:-1] if len(name) > 1 and name[0] == name[-1] == '"' else ""


def chunks(text):
    """Return the Chunks of comment-free GLSL; declarations that share a line make one."""
    found, lines = [], text.split("\n")
    first, depth, continued = 0, 0, False
    for i, line in enumerate(lines):
        bare = line.strip()
        directive = continued or bare[:1] == "#"
        continued = directive and bare[-1:] == "\\"
        if not directive:
            for bracket in _BRACKET.findall(bare):
                depth += 1 if bracket in "({[" else -1
        fresh = first == i or not "".join(lines[first:i]).strip()
        complete = directive or (not bare and fresh) or bare[-1:] in (";", "}")
        if (depth == 0 and complete and not continued) or i == len(lines) - 1:
            code = "\n".join(lines[first : i + 1]) if i > first else bare
            words = set(_WORD.findall(code)) if code else set()
            names, kept = _declared(code, words) if code else (words, False)
            found.append(Chunk(first, i, names, words, kept))
            first = i + 1
    return found


def _declared(code, words):
    """Return (names that a chunk of GLSL declares, whether it stays in any case)."""
    head, brace, body = code.partition("{")
    start = _WORD.findall(head.partition("(")[0])
    if "#" in code or not _ALWAYS.isdisjoint(start):
        return set(), True
    if "struct" in start:  # its name, and those of the variables right behind it
        names = re.findall(r"\bstruct\s+(\w+)", code)
        variables, _, more = code.rpartition("}")[2].partition(";")
        return {*names, *_variables(variables + ";")}, bool(more.strip()) or code.count("{") > 1
    if brace:
        return set(start[-1:]), _holds_several(body)
    return set(_variables(head)), False


def _variables(code):
    """Return the names that a list of declarators, up to its `;`, declares."""
    while "(" in code and code != (code := re.sub(r"\([^()]*\)", "", code)):
        pass  # what is in brackets declares nothing
    bare = re.sub(r"=[^,;]*", "=", code)
    return re.findall(r"(\w+)\s*(?:\[[^\]]*\]\s*)?(?==|,|;)", bare)


def _holds_several(body):
    """Return whether a function body, from behind its first brace, ends before the text does."""
    depth = 1
    for found in re.finditer(r"[{}]", body):
        depth += 1 if found.group() == "{" else -1
        if depth == 0:
            return bool(body[found.end() :].strip(" ;\n"))
    return False


def unreachable(every):
    """Return the Chunks that main(), and what stays in any case, have no use for."""
    declaring = {}
    for chunk in every:
        for name in chunk.names:
            declaring.setdefault(name, []).append(chunk)
    wanted = [chunk for chunk in every if chunk.kept or "main" in chunk.names]
    reached = set()
    while wanted:
        chunk = wanted.pop()
        if chunk.first not in reached:
            reached.add(chunk.first)
            wanted.extend(other for word in chunk.words for other in declaring.get(word, ()))
    return [chunk for chunk in every if chunk.words and chunk.first not in reached]
