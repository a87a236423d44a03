"""A square lamp over a matt floor: closed form against sums over more and more points of it."""

import os

import numpy as np

from .. import catalog, factors, study
from ..estimate import Estimator, Way, costs
from ..files import GLSL
from ..notation import number
from ..parts import Light, Object
from ..study import RELATIVE, Remark, Shown

TITLE = {
    "en": "Area light: closed form or samples",
    "pt": "Luz de área: forma fechada ou amostras",
}
SECONDS = (60.0, 6.0)
ERROR = "rms"
METRICS = {ERROR: RELATIVE}
SIZES = {False: (0.1, 1.0, 10.0), True: (1.0,)}  # of the lamp, over its height
COUNTS = {False: (1, 4, 16, 64, 256, 1024, 4096), True: (1, 4, 64)}
PLACES, SEEDS, ROWS = 128, 16, 64  # of the floor; random numbers for each; rows while timed
PICTURE, SHOWN = 96, 4  # pixels a side; samples
EXACT, EDGES = "closed", "edges"
KINDS = ("area", "angle")
POINTS = {
    "random": ("random", "aleatórios"),
    "stratified": ("stratified", "estratificados"),
    "spread": ("low-discrepancy", "de baixa discrepância"),
}
WHAT = {
    "area": {"en": "points of its area", "pt": "pontos da área"},
    "angle": {"en": "directions to it", "pt": "pontos do ângulo sólido"},
}
WORDS = {
    ERROR: {
        "en": "RMS relative error of the radiance of the floor",
        "pt": "erro relativo RMS da radiância do chão",
    },
    EXACT: {"en": "closed form, stable (light Quad)", "pt": "forma fechada, estável (luz Quad)"},
    EDGES: {"en": "closed form, Lambert's sum as it stands", "pt": "forma fechada de Lambert"},
    **{
        f"size {s:g}": {
            "en": f"a lamp {s:g} m wide, 1 m above the floor",
            "pt": f"lâmpada de {number(s, lang='pt')} m de largura, 1 m acima do chão",
        }
        for s in SIZES[False]
    },
    **{
        f"{kind} {points} {n}": {
            "en": f"{WHAT[kind]['en']}, {en}: {n}",
            "pt": f"{WHAT[kind]['pt']}, {pt}: {n}",
        }
        for kind in KINDS
        for points, (en, pt) in POINTS.items()
        for n in COUNTS[False]
    },
}
FALLS = {
    "en": "{case}: with N {what} the error falls as {powers}.",
    "pt": "{case}: com N {what} o erro cai como {powers}.",
}
PRICE = {
    "en": "{case}: less than 1 % of error takes {names}; about {ratio} times the closed form.",
    "pt": "{case}: menos de 1 % de erro pede {names}; cerca de {ratio} vezes a forma fechada.",
}


def lamps(size):
    """Return {kind: parts.Light} of a square lamp, `size` wide and 1 above the floor."""
    folder = os.path.join(GLSL, "studies")
    kinds = {
        "angle": catalog.read("light", "quad"),
        "area": catalog.read("light", os.path.join(folder, "quad_by_area.glsl")),
        EDGES: catalog.read("light", os.path.join(folder, "quad_by_edges.glsl")),
    }
    values = {"position": (0.0, 1.0, 0.0), "width": size}
    lights = {name: Light(kind, {**kind.defaults(), **values}) for name, kind in kinds.items()}
    same = {**lights["angle"].values, "height": size, "radiance": 1.0}
    return lights | {"angle": lights["angle"]._replace(values=same)}


def truth(size, places, albedo):
    """Return the radiance (…) of a Lambertian floor at places (…, 3), in float64 (factors)."""
    h = size / 2.0
    corners = np.array([(-h, 1.0, -h), (h, 1.0, -h), (h, 1.0, h), (-h, 1.0, h)])
    up = np.array([0.0, 1.0, 0.0])
    twice = factors.vector_irradiance(places.reshape(-1, 3).astype(float), corners, up)[0]
    return (np.abs(twice) / 2.0 * albedo / np.pi).reshape(places.shape[:-1])


def floor(size, u):
    """Return places (…, 3) float32 of the floor, as far out as the lamp and its height, by u."""
    reach = size / 2.0 + 1.0
    x, z = np.moveaxis((2.0 * u - 1.0) * reach, -1, 0)
    return np.stack([x, 0.0 * x, z], axis=-1).astype(np.float32)


