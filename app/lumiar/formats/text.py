"""Text mesh files as arrays: blocks of lines, the words in them, the numbers the words spell."""

import re
import warnings

import numpy as np

from lumiar.formats.check import mistake

SPACE = np.uint8(32)
BLOCK = 1 << 18  # large enough to hide NumPy's cost per call, small enough for the cache
LONGEST_LINE = 8 << 20

# An end of line that no backslash continues; the "\r" of "\r\n" may count: it leaves a blank line.
_LINE_END = re.compile(rb"(?<!\\)(?<!\\\r)[\r\n]")
_FLOAT = rb"[+-]?(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][+-]?\d++)?|[+-]?(?i:nan|inf|infinity)"
_NOT_A_NUMBER = {
    kind: re.compile(rb"(?<!\S)(?!(?:" + pattern + rb")(?!\S))\S+")
    for kind, pattern in ((float, _FLOAT), (int, rb"[+-]?\d++"))
}


def line(data, at):
    """Return the line, counted from 1, that byte `at` of `data` is on."""
    breaks = data.count(b"\n", 0, at) + data.count(b"\r", 0, at) - data.count(b"\r\n", 0, at)
    return breaks + 1


def fail(name, data, at, what):
    """Return the Mistake that says `what` is wrong at byte `at` of `data`, as name:line."""
    return mistake(name, what, line(data, at))


def opening(data, name):
    """Return the byte at which the text starts, and the notes: a byte-order mark is skipped.

    Raises a Mistake for a NUL byte, which no text holds (but UTF-16 does).
    """
    zero = data.find(b"\0")
    if zero >= 0:
        raise fail(name, data, zero, "a NUL byte in a text file; save it as plain UTF-8 text")
    marked = data.startswith(b"\xef\xbb\xbf")
    return (3, ["byte-order mark skipped"]) if marked else (0, [])


def blocks(data, name, start=0, comments=False, continued=False):
    """Yield (at, buffer) for whole lines of `data` from byte `start` on, 256 KiB or more at a time.

    `buffer` (uint8) begins and ends with a line feed of its own; its byte i is byte at + i of
    `data`. With `comments`, text from # to the line's end is blank; with `continued`, so is a
    backslash at a line's end together with that end. Raises a Mistake for a line of over 8 MB.
    """
    while start < len(data):
        found = _LINE_END.search(data, start + BLOCK, start + BLOCK + LONGEST_LINE)
        if not found and start + BLOCK + LONGEST_LINE < len(data):
            raise fail(name, data, start + BLOCK, "a line of over 8 MB; write shorter lines")
        stop = found.end() if found else len(data)
        buffer = np.full(stop - start + 2, 10, np.uint8)
        buffer[1:-1] = np.frombuffer(data, np.uint8, stop - start, start)
        if comments and data.find(b"#", start, stop) >= 0:
            _blank_comments(buffer)
        if continued and data.find(b"\\", start, stop) >= 0:
            _join_lines(buffer)
        yield start - 1, buffer
        start = stop


def _line_ends(buffer):
    return (buffer == ord("\n")) | (buffer == ord("\r"))


def _blank_comments(buffer):
    ends, marks = np.flatnonzero(_line_ends(buffer)), np.flatnonzero(buffer == ord("#"))
    line = np.searchsorted(ends, marks)
    first = np.diff(line, prepend=-1) != 0  # a second # in a line is part of the comment
    step = np.zeros(len(buffer), np.int8)
    step[marks[first]] = 1
    step[ends[line[first]]] = -1
    buffer[np.cumsum(step, dtype=np.int8) > 0] = SPACE


def _join_lines(buffer):
    end = np.flatnonzero((buffer[:-1] == ord("\\")) & _line_ends(buffer[1:])) + 1
    pair = (buffer[end] == ord("\r")) & (buffer[np.minimum(end + 1, len(buffer) - 1)] == ord("\n"))
    for blank in (end - 1, end, end[pair] + 1):
        buffer[blank] = SPACE
    buffer[-1] = ord("\n")  # nothing follows a backslash that ends the file


def only(buffer, keep):
    """Return `buffer` with a space for every byte that is not kept."""
    return buffer * keep | ~keep * SPACE  # np.where is ten times slower


def words(buffer):
    """Return where words start and stop in `buffer`, and the first word and word count per line.

    `buffer` begins and ends with a line feed. Lines without a word are left out.
    """
    ink = buffer > SPACE
    edges = np.flatnonzero(ink[1:] != ink[:-1]) + 1
    starts, stops = edges[0::2], edges[1::2]
    first = np.searchsorted(starts, np.flatnonzero(_line_ends(buffer)))
    count = np.diff(first)
    filled = count > 0
    return starts, stops, first[:-1][filled], count[filled]


def numbers(buffer, expected, kind, name, data, at):
    """Return the `expected` numbers that the words of `buffer` spell: float64 or int64 by `kind`.

    Raises a Mistake at the first word that is not a number; byte i of `buffer` is byte at + i of
    `data`, the file `name`.
    """
    if expected == 0:
        return np.empty(0, kind)
    text = buffer.tobytes()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)  # early NumPy 2 only warns
            values = np.fromstring(text, kind, sep=" ")
    except (ValueError, DeprecationWarning):
        values = ()
    if len(values) == expected:
        return values
    bad = _NOT_A_NUMBER[kind].search(text) or re.search(rb"\S+", text)
    advice = "a decimal point, no commas" if b"," in bad[0] else "a number"
    if kind is int:
        advice = "a whole number"
    what = f"'{bad[0][:40].decode('latin-1')}' is not a number; write {advice}"
    raise fail(name, data, at + bad.start(), what)
