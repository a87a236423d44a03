"""A virtual gonioreflectometer: any model at any directions, as arrays, and what it costs.

Directions are (n, 3) unit, away from the surface, in the local frame. The model runs on the
graphics card in float32, the very text that draws pictures (`compose.measured`).
"""

import math
from typing import NamedTuple

import numpy as np

from . import catalog, compose, layout, timing
from .card import OnCard, compiled

WIDTH = 1024  # pairs in a row of a texture
PROGRAMS = 64  # kept, those that were used last: a model that is edited is another one every time
TIMED = (256, 8)  # pixels a side and the least repeats of a timed run
LONG = 4e-3  # seconds of a timed run: others rarely interrupt it, and its start does not count
EMPTY = "// model   Nothing\nvec3 scatter(vec3 L, vec3 V) { return vec3(0.0); }\n"
NOTHING = catalog.parse("model", "nothing", "nothing.glsl", EMPTY), {}


class Pairs(NamedTuple):
    """Pairs of directions on the graphics card: their number and the textures of L and V."""

    count: int
    L: object
    V: object
    target: object


class Instrument(OnCard):
    """Evaluates models; release it or use `with`."""

    def __init__(self, context=None):
        super().__init__(context)
        self._programs, self._pairs, self._timed = {}, [], None
        self._repeats, self._clock = 0, None  # of a timed run, see costs

    def _free(self):
        for program, array in self._programs.values():
            array.release()
            program.release()
        for pairs in self._pairs:
            self._free_pairs(pairs)

    def pairs(self, L, V):
        """Return Pairs of directions (n, 3) each, to be measured as often as wanted."""
        return self._upload(L, V, (WIDTH, max(1, -(-len(L) // WIDTH))))

    def forget(self, pairs):
        """Free the memory of Pairs."""
        with self.context:  # another one may be the current one
            self._free_pairs(pairs)
        self._pairs = [one for one in self._pairs if one is not pairs]

    def _free_pairs(self, pairs):
        self.free_framebuffer(pairs.target)
        pairs.L.release()
        pairs.V.release()

    def scatter(self, model, values, pairs, strict=False):
        """Return f(L, V) |N.L| of a model for Pairs, (n, 3) float32 [1/sr]; NaN where cut short.

        model is a catalog.Shader, values {parameter: value} as a Scene's object holds them. strict
        keeps every NaN, which drivers may drop in max, min and clamp. Raises Mistake naming
        file:line for what the driver does not compile.
        """
        with self.context:
            return self._measured(model, values, pairs, "scatter", strict)

    def surround(self, model, values, pairs, strict=False):
        """Return the radiance toward V of Pairs, (n, 3) float32, when it is 1 all around."""
        with self.context:
            return self._measured(model, values, pairs, "surround", strict)

    def facet(self, model, values, pairs):
        """Return the Fresnel reflectance F_facet at N.V of Pairs, (n, 3) float32."""
        with self.context:
            return self._measured(model, values, pairs, "facet", False)

    def sampled(self, model, values, V, u):
        """Return L (n, 3), weight (n, 3) and pdf (n,) of sample_scatter for V (n, 3), u (n, 2)."""
        pairs = self.pairs(np.pad(np.asarray(u), ((0, 0), (0, 1))), V)
        with self.context:
            L = self._measured(model, values, pairs, "sampled", False).copy()
            weight = self._measured(model, values, pairs, "weighed", False).copy()
        self.forget(pairs)
        return L, weight, self.density(model, values, L, V)

    def density(self, model, values, L, V):
        """Return scatter_pdf(L, V) of a model for (n, 3) directions each, (n,) float32 [1/sr]."""
        pairs = self.pairs(L, V)
        with self.context:
            found = self._measured(model, values, pairs, "density", False)[:, 0].copy()
        self.forget(pairs)
        return found

    def cost(self, model, values):
        """Return (ns of an evaluation, width of its interval), those of an empty model taken off.

        Only its ratio to another model's on the same machine means anything.
        """
        found = self.costs([(model, values)], 0.1)[0]
        return found.cost, found.high - found.low

    def costs(self, jobs, seconds, clock=None):
        """Return a timing.Timing in ns of an evaluation for each of the (model, values).

        They race each other and an empty model, whose time is taken off, for about so many seconds,
        on directions that are all above the surface. clock: `timing.believed`'s, unless given.
        """
        if not (clock or self._clock):
            self._clock = timing.believed(self.context, [self.timed(*NOTHING, 64)])
        clock = clock or self._clock
        runs, count = self.racers(jobs, clock)
        found = timing.race(runs, clock, seconds, empty=0, spread=True)
        return [one.per(count) for one in found[1:]]

    def racers(self, jobs, clock):
        """Return [job, …] of a run of the empty model and of each (model, values), evaluations."""
        if not self._repeats:  # a run long enough to be timed, whatever the card
            self._repeats = TIMED[1]
            clock.time(self.timed(*NOTHING))
            while clock.time(self.timed(*NOTHING))[1] < LONG and self._repeats < 1 << 14:
                self._repeats *= 2
        return [self.timed(*job) for job in (NOTHING, *jobs)], TIMED[0] ** 2 * self._repeats

    def timed(self, model, values, repeats=None):
        """Return the job of evaluating a model at all pixels of a timed run, again and again."""
        repeats = repeats or self._repeats

        def job():
            pairs = self._timed_pairs()
            with self.context:
                array = self._prepared(model, values, "timed", repeats)
                pairs.target.use()
                pairs.L.use(0)
                pairs.V.use(1)
                array.render(vertices=3)

        return job

    def _timed_pairs(self):
        """Return Pairs above the surface, spread evenly, in a square texture of TIMED pixels."""
        if not self._timed:
            generator = np.random.default_rng(1)
            L, V = (upper(generator.random((TIMED[0] ** 2, 2))) for _ in range(2))
            self._timed = self._upload(L, V, (TIMED[0], TIMED[0]))
        return self._timed

    def _upload(self, L, V, size):
        textures = []
        with self.context:
            for w in (L, V):
                texels = np.zeros((size[0] * size[1], 4), np.float32)
                texels[: len(w), :3] = w
                texels[len(w) :] = (0.0, 0.0, 1.0, 0.0)
                textures.append(self.context.texture(size, 4, texels, dtype="f4"))
            target = self.context.framebuffer([self.context.texture(size, 4, dtype="f4")])
        pairs = Pairs(len(L), *textures, target)
        self._pairs.append(pairs)
        return pairs

    def _measured(self, model, values, pairs, what, strict):
        array = self._prepared(model, values, what, strict=strict)
        pairs.target.use()
        pairs.L.use(0)
        pairs.V.use(1)
        array.render(vertices=3)
        data = np.frombuffer(pairs.target.read(components=4, dtype="f4"), np.float32)
        return data.reshape(-1, 4)[: pairs.count, :3]

    def active(self, model, values):
        """Return the names of the parameters that count under the choices and toggles of values."""
        with self.context:
            program = self._prepared(model, values, "scatter", strict=True).program
        return [p.name for p in model.parameters if p.name in program]

    def _prepared(self, model, values, what, repeats=0, strict=False):
        """Return the vertex array that evaluates a model with these values, compiled once."""
        constants = model.constants(values)
        key = (model.source, what, strict, *constants.items())
        if key not in self._programs:
            program = compiled(self.context, compose.measured(model, constants, what, strict))
            self._programs[key] = program, self.context.vertex_array(program, [])
        program, array = self._programs[key] = self._programs.pop(key)  # the last one used
        if len(self._programs) > PROGRAMS:
            for made in reversed(self._programs.pop(next(iter(self._programs)))):
                made.release()
        for name, value in layout.packed(model, values, 0.0, "").items():
            if name in program:
                program[name].write(value)
        for name, value in (
            ("rig_L", 0),
            ("rig_V", 1),
            ("rig_repeats", repeats),
            ("rig_tiny", 1e-30),
        ):
            if name in program:
                program[name].value = value
        self.context.enable_only(0)
        return array


def upper(u):
    """Return directions (n, 3) spread evenly over the upper hemisphere; u is (n, 2) in [0, 1)."""
    z = 1.0 - u[:, 0]
    r, phi = np.sqrt((1.0 - z) * (1.0 + z)), 2.0 * math.pi * u[:, 1]
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1)


def polar(theta, phi):
    """Return directions (n, 3) at angles theta from the normal and phi from the tangent, radians.

    cos(theta) is 0 exactly at a right angle, which cos() itself misses by 6e-17.
    """
    theta, phi = np.broadcast_arrays(np.asarray(theta, np.float64), phi)
    s, z = np.sin(theta), np.where(theta == math.pi / 2.0, 0.0, np.cos(theta))
    return np.stack([s * np.cos(phi), s * np.sin(phi), z], axis=-1)


def hemisphere(theta, phi, nodes, below=False, shrink=3.0):
    """Return (directions (m, 3), weights (m,)): sum f w = integral of f |cos| over a hemisphere.

    Gauss-Legendre panels that shrink geometrically toward the direction (theta, phi) in radians,
    where a lobe may stand, `shrink` times from one to the next; nodes per panel. below turns them
    to the lower hemisphere.
    """
    t, wt = _panels(min(max(theta, 0.0), math.pi / 2.0), 0.0, math.pi / 2.0, nodes, shrink)
    p, wp = _panels(0.0, -math.pi, math.pi, nodes, shrink)
    t, p = np.repeat(t, len(p)), np.tile(p, len(t)) + phi
    weights = np.repeat(wt, len(wp)) * np.tile(wp, len(wt)) * np.sin(t) * np.cos(t)
    w = polar(t, p)
    return (w * [1.0, 1.0, -1.0] if below else w), weights


def _panels(centre, low, high, nodes, shrink):
    """Return (points, weights) of Gauss-Legendre panels that shrink toward `centre`."""
    steps = (high - low) * shrink ** -np.arange(0.0, 11.0 / math.log(shrink))
    edges = np.concatenate([[low, centre, high], centre - steps, centre + steps])
    edges = np.unique(np.clip(edges, low, high))
    x, w = np.polynomial.legendre.leggauss(nodes)
    half = np.diff(edges) / 2.0
    points = (edges[:-1] + half)[:, None] + half[:, None] * x
    return points.ravel(), (half[:, None] * w).ravel()


def albedo(instrument, model, values, angles, azimuth=0.0, nodes=6, transmits=True):
    """Return (albedo (k, 3), its error (k,)) for light from k angles of incidence, in radians.

    The share of the light that leaves again, a(l) = integral of f |cos theta_v| over all directions
    (F. Nicodemus, 1977), below the surface too if it `transmits`. The error is the change to
    other panels with three quarters of the nodes. Angles beyond a right angle are light from below.
    """
    found = []
    for n, shrink in ((nodes, 3.0), (max(2, nodes * 3 // 4), 2.1)):
        index = transmits and index_of(values)
        L, V, weights = albedo_pairs(angles, azimuth, n, index, shrink)
        pairs = instrument.pairs(L.reshape(-1, 3), V.reshape(-1, 3))
        scatter = instrument.scatter(model, values, pairs).reshape(len(L), -1, 3)
        instrument.forget(pairs)
        found.append(np.einsum("kmc,km->kc", scatter.astype(np.float64), weights))
    return found[0], np.abs(found[0] - found[1]).max(axis=1)


def albedo_pairs(angles, azimuth, nodes, index, shrink=3.0):
    """Return L, V (k, m, 3) and weights (k, m): see `hemisphere`; 1/|cos theta_l| is within.

    index is that of refraction below over above, or False for light that does not pass.
    """
    sets = []
    for theta in angles:
        L = polar(theta, azimuth)
        flat = theta if theta <= math.pi / 2.0 else math.pi - theta
        turn, below = azimuth + math.pi, theta > math.pi / 2.0
        parts = [hemisphere(flat, turn, nodes, below, shrink)]
        if index:
            n = index if theta <= math.pi / 2.0 else 1.0 / index
            bent = math.asin(min(1.0, math.sin(flat) / n))
            parts.append(hemisphere(bent, turn, nodes, not below, shrink))
        V, w = (np.concatenate(one) for one in zip(*parts, strict=True))
        sets.append((np.broadcast_to(L, V.shape), V, w / abs(L[2])))
    most = max(len(w) for _, _, w in sets)  # every angle has its own panels: fill up with nothing
    up = np.array([0.0, 0.0, 1.0])
    L, V = (np.zeros((len(sets), most, 3)) + up for _ in range(2))
    weights = np.zeros((len(sets), most))
    for i, (one, other, w) in enumerate(sets):
        L[i, : len(w)], V[i, : len(w)], weights[i, : len(w)] = one, other, w
    return L, V, weights


def index_of(values):
    """Return the index of refraction among a model's values, 1 where it has none."""
    eta = values.get("eta", 1.0)
    return eta if isinstance(eta, float) else 1.0