def ways(quick):
    """Return {variant: (which of lamps, Way)}."""
    found = {EXACT: ("angle", Way("exact")), EDGES: (EDGES, Way("exact"))}
    for kind in KINDS:
        for points in POINTS:
            for n in COUNTS[quick]:
                found[f"{kind} {points} {n}"] = kind, Way("light", points, n)
    return found


def run(bench):
    """Yield the points, pictures and remarks of this study."""
    model = catalog.read("model", "lambert")
    matt, eye = Object(model, model.defaults()), (0.0, 5.0, 0.0)
    u = (0.5 + np.outer(np.arange(PLACES), (0.7548776662, 0.5698402910))) % 1.0  # M. Roberts' R2
    grid = (np.stack(np.meshgrid(*[np.arange(PICTURE)] * 2), axis=-1) + 0.5) / PICTURE
    with Estimator(bench.instrument.context) as estimator:

        def pieces(places):
            return estimator.pieces(places, np.broadcast_to((0.0, 1.0, 0.0), places.shape))

        held, lights = pieces(np.broadcast_to(floor(1.0, u), (ROWS, PLACES, 3))), lamps(1.0)
        jobs = {v: (matt, lights[which], eye, way) for v, (which, way) in ways(bench.quick).items()}
        # where the lamp is hardly changes what it costs
        spent = costs(bench, estimator, jobs, held, SECONDS[bench.quick] * 0.7)
        for size in SIZES[bench.quick]:
            lights, case = lamps(size), f"size {size:g}"
            places = np.broadcast_to(floor(size, u), (SEEDS, PLACES, 3))
            flat = floor(size, grid)
            held, shown, found = pieces(places), pieces(flat), []
            true, seen = (truth(size, at, model.defaults()["albedo"][0]) for at in (places, flat))
            for variant, (which, way) in ways(bench.quick).items():
                light = lights[which]
                radiance = estimator.radiance(held, matt, light, eye, way)[..., 0]
                error = float(np.sqrt(np.mean((radiance / true - 1.0) ** 2)))
                facts = {"size": size, "samples": float(way.samples if " " in variant else 0)}
                timing = spent[variant]
                default = variant == EXACT
                more = (timing, "ns", default, facts)
                found += study.points(case, variant, {ERROR: error}, *more)
                if size == 1.0 and (way.drawn == "exact" or way.samples == SHOWN):
                    pixels = estimator.radiance(shown, matt, light, eye, way)
                    off = np.abs(pixels[..., 0] / seen - 1.0)
                    yield Shown(case, variant, pixels / seen.max(), off)
            yield from found
            yield from remarks(found)


def remarks(found):
    """Yield how fast errors fall, and what sampling costs until they do not show."""
    case = found[0].case
    for kind in KINDS:
        powers = {"en": [], "pt": []}
        for points, names in POINTS.items():
            own = [p for p in found if p.variant.startswith(f"{kind} {points} ")]
            first, last = own[0], own[-1]
            ratio = last.parameters["samples"] / first.parameters["samples"]
            power = np.log(last.error / first.error) / np.log(ratio)
            for lang, name in zip(powers, names, strict=True):
                powers[lang].append(f"N^{number(power, 2 - (power > -1.0), lang)} ({name})")
        yield _said(
            FALLS, case, what=WHAT[kind], powers={k: ", ".join(v) for k, v in powers.items()}
        )
    exact = next(p for p in found if p.variant == EXACT)
    enough = [p for p in found if p.error < METRICS[ERROR].visible and p.parameters["samples"] > 0]
    least = min(enough, key=lambda p: p.cost, default=None)
    if least and study.cheaper(exact, least):
        ratio = {lang: number(least.cost / exact.cost, 1, lang) for lang in PRICE}
        yield _said(PRICE, case, names=WORDS[least.variant], ratio=ratio)


def _said(words, case, **facts):
    """Return the Remark of words and facts {name: {language: text}} on a case."""
    texts = (
        words[lang].format(case=WORDS[case][lang], **{k: v[lang] for k, v in facts.items()})
        for lang in ("en", "pt")
    )
    return Remark(*(text[0].upper() + text[1:] for text in texts))
