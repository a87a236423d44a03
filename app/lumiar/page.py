"""A report of `lumiar bench` as one page of HTML that needs nothing else, in both languages.

A report is what `ledger` describes. All that is said on the page as a whole is in its frame,
assets/bench/page.html, with its looks.
"""

import os
import re
from html import escape

from . import chart, files, plates, study
from .chart import Mark

FRAME = os.path.join(files.ASSETS, "bench", "page.html")
TEXT = {
    "en": {
        "renderer": "drawn by",
        "cpu": "processor",
        "cores": "cores",
        "system": "system",
        "clock": "clock",
        "version": "program",
        "date": "date",
        "quick": "a quick run: coarser, with fewer variants",
        "error": "error",
        "cost": "cost",
        "interval": "interval",
        "ns": "ns per evaluation",
        "ms": "ms per frame",
        "values": "Values",
        "front": "front",
        "default": "Lumiar's choice",
        "off": "Taken off every cost: {:.3g} {}.",
        "visible": "seen above",
        "floor": "as good as exact",
        "pictures": "Pictures, and where they err",
        "scale": "error",
        "log scale": "error, log scale",
    },
    "pt": {
        "renderer": "desenhado por",
        "cpu": "processador",
        "cores": "núcleos",
        "system": "sistema",
        "clock": "relógio",
        "version": "programa",
        "date": "data",
        "quick": "execução rápida: mais grossa, com menos variantes",
        "error": "erro",
        "cost": "custo",
        "interval": "intervalo",
        "ns": "ns por avaliação",
        "ms": "ms por quadro",
        "values": "Valores",
        "front": "fronteira",
        "default": "escolha do Lumiar",
        "off": "Descontado de cada custo: {:.3g} {}.",
        "visible": "vê-se acima",
        "floor": "como exato",
        "pictures": "Imagens, e onde erram",
        "scale": "erro",
        "log scale": "erro, escala log",
    },
}
CLOCKS = (  # what timing.believed says, and the same in Portuguese
    ("processor time, spread over", "tempo de processador, repartido por"),
    (" cores", " núcleos"),
    ("timer queries, within", "relógio da placa, a menos de"),
    ("of the wall clock", "do relógio comum"),
    ("wall clock: timer queries are", "relógio comum: o da placa difere dele em"),
    (" off it", ""),
)


def html(report, pictures):
    """Return the text of the page of a report.

    pictures is {file named in the report: `plates.Plate`}; one that is missing is left out.
    """
    frame = files.read_text(FRAME, 1 << 20, "the frame of the page")
    contents = "".join(
        f'<li><a href="#{escape(one["name"])}">{_said(one["title"])}</a>{_gist(one)}</li>'
        for one in report["studies"]
    )
    frame = frame.replace("{{facts}}", _facts(report["made"])).replace("{{contents}}", contents)
    return frame.replace(
        "{{studies}}", "\n".join(_study(one, pictures) for one in report["studies"])
    )


def _gist(one):
    """Return what a study says before all: its own remarks, or else its first advice."""
    if one["remarks"]:
        return "".join(_said(said, "p") for said in one["remarks"])
    for said in one["advice"]:
        for texts in _sentences(said)[:1]:
            case = _name(one, said["case"])
            return _said({lang: f"{case[lang]}: {texts[lang]}" for lang in TEXT}, "p")
    return ""


def _said(texts, tag="span", looks=""):
    """Return texts {language: text}, one element each, escaped."""
    looks = f' class="{looks}"' if looks else ""
    if tag == "span" and not looks and texts["en"] == texts["pt"]:
        return escape(texts["en"])
    return "".join(
        f'<{tag} lang="{lang}"{looks}>{escape(text)}</{tag}>' for lang, text in texts.items()
    )


def _word(key, *values):
    """Return one of TEXT in each language, values filled in."""
    found = {lang: words.get(key, key).format(*values) for lang, words in TEXT.items()}
    return {**found, "pt": _comma(found["pt"])} if values else found


def _comma(text):
    """Return a Portuguese text with a comma in its numbers instead of a point."""
    return re.sub(r"(?<=\d)\.(?=\d)", ",", text)


