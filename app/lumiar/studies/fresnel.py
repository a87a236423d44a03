"""Fresnel's reflectance: exact forms against approximations, over angle and index."""

import math

import numpy as np

from .. import materials
from .. import reference_terms as terms
from ..study import RELATIVE, SHARE, points

TITLE = {"en": "Fresnel's reflectance", "pt": "Refletância de Fresnel"}
SECONDS = (40.0, 5.0)
METRICS = {"absolute": SHARE, "relative": RELATIVE}
OUTSIDE = (1.1, 1.333, 1.5, 1.8, 2.417, 4.0)
INSIDE = (1.333, 1.5, 2.417)
NEAR_ONE = (1.0 + 1e-3, 1.0 + 1e-6)
METALS = ("gold", "silver", "copper", "aluminium", "iron")
FORMS = ("exact", "g_form", "textbook", "schlick", "schlick_pow", "f82", "constant", "slide")
FORMS_INSIDE = (*FORMS[:4], "schlick_t")
FORMS_METAL = ("exact", "textbook", "schlick", "f82", "constant")
WORDS = {
    "absolute": {"en": "absolute error", "pt": "erro absoluto"},
    "relative": {"en": "relative error", "pt": "erro relativo"},
    "glass": {"en": "glass from outside, n = 1.5", "pt": "vidro por fora, n = 1,5"},
    "outside": {"en": "from outside, n 1.1 to 4", "pt": "por fora, n de 1,1 a 4"},
    "near one": {"en": "n = 1.001 and 1.000001", "pt": "n = 1,001 e 1,000001"},
    "inside": {"en": "from inside, n 1.333 to 2.417", "pt": "por dentro, n de 1,333 a 2,417"},
    "critical": {"en": "from inside, at the critical angle", "pt": "por dentro, no ângulo crítico"},
    "metals": {
        "en": "gold, silver, copper, aluminium, iron",
        "pt": "ouro, prata, cobre, alumínio, ferro",
    },
    "exact": {"en": "exact Fresnel", "pt": "Fresnel exato"},
    "g_form": {"en": "the slide's g-form (put right)", "pt": "a forma g do slide (corrigida)"},
    "textbook": {"en": "the textbook's form", "pt": "a forma dos livros"},
    "schlick": {"en": "Schlick", "pt": "Schlick"},
    "schlick_pow": {"en": "Schlick by pow", "pt": "Schlick com pow"},
    "schlick_t": {"en": "Schlick at the larger angle", "pt": "Schlick no ângulo maior"},
    "f82": {"en": "F82", "pt": "F82"},
    "constant": {"en": "constant F0", "pt": "F0 constante"},
    "slide": {"en": "the slide as printed", "pt": "o slide como impresso"},
}


def run(bench):
    """Yield the Points of all cases."""
    model = bench.formulas("fresnel")
    seconds = 1.0 if bench.quick else 12.0
    angles = np.linspace(0.0, math.pi / 2.0, 2001 if bench.quick else 20001)[:-1]
    cosines = np.unique(np.append(np.cos(angles), np.geomspace(1e-6, 1.0, 200)))
    costs = bench.costs(_jobs(model, FORMS, _dielectric(1.5)), seconds)
    whole = [(_dielectric(n), cosines) for n in OUTSIDE]
    yield from _case(bench, model, "glass", FORMS, whole[2:3], costs)
    yield from _case(bench, model, "outside", FORMS, whole, costs)
    near = [(_dielectric(n), cosines) for n in NEAR_ONE]
    yield from _case(bench, model, "near one", FORMS[:3], near, costs)
    costs = bench.costs(_jobs(model, FORMS_INSIDE, _dielectric(1.0 / 1.5)), seconds)
    away, at = [], []
    for n in INSIDE:
        critical = math.sqrt((1.0 - 1.0 / n) * (1.0 + 1.0 / n))
        away.append((_dielectric(1.0 / n), cosines[np.abs(cosines - critical) > 1e-3]))
        offsets = np.geomspace(1e-6, 1e-3, 100)
        at.append((_dielectric(1.0 / n), critical + np.concatenate([-offsets, offsets])))
    yield from _case(bench, model, "inside", FORMS_INSIDE, away, costs)
    yield from _case(bench, model, "critical", FORMS[:3], at, costs)
    values = [_metal(materials.read(name).values) for name in METALS]
    costs = bench.costs(_jobs(model, FORMS_METAL, values[0]), seconds)
    metals = [(one, cosines) for one in values]
    yield from _case(bench, model, "metals", FORMS_METAL, metals, costs)


def _dielectric(n):
    """Return the values of the forms for an index, all approximations fitted to it."""
    f0 = ((n - 1.0) / (n + 1.0)) ** 2
    f82 = float(terms.F_dielectric(np.array([1.0 / 7.0]), n)[0])
    return {"eta": n, "grey": f0, "grey82": f82}


def _metal(values):
    eta, k = (np.array(values[name]) for name in ("eta", "k"))
    f0, f82 = (tuple(terms.F_conductor(c, eta, k).tolist()) for c in (1.0, 1.0 / 7.0))
    index, k = tuple(values["eta"]), tuple(values["k"])
    return {"metal": True, "index": index, "k": k, "f0": f0, "f82": f82}


def _jobs(model, forms, values):
    return {form: (model, {**model.defaults(), **values, "form": form}) for form in forms}


def _case(bench, model, case, forms, settings, costs):
    """Yield the Points of the forms: the largest errors over settings (values, cosines)."""
    worst = {form: {"absolute": 0.0, "relative": 0.0} for form in forms}
    for values, cosines in settings:
        c = cosines.astype(np.float32)
        L = np.stack([np.sqrt((1.0 - c) * (1.0 + c)), np.zeros_like(c), c], axis=1)
        pairs = bench.instrument.pairs(L, L)
        true = _true(values, c.astype(np.float64)[:, None])
        for form, (_, given) in _jobs(model, forms, values).items():
            found = bench.instrument.scatter(model, given, pairs).astype(np.float64)
            error = np.abs(found - true)
            for name, value in (("absolute", error), ("relative", error / true)):
                worst[form][name] = max(worst[form][name], float(value.max()))
        bench.instrument.forget(pairs)
    for form in forms:
        yield from points(case, form, worst[form], costs[form], default=form == "exact")


def _true(values, c):
    """Return the reflectance (n, 3) in float64 for what the card is given, in float32."""
    if "metal" in values:
        eta, k = (np.float32(values[name]).astype(np.float64) for name in ("index", "k"))
        return terms.F_conductor(c, eta, k)
    return np.broadcast_to(terms.F_dielectric(c, float(np.float32(values["eta"]))), (len(c), 3))
