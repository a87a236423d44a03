"""What the plots of the window show of models: measured on its own context, kept while it holds."""

import math
from typing import NamedTuple

import numpy as np

from . import facing, gonio, measuring, panels
from .errors import Mistake, one_line
from .measure import Instrument
from .measuring import INCIDENCE, Chosen

ANGLES = gonio.steps(0.0, 90.0, 0.5)  # degrees at which a Fresnel reflectance is told
CLOSE = 0.01  # degrees from the normal, where a direction has no azimuth worth the name


class Aim(NamedTuple):
    """Where the light stands and in which plane the detector goes, in degrees.

    theta and phi are those of the light; plane is the azimuth of that half of the plane in which
    the detector's angles are negative: the light's own, or the nearer one to it.
    """

    theta: float
    phi: float = 0.0
    plane: float = 0.0

    @property
    def L(self):
        """The direction to the light, (3,)."""
        return gonio.directions(self.theta, self.phi)

    def angle(self, w):
        """Return where the detector's scale has a direction, and how far it is off its plane."""
        theta = facing.theta(w)
        turn = math.degrees(facing.azimuth(w)) - self.plane
        away = abs(math.remainder(turn, 360.0))  # 0 to 180
        if theta < CLOSE or theta > 180.0 - CLOSE:
            return theta, 0.0
        side = math.cos(math.radians(away))
        off = math.degrees(math.asin(min(1.0, math.sin(math.radians(theta)) * _sine(away))))
        return (-theta if side > 0.0 else theta), off


class Bench:
    """Measures Chosen models (see `measuring`) as often as something changed; release it.

    faults holds a line for each model that could not be measured since the last `turn`, for which
    every method returns None; busy tells that there is more to come of an albedo.
    """

    def __init__(self, context):
        self._instrument = Instrument(context)
        self._before, self._kept = {}, {}
        self.faults, self.busy, self._spent = [], False, False

    def release(self):
        """Free what is on the card."""
        self._instrument.release()

    def turn(self):
        """Begin a frame: what the one before had no use for is forgotten."""
        self._before, self._kept, self.faults = self._kept, {}, []
        self.busy = self._spent = False

    def curve(self, one, aim):
        """Return the panels.Curve of a model in the plane of an Aim."""

        def make(evaluate):
            eta = one.eta if one.shader.transmits else 1.0
            angles = gonio.lobe_angles(aim.theta, one.highest, eta)
            light, detector = gonio.in_plane(np.array([aim.theta]), aim.plane, angles)
            light[:, 1] = aim.phi
            found = gonio.measured(evaluate, light, detector, opaque=one.highest <= 90.0)
            return panels.Curve("", aim.theta, angles, gonio.divided(found, aim.theta))

        return self._measured("curve", one, aim, make)

    def lobe(self, one, aim):
        """Return the panels.Lobe of a model under the light of an Aim, which is at azimuth 0."""

        def make(evaluate):
            how = (aim.theta, aim.phi, one.highest, one.eta)
            return panels.Lobe("", aim.theta, *gonio.full_lobe(evaluate, *how))

        return self._measured("lobe", one, aim._replace(plane=0.0), make)

    def value(self, one, L, V):
        """Return f(L, V) (3,) [1/sr]; NaN for light along the surface."""

        def make(evaluate):
            pair = np.array([L], np.float64), np.array([V], np.float64)
            with np.errstate(divide="ignore", invalid="ignore"):
                return evaluate(*pair)[0].astype(np.float64) / (abs(L[2]) or np.nan)

        return self._measured("value", one, (tuple(L), tuple(V)), make)

    def facet(self, one):
        """Return the Fresnel reflectance of a model as a panels.Albedo; None where it has none."""
        if "F_facet" not in one.shader.defines:
            return None

        def make(evaluate):
            V = gonio.directions(ANGLES, 0.0)
            return panels.Albedo("", ANGLES, evaluate(V, V), np.zeros(len(ANGLES)))

        return self._measured("facet", one, (), make, "facet")

    def albedo(self, one, azimuth, more):
        """Return the panels.Albedo of a model, as many of its angles as there are by now.

        more: whether there is time for another angle; a frame measures one, of all models.
        """
        found = self._measured("albedo", one, azimuth, lambda _: [])
        if found is None:
            return None
        if len(found) < len(INCIDENCE):
            self.busy = True
            if more and not self._spent:
                self._spent = True
                angle = INCIDENCE[len(found) : len(found) + 1]
                found.append(measuring.albedo(self._instrument, one, azimuth, angle))
        if not found:
            return panels.Albedo(one.label, *map(np.array, ([], np.zeros((0, 3)), [])))
        parts = (np.concatenate(side) for side in list(zip(*found, strict=True))[1:4])
        return panels.Albedo(one.label, *parts, any(part.surround for part in found))

    def _measured(self, what, one, how, make, quantity="scatter"):
        """Return what `make` makes of a function (L, V) → (n, 3), once for the same model."""
        key = (what, one.shader.source, tuple(one.values.items()), how)
        if key not in self._kept:
            try:
                made = self._before.get(key)
                evaluate = measuring.evaluator(self._instrument, one, quantity)
                self._kept[key] = make(evaluate) if made is None else made
            except Mistake as mistake:
                self._kept[key] = one_line(mistake)
        found = self._kept[key]
        if isinstance(found, str):
            self.faults.append(found)
            return None
        return found._replace(label=one.label) if hasattr(found, "label") else found


def compared(one, others, same):
    """Return the Chosen of an Object, and of others: (Shader, values or None, label or "") each.

    Without values of its own a model has its defaults, or, where `same`, what it shares with the
    object's: values of the same name and kind. No two labels are alike.
    """
    models = [Chosen(one.model, one.values, _title(one.model))]
    for shader, values, label in others:
        values = values or _values(shader, models[0] if same else None)
        models.append(Chosen(shader, values, label or _title(shader)))
    for i, model in enumerate(models):
        alike = sum(other.label == model.label for other in models[:i])
        models[i] = model._replace(label=f"{model.label} ({alike + 1})") if alike else model
    return models


def _title(shader):
    return shader.header.get("model", shader.name)


def _values(shader, like):
    found, theirs = shader.defaults(), {}
    if like:
        theirs = {p.name: p for p in like.shader.parameters}
    for p in shader.parameters:
        other = theirs.get(p.name)
        if other and (other.type, other.choices) == (p.type, p.choices):
            found[p.name] = like.values[p.name]
    return found


def aimed(L, V):
    """Return the Aim whose light is in direction L and whose plane holds V."""
    phi = math.degrees(facing.azimuth(L))
    near = facing.theta(V) < CLOSE
    plane = phi if near else math.degrees(facing.azimuth(V))
    if math.cos(math.radians(plane - phi)) < 0.0:
        plane += 180.0
    return Aim(facing.theta(L), phi, plane)


def _sine(degrees):
    return math.sin(math.radians(degrees))