def _facts(made):
    """Return what a report says of how it was made, as rows of a list of facts."""
    clock = dict.fromkeys(TEXT, made["clock"])
    for english, portuguese in CLOCKS:
        clock["pt"] = clock["pt"].replace(english, portuguese)
    cores = {
        lang: f"{made['cpu']}, {made['cores']} {words['cores']}" for lang, words in TEXT.items()
    }
    rows = {
        "renderer": escape(made["renderer"]),
        "cpu": _said(cores),
        "system": escape(f"{made['system']}, Python {made['python']}"),
        "clock": _said(clock),
        "version": escape(f"Lumiar {made['lumiar']} {made['commit']}".strip()),
        "date": escape(made["date"][:16].replace("T", " ") + " UTC"),
    }
    told = "".join(f"<dt>{_said(_word(key))}</dt><dd>{text}</dd>" for key, text in rows.items())
    return told + (f"<dt></dt><dd>{_said(_word('quick'), 'b')}</dd>" if made["quick"] else "")


def _study(one, pictures):
    """Return one study: what it found, then each case with a plot per metric."""
    found = [study.from_row(row) for row in one["points"]]
    styles = {}
    for point in found:
        styles.setdefault(_series(point.variant)[0], len(styles))
    cases, plots, told = {}, [], ()
    for (case, _), group in study.grouped(found).items():
        advised = _advised(one, group[0])
        words = [case, *(sorted(said["en"].split(" ")) for said in advised)]
        plots.append(_figure(one, group, styles, advised if words != told else ()))
        cases[case], told = _pictures(one, case, pictures), words
    parts = [f'<section id="{escape(one["name"])}"><h2>{_said(one["title"])}</h2>']
    parts += [_said(said, "p", "remark") for said in one["remarks"]]
    parts.append(f'<div class="plots">{"".join(plots)}</div>')
    return "".join((*parts, *cases.values())) + "</section>"


def _name(one, key):
    """Return what a case, variant or metric of a study is called in each language."""
    return one["words"].get(key) or dict.fromkeys(TEXT, key)


def _advised(one, point):
    """Return the sentences {language: text} about the case and metric of a point."""
    for said in one["advice"]:
        if (said["case"], said["metric"]) == (point.case, point.metric):
            return _sentences(said)
    return []


def _sentences(said):
    """Return the sentences {language: text} of one advice."""
    rows = zip(*(said[lang] for lang in TEXT), strict=True)
    return [dict(zip(TEXT, texts, strict=True)) for texts in rows]


def _series(variant):
    """Return (a variant's name without its first whole number, that number or None)."""
    words = variant.split(" ")
    number = next((word for word in words if word.isdigit()), None)
    return " ".join(word for word in words if word is not number), number


def _lines(group):
    """Return {series: its points, in the order of their numbers}, of those that have several."""
    lines = {}
    for point in group:
        name, number = _series(point.variant)
        if number:
            lines.setdefault(name, []).append(point)
    return {
        name: sorted(points, key=lambda p: int(_series(p.variant)[1]))
        for name, points in lines.items()
        if len(points) > 1
    }


def _figure(one, group, styles, advised):
    """Return the plot of the points of one case and metric, with what they advise, and values."""
    lines = _lines(group)
    drawn = [p for p in group if p.error is not None] or group
    priced = drawn[0].error is not None
    scaled = "" if priced else _varied(group)
    marks = {}
    for point in drawn if priced or scaled else ():
        names, (series, number) = _name(one, point.variant), _series(point.variant)
        short = dict.fromkeys(TEXT, number if priced else "") if series in lines else names
        x, y = (point.cost, point.error) if priced else (point.parameters[scaled], point.cost)
        tips = {lang: _tip(point, names[lang], lang) for lang in TEXT}
        interval, style = (point.low, point.high), styles[series]
        marks[point.variant] = Mark(x, y, interval, style, short, tips, point.pareto, point.default)
    head = [f"<b>{_said(_name(one, group[0].case))}</b>"]
    head.append(f'<p class="metric">{_said(_name(one, group[0].metric))}</p>')
    head += [_said(said, "p") for said in advised]
    parts = [f"<figure><figcaption>{''.join(head)}</figcaption>"]
    if marks:
        titles = (_word(group[0].unit), _word("error"))
        if not priced:
            named = scaled if scaled in one["words"] else group[0].case
            titles = (_name(one, named), titles[0])
        metric = one["metrics"][group[0].metric]
        levels = [(metric[key], _word(key), key == "floor") for key in ("visible", "floor")]
        joined = [[marks[p.variant] for p in line if p.variant in marks] for line in lines.values()]
        along, levels = ("x", levels) if priced else ("y", ())
        parts.append(chart.svg([*marks.values()], titles, along, levels, joined))
        parts.append(_keys(one, group, lines, styles))
    return "".join(parts) + _values(one, group, styles) + "</figure>"


