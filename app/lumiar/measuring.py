"""What `lumiar measure` makes of models as typed: a table, a picture, or exact pairs in a file."""

import io
import math
import os
from typing import NamedTuple

import numpy as np

from . import __version__, catalog, gonio, materials, measure, panels, settings, tables
from .captions import TEXT
from .errors import Mistake, nearest
from .parts import Object
from .scene import Scene

LIGHTS = (0.0, 30.0, 60.0, 80.0)  # degrees, unless others are asked for
COMPARED = (60.0,)  # whose lobes are drawn where several models are and no light is asked for
SOLID = 50.0  # the light nearest to this angle has its lobe drawn in 3-D
INCIDENCE = (*range(0, 86, 5), 87.0, 89.0)  # degrees at which the albedo is summed
ROWS = 1_000_000  # of one table


class Chosen(NamedTuple):
    """A model to be measured: its Shader, every value of it, and what pictures call it."""

    shader: catalog.Shader
    values: dict
    label: str

    @property
    def highest(self):
        """How far from the normal a detector can see it, in degrees: 180 for both sides."""
        return 180.0 if self.shader.transmits else 90.0

    @property
    def eta(self):
        """Its index of refraction, below the surface over above; 1 where it has none."""
        return measure.index_of(self.values)


class Setup(NamedTuple):
    """How the instrument is set; all in degrees but the relative noise.

    detector is (low, high, step) in the plane of incidence, or None for all of it; step, unless 0,
    is that of a scan of all directions instead; aperture is a half-angle.
    """

    lights: tuple
    azimuth: float = 0.0
    detector: tuple | None = None
    step: float = 0.0
    aperture: float = 0.0
    noise: float = 0.0
    seed: int = 0


def chosen(specs, pairs, folder="", material=None):
    """Return the Chosen models of texts such as `ward:alpha_x=0.3`.

    material names one whose values they take; pairs are (key, value) set in all of them that have
    such a value. Raises Mistake.
    """
    models, used = [], set()
    for spec in specs:
        name, *own = settings.light_parts(spec)
        shader = catalog.read("model", name, "", folder)
        values = shader.defaults()
        if material:
            one = Object(shader, values)
            values = materials.applied(one, material, True, "--material: ").values
        for key, value in pairs:
            if key in values:
                used.add(key)
                values = _with(shader, values, key, value, "--set: ")
        for setting in own:
            key, _, value = setting.partition("=")
            shader.parameter(key, f"{spec}: ")
            values = _with(shader, values, key, value, f"{spec}: ")
        title = shader.header.get("model", os.path.basename(name))
        models.append(Chosen(shader, values, title + f" ({', '.join(own)})" * bool(own)))
    for key, _ in pairs:
        if key not in used:
            names = {name for one in models for name in one.values}
            raise Mistake(f"--set: no value '{key}'; {nearest(key, names)}")
    for i, one in enumerate(models):
        before = sum(other.label == one.label for other in models[:i])
        models[i] = one._replace(label=f"{one.label} ({before + 1})") if before else one
    return models


def _with(shader, values, key, value, where):
    scene = Scene((Object(shader, values),), ())
    return scene.changed(key, value, where).objects[0].values


def evaluator(instrument, one, what="scatter"):
    """Return the function (L, V) → (n, 3) that measures one Chosen model."""

    def evaluate(L, V):
        pairs = instrument.pairs(L, V)
        found = getattr(instrument, what)(one.shader, one.values, pairs)
        instrument.forget(pairs)
        return found

    return evaluate


def measurement(instrument, models, setup):
    """Return the tables.Measurement of Chosen models, one after the other. Raises Mistake."""
    arms, number = [], []
    for i, one in enumerate(models, 1):
        arms.append(_arms(one, setup, max(one.highest for one in models)))
        number.append(np.full(len(arms[-1][0]), i))
    generator, found = np.random.default_rng(setup.seed), []
    for one, (light, detector) in zip(models, arms, strict=True):
        opaque = one.highest <= 90.0
        evaluate = evaluator(instrument, one)
        scatter = gonio.measured(evaluate, light, detector, setup.aperture, opaque)
        found.append(gonio.noisy(scatter, setup.noise, generator) if setup.noise else scatter)
    header = {
        "program": f"Lumiar {__version__}, lumiar measure",
        **described(models),
        "light": f"{', '.join(f'{x:g}' for x in setup.lights)} degrees from the normal",
        "azimuth": f"{setup.azimuth:g} degrees, of the light from the tangent",
        "detector": _scan(setup),
        "aperture": f"{setup.aperture:g} degrees, half-angle of the cone whose mean is taken",
        "noise": f"{setup.noise:g} of the value, Gaussian, seed {setup.seed}",
        "scatter": "f |cos theta_l|; brdf is f; theta from the normal, phi from the tangent",
    }
    light, detector = (np.concatenate(side) for side in zip(*arms, strict=True))
    scatter = np.concatenate(found).astype(np.float32)
    return tables.Measurement(header, light, detector, scatter, np.concatenate(number))


