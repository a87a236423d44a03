"""TOML text as data, and the line on which each of its keys stands (tomllib does not tell)."""

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
