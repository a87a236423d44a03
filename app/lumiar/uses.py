"""Which points of a study of `lumiar bench` stand for what a scene does, the nearest of them."""

import math

LAWS = {"phong": "phong", "blinn": "blinn", "ward": "ward", "oren_nayar": "oren_nayar"}
DIFFUSE = {"qualitative": "qualitative", "full": "full", "energy_preserving": "eon"}
METALS = ("conductor", "rough_conductor")
GLASSES = ("dielectric", "rough_dielectric", "plastic", "transparency")


def used(study, points, thing, triangles, shading, lights):
    """Return those of a study's Points that an Object of so many triangles uses in a scene.

    shading is the scene's rate, lights its Lights. Empty where the study is of other things.
    """
    rule = _RULES.get(study)
    chosen, near = rule(thing, triangles, shading, lights) if rule else (None, {})
    found = [p for p in points if chosen and chosen(p)]

    def off(point):
        given = point.parameters or {}
        pairs = ((given[key], value) for key, value in near.items() if key in given)
        return round(sum(abs(math.log(max(a, 1e-9) / max(b, 1e-9))) for a, b in pairs), 6)

    least = min(map(off, found), default=0.0)
    return [point for point in found if off(point) == least]


def _shading_rate(thing, triangles, shading, _):
    near = {"triangles": triangles, "exponent": thing.values.get("shininess", 50.0)}
    return lambda p: p.variant.startswith(f"{shading} "), near


def _diffuse(thing, *_):
    form = DIFFUSE.get(thing.values.get("form")) if thing.model.name == "oren_nayar" else None
    name = "lambert" if thing.model.name == "lambert" else form
    return lambda p: p.variant == name, {"sigma": thing.values.get("sigma", 30.0)}


def _lobes(thing, *_):
    values, law = thing.values, LAWS.get(thing.model.name)
    if thing.model.name == "cook_torrance":
        law = values["distribution"]
    near = {"alpha_x": values.get("alpha_x", 0.1), "alpha": values.get("alpha", 0.1)}
    near |= {"shininess": values.get("shininess", 100.0), "sigma": values.get("sigma", 30.0)}
    return lambda p: p.variant == "stable" and p.case.rpartition(" ")[0] == law, near


def _precision(thing, *_):
    return lambda p: p.variant == "lumiar" and p.case == thing.model.name, {}


def _fresnel(thing, *_):
    name, metal = thing.model.name, thing.model.name in METALS
    form = "exact" if metal or name in GLASSES else thing.values.get("fresnel")
    return lambda p: p.variant == form and (p.case == "metals") == metal, {}


def _area_light(thing, _, __, lights):
    exact = "constant" in thing.model.claims and any(one.kind.name == "quad" for one in lights)
    return lambda p: exact and p.variant == "closed", {}


def _environment(_, __, ___, lights):
    counts = [one.samples for one in lights if one.kind.name == "environment"]
    return lambda p: counts and p.variant.startswith("both "), {"samples": max(counts, default=1)}


def _spectrum(_, __, ___, lights):
    warm = any(one.temperature for one in lights)
    return lambda p: warm and p.case == "black body" and p.variant == "95", {}


_RULES = {
    "shading-rate": _shading_rate,
    "diffuse": _diffuse,
    "lobes": _lobes,
    "precision": _precision,
    "fresnel": _fresnel,
    "area-light": _area_light,
    "environment": _environment,
    "spectrum": _spectrum,
}
