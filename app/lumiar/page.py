"""A report of `lumiar bench` as one page of HTML that needs nothing else, in both languages.

A report is what `ledger` describes. All that is said on the page as a whole is in its frame,
assets/bench/page.html, with its looks.
"""

import os
from html import escape

from . import chart, files, plates, study
from .bilingual import TEXT, name_of, said, word
from .figures import alone, figure, series
from .notation import number

FRAME = os.path.join(files.ASSETS, "bench", "page.html")
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
        f'<li><a href="#{escape(one["name"])}">{said(one["title"])}</a>{_gist(one)}</li>'
        for one in report["studies"]
    )
    frame = frame.replace("{{facts}}", _facts(report["made"])).replace("{{contents}}", contents)
    studies = [_study(one, pictures) for one in report["studies"]]
    return frame.replace("{{studies}}", "\n".join((chart.shapes(), *studies)))


def _gist(one):
    """Return what a study says before all: its own remarks, or else its first advice."""
    if one["remarks"]:
        return "".join(said(texts, "p") for texts in one["remarks"])
    for given in one["advice"]:
        for texts in _sentences(given)[:1]:
            case = name_of(one, given["case"])
            return said({lang: f"{case[lang]}: {texts[lang]}" for lang in TEXT}, "p")
    return ""


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
        "cpu": said(cores),
        "system": escape(f"{made['system']}, Python {made['python']}"),
        "clock": said(clock),
        "version": escape(f"Lumiar {made['lumiar']} {made['commit']}".strip()),
        "date": escape(made["date"][:16].replace("T", " ") + " UTC"),
    }
    told = "".join(f"<dt>{said(word(key))}</dt><dd>{text}</dd>" for key, text in rows.items())
    return told + (f"<dt></dt><dd>{said(word('quick'), 'b')}</dd>" if made["quick"] else "")


def _study(one, pictures):
    """Return one study: what it found, then each case with a plot per metric."""
    found = [study.from_row(row) for row in one["points"]]
    styles = {}
    for point in found:
        styles.setdefault(series(point.variant)[0], len(styles))
    cases, plots, lone, told = {}, [], [], ()
    for (case, _), group in study.grouped(found).items():
        cases[case] = _pictures(one, case, pictures)
        if len(group) == 1:
            lone += group
            continue
        advised = _advised(one, group[0])
        words = [case, *(sorted(texts["en"].split(" ")) for texts in advised)]
        plots.append(figure(one, group, styles, advised if words != told else ()))
        told = words  # advice that was just given is not given once more
    plots += [alone(one, lone, styles)] if lone else []
    parts = [f'<section id="{escape(one["name"])}"><h2>{said(one["title"])}</h2>']
    parts += [said(texts, "p", "remark") for texts in one["remarks"]]
    parts.append(f'<div class="plots">{"".join(plots)}</div>')
    return "".join((*parts, *cases.values())) + "</section>"


def _advised(one, point):
    """Return the sentences {language: text} about the case and metric of a point."""
    for given in one["advice"]:
        if (given["case"], given["metric"]) == (point.case, point.metric):
            return _sentences(given)
    return []


def _sentences(given):
    """Return the sentences {language: text} of one advice."""
    rows = zip(*(given[lang] for lang in TEXT), strict=True)
    return [dict(zip(TEXT, texts, strict=True)) for texts in rows]


def _pictures(one, case, pictures):
    """Return the pictures of a case, each beside the map of its error, and the scale of these."""
    found, ruler = [], None
    for row in one["pictures"]:
        plate, error = pictures.get(row["file"]), pictures.get(row.get("error_file"))
        if row["case"] != case or plate is None:
            continue
        ruler = ruler or (error and error.ruler)
        names = name_of(one, row["variant"])
        images = "".join(
            f'<img src="{each.address}" width="{each.size[0]}" height="{each.size[1]}"'
            f' alt="{escape(names["en"])}">'
            for each in (plate, error)
            if each
        )
        strip = " strip" if plate.size[0] > 2 * plate.size[1] else ""
        caption = f"<figcaption>{said(names)}</figcaption>"
        found.append(f'<figure><div class="pair{strip}">{images}</div>{caption}</figure>')
    if not found:
        return ""
    bar = ""
    if ruler:
        kind = "log scale" if ruler.log else "scale"
        ends = [number(end) for end in (ruler.low, ruler.high)]
        first, last = (f'<span class="n">{end}</span>' for end in ends)
        colours = f'<i style="background:linear-gradient(90deg,{",".join(plates.ramp())})"></i>'
        bar = f'<div class="scale">{said(word(kind))} {first}{colours}{last}</div>'
    head = f"<h3>{said(name_of(one, case))}</h3>"
    return f'{head}{bar}<div class="pictures">{"".join(found)}</div>'
