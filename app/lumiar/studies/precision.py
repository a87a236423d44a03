"""Every model in float32: its error, what of it could be avoided, what hard cases make of it.

relative is the largest relative error on ordinary directions, avoidable what of it at the ends of
all sliders is beyond three times what the rounding of the input does, broken the share of hostile
directions whose value is NaN, infinite or negative.
"""

import numpy as np

from .. import catalog, hostile, reference
from ..study import RELATIVE, Metric, Remark, points

TITLE = {"en": "Models in float32", "pt": "Modelos em float32"}
SECONDS = (70.0, 6.0)
METRICS = {"relative": RELATIVE, "avoidable": RELATIVE, "broken": Metric(1e-9, 1e-12)}
SETTINGS = (2, 40)  # of slider ends that are tried: quick, full
MOVES = 2  # ways in which the input is moved by its rounding
PEAK = 1e-6  # share of the lobe's peak below which no relative error is counted
DARK = ("black_body", "conductor", "dielectric")  # which scatter nothing: see the study fresnel
PRINTED = {  # model: what `naive` calls it, and the choices with which it is the slide's
    "phong": ("phong", {}),
    "blinn": ("blinn", {}),
    "ward": ("ward", {"form": "slide"}),
    "cook_torrance": ("beckmann", {"fresnel": "schlick", "shadowing": "v_groove"}),
    "oren_nayar": ("oren_nayar", {}),
}
WAYS = ("lumiar", "guarded", "printed")
NAMES = tuple(name for name in catalog.names("model") if name not in DARK)
WORDS = {
    **{
        name: dict.fromkeys(("en", "pt"), catalog.read("model", name).header["model"])
        for name in NAMES
    },
    "relative": {"en": "error, default values", "pt": "erro, valores padrão"},
    "avoidable": {"en": "avoidable error, slider ends", "pt": "erro evitável, extremos"},
    "broken": {"en": "hard cases broken", "pt": "casos difíceis quebrados"},
    "lumiar": {"en": "Lumiar's model", "pt": "o modelo do Lumiar"},
    "guarded": {"en": "as printed, with guards", "pt": "como impresso, com proteções"},
    "printed": {"en": "as printed", "pt": "como impresso"},
}


def run(bench):
    """Yield the Points of every model, and of the slides' text of it where there is one."""
    jobs = {(name, way): _job(bench, name, way, {}) for name in NAMES for way in _ways(name)}
    costs = bench.costs(jobs, 1.5 if bench.quick else 40.0)
    broken = {way: [] for way in WAYS}
    for name in NAMES:
        for way, errors in _errors(bench, name).items():
            broken[way].append(errors["broken"])
            yield from points(name, way, errors, costs[name, way], default=way == "lumiar")
    yield _census(max(broken["lumiar"]), broken["printed"])


def _census(own, printed):
    """Return the Remark on the shares of hard cases that break."""
    low, high = f"{min(printed):.0%}", f"{max(printed):.0%}"
    none = {True: ("none", "nenhum"), False: (f"up to {own:.1%}", f"até {own:.1%}")}[own == 0.0]
    return Remark(
        f"Of the hard cases the models as printed break {low} to {high}, Lumiar's {none[0]}.",
        f"Dos casos difíceis, os modelos como impressos quebram de {low} a {high}, os do Lumiar"
        f" {none[1]}.",
    )


def _ways(name):
    return WAYS if name in PRINTED else WAYS[:1]


def _base(name):
    """Return a model and its default values, with the choices that make it the slide's."""
    own = catalog.read("model", name)
    return own, {**own.defaults(), **PRINTED.get(name, ("", {}))[1]}


def _job(bench, name, way, end):
    """Return the (model, values) of a model at a slider end, as Lumiar has it or as printed."""
    own, values = _base(name)
    values |= end
    if way == "lumiar":
        return own, values
    naive, law = bench.formulas("naive"), PRINTED[name][0]
    shared = {key: value for key, value in values.items() if key in naive.defaults()}
    if law == "beckmann":
        shared |= {"alpha_x": values["alpha"], "f0": values["f0"][0]}
    return naive, {**naive.defaults(), **shared, "law": law, "guarded": way == "guarded"}


def _errors(bench, name):
    """Return {way: {metric: error}} of a model at its default values and its slider ends."""
    own, base = _base(name)
    ends = hostile.corners(own, bench.instrument.active(own, base))
    count = min(len(ends), SETTINGS[not bench.quick])
    ends = [{}, *(ends[round(i)] for i in np.linspace(0, len(ends) - 1, count))]
    L, V = hostile.ordinary(own.transmits)
    w = hostile.directions(base)
    above = w if own.transmits else w[w[:, 2] > hostile.BELOW * 2]
    ordinary = bench.instrument.pairs(L, V)
    hard = bench.instrument.pairs(np.repeat(w, len(above), axis=0), np.tile(above, (len(w), 1)))
    found = {way: dict.fromkeys(METRICS, 0.0) for way in _ways(name)}
    for end in ends:
        true, inherent = _true(own, {**base, **end}, L, V)
        for way, errors in found.items():
            job = _job(bench, name, way, end)
            measured = bench.instrument.scatter(*job, ordinary, strict=True)
            error = _off(measured.astype(np.float64), true)
            if end:
                beyond = float(np.maximum(error - 3.0 * inherent, 0.0).max())
                errors["avoidable"] = max(errors["avoidable"], beyond)
            else:
                errors["relative"] = float(error.max())
            measured = bench.instrument.scatter(*job, hard, strict=True)
            errors["broken"] += _broken(measured) / len(ends)
    bench.instrument.forget(ordinary)
    bench.instrument.forget(hard)
    return found


def _true(own, values, L, V):
    """Return the float64 values and their relative change by the rounding of what is given."""
    function, given = getattr(reference, own.name), own.in_radians(values)
    true, inherent = function(L, V, **given), 0.0
    for seed in range(MOVES):
        moved = function(*hostile.moved(L, V, seed), **hostile.rounded(given, seed))
        inherent = np.maximum(inherent, _off(moved, true))
    return true, inherent


def _off(found, true):
    """Return the relative error of all values above PEAK; what is no number is wrong by all."""
    counted = true > PEAK * true.max(initial=0.0)
    error = np.where(counted, np.abs(found - true) / np.where(counted, true, 1.0), 0.0)
    return np.nan_to_num(error, nan=1.0, posinf=1e30)


def _broken(found):
    """Return the share of rows with a value that is NaN, infinite or negative."""
    return float(np.mean(~(np.isfinite(found) & (found >= 0.0)).all(axis=1)))
