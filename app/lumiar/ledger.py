"""A report of `lumiar bench`: as JSON and CSV, as a table for people, and against an older one.

A report is {"schema": 1, "made": {date, lumiar, commit, renderer, cpu, cores, system, python,
clock, quick}, "studies": [study, …]}; a study is {"name", "title": {language: text}, "seconds",
"metrics": {name: {"visible", "floor"}}, "words": {case, variant or metric: {language: text}},
"points": [{"study", "case", "variant", "metric", "error", "cost", "taken_off", "unit", "spread":
[low, high], "default", "pareto", "parameters"}], "advice": [{"case", "metric", language: [text]}],
"remarks": [{language: text}], "pictures": [{"case", "variant", "file", "error_file"}]}.
"""

import csv
import io
import json
import statistics

from . import advice, study
from .errors import Mistake
from .files import read_bytes
from .notation import number

SCHEMA = 1
LIMIT = 1 << 26  # bytes of a report
CHANGED = 0.10  # share of a cost beyond which it has changed, where the intervals do not overlap
PARTS = {"name", "title", "metrics", "words", "points", "advice", "remarks", "pictures"}
COLUMNS = ("study", "case", "variant", "metric", "error", "cost", "low", "high", "unit")
TEXT = {
    "en": {
        "head": ("cost", "interval"),
        "default": "Lumiar's default",
        "front": "* on the front: nothing is both as exact and as cheap; intervals that overlap"
        " are not ranked",
    },
    "pt": {
        "head": ("custo", "intervalo"),
        "default": "padrão do Lumiar",
        "front": "* na fronteira: nada é tão exato e tão barato; intervalos que se sobrepõem não"
        " são ordenados",
    },
}


def read(path):
    """Return the report in a file; raise Mistake for what is none."""
    try:
        report = json.loads(read_bytes(path, LIMIT, "a report.json of `lumiar bench`"))
        reason = f"schema {report['schema']}, not {SCHEMA}"
        if report["schema"] == SCHEMA:
            for one in report["studies"]:
                [study.from_row(row) for row in one["points"]]
            if "made" in report and all({*one} >= PARTS for one in report["studies"]):
                return report
            reason = "parts of it are missing"
    except (ValueError, KeyError, TypeError, RecursionError):
        reason = "another kind of file, or an older one"
    raise Mistake(f"{path}: no report of `lumiar bench` ({reason}); name its report.json")


def as_json(report):
    """Return a report as the bytes of a .json file."""
    return (json.dumps(report, indent=1, ensure_ascii=False) + "\n").encode()


def as_csv(report):
    """Return the points of a report as the bytes of a .csv file."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow((*COLUMNS, "taken_off", "default", "pareto", "parameters"))
    for point in points(report):
        own = (getattr(point, name) for name in COLUMNS)
        numbers = " ".join(f"{name}={value:g}" for name, value in (point.parameters or {}).items())
        flags = (int(point.default), int(point.pareto))
        rows.writerow((*own, point.taken_off, *flags, numbers))
    return text.getvalue().encode()


def points(report):
    """Return the study.Points of a report."""
    return [study.from_row(row) for one in report["studies"] for row in one["points"]]


def advised(found, metrics, words):
    """Return the advice of a study's marked points; see the report's."""
    out = []
    for (case, metric), group in study.grouped(found).items():
        said = {
            lang: advice.sentences(group, metrics[metric], _names(words, lang), lang)
            for lang in TEXT
        }
        out.append({"case": case, "metric": metric, **said})
    for case, (default, by) in study.beaten(found, metrics).items():
        last = [row for row in out if row["case"] == case][-1]
        for lang in TEXT:
            last[lang].append(advice.beaten(default, by, _names(words, lang), lang))
    return out


def table(one, lang):
    """Return the lines of a study of a report for people: a table for each case."""
    names = _names(one["words"], lang)
    lines, cases = [one["title"][lang]], {}
    for row in one["points"]:
        cases.setdefault(row["case"], []).append(study.from_row(row))
    for case, found in cases.items():
        metrics = list(dict.fromkeys(point.metric for point in found))
        lines += ["", names[case], *_aligned(_rows(found, metrics, names, lang))]
        for said in (said for said in one["advice"] if said["case"] == case and said[lang]):
            what = f"{names[said['metric']]}: " * (len(metrics) > 1)
            lines.append(f"  {what}{' '.join(said[lang])}")
    return "\n".join([*lines, *(f"  {said[lang]}" for said in one["remarks"])])


def _rows(found, metrics, names, lang):
    """Yield the rows of a case's table: a variant, its error in each metric, its cost."""
    words = TEXT[lang]
    yield ("", *(names[metric] for metric in metrics), *words["head"])
    variants = {}
    for point in sorted(found, key=lambda p: p.cost):
        variants.setdefault(point.variant, {})[point.metric] = point
    for name, own in variants.items():
        point = next(iter(own.values()))
        errors = [_error(own.get(metric), lang) for metric in metrics]
        cost, low, high = (number(x, 3, lang) for x in (point.cost, point.low, point.high))
        label = names[name] + f" ({words['default']})" * point.default
        yield (label, *errors, f"{cost} {point.unit}", f"{low} … {high}")


def _error(point, lang):
    if point is None or point.error is None:
        return " "
    return number(point.error, 2, lang) + (" *" if point.pareto else "  ")


def _aligned(rows):
    """Yield the lines of rows of cells, the first column to the left."""
    rows = list(rows)
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for first, *others in rows:
        cells = (cell.rjust(w) for cell, w in zip(others, widths[1:], strict=True))
        yield f"  {first:{widths[0]}}  {'  '.join(cells)}".rstrip()


def changes(old, new):
    """Return (lines, whether something is worse): what changed between reports beyond noise.

    Errors by any digit; costs where intervals do not overlap and they differ by more than CHANGED,
    after the ratio in the middle of all, taken for the machine's speed, is taken out.
    """
    lines, worse = [], False
    before = {_key(point): point for point in points(old)}
    pairs = [(before[_key(now)], now) for now in points(new) if _key(now) in before]
    speed = _middle([now.cost / was.cost for was, now in pairs if was.cost > 0.0 < now.cost])
    if abs(speed - 1.0) > CHANGED:
        lines.append(f"costs are {speed:.2f} times the old ones on the whole: taken out below")
    for was, now in pairs:
        place = f"{now.study}, {now.case}, {now.variant}"
        if was.error != now.error:
            worse = worse or now.error is None or (was.error or 0.0) < now.error
            lines.append(f"{place}: {now.metric} error {was.error} -> {now.error}")
        was = was._replace(**{k: getattr(was, k) * speed for k in ("cost", "low", "high")})
        apart = study.cheaper(now, was) or study.cheaper(was, now)
        if apart and abs(now.cost - was.cost) > CHANGED * abs(was.cost):
            worse = worse or now.cost > was.cost
            lines.append(f"{place}: cost {was.cost:.3g} -> {now.cost:.3g} {now.unit}")
    return list(dict.fromkeys(lines)), worse


def _key(point):
    return point.study, point.case, point.variant, point.metric, point.unit


def _middle(ratios):
    """Return the median ratio; 1 where it lies between the two in the middle, or there is none."""
    if not ratios:
        return 1.0
    low, high = statistics.median_low(ratios), statistics.median_high(ratios)
    return min(max(1.0, low), high)


class _names(dict):
    """The names of cases, variants and metrics in a language; what has none is called as it is."""

    def __init__(self, words, lang):
        super().__init__({key: said[lang] for key, said in words.items()})

    def __missing__(self, key):
        return key
