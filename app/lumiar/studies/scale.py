"""What a frame costs with more pixels, triangles, lights, objects, beside one of one colour."""

import math

import numpy as np

from .. import geometry, study
from ..measure import NOTHING
from ..scene import Scene
from ..study import Metric, Point, Remark

TITLE = {
    "en": "Scale: pixels, triangles, lights, objects",
    "pt": "Escala: pixels, triângulos, luzes, objetos",
}
SECONDS = (45.0, 7.0)
TIME, MEMORY = "time", "memory"
METRICS = {TIME: Metric(math.inf, 0.0), MEMORY: Metric(math.inf, 0.0)}
COUNTS = {  # case: how many of it, in full and quickly
    "pixels": (
        [side**2 for side in (256, 512, 1024, 2048, 4096)],
        [side**2 for side in (256, 512, 1024)],
    ),
    "triangles": ([4**n for n in range(5, 12)], [4**n for n in range(5, 9)]),
    "lights": ([1, 2, 4, 8, 16, 32, 64], [1, 4, 16]),
    "objects": ([1, 4, 16, 64, 256], [1, 16, 64]),
}
OURS, FLOOR = "phong", "floor"
OPEN, WIDE = 0.5, 2.0  # widths of intervals that tell nothing: of an exponent, of a ratio
STORED = ("pixels", "triangles")  # what takes memory
PORTUGUESE = {"triangles": "triângulos", "lights": "luzes", "objects": "objetos"}
WORDS = {
    TIME: {"en": "time of a frame", "pt": "tempo de um quadro"},
    MEMORY: {
        "en": "memory of the picture and its depth, or of the mesh",
        "pt": "memória da imagem e sua profundidade, ou da malha",
    },
    **{case: {"en": case, "pt": PORTUGUESE.get(case, case)} for case in COUNTS},
    **{
        f"{case}, {MEMORY}": {
            "en": f"{case}: memory on the card",
            "pt": f"{PORTUGUESE.get(case, case)}: memória na placa",
        }
        for case in STORED
    },
    **{
        f"{which} {n} {case}": {
            "en": f"{'Phong' if which == OURS else 'one colour'}, {case}: {n:,}",
            "pt": f"{'Phong' if which == OURS else 'uma só cor'}, {PORTUGUESE.get(case, case)}: "
            + f"{n:,}".replace(",", "."),
        }
        for case, (counts, _) in COUNTS.items()
        for n in counts
        for which in (OURS, FLOOR)
    },
}
SAYS = {
    "en": "At the large end time grows as the {power} power of the number of {case}; {most} of"
    " them take {ratio} times as long as in one colour.",
    "pt": "Na ponta grande o tempo cresce com a potência {power} do número de {case}; {most}"
    " levam {ratio} vezes o tempo de uma só cor.",
}


def scene(case, n):
    """Return the Scene with n of what a case counts: Phong, 512 x 512 pixels, a far light."""
    one = Scene.default().set(model="phong", size=(512, 512), samples=1)
    one = one._replace(lights=one.lights[:1])
    if case == "pixels":
        return one._replace(size=(math.isqrt(n),) * 2)
    if case == "triangles":
        return one.set(mesh=f"torus:rings={math.isqrt(n)}:segments={math.isqrt(n) // 2}")
    if case == "lights":
        return one._replace(lights=one.lights * n)
    ball = one.objects[0]._replace(mesh="sphere:subdivision=3")
    side = math.isqrt(n)
    places = ((2.2 * (i % side), 2.2 * (i // side), 0.0) for i in range(n))
    return one._replace(objects=tuple(ball._replace(position=at) for at in places))


def floor(one):
    """Return a Scene with the same geometry, in one colour, which no light is needed for."""
    objects = tuple(o._replace(model=NOTHING[0], values=NOTHING[1]) for o in one.objects)
    return one._replace(objects=objects, lights=())


def run(bench):
    """Yield the points and remarks of this study."""
    for case, counts in COUNTS.items():
        chosen = counts[bench.quick]
        scenes = {(OURS, n): scene(case, n) for n in chosen}
        scenes |= {(FLOOR, n): floor(scene(case, n)) for n in chosen}
        with _Targets(bench) as targets:
            jobs = {key: targets.drawing(one) for key, one in scenes.items()}
            spent = bench.race(jobs, SECONDS[bench.quick] / 5.0)
        found = []
        for (which, n), timing in spent.items():
            name, facts = f"{which} {n} {case}", {"count": float(n)}
            timing = timing.per(1, 1e-3)
            found += study.points(case, name, {TIME: None}, timing, "ms", parameters=facts)
        yield from found
        yield from said(case, found)
        for n in chosen if case in STORED else ():
            size = memory(case, scenes[OURS, n]) / 1e6
            facts = {"parameters": {"count": float(n)}}
            cost = (None, size, size, size, 0.0, "MB")
            yield Point("", f"{case}, {MEMORY}", f"{OURS} {n} {case}", MEMORY, *cost, **facts)


class _Targets:
    """Framebuffers to draw into, one for each size: a race changes size at every turn."""

    def __init__(self, bench):
        self.renderer, self.made = bench.renderer, {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with self.renderer.context:
            for one in self.made.values():
                self.renderer.free_framebuffer(one)

    def drawing(self, one):
        """Return the job of drawing the radiance of a Scene."""
        if one.size not in self.made:
            with self.renderer.context as context:
                texture = context.texture(one.size, 4, dtype="f4")
                depth = context.depth_renderbuffer(one.size)
                self.made[one.size] = context.framebuffer([texture], depth)

        def job():
            with self.renderer.context:
                self.renderer.draw(one, self.made[one.size])

        return job


def memory(case, one):
    """Return the bytes of what a case has more of, on the card: 4 floats and a depth a pixel."""
    if case == "pixels":
        return 20 * one.size[0] * one.size[1]
    mesh = geometry.load(one.objects[0].mesh)
    return len(mesh.vertices) + len(mesh.indices)


def power(points):
    """Return (low, high) of the exponent that cost grows with at the large end, [] of a count.

    The slope of a straight line through the logarithms of the upper half, as steep and as flat as
    the intervals of the costs allow.
    """
    upper = points[len(points) // 2 :] if len(points) > 3 else points[-2:]
    x = np.log([p.parameters["count"] for p in upper])
    x -= x.mean()
    low, high = (np.log([getattr(p, end) for p in upper]) for end in ("low", "high"))
    slopes = [x @ np.where(x > 0.0, *pair) / (x @ x) for pair in ((low, high), (high, low))]
    return tuple(map(float, slopes))


def said(case, found):
    """Yield the Remark that the points of a case support, none where noise leaves too much open."""
    ours, base = ([p for p in found if p.variant.startswith(w)] for w in (OURS, FLOOR))
    low, high = power(ours)
    least, most = ours[-1].low / base[-1].high, ours[-1].high / base[-1].low
    if high - low > OPEN or not 0.0 < most < WIDE * least:
        return
    facts = {"most": f"{round(ours[-1].parameters['count']):,}", "power": _between(low, high)}
    facts["ratio"] = _between(least, most)
    swapped = str.maketrans(",.", ".,")
    portuguese = {name: text.translate(swapped) for name, text in facts.items()}
    yield Remark(
        SAYS["en"].format(case=WORDS[case]["en"], **facts),
        SAYS["pt"].format(case=WORDS[case]["pt"], **portuguese),
    )


def _between(low, high):
    low, high = f"{low:.1f}", f"{high:.1f}"
    return low if low == high else f"{low}–{high}"
