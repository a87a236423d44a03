"""What becomes of a model on all its hard cases: claims, broken values, float32 error."""

import math
import os

import numpy as np

from . import catalog, hostile, measure, reference
from .claims import TOLERANCE, Findings

ANGLES = (0.0, 30.0, 60.0, 75.0, 85.0, 89.0)  # degrees of incidence at which energy is summed
RESOLVED = 1e-2  # error of an albedo beyond which it proves nothing
MOST = 300  # settings at slider ends; beyond, each choice gets its share of the corners
COMPARED = 100  # settings compared with the reference
SEARCHES = 48  # settings by chance in which a property that is not claimed is looked for
MOVES = 3  # ways in which directions are moved by their rounding
WRONG = 1e-2  # relative error at default sliders that no rounding explains
PEAK = 1e-6  # share of the lobe's peak below which no relative error is counted


class Examination:
    """What is gathered while a model is examined setting by setting."""

    def __init__(self, model, instrument, seed):
        self.model, self.instrument, self.seed = model, instrument, seed
        self.both = model.transmits
        self.references = references(model)
        w = hostile.directions(model.defaults())
        above = w if self.both else w[w[:, 2] > hostile.BELOW * 2]
        self.L = np.repeat(w, len(above), axis=0)
        self.V = np.tile(above, (len(w), 1))
        self.cases = instrument.pairs(self.L, self.V)
        self.fair = hostile.ordinary(self.both)
        self.compared, self.turned = (instrument.pairs(*p) for p in (self.fair, self.fair[::-1]))
        turns = (0.0, math.radians(37.0)) if "tangent" in model.needs else (0.0,)
        angles = np.radians([*ANGLES, *(180.0 - a for a in ANGLES if self.both)])
        self.turns, self.angles, self._furnaces = turns, angles, {}
        self.counts = {"evaluations": 0, "nan": 0, "infinite": 0, "negative": 0, "where": {}}
        self.findings = Findings(model)
        self.found = {"default": [], "corners": []}

    def everything(self):
        """Examine every choice at its defaults and corners; return the number of settings."""
        every, tried = hostile.choices(self.model, self.seed), 0
        for i, choice in enumerate(every):
            base = {**self.model.defaults(), **choice}
            names = self.instrument.active(self.model, base)
            settings = hostile.corners(self.model, names, self.seed)
            share = max(1, MOST // len(every))  # of the corners, others for each choice
            if share < len(settings):
                settings = (settings * 2)[i * share % len(settings) :][:share]
            settings = [{}, *settings]
            step = max(1, len(every) * len(settings) // COMPARED)
            for j, setting in enumerate(settings):
                compared = i == 0 or (i * len(settings) + j) % step == 0
                self.examine({**base, **setting}, bool(setting), compared)
                tried += 1
        for choice in every[:16]:  # what is not claimed may fail between the corners only
            base = {**self.model.defaults(), **choice}
            names = self.instrument.active(self.model, base)
            count = max(4, SEARCHES // min(16, len(every)))
            for setting in hostile.anywhere(self.model, names, count, self.seed):
                self.examine({**base, **setting}, True, False)
                tried += 1
        return tried

    def examine(self, values, corner, compared):
        """Look at one setting of the model on all hard cases, and compare it with the reference."""
        found = self.instrument.scatter(self.model, values, self.cases, strict=True)
        self._count(found, values, "scatter")
        if "surround" in self.model.defines:
            seen = self.instrument.surround(self.model, values, self.cases, strict=True)
            self._count(seen, values, "surround")
            brightest = float(np.nan_to_num(seen, nan=np.inf).max())
            what = f"in a white furnace {brightest:.6g}"
            self.findings.note("conserving", brightest - 1.0, values, what)
        self._constant(found, values)
        self._reciprocal(values)
        self._conserving(values)
        if compared and not values.get("compensated"):  # a fit: see _conserving for its furnace
            for what in tuple(self.references):
                self._error(values, corner, what)

    def broken(self):
        """Return one line for each thing a header must not say, or keep silent about."""
        lines = self.findings.broken()
        error = (self.errors() or {}).get("default")
        if error and error["beyond"] > WRONG:
            lines.append(f"{error['beyond']:.1%} off the float64 reference at {error['where']}")
        for kind in ("nan", "infinite"):
            if self.counts[kind]:
                lines.append(
                    f"{self.counts[kind]} {kind} values, first at {self.counts['where'][kind]}"
                )
        return lines

    def errors(self):
        """Return {part: figures} of the relative error against the reference, or None."""
        worst = {
            part: max(found, key=lambda one: one["beyond"])
            for part, found in self.found.items()
            if found
        }
        return worst or None

    def _count(self, found, values, what):
        self.counts["evaluations"] += found.shape[0]
        kinds = {"nan": np.isnan(found), "infinite": np.isinf(found), "negative": found < 0.0}
        for kind, at in kinds.items():
            rows = at.any(axis=1)
            number = int(np.count_nonzero(rows))
            if number:
                self.counts[kind] += number
                i = int(rows.argmax())
                self.counts["where"].setdefault(kind, self._place(values, i, what))
        least = -float(np.nanmin(found, initial=0.0))
        self.findings.note("positive", least, values, f"{what} is {-least:.3g}")

    def _constant(self, found, values):
        """Compare f of all hard cases above the surface, and with 0 of those that pass it."""
        if self.findings.settled("constant", values):
            return
        z = np.abs(self.L[:, 2])
        steady = (z > 1e-3) & (np.abs(self.V[:, 2]) > 1e-3)
        f = np.nan_to_num(found[steady] / z[steady, None], posinf=1e30, neginf=-1e30)
        above = (self.L[steady, 2] > 0.0) & (self.V[steady, 2] > 0.0)
        spread = max(np.ptp(f[above], axis=0).max(), np.abs(f[~above]).max(initial=0.0))
        spread = float(spread / max(np.abs(f).max(), 1e-30))  # 1e-30: nothing is scattered
        self.findings.note("constant", spread, values, f"f varies by {spread:.2%} of its peak")

    def _reciprocal(self, values):
        """Compare f(L, V) with f(V, L), up to one factor n^2 where light passes the surface."""
        if self.findings.settled("reciprocal", values):
            return
        L, V = self.fair
        there, back = (
            self.instrument.scatter(self.model, values, pairs, strict=True).astype(np.float64)
            for pairs in (self.compared, self.turned)
        )
        f, g = there * np.abs(V[:, 2:]), back * np.abs(L[:, 2:])  # both times both cosines
        steady = (np.abs(L[:, 2]) > 1e-2) & (np.abs(V[:, 2]) > 1e-2)
        through = L[:, 2] * V[:, 2] < 0.0
        for part in (steady & ~through, steady & through):
            a, b = f[part], g[part]
            peak = max(np.nanmax(a, initial=0.0), np.nanmax(b, initial=0.0))
            strong = np.maximum(a, b) > 1e-4 * peak
            if not peak > 0.0 or not strong.any():
                continue
            if through[part].any():  # the one factor: n^2
                up = V[part, 2:] > 0.0
                sums = a[strong & up].sum(), b[strong & up].sum()
                ratio = sums[0] / sums[1] if sums[1] > 0.0 else 1.0
                b = np.where(up, b * ratio, b / ratio)
            off = np.where(strong, np.abs(a - b) / np.maximum(np.maximum(a, b), 1e-300), 0.0)
            off = np.nan_to_num(off, nan=0.0)
            i = int(off.max(axis=1).argmax())
            pair = f"{_degrees(L[part][i])}, {_degrees(V[part][i])}"
            what = f"f(L, V) and f(V, L) differ by {off.max():.2%} for {pair}"
            self.findings.note("reciprocal", float(off.max()), values, what)

    def _conserving(self, values):
        """Sum the light that leaves, for light from all angles, as finely as doubt asks for."""
        if self.findings.settled("conserving", values):
            return
        pairs, weights, angles, turns = self._furnace(self.both and measure.index_of(values))
        found = self.instrument.scatter(self.model, values, pairs, strict=True)
        sums = np.einsum("kmc,km->kc", found.reshape(*weights.shape, 3), weights).max(axis=1)
        sums = np.nan_to_num(sums, nan=0.0)
        i = int(sums.argmax())
        most = float(sums[i])
        if most > 1.0 + TOLERANCE["conserving"] and self.model.covers("conserving", values):
            for nodes in (8, 16):
                finer, error = measure.albedo(
                    self.instrument, self.model, values, [angles[i]], turns[i], nodes, self.both
                )
                if error[0] < TOLERANCE["conserving"] / 2.0:
                    break
            if error[0] > RESOLVED:
                return  # a ridge too narrow for the panels: nothing can be said
            most = float(finer.max() - error[0])
        what = f"the albedo is {most:.6g} for light at {math.degrees(angles[i]):.4g} degrees"
        self.findings.note("conserving", most - 1.0, values, what)

    def _furnace(self, index):
        """Return (Pairs, weights (k, m), angles (k,), azimuths (k,)) for an index of refraction."""
        if index not in self._furnaces:
            sets = [measure.albedo_pairs(self.angles, turn, 4, index) for turn in self.turns]
            L, V, weights = (np.concatenate(part) for part in zip(*sets, strict=True))
            pairs = self.instrument.pairs(L.reshape(-1, 3), V.reshape(-1, 3))
            angles = np.tile(self.angles, len(self.turns))
            turns = np.repeat(self.turns, len(self.angles))
            self._furnaces[index] = pairs, weights, angles, turns
        return self._furnaces[index]

    def forget(self):
        """Free what the hard cases take on the graphics card."""
        furnaces = (furnace[0] for furnace in self._furnaces.values())
        for pairs in (self.cases, self.compared, self.turned, *furnaces):
            self.instrument.forget(pairs)

    def _error(self, values, corner, what):
        """Compare float32 with float64, and with what the rounding of float32 input alone does."""
        reference = self.references[what]
        found = getattr(self.instrument, what)(self.model, values, self.compared)
        try:
            figures = deviation(self.model, values, what, reference, found, *self.fair)
        except (TypeError, KeyError):
            self.references.pop(what)  # another model of that name
            return
        if figures:
            self.found["corners" if corner else "default"].append(figures)

    def _place(self, values, i, what):
        if what == "surround":
            return f"V {_degrees(self.V[i])}; {self.model.changes(values)}"
        return f"{_degrees(self.L[i])}, {_degrees(self.V[i])}; {self.model.changes(values)}"


def deviation(model, values, what, reference, found, L, V):
    """Return how far float32 is off float64, relative to it, as `audit.audit` tells; None in black.

    what is "scatter" or "surround", and found (n, 3) what the card says of it for L, V (n, 3);
    reference is one of `references`, which raises TypeError or KeyError where it is of another
    model. inherent is what the rounding of float32 input alone does, beyond the error without it.
    """
    given = model.in_radians(values)

    def true(L, V, given):
        if what == "surround":
            return np.maximum(reference(V, np.ones_like, **given), 0.0)
        return reference(L, V, **given)

    exact = true(L, V, given)
    counted = exact > PEAK * exact.max(initial=0.0)
    if not counted.any():
        return None
    size = np.where(counted, exact, 1.0)
    error = np.where(counted, np.abs(found.astype(np.float64) - exact) / size, 0.0)
    inherent = np.zeros_like(error)
    for seed in range(MOVES):
        moved = true(*hostile.moved(L, V, seed), hostile.rounded(given, seed))
        inherent = np.maximum(inherent, np.where(counted, np.abs(moved - exact) / size, 0.0))
    beyond = np.maximum(error - 3.0 * inherent, 0.0)
    i = int(beyond.max(axis=1).argmax())
    return {
        "max": float(error.max()),
        "p99": float(np.quantile(error[counted], 0.99)),
        "inherent": float(error.max() - beyond.max()),
        "beyond": float(beyond.max()),
        "where": f"{_degrees(L[i])}, {_degrees(V[i])}; {model.changes(values)}",
    }


def references(model):
    """Return {"scatter": function, "surround": function} of `reference` for what a file says it is.

    That is a model of ours with its file name or its title: a copy is held against the original.
    """
    name = os.path.splitext(os.path.basename(model.path))[0]
    if name not in catalog.names("model"):
        title = model.header.get("model")
        ours = (catalog.read("model", one) for one in catalog.names("model"))
        name = next((one.name for one in ours if one.header["model"] == title), name)
        if name not in catalog.names("model"):
            return {}
    found = {"scatter": name, "surround": f"{name}_surround"}
    found = {what: getattr(reference, key, None) for what, key in found.items()}
    return {what: f for what, f in found.items() if f and what in model.defines}


def _degrees(w):
    """Return a direction in words: its angles from the normal and around it."""
    theta = math.degrees(math.atan2(math.hypot(w[0], w[1]), w[2]))
    phi = math.degrees(math.atan2(w[1], w[0]))
    return f"({theta:.6g}, {phi:.4g}) degrees"
