"""Tables of numbers written as lines of text: read in pieces, section after section."""

from typing import NamedTuple

import numpy as np

from lumiar.formats import text


class Rows(NamedTuple):
    """Lines of numbers: all `values`, and of each line its first value, their count, its byte."""

    values: np.ndarray
    first: np.ndarray
    count: np.ndarray
    at: np.ndarray


def sections(data, name, start, counts, comments=False):
    """Yield (section, Rows) for the lines of numbers from byte `start` on, in pieces, in order.

    Section i is the next counts[i] lines that are not blank. What follows the last section is not
    read: if there is such text, the last yield is (len(counts), None). Raises a Mistake as
    name:line for a word that is not a number, and for a file that ends before the last section.
    """
    todo = list(counts)
    section = 0
    for at, buffer in text.blocks(data, name, start, comments):
        starts, _, first, count = text.words(buffer)
        wanted = sum(todo)
        if len(first) > wanted:
            buffer[starts[first[wanted]] :] = text.SPACE
            starts = starts[: first[wanted]]
        values = text.numbers(buffer, len(starts), float, name, data, at)
        done = 0
        while done < len(first):
            while section < len(todo) and todo[section] == 0:
                section += 1
            if section == len(todo):
                yield section, None
                return
            part = slice(done, min(done + todo[section], len(first)))
            todo[section] -= part.stop - part.start
            done = part.stop
            places = (starts[first[part]] + at).astype(np.int32)
            yield section, Rows(values, first[part], count[part], places)
    if any(todo):
        what = f"the file is cut off: {sum(todo)} of the {sum(counts)} promised lines are missing"
        raise text.fail(name, data, len(data), what)


def spans(starts, counts, step=1):
    """Return starts[i], starts[i] + step, ..., counts[i] of them, one i after another, as (N,)."""
    starts, counts = starts[counts > 0], counts[counts > 0]
    found = np.full(counts.sum(), step)
    if len(found):
        found[0] = starts[0]
        found[np.cumsum(counts)[:-1]] = starts[1:] - starts[:-1] - (counts[:-1] - 1) * step
    return np.cumsum(found, out=found)


def lists(rows, begin, name, data):
    """Return (counts, picked): the list that starts at value begin[i] of line i.

    It is a count and so many numbers, rows.values[picked]. Raises a Mistake if the line is short.
    """
    left = rows.first + rows.count - begin  # the count and what follows it
    counts = rows.values[np.where(left > 0, begin, 0)]
    bad = (left < 1) | ~_whole(counts) | (counts < 0) | (counts >= left)
    if bad.any():
        row = int(np.argmax(bad))
        what = f"a list of {counts[row]:g} numbers" if left[row] > 0 else "a list without its count"
        what += f", but {max(left[row] - 1, 0)} follow; write as many as the count says"
        raise text.fail(name, data, int(rows.at[row]), what)
    counts = counts.astype(np.int64)
    return counts, spans(begin + 1, counts)


def integers(rows, counts, picked, name, data):
    """Return the (N,) int32 of rows.values[picked], counts[i] of them from line i."""
    values = rows.values[picked]
    bad = ~_whole(values)
    if bad.any():
        row = int(np.searchsorted(np.cumsum(counts), np.argmax(bad), side="right"))
        what = f"index {values[bad][0]:g} is of no vertex; write whole numbers from 0"
        raise text.fail(name, data, int(rows.at[row]), what)
    return values.astype(np.int32)


def _whole(values):
    return (np.floor(values) == values) & (np.abs(values) < 2**31)
