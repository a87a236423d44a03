"""TOML text as data and back, and the line on which each key stands (tomllib does not tell)."""

import re
from typing import NamedTuple

from .errors import Mistake


class Place(NamedTuple):
    """Where a key stands, as the beginning of a message; worked out only when it is shown.

    section is the name of a table or list of tables, empty for the top; index counts from 0.
    """

    text: str
    path: str
    key: str
    section: str = ""
    index: int = 0

    def __str__(self):
        header = re.compile(rf"\s*\[\[?\s*{self.section}\s*[\].]")
        wanted = re.compile(rf"\s*[\"']?{re.escape(self.key)}[\"']?\s*[=.]")
        inside, seen, line = not self.section, -1, 0
        for number, row in enumerate(self.text.split("\n"), 1):
            if row.lstrip().startswith("["):
                seen += bool(header.match(row))
                inside = bool(self.section) and bool(header.match(row)) and seen == self.index
                line = number if inside or (not self.section and self._is_header(row)) else line
            elif inside and wanted.match(row):
                line = number
                break
        shown = f"{self.section} {self.index + 1}: " if self.index or self._is_listed() else ""
        return f"{self.path}:{line or 1}: {shown}"

    def _is_header(self, row):
        return row.strip(" []\t\r") == self.key

    def _is_listed(self):
        return bool(re.search(rf"^\s*\[\[\s*{self.section or ' '}\s*\]\]", self.text, re.MULTILINE))


def parse(text, path):
    """Return the data of TOML text; raise Mistake naming path:line."""
    import tomllib

    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"at line (\d+)", str(error))
        line = found.group(1) if found else text.count("\n") + 1
        reason = re.sub(r"\s*\(at .*\)", "", str(error))
        raise Mistake(f"{path}:{line}: not TOML: {reason}") from None
    except (RecursionError, ValueError) as error:
        raise Mistake(f"{path}:1: not TOML that can be read: {error}") from None


def dumps(data):
    """Return nested data as TOML text; what is None or empty is left out.

    Values are bool, int, float, str, sequences, and tables {key: value} of them; a table at the top
    becomes a section, a list of tables a section for each. (Arrays stand on one line, and reading
    tomli-w takes longer than writing a scene with this.)
    """
    lines = [f"{_key(k)} = {_value(v)}" for k, v in data.items() if _is_plain(v) and _says(v)]
    for name, value in data.items():
        tables = [value] if isinstance(value, dict) else [] if _is_plain(value) else value
        for table in tables:
            if isinstance(value, list) or _says(table):
                header = f"[[{_key(name)}]]" if isinstance(value, list) else f"[{_key(name)}]"
                lines += ["", header]
                lines += [f"{_key(k)} = {_value(v)}" for k, v in table.items() if _says(v)]
    return "\n".join(lines).lstrip("\n") + "\n"


def _is_plain(value):
    listed = isinstance(value, list) and any(isinstance(entry, dict) for entry in value)
    return not listed and not isinstance(value, dict)


def _says(value):
    return value is not None and not (isinstance(value, (str, dict, list, tuple)) and not value)


def _value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{_key(k)} = {_value(v)}' for k, v in value.items())} }}"
    return repr(value)


def _key(name):
    plain = name.isascii() and name.replace("-", "a").replace("_", "a").isalnum()
    return name if plain else _quoted(name)


def _quoted(text):
    if text.isprintable() and '"' not in text and "\\" not in text:
        return f'"{text}"'
    inner = re.sub(r'[\x00-\x1f\x7f"\\]', lambda found: f"\\u{ord(found.group()):04x}", text)
    return f'"{inner}"'
