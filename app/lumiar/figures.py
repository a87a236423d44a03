"""One case and metric of a study as a figure of a page: what it says, a plot, the values."""

import re

from . import chart
from .bilingual import TEXT, name_of, said, word
from .chart import Mark
from .notation import number


def series(variant):
    """Return (a variant without its first whole number, that number as text or None)."""
    parts = variant.split(" ")
    count = next((part for part in parts if part.isdigit()), None)
    return " ".join(part for part in parts if part is not count), count


def figure(one, group, styles, advised):
    """Return a figure of the points of one case and metric of a study of a report.

    styles {series: number} says how each is drawn in all figures of the study; advised are the
    sentences {language: text} to stand above.
    """
    lines = _lines(group)
    drawn = [p for p in group if p.error is not None] or group
    priced = drawn[0].error is not None
    scaled = "" if priced else _varied(group)
    marks = {}
    for point in drawn if priced or scaled else ():
        names, (kind, count) = name_of(one, point.variant), series(point.variant)
        short = dict.fromkeys(TEXT, _spaced(count) if priced else "") if kind in lines else names
        x, y = (point.cost, point.error) if priced else (point.parameters[scaled], point.cost)
        interval, style, tip = (point.low, point.high), styles[kind], _tip(point, names)
        marks[point.variant] = Mark(x, y, interval, style, short, tip, point.pareto, point.default)
    head = [f"<b>{said(name_of(one, group[0].case))}</b>"]
    head.append(f'<p class="metric">{said(name_of(one, group[0].metric))}</p>')
    head += [said(texts, "p") for texts in advised]
    parts = [f"<figure><figcaption>{''.join(head)}</figcaption>"]
    if marks:
        titles = (word(group[0].unit), word("error"))
        if not priced:
            named = scaled if scaled in one["words"] else group[0].case
            titles = (name_of(one, named), titles[0])
        metric = one["metrics"][group[0].metric]
        levels = [(metric[key], word(key), key == "floor") for key in ("visible", "floor")]
        joined = [[marks[p.variant] for p in line if p.variant in marks] for line in lines.values()]
        along, levels = ("x", levels) if priced else ("y", ())
        plot, named = chart.svg([*marks.values()], titles, along, levels, joined)
        parts += [plot] if named else [plot, _keys(one, group, lines, styles)]
    return "".join(parts) + _values(one, group, styles) + "</figure>"


def _spaced(count):
    """Return a number's digits with a little room between thousands, from five digits on."""
    return f"{int(count):,}".replace(",", "\u202f") if count and len(count) > 4 else count


def _lines(group):
    """Return {series: its points, in the order of their numbers}, of those that have several."""
    lines = {}
    for point in group:
        name, count = series(point.variant)
        if count:
            lines.setdefault(name, []).append(point)
    return {
        name: sorted(points, key=lambda p: int(series(p.variant)[1]))
        for name, points in lines.items()
        if len(points) > 1
    }


def _varied(group):
    """Return the parameter that differs most often between points, "" where none does."""
    seen = {}
    for point in group:
        for name, value in (point.parameters or {}).items():
            seen.setdefault(name, set()).add(value)
    shared = [n for n in seen if all((p.parameters or {}).get(n, 0.0) > 0.0 for p in group)]
    name = max(shared, key=lambda n: len(seen[n]), default="")
    return name if name and len(seen[name]) > 1 else ""


def _tip(point, names):
    """Return what pointing at a mark tells, in every language."""
    cost, low, high = (number(x) for x in (point.cost, point.low, point.high))
    error = "" if point.error is None else f"{number(point.error)}; "
    said = " · ".join(dict.fromkeys(names.values()))
    return f"{said}\n{error}{cost} {point.unit} ({low} … {high})"


def _keys(one, group, lines, styles):
    """Return the marks with their names, a series once."""
    rows, done = [], set()
    for point in group:
        kind = series(point.variant)[0]
        if kind in done:
            continue
        names = name_of(one, point.variant)
        if kind in lines:
            done.add(kind)
            last = name_of(one, lines[kind][-1].variant)
            names = {lang: _alike(names[lang], last[lang]) for lang in TEXT}
        rows.append(f"<li>{_key(styles[kind])}{said(names)}</li>")
    return f'<ul class="keys">{"".join(rows)}</ul>'


def _alike(a, b):
    """Return a name without the numbers by which two of a series differ."""
    a, b = (re.split(r"(\d[\d.,]*)", text) for text in (a, b))
    if len(a) != len(b):
        return "".join(a)
    return "".join(x if x == y else "n" for x, y in zip(a, b, strict=True))


def _key(style, full=True):
    look = chart.looks(style, full)
    return f'<svg class="key {look}" viewBox="-7 -7 14 14">{chart.glyph(style)}</svg>'


def alone(one, points, styles):
    """Return a figure of points that are their case's only variant: nothing to plot, but values."""
    rows = []
    for point in points:
        names = [name_of(one, key) for key in (point.case, point.variant, point.metric)]
        names = {lang: "{}: {}, {}".format(*(each[lang] for each in names)) for lang in TEXT}
        rows.append(_row(said(names), point, styles))
    return f'<figure class="all"><b>{said(word("alone"))}</b>{_table(rows)}</figure>'


def _values(one, group, styles):
    """Return the folded table of all points of one case and metric, the cheapest first."""
    rows = []
    for point in sorted(group, key=lambda p: p.cost):
        told = [said(name_of(one, point.variant))]
        told += [f"({said(word('default'))})"] if point.default else []
        rows.append(_row(" ".join(told), point, styles))
    off, unit = group[0].taken_off, group[0].unit
    told = {lang: words["off"].format(number(off, 3, lang), unit) for lang, words in TEXT.items()}
    off = f"<p>{said(told)}</p>" if off else ""
    return f"<details><summary>{said(word('values'))}</summary>{_table(rows)}{off}</details>"


def _row(name, point, styles):
    """Return the row of a table that holds a point, under a name that is HTML already."""
    mark = _key(styles[series(point.variant)[0]], point.pareto or point.error is None)
    numbers = ["" if point.error is None else number(point.error)]
    numbers += [f"{number(point.cost)} {point.unit}"]
    numbers += [f"{number(point.low)} … {number(point.high)}"]
    cells = "".join(f"<td>{text}</td>" for text in numbers)
    best = ' class="best"' if point.pareto else ""
    return f'<tr{best}><th scope="row">{mark}{name}</th>{cells}</tr>'


def _table(rows):
    heads = "".join(f"<th>{said(word(key))}</th>" for key in ("error", "cost", "interval"))
    head = f"<thead><tr><th></th>{heads}</tr></thead>"
    return f'<div class="wide"><table>{head}<tbody>{"".join(rows)}</tbody></table></div>'
