"""Lobes typed as the slides print them against the forms of Lumiar, to the extremes of width."""

import numpy as np

from .. import catalog, hostile, reference
from ..notation import number
from ..study import RELATIVE, Remark, in_order, points

TITLE = {
    "en": "Lobes: as printed, and in forms that float32 bears",
    "pt": "Lobos: como impressos, e em formas que o float32 suporta",
}
SECONDS = (60.0, 5.0)
METRICS = {"relative": RELATIVE}
PEAK = 1e-6  # share of the peak of a lobe below which no relative error counts
LOW = 0.05  # cosine of directions below which rounding of the input alone decides
EXPONENTS, ALPHAS = (10.0, 100.0, 1e4, 1e6), (0.3, 0.1, 0.01, 0.001)
LAWS = {  # law: (name, model, its choices, what is varied, values)
    "phong": ("Phong", "phong", {}, "shininess", EXPONENTS),
    "blinn": ("Blinn", "blinn", {}, "shininess", EXPONENTS),
    "ward": ("Ward", "ward", {"form": "slide"}, "alpha_x", ALPHAS),
    "beckmann": (
        "Cook-Torrance, Beckmann",
        "cook_torrance",
        {"distribution": "beckmann", "shadowing": "v_groove", "fresnel": "schlick"},
        "alpha",
        ALPHAS,
    ),
    "ggx": (
        "Cook-Torrance, GGX",
        "cook_torrance",
        {"distribution": "ggx", "shadowing": "v_groove", "fresnel": "schlick"},
        "alpha",
        ALPHAS,
    ),
    "oren_nayar": ("Oren-Nayar", "oren_nayar", {}, "sigma", (5.0, 30.0, 90.0)),
}
SYMBOLS = {"shininess": "m", "alpha_x": "α", "alpha": "α", "sigma": "σ"}
SENTENCE = ("phong", "blinn", "ward")  # of the slides, fastest first


def _words():
    cases = {
        f"{law} {value:g}": f"{name}, {SYMBOLS[key]} = {_number(value)}{'°' * (key == 'sigma')}"
        for law, (name, _, _, key, values) in LAWS.items()
        for value in values
    }
    return {
        **{case: {"en": said, "pt": said.replace(".", ",")} for case, said in cases.items()},
        "relative": {"en": "relative error", "pt": "erro relativo"},
        "naive": {"en": "as printed", "pt": "como impresso"},
        "stable": {"en": "Lumiar's form", "pt": "a forma do Lumiar"},
    }


def _number(value):
    return f"{value:,.0f}".replace(",", "\u202f") if value >= 1e4 else f"{value:g}"


WORDS = _words()
VERDICTS = {
    "en": {True: "true", False: "false", None: "not to be told apart"},
    "pt": {True: "verdade", False: "falso", None: "não se pode dizer"},
}


def run(bench):
    """Yield the Points of all lobes and widths, and what the slides' sentence is worth."""
    jobs = {}
    for law, (_, _, _, _, values) in LAWS.items():
        for value in values:
            for variant in ("naive", "stable"):
                jobs[law, value, variant] = _job(bench, law, variant, value)
    timed = {key: job for key, job in jobs.items() if not bench.quick or key[1] == _usual(key[0])}
    costs = bench.costs(timed, 2.0 if bench.quick else 50.0)
    L, V = hostile.ordinary(False)
    high = (L[:, 2] > LOW) & (V[:, 2] > LOW)
    L, V = L[high], V[high]
    pairs, found = bench.instrument.pairs(L, V), {}
    for key, (model, values) in jobs.items():
        law, value, variant = key
        measured = bench.instrument.scatter(model, values, pairs).astype(np.float64)
        error = _error(measured, _true(law, value, L, V))
        timing = costs.get(key) or costs[law, _usual(law), variant]
        (found[key],) = points(
            f"{law} {value:g}",
            variant,
            {"relative": error},
            timing,
            default=variant == "stable",
            parameters={LAWS[law][3]: value},
        )
        yield found[key]
    bench.instrument.forget(pairs)
    yield _judged(found)


def _usual(law):
    """Return the width that costs stand for where not all are timed."""
    return LAWS[law][4][1]


def _job(bench, law, variant, value):
    """Return the (model, values) of a lobe; the same numbers for both variants."""
    _, name, choices, key, _ = LAWS[law]
    if variant == "naive":
        model = bench.formulas("naive")
        names = {"alpha": ("alpha_x",), "alpha_x": ("alpha_x", "alpha_y")}.get(key, (key,))
        own = {"law": law}
    else:
        model, own = catalog.read("model", name), choices
        names = ("alpha_x", "alpha_y") if key == "alpha_x" else (key,)
    common = {"kd": (0.1,) * 3, "ks": (0.5,) * 3}
    common = {k: v for k, v in common.items() if k in model.defaults()}
    return model, {**model.defaults(), **common, **own, **dict.fromkeys(names, value)}


def _true(law, value, L, V):
    """Return the float64 values of a lobe, for the parameters as the card holds them."""
    _, name, choices, key, _ = LAWS[law]
    model = catalog.read("model", name)
    values = {**model.defaults(), "kd": (0.1,) * 3, "ks": (0.5,) * 3, **choices}
    names = ("alpha_x", "alpha_y") if key == "alpha_x" else (key,)
    values = model.in_radians({**values, **dict.fromkeys(names, value)})
    single = {k: _single(v) for k, v in values.items()}
    return getattr(reference, name)(L, V, **single)


def _single(value):
    """Return a number, or a tuple of them, rounded to float32."""
    if isinstance(value, tuple):
        return tuple(map(_single, value))
    return float(np.float32(value)) if type(value) is float else value


def _error(found, true):
    """Return the largest relative error above PEAK; what is no number is wrong by all of it."""
    counted = true > PEAK * true.max()
    off = np.where(counted, np.abs(found - true) / np.where(counted, true, 1.0), 0.0)
    return float(np.nan_to_num(off, nan=1.0, posinf=1e30).max())


def _judged(found):
    """Return the Remark on the slides' sentence, "Phong is fastest, then Blinn, then Ward"."""
    said = {}
    for lang, intro, ways in (
        (
            "en",
            "The slides: Phong is fastest, then Blinn, then Ward.",
            {"naive": "As printed", "stable": "In Lumiar's forms"},
        ),
        (
            "pt",
            "Os slides: Phong é o mais rápido, depois Blinn, depois Ward.",
            {"naive": "Como impressos", "stable": "Nas formas do Lumiar"},
        ),
    ):
        parts = [intro]
        for variant, how in ways.items():
            order = [found[law, _usual(law), variant] for law in SENTENCE]
            times = "; ".join(number(p.cost, 2, lang) for p in order)
            parts.append(f"{how}: {VERDICTS[lang][in_order(order)]} ({times} ns).")
        said[lang] = " ".join(parts)
    return Remark(**said)
