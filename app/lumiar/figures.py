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
        short = dict.fromkeys(TEXT, count if priced else "") if kind in lines else names
        x, y = (point.cost, point.error) if priced else (point.parameters[scaled], point.cost)
        tips = {lang: _tip(point, names[lang], lang) for lang in TEXT}
        interval, style = (point.low, point.high), styles[kind]
        marks[point.variant] = Mark(x, y, interval, style, short, tips, point.pareto, point.default)
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
        parts.append(chart.svg([*marks.values()], titles, along, levels, joined))
        parts.append(_keys(one, group, lines, styles))
    return "".join(parts) + _values(one, group, styles) + "</figure>"


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
        for name, value in point.parameters.items():
            seen.setdefault(name, set()).add(value)
    shared = [n for n in seen if all(p.parameters.get(n, 0.0) > 0.0 for p in group)]
    name = max(shared, key=lambda n: len(seen[n]), default="")
    return name if name and len(seen[name]) > 1 else ""


def _tip(point, name, lang):
    """Return what pointing at a mark tells."""
    cost, low, high = (number(x, 3, lang) for x in (point.cost, point.low, point.high))
    lines = [name, f"{TEXT[lang]['cost']} {cost} {point.unit} ({low} … {high})"]
    if point.error is not None:
        lines.insert(1, f"{TEXT[lang]['error']} {number(point.error, 3, lang)}")
    return "\n".join(lines)


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
    mark = chart.glyph(style, 0.0, 0.0, full)
    return f'<svg class="key" viewBox="-7 -7 14 14" aria-hidden="true">{mark}</svg>'


def _values(one, group, styles):
    """Return the folded table of all points of one case and metric, the cheapest first."""
    rows = []
    for point in sorted(group, key=lambda p: p.cost):
        told = [said(name_of(one, point.variant))]
        told += [f"({said(word('default'))})"] if point.default else []
        name = _key(styles[series(point.variant)[0]], point.pareto) + " ".join(told)
        numbers = ["" if point.error is None else number(point.error)]
        numbers += [f"{number(point.cost)} {point.unit}"]
        numbers += [f"{number(point.low)} … {number(point.high)}"]
        cells = "".join(f'<td class="n">{text}</td>' for text in numbers)
        best = ' class="best"' if point.pareto else ""
        rows.append(f'<tr{best}><th scope="row">{name}</th>{cells}</tr>')
    heads = "".join(f"<th>{said(word(key))}</th>" for key in ("error", "cost", "interval"))
    off, unit = group[0].taken_off, group[0].unit
    told = {lang: words["off"].format(number(off, 3, lang), unit) for lang, words in TEXT.items()}
    off = f"<p>{said(told)}</p>" if off else ""
    return (
        f'<details><summary>{said(word("values"))}</summary><div class="wide"><table><thead><tr>'
        f"<th></th>{heads}</tr></thead><tbody>{''.join(rows)}</tbody></table></div>{off}</details>"
    )
