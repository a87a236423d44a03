"""Model → data sheet: claims, hard cases, float32 error, albedo, cost. Every figure is measured."""

import math

import numpy as np

from . import catalog, compose, gonio, measure, settings
from .examine import Examination

CURVE = (*map(float, range(0, 90, 5)), 87.5, 89.0)  # degrees of the albedo curve


def audit(model, instrument, seed=0):
    """Return the data sheet of a catalog.Shader as a dictionary of plain values.

    claims    {name: claimed, verdict, agrees, worst, what, where}; verdict is "holds", "broken",
              "does not hold" or "holds, unclaimed"; agrees: whether the header may stay as it is
    hostile   evaluations and how many were NaN, infinite or negative, with the first place of each
    error     relative error against `reference` at default sliders and at all corners, or None
    albedo    {degrees, rgb, error} at default values; cost in ns, also of Lambert's model
    compiled  lines of GLSL and the choices they are for; settings tried
    broken    one line for each claim that does not hold, empty if all is well
    """
    run = Examination(model, instrument, seed)
    tried = run.everything()
    run.forget()
    return {
        "model": model.name,
        "title": model.header.get("model", model.name),
        "paper": model.header.get("paper", ""),
        "note": model.header.get("note", ""),
        "claims": run.findings.verdicts(),
        "hostile": run.counts,
        "error": run.errors(),
        "albedo": _curve(model, instrument),
        "cost": _cost(model, instrument),
        "compiled": {
            "lines": _lines(model),
            "choices": model.constants(model.defaults()),
            "settings": tried,
        },
        "broken": run.broken(),
    }


def text(sheet):
    """Return the lines of a data sheet for people."""
    out = [f"{sheet['title']}  ({sheet['model']})"]
    for key in ("paper", "note"):
        out += [f"  {key:10}{sheet[key]}"] if sheet[key] else []
    for name, said in sheet["claims"].items():
        claimed = {"yes": "claimed", "no": "not claimed"}.get(
            said["claimed"], f"claimed for {said['claimed']}"
        )
        worst = f"; at worst {said['what']} ({said['where']})" if said["worst"] > 0.0 else ""
        out.append(f"  {name:12}{claimed}: {said['verdict']}{worst}")
    hard = sheet["hostile"]
    counts = ", ".join(f"{hard[kind]} {kind}" for kind in ("nan", "infinite", "negative"))
    out.append(f"  hard cases  {hard['evaluations']} evaluations: {counts}")
    out += [f"    first {kind}: {where}" for kind, where in hard["where"].items()]
    if sheet["error"]:
        for part, found in sheet["error"].items():
            own = f"{found['max']:.1e} at most ({found['inherent']:.1e} of it by rounded input)"
            out.append(f"  error       {part}: {own}, 99 % below {found['p99']:.1e}")
            out.append(f"              {found['where']}")
    else:
        out.append("  error       not measured: no float64 reference of this name")
    curve = sheet["albedo"]
    shown = [i for i, a in enumerate(curve["degrees"]) if a in (0.0, 30.0, 60.0, 85.0, 89.0)]
    values = (f"{max(curve['rgb'][i]):.4f} at {curve['degrees'][i]:g}" for i in shown)
    error = max(curve["error"])
    out.append(f"  albedo      {', '.join(values)} degrees (quadrature within {error:.0e})")
    cost = sheet["cost"]
    ratio = cost["ns"] / cost["lambert_ns"] if cost["lambert_ns"] > 0.0 else math.nan
    spread = cost["spread"] / 2.0
    out.append(f"  cost        {cost['ns']:.2f} ± {spread:.2f} ns, {ratio:.1f} times Lambert's")
    made = sheet["compiled"]
    chosen = ", ".join(f"{name} = {value}" for name, value in made["choices"].items())
    out.append(f"  compiled    {made['lines']} lines of GLSL{' with ' * bool(chosen)}{chosen}")
    out.append(f"  tried       {made['settings']} settings of choices and sliders")
    out += [f"  BROKEN      {line}" for line in sheet["broken"]] or ["  verdict     as claimed"]
    return "\n".join(out)


def page(sheet, model, instrument, renderer, lang):
    """Return the bytes of a PNG: a data sheet as one page, with a picture of the model."""
    from . import measuring, panels, picture, plots
    from .captions import TEXT
    from .scene import Scene

    chosen = measuring.Chosen(model, model.defaults(), sheet["title"])
    evaluate = measuring.evaluator(instrument, chosen)
    how = (0.0, chosen.highest, chosen.eta)
    curves = [
        panels.Curve(chosen.label, light, *gonio.lobe(evaluate, light, *how))
        for light in measuring.LIGHTS
    ]
    scene = Scene.default().set(model=model.path, size=(480, 480), samples=16, exposure=-1.0)
    scene = scene.changed("light", "directional:direction=0.5,0.7,0.9")
    more = settings.light("studio:radiance=0.5")
    shot = picture.capture(scene._replace(lights=(*scene.lights, more)), renderer=renderer)
    words = TEXT[lang]["sheet"]
    claims = tuple(
        (
            words[name],
            words.get(said["claimed"], words["partly"]),
            words[said["verdict"]],
            said["agrees"],
        )
        for name, said in sheet["claims"].items()
    )
    facts = plots.Sheet(
        sheet["title"],
        sheet["paper"],
        claims,
        tuple(curves),
        measuring.albedo(instrument, chosen, 0.0),
        tuple(_facts(sheet, words)),
    )
    return plots.data_sheet(facts, shot.pixels, shot.size, lang)


def _facts(sheet, words):
    """Yield the (label, value) texts of a data sheet's numbers."""
    hard, cost, made = sheet["hostile"], sheet["cost"], sheet["compiled"]
    yield words["evaluations"], f"{hard['evaluations']:,}".replace(",", " ")
    for kind in ("nan", "infinite", "negative"):
        yield words[kind], str(hard[kind])
    for part, found in (sheet["error"] or {}).items():
        yield words[f"error {part}"], f"{found['max']:.1e}"
        yield words["inherent"], f"{found['inherent']:.1e}"
    yield words["cost"], f"{cost['ns']:.2f} ns"
    if cost["lambert_ns"] > 0.0:
        yield words["times"], f"{cost['ns'] / cost['lambert_ns']:.1f}"
    yield words["lines"], str(made["lines"])
    yield words["settings"], str(made["settings"])


def _curve(model, instrument):
    """Return the albedo against the angle of incidence at default values."""
    rgb, error = measure.albedo(
        instrument, model, model.defaults(), np.radians(CURVE), transmits=model.transmits
    )
    return {"degrees": list(CURVE), "rgb": rgb.tolist(), "error": error.tolist()}


def _cost(model, instrument):
    lambert = catalog.read("model", "lambert")
    (own, spread), (other, _) = (instrument.cost(one, one.defaults()) for one in (model, lambert))
    return {"ns": own, "spread": spread, "lambert_ns": other}


def _lines(model):
    """Return the number of lines of GLSL that evaluate the model at its default choices."""
    constants = model.constants(model.defaults())
    text = compose.measured(model, constants, "scatter")["fragment"].text
    return sum(
        1 for line in text.split("\n") if line.strip() and not line.lstrip().startswith("//")
    )
