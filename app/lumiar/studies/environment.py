"""A sphere in a furnace and in a photograph of a place: ways to draw directions, against sums."""

import numpy as np

from .. import catalog, measure, reference, study, surroundings
from ..estimate import Estimator, Way, costs
from ..notation import number
from ..parts import Light, Object
from ..study import Metric, Remark, Shown

TITLE = {
    "en": "Environment: which directions to draw",
    "pt": "Ambiente: que direções sortear",
}
SECONDS = (70.0, 7.0)
ERROR, ALL = "rms", "all"
METRICS = {ERROR: Metric(0.01, 1e-3)}  # what the sums of the truth leave is below that
MATERIALS = {  # name: (model, values)
    "lambert": ("lambert", {}),
    "gold 0.3": ("rough_conductor", {"alpha": 0.3}),
    "gold 0.1": ("rough_conductor", {"alpha": 0.1}),
}
CASES = {
    False: [
        ("furnace", "gold 0.3"),
        *(("venice", name) for name in MATERIALS),
        *(("studio", name) for name in ("lambert", "gold 0.3")),  # 0.1 would need finer sums
    ],
    True: [("venice", "gold 0.3")],
}
COUNTS = {False: (1, 4, 16, 64, 256, 1024), True: (1, 4, 16)}
WAYS = {
    "even": ("evenly over the hemisphere", "uniformes no hemisfério"),
    "cosine": ("by the cosine", "pelo cosseno"),
    "model": ("by the material", "pelo material"),
    "light": ("by the light", "pela luz"),
    "both": ("by each of both, weighted", "por cada um dos dois, com pesos"),
}
TOLD = 64  # directions that ways are held against each other with
PLACES, SEEDS, ROWS = 64, 32, 128  # of the sphere; random numbers for each; rows while timed
FAR = 0.9  # share of the visible disk's radius: beyond, sums would need finer nodes
EYE = (0.0, 0.0, 4.0)
PICTURE, SHOWN, CONVERGED = 72, 16, 1024  # pixels a side; directions; for what is held right
WHITE = 2.0  # mean radiances that are shown as white
GOLDEN = 2.399963229728653  # radians
NAMES = {
    "furnace": ("furnace", "forno branco"),
    "venice": ("photograph of Venice", "fotografia de Veneza"),
    "studio": ("studio with small bright lamps", "estúdio com lâmpadas pequenas e fortes"),
    "lambert": ("matt", "fosco"),
    "gold 0.3": ("gold, α = 0.3", "ouro, α = 0,3"),
    "gold 0.1": ("gold, α = 0.1", "ouro, α = 0,1"),
}
WORDS = {
    ERROR: {
        "en": "RMS error of the radiance, over its mean",
        "pt": "erro RMS da radiância, sobre sua média",
    },
    ALL: {
        "en": "the worst of all of these, and the mean time",
        "pt": "o pior de todos esses, e o tempo médio",
    },
    **{
        f"{place} {material}": {
            "en": f"{NAMES[material][0]} in a {NAMES[place][0]}",
            "pt": f"{NAMES[material][1]}: {NAMES[place][1]}",
        }
        for place, material in CASES[False]
    },
    **{
        f"{drawn} {n}": {"en": f"{n} {en}", "pt": f"{n} {pt}"}
        for drawn, (en, pt) in WAYS.items()
        for n in COUNTS[False]
    },
}


SAYS = {
    "en": "{n} directions {way} err up to {more} times as much as by each of both ({case}).",
    "pt": "{n} direções {way} erram até {more} vezes o que se erra pelos dois ({case}).",
}


def material(name):
    """Return the Object of a material."""
    model, values = MATERIALS[name]
    kind = catalog.read("model", model)
    return Object(kind, {**kind.defaults(), **values})


def light(place):
    """Return the Light of a place, of radiance as its picture has it, or 1 in the furnace."""
    kind = catalog.read("light", "furnace" if place == "furnace" else "environment")
    image = "" if place == "furnace" else place
    return Light(kind, {**kind.defaults(), "radiance": 1.0}, image=image)


def sphere(u):
    """Return points (n, 3) of the unit sphere seen from +z, at places u (n, 2) of a disk."""
    return np.concatenate([u, np.sqrt(1.0 - (u * u).sum(axis=1, keepdims=True))], axis=1)


def spiral(count):
    """Return (count, 2) places spread evenly over a disk."""
    i = np.arange(count)
    r = FAR * np.sqrt((i + 0.5) / count)
    return np.stack([r * np.cos(GOLDEN * i), r * np.sin(GOLDEN * i)], axis=1)


def truth(place, name, points, fine=1):
    """Return the radiance (n, 3) that points of the unit sphere send to the eye, in float64.

    Sums over directions: in the furnace by measure.hemisphere, else over the image, see `nodes`;
    of its pixels they are within 3e-4.
    """
    one = material(name)
    model = getattr(reference, one.model.name)
    V = np.array(EYE) - points
    V /= np.linalg.norm(V, axis=1, keepdims=True)
    ways, weights = (None, None) if place == "furnace" else nodes(place, fine)
    found = []
    for normal, view in zip(points, V, strict=True):
        side = np.cross(normal, (0.0, 1.0, 0.0))
        side /= np.linalg.norm(side)
        axes = np.stack([side, np.cross(normal, side), normal])
        view = axes @ view
        if place == "furnace":
            turn = np.arctan2(-view[1], -view[0])
            L, shares = measure.hemisphere(np.arccos(view[2]), turn, 6)
            shares = shares[:, None] / L[:, 2:]
        else:
            above = ways @ normal > 0.0
            L, shares = ways[above] @ axes.T, weights[above]
        values = model(L, np.broadcast_to(view, L.shape), **one.values)
        found.append((values * shares).sum(axis=0))
    return np.array(found)


