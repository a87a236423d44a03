"""The points of a study, error against cost, and what may be said of them whatever the noise."""

import itertools
from typing import NamedTuple

ALIKE = 1.35  # ratio of costs beyond which they are too vague for a lower error to decide
CLEAR = 1.05  # ratio of errors from which one is the lower, where the costs are alike
FLOAT = 4e-6  # relative error that float32 leaves in a good formula; what is below is alike


class Metric(NamedTuple):
    """What an error is: visible is the least that shows, and what is below floor is no error."""

    visible: float
    floor: float


SHARE = Metric(0.5 / 255.0, FLOAT)  # of a reflectance: half a step of an 8-bit display
RELATIVE = Metric(0.01, FLOAT)  # of the value: about what the eye tells apart (E. Weber, 1834)


class Point(NamedTuple):
    """One variant in one case: its error in a metric, and its cost.

    error is None where a study has no truth. cost, low and high (the interval that it lies in) and
    taken_off (the empty job's) are in unit. default: Lumiar does so unless
    told otherwise; pareto: no other point of the case is better. parameters are numbers of the case
    or the variant for plots, {name: number} or None.
    """

    study: str
    case: str
    variant: str
    metric: str
    error: float | None
    cost: float
    low: float
    high: float
    taken_off: float
    unit: str
    default: bool = False
    pareto: bool = False
    parameters: dict | None = None


class Shown(NamedTuple):
    """A picture of a variant: linear radiance (h, w, 3), and its error per pixel (h, w) or None."""

    case: str
    variant: str
    pixels: object
    error: object = None


class Remark(NamedTuple):
    """A sentence that a study derives from its own points, in English and Portuguese."""

    en: str
    pt: str


def points(case, variant, errors, timing, unit="ns", default=False, parameters=None):
    """Return a Point for each metric of errors {metric: error}, of one timing.Timing in `unit`."""
    cost = (timing.cost, timing.low, timing.high, timing.taken_off, unit)
    more = (default, False, parameters)
    return [Point("", case, variant, name, error, *cost, *more) for name, error in errors.items()]


def grouped(found):
    """Return {(case, metric): points}, in the order of the points."""
    groups = {}
    for point in found:
        groups.setdefault((point.case, point.metric), []).append(point)
    return groups


def cheaper(a, b):
    """Return whether a costs less than b beyond the noise: their intervals do not overlap."""
    return a.high < b.low


def alike(a, b):
    """Return whether a surely costs no more than b, or so little more that nobody would mind."""
    return a.high <= ALIKE * b.cost and not cheaper(b, a)


def dominates(a, b, floor):
    """Return whether a is better than b: cheaper and no less exact, or more exact and not dearer.

    Both beyond the noise, so that another run says the same; errors below floor are alike.
    """
    if a.error is None or b.error is None:
        return False
    one, other = max(a.error, floor), max(b.error, floor)
    return (cheaper(a, b) and one <= other) or (alike(a, b) and one * CLEAR < other)


def marked(found, metrics):
    """Return the points with `pareto` set; metrics {name: Metric}."""
    done = {}
    for (case, name), group in grouped(found).items():
        for point in group:
            beaten = any(dominates(other, point, metrics[name].floor) for other in group)
            best = point.error is not None and not beaten
            done[case, name, point.variant] = point._replace(pareto=best)
    return [done[p.case, p.metric, p.variant] for p in found]


def beaten(found, metrics):
    """Return {case: (default, those that beat it)} where some do, whatever the metric.

    They are better in one metric, and in the others neither less exact nor dearer.
    """
    cases, out = {}, {}
    for point in found:
        cases.setdefault(point.case, {}).setdefault(point.variant, {})[point.metric] = point
    for case, variants in cases.items():
        for name, own in variants.items():
            if not next(iter(own.values())).default:
                continue
            by = [other for other, its in variants.items() if _better(its, own, metrics)]
            if by:
                out[case] = name, by
    return out


def _better(its, own, metrics):
    pairs = [(its[m], point, metrics[m].floor) for m, point in own.items() if m in its]
    no_worse = all(
        a.error is not None
        and b.error is not None
        and max(a.error, floor) <= CLEAR * max(b.error, floor)
        and not cheaper(b, a)
        for a, b, floor in pairs
    )
    return no_worse and any(dominates(*pair) for pair in pairs)


def in_order(found):
    """Return True if points are in order of their cost, False if one is out of it, or None.

    None: some that follow each other cannot be told apart.
    """
    if any(cheaper(b, a) for i, a in enumerate(found) for b in found[i + 1 :]):
        return False
    pairs = itertools.pairwise(found)
    return True if all(cheaper(a, b) for a, b in pairs) else None


def as_row(point):
    """Return a Point as the dictionary that a report holds."""
    row = point._asdict()
    low, high = row.pop("low"), row.pop("high")
    return {**row, "spread": [low, high]}


def from_row(row):
    """Return the Point of a dictionary that a report holds."""
    row = dict(row)
    low, high = row.pop("spread")
    return Point(**{**row, "low": low, "high": high})