def _arms(one, setup, widest):
    """Return (light (n, 2), detector (n, 2)) of the scan of a model; below the surface is none."""
    low, high, fine = setup.detector or (-one.highest, one.highest, 1.0)
    reach = max(map(abs, (*setup.lights, low, high)))
    if reach > widest:
        advice = "only a model whose header says `// sides   both` has directions beyond 90"
        raise Mistake(f"measure: {reach:g} degrees from the normal is below the surface; {advice}")
    above = np.array([light for light in setup.lights if light <= one.highest])
    each = one.highest / setup.step * 360.0 / setup.step if setup.step else (high - low) / fine
    if len(above) * each > ROWS:
        told = f"{len(above) * each:.0f} directions; allowed: {ROWS}"
        raise Mistake(f"measure: a scan of {told}; take larger steps or fewer lights")
    if setup.step:
        return gonio.hemispherical(above, setup.azimuth, setup.step, one.highest)
    angles = gonio.steps(low, high, fine)
    return gonio.in_plane(above, setup.azimuth, angles[np.abs(angles) <= one.highest])


def _scan(setup):
    """Return what a table's header says of the detector's way."""
    if setup.step:
        return f"all directions, every {setup.step:g} degrees of theta and of phi"
    way = ":".join(f"{x:g}" for x in setup.detector) if setup.detector else "all around, every 1"
    return f"in the plane of incidence, {way} degrees, negative on the light's side"


def described(models):
    """Return what a table's header says of Chosen models, numbered from 1: {key: text}."""
    told = {}
    for i, one in enumerate(models, 1):
        told[f"model {i}"] = one.label
        told[f"file {i}"] = one.shader.name
        told[f"paper {i}"] = one.shader.header.get("paper", "not given")
        for p in one.shader.parameters:
            unit = "degrees" if p.degrees else p.unit or ("choice" if p.constant else "unitless")
            told[f"parameter {i}.{p.name}"] = f"{_shown(one.values[p.name])} ({unit})"
    return told


def _shown(value):
    if isinstance(value, tuple):
        return ", ".join(map(_shown, value))
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else f"{value:.9g}"


def picture(instrument, models, setup, asked, measured, overlays, lang, ending, changed=""):
    """Return the bytes of a picture of Chosen models, their lobes as they are, without detector.

    asked      the lights to show, None for those that suit
    measured   a Measurement, shown as points if its detector has noise or an aperture, or None
    overlays   (name, Measurement), shown as points
    changed    what to write below the title
    """
    from . import plots

    shown = asked or (LIGHTS if len(models) == 1 else COMPARED)
    curves, albedos, lobes = [], [], []
    solid = min(shown, key=lambda light: abs(light - SOLID))
    for one in models:
        evaluate, how = evaluator(instrument, one), (setup.azimuth, one.highest, one.eta)
        for light in (light for light in shown if light <= one.highest):
            curves.append(panels.Curve(one.label, light, *gonio.lobe(evaluate, light, *how)))
        if solid <= one.highest:
            lobes.append(panels.Lobe(one.label, solid, *gonio.full_lobe(evaluate, solid, *how)))
        albedos.append(albedo(instrument, one, setup.azimuth))
    points = [point for name, other in overlays for point in _points(name, other, shown)]
    if setup.noise or setup.aperture:
        points += _points(TEXT[lang]["detector"], measured, shown)
    title = ", ".join(one.label for one in models)
    paper = models[0].shader.header.get("paper", "") if len(models) == 1 else ""
    light = TEXT[lang]["light"].format(shown[0]) if len(shown) == 1 else ""
    under = "; ".join(filter(None, (paper, changed, light)))
    return plots.measurement(title, under, curves, points, albedos, lobes, lang, ending)


def albedo(instrument, one, azimuth=0.0, angles=INCIDENCE):
    """Return the panels.Albedo of a Chosen model for light from angles, in degrees.

    Where it scatters nothing, as a mirror does, that of its surroundings in a white furnace.
    """
    angles, turn = np.array(angles, np.float64), math.radians(azimuth)
    values, error = measure.albedo(
        instrument, one.shader, one.values, np.radians(angles), turn, 10, one.highest > 90.0
    )
    if values.any() or "surround" not in one.shader.defines:
        return panels.Albedo(one.label, angles, values, error)
    V = gonio.directions(angles, azimuth)
    values = evaluator(instrument, one, "surround")(V, V)
    return panels.Albedo(one.label, angles, values, np.zeros(len(angles)), True)


def _points(name, other, lights):
    """Return Curves of those rows of a Measurement that stand in the plane of a light shown."""
    brdf, angles, found = other.brdf, other.angles, []
    for light in lights:
        here = np.isclose(other.light[:, 0], light) & np.isfinite(angles)
        for number in np.unique(other.model[here]):
            rows = np.flatnonzero(here & (other.model == number))
            rows = rows[np.unique(angles[rows], return_index=True)[1]]  # in order, each once
            label = f"{name}: {other.header.get(f'model {number}', number)}"
            found.append(panels.Curve(label, light, angles[rows], brdf[rows]))
    if not found:
        held = ", ".join(f"{x:g}" for x in np.unique(other.light[:, 0])[:8])
        raise Mistake(f"{name}: nothing in it is at the lights shown; write --light {held}")
    return found


def exact(instrument, one, L, V):
    """Return the bytes of an .npz with scatter, and surround where it is defined, of exact pairs.

    Also the number of pairs for which one of these is not finite.
    """
    found = {"scatter": gonio.batched(evaluator(instrument, one), L, V)}
    if "surround" in one.shader.defines:
        found["surround"] = gonio.batched(evaluator(instrument, one, "surround"), L, V)
    broken = sum(int((~np.isfinite(a)).any(axis=1).sum()) for a in found.values())
    out = io.BytesIO()
    np.savez(out, **found)
    return out.getvalue(), broken