def nodes(image, fine):
    """Return directions (n, 3) all around and radiance times solid angle (n, 3) of an image.

    As lights/environment.glsl has it: linear between the middles of its pixels. fine: each is cut
    into as many parts each way.
    """
    texels = surroundings.given(light(image))["picture"]
    wide, high = texels.size
    pixels = np.frombuffer(texels.data, np.float32).reshape(high, wide, 3).astype(float)
    for axis, edge in ((0, "edge"), (1, "wrap")):
        at = (np.arange(pixels.shape[axis] * fine) + 0.5) / fine - 0.5
        low, t = np.floor(at).astype(int), at - np.floor(at)
        pad = [(1, 1) if axis == k else (0, 0) for k in range(3)]
        wider = np.moveaxis(np.pad(pixels, pad, edge), axis, 0)
        t = t[:, None, None]
        pixels = np.moveaxis((1.0 - t) * wider[low + 1] + t * wider[low + 2], 0, axis)
    high, wide = pixels.shape[:2]
    polar = (np.arange(high) + 0.5) * np.pi / high
    turn = 2.0 * np.pi * (0.5 - (np.arange(wide) + 0.5) / wide)
    cell = 2.0 * np.sin(polar) * np.sin(0.5 * np.pi / high) * 2.0 * np.pi / wide
    s = np.sin(polar)[:, None]
    ways = np.stack(
        np.broadcast_arrays(s * np.sin(turn), np.cos(polar)[:, None], s * np.cos(turn)), -1
    )
    return ways.reshape(-1, 3), (pixels * cell[:, None, None]).reshape(-1, 3)


def run(bench):
    """Yield the points and pictures of this study."""
    counts = COUNTS[bench.quick]
    ways = {f"{d} {n}": Way(d, "spread", n) for d in WAYS for n in counts}
    points = sphere(spiral(PLACES)).astype(np.float32)
    u = (np.stack(np.meshgrid(*[np.arange(PICTURE)] * 2), -1) + 0.5) * (2.0 / PICTURE) - 1.0
    u[..., 1] *= -1.0
    seen = np.linalg.norm(u, axis=-1) < 1.0
    disk = np.broadcast_to((0.0, 0.0, 1.0), (*u.shape[:2], 3)).copy()
    disk[seen] = sphere(u[seen])
    with Estimator(bench.instrument.context) as estimator:
        timed = estimator.pieces(*[np.broadcast_to(points, (ROWS, PLACES, 3))] * 2)
        held = estimator.pieces(*[np.broadcast_to(points, (SEEDS, PLACES, 3))] * 2)
        shown = estimator.pieces(disk, disk)
        found = []
        for place, name in CASES[bench.quick]:
            one, lamp, case = material(name), light(place), f"{place} {name}"
            jobs = {variant: (one, lamp, EYE, way) for variant, way in ways.items()}
            seconds = 0.6 * SECONDS[bench.quick] / len(CASES[bench.quick])
            spent = costs(bench, estimator, jobs, timed, seconds)
            true = truth(place, name, points.astype(float))
            for variant, way in ways.items():
                radiance = estimator.radiance(held, one, lamp, EYE, way)
                error = float(np.sqrt(np.mean((radiance - true) ** 2)) / true.mean())
                facts = {"samples": float(way.samples)}
                more = (spent[variant], "ns", False, facts)
                found += study.points(case, variant, {ERROR: error}, *more)
            if name == "gold 0.3" and place != "furnace" and not bench.quick:
                yield from _pictures(estimator, shown, one, lamp, seen, case)
        yield from found
        if not bench.quick:
            yield from together(found)
            yield from remarks(found)


def together(found):
    """Yield a Point for each variant with its largest error in all cases and its mean cost.

    Lumiar's default has to do for all of them, so that it is held to this.
    """
    for variant in dict.fromkeys(p.variant for p in found):
        own = [p for p in found if p.variant == variant]
        costs = {
            key: float(np.mean([getattr(p, key) for p in own])) for key in ("cost", "low", "high")
        }
        error, default = max(p.error for p in own), variant == "both 16"
        yield own[0]._replace(case=ALL, error=error, default=default, **costs)


def remarks(found):
    """Yield how much worse each way alone can be than both together, with as many directions."""
    errors = {(p.case, p.variant): p.error for p in found}
    for way in WAYS:
        if way != "both":
            ratios = {
                case: error / errors[case, f"both {TOLD}"]
                for (case, variant), error in errors.items()
                if variant == f"{way} {TOLD}"
            }
            case = max(ratios, key=ratios.get)
            yield Remark(
                *(
                    SAYS[lang].format(
                        n=TOLD, way=name, more=number(ratios[case], 2, lang), case=WORDS[case][lang]
                    )
                    for lang, name in zip(("en", "pt"), WAYS[way], strict=True)
                )
            )


def _pictures(estimator, shown, one, lamp, seen, case):
    """Yield a picture of each way; errors from one of many directions, other than the truth."""
    whole = estimator.radiance(shown, one, lamp, EYE, Way("both", "random", CONVERGED))
    mean = whole[seen].mean()
    for drawn in WAYS:
        pixels = estimator.radiance(shown, one, lamp, EYE, Way(drawn, "spread", SHOWN))
        off = np.abs(pixels - whole).max(axis=-1) / mean
        shown_as = pixels * (seen[..., None] / (WHITE * mean))
        yield Shown(case, f"{drawn} {SHOWN}", shown_as, off * seen)