def _varied(group):
    """Return the parameter that differs most often between points, "" where none does."""
    seen = {}
    for point in group:
        for name, value in point.parameters.items():
            seen.setdefault(name, set()).add(value)
    shared = [n for n in seen if all(p.parameters.get(n, 0.0) > 0.0 for p in group)]
    name = max(shared, key=lambda n: len(seen[n]), default="")
    return name if name and len(seen[name]) > 1 else ""


def _number(value):
    """Return a number as it is written in tables."""
    if value is None:
        return "–"
    return chart.power(value) if value > 0.0 else f"{value:.3g}"


def _tip(point, name, lang):
    """Return what pointing at a mark tells."""
    cost = f"{_number(point.cost)} {point.unit} ({_number(point.low)} … {_number(point.high)})"
    error = "" if point.error is None else f"{TEXT[lang]['error']} {_number(point.error)}\n"
    told = f"{error}{TEXT[lang]['cost']} {cost}"
    return f"{name}\n{_comma(told) if lang == 'pt' else told}"


def _keys(one, group, lines, styles):
    """Return the marks with their names, a series once."""
    rows, done = [], set()
    for point in group:
        series = _series(point.variant)[0]
        if series in done:
            continue
        names = _name(one, point.variant)
        if series in lines:
            done.add(series)
            last = _name(one, lines[series][-1].variant)
            names = {lang: _alike(names[lang], last[lang]) for lang in TEXT}
        rows.append(f"<li>{_key(styles[series])}{_said(names)}</li>")
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
        told = [_said(_name(one, point.variant))]
        told += [f"({_said(_word('default'))})"] if point.default else []
        name = _key(styles[_series(point.variant)[0]], point.pareto) + " ".join(told)
        numbers = [_number(point.error), f"{_number(point.cost)} {point.unit}"]
        numbers.append(f"{_number(point.low)} … {_number(point.high)}")
        cells = "".join(f'<td class="n">{text}</td>' for text in numbers)
        best = ' class="best"' if point.pareto else ""
        rows.append(f'<tr{best}><th scope="row">{name}</th>{cells}</tr>')
    heads = "".join(f"<th>{_said(_word(key))}</th>" for key in ("error", "cost", "interval"))
    off = group[0].taken_off
    off = f"<p>{_said(_word('off', off, group[0].unit))}</p>" if off else ""
    return (
        f'<details><summary>{_said(_word("values"))}</summary><div class="wide"><table><thead><tr>'
        f"<th></th>{heads}</tr></thead><tbody>{''.join(rows)}</tbody></table></div>{off}</details>"
    )


def _pictures(one, case, pictures):
    """Return the pictures of a case, each beside the map of its error, and the scale of these."""
    found, ruler = [], None
    for row in one["pictures"]:
        plate, error = pictures.get(row["file"]), pictures.get(row.get("error_file"))
        if row["case"] != case or plate is None:
            continue
        ruler = ruler or (error and error.ruler)
        names = _name(one, row["variant"])
        images = "".join(
            f'<img src="{each.address}" width="{each.size[0]}" height="{each.size[1]}"'
            f' alt="{escape(names["en"])}">'
            for each in (plate, error)
            if each
        )
        strip = " strip" if plate.size[0] > 2 * plate.size[1] else ""
        caption = f"<figcaption>{_said(names)}</figcaption>"
        found.append(f'<figure><div class="pair{strip}">{images}</div>{caption}</figure>')
    if not found:
        return ""
    bar = ""
    if ruler:
        kind = "log scale" if ruler.log else "scale"
        ends = [chart.power(end) if end else "0" for end in (ruler.low, ruler.high)]
        first, last = (f'<span class="n">{end}</span>' for end in ends)
        colours = f'<i style="background:linear-gradient(90deg,{",".join(plates.ramp())})"></i>'
        bar = f'<div class="scale">{_said(_word(kind))} {first}{colours}{last}</div>'
    head = f"<h3>{_said(_name(one, case))}</h3>"
    return f'{head}{bar}<div class="pictures">{"".join(found)}</div>'
