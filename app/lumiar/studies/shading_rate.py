"""Flat, Gouraud and Phong shading of a sphere, on coarse and fine meshes, against the true one."""

from contextlib import suppress

import numpy as np

from .. import difference, reference, study
from ..colorimetry import srgb
from ..reference_terms import unit
from ..scene import Scene
from ..study import Metric, Remark, Shown

TITLE = {
    "en": "Shading rate: per face, per vertex or per pixel, against the true sphere",
    "pt": "Tonalização: por face, vértice ou pixel, contra a esfera verdadeira",
}
SECONDS = (60.0, 5.0)
FLIP, INSIDE = "flip", "rmse"
METRICS = {FLIP: Metric(0.01, 1e-4), INSIDE: Metric(0.5 / 255.0, 1e-6)}
SIDE = 256  # pixels
EXPONENTS = {False: (5.0, 50.0, 500.0), True: (50.0,)}
MESHES = {False: range(1, 9), True: range(1, 7)}  # subdivisions of an icosahedron
FINE = 6  # from this on a race is one of fine meshes
SHOWN = (2, 4)
RATES = {"flat": "flat", "gouraud": "Gouraud", "phong": "Phong"}
WORDS = {
    FLIP: {
        "en": "mean FLIP error of the picture, outline and all",
        "pt": "erro FLIP médio da imagem, com o contorno",
    },
    INSIDE: {
        "en": "RMS error inside the outline of both (share of the brightest pixel)",
        "pt": "erro RMS dentro do contorno de ambas (fração do pixel mais claro)",
    },
    **{
        f"m = {m:g}": {
            "en": f"Phong's lobe, exponent {m:g}",
            "pt": f"lobo de Phong, expoente {m:g}",
        }
        for m in EXPONENTS[False]
    },
    **{
        f"{rate} {20 * 4**n}": {
            "en": f"{name} on {20 * 4**n:,} triangles",
            "pt": f"{name} em {20 * 4**n:,} triângulos".replace(",", "."),
        }
        for rate, name in RATES.items()
        for n in MESHES[False]
    },
}
BEATS = {
    "en": "Exponent {m:g}: {fine} is nearer to the true sphere than {coarse}, and cheaper.",
    "pt": "Expoente {m:g}: {fine} fica mais perto da esfera verdadeira que {coarse}, e custa"
    " menos.",
}
NEVER = {
    "en": "Exponent {m:g}: on no mesh does Gouraud beat Phong on a coarser one.",
    "pt": "Expoente {m:g}: em nenhuma malha Gouraud supera Phong em outra mais grossa.",
}


def scene(rate, subdivision, exponent, side=SIDE):
    """Return the Scene of a sphere of 20 * 4^subdivision triangles, one far light and ambient."""
    return Scene.default().set(
        mesh=f"sphere:subdivision={subdivision}",
        model="phong",
        shading=rate,
        shininess=exponent,
        size=(side, side),
        samples=1,
        background=(0.0, 0.0, 0.0),
        camera__position=(0.0, 0.0, 4.0),
        camera__target=(0.0, 0.0, 0.0),
    )


def analytic(one):
    """Return the linear radiance (h, w, 3) float64 of a `scene`, and its normals, NaN beside.

    The nearer crossing of each pixel's ray with the unit sphere, in its middle, no mesh, no card.
    """
    (width, height), back = one.size, np.tan(np.radians(one.camera.fov) / 2.0)
    x, y = np.meshgrid(np.arange(width) + 0.5 - width / 2.0, height / 2.0 - 0.5 - np.arange(height))
    rays = unit(np.stack([x, y, np.full_like(x, -0.5 * height / back)], axis=-1).reshape(-1, 3))
    eye = np.array(one.camera.position)
    along = -rays @ eye
    square = along**2 - (eye @ eye - 1.0)
    hit = square > 0.0
    normals = np.full_like(rays, np.nan)
    normals[hit] = unit(eye + (along[hit] - np.sqrt(square[hit]))[:, None] * rays[hit])
    radiance = np.zeros_like(rays)
    radiance[hit] = _reflected(one, normals[hit], unit(eye - normals[hit]))
    return radiance.reshape(height, width, 3), normals.reshape(height, width, 3)


def _reflected(one, normals, view):
    """Return what points with these normals send to the eye, (n, 3), by reference.phong."""
    values = one.objects[0].values
    far, ambient = ({k: np.asarray(v, float) for k, v in x.values.items()} for x in one.lights)
    toward = np.broadcast_to(unit(far["direction"][None]), normals.shape)
    across = unit(np.cross(np.eye(3)[np.abs(normals).argmin(axis=1)], normals))
    axes = np.stack([across, np.cross(normals, across), normals], axis=1)
    L, V = (np.einsum("nij,nj->ni", axes, w) for w in (toward, view))
    reflected = far["irradiance"] * far["color"] * reference.phong(L, V, **values)
    return reflected + ambient["radiance"] * ambient["color"] * np.asarray(values["ka"])


def run(bench):
    """Yield the points, pictures and remarks of this study."""
    meshes, exponents = MESHES[bench.quick], EXPONENTS[bench.quick]
    chosen = [(rate, n) for n in meshes for rate in RATES]
    spent = {}
    for fine in (False, True):  # what takes longest would leave the others few rounds
        some = [key for key in chosen if (key[1] > FINE) == fine]
        jobs = {key: bench.frame(scene(*key, exponents[0])) for key in some}
        spent |= bench.race(jobs, SECONDS[bench.quick] * 0.3) if jobs else {}
    for m in exponents:
        truth, normals = analytic(scene("phong", 1, m))
        found = []
        for rate, n in chosen:
            pixels = bench.image(scene(rate, n, m))
            errors, off = compared(pixels, truth, np.isfinite(normals[..., 0]), not bench.quick)
            variant, default = f"{rate} {20 * 4**n}", (rate, n) == ("phong", 5)
            facts = {"exponent": m, "triangles": 20.0 * 4**n}
            timing = spent[rate, n].per(1, 1e-3)
            found += study.points(f"m = {m:g}", variant, errors, timing, "ms", default, facts)
            if n in SHOWN and m == exponents[len(exponents) // 2]:
                yield Shown(f"m = {m:g}", variant, pixels, off)
        yield from found
        yield from remarks(m, [p for p in found if p.metric == INSIDE])


def compared(pixels, truth, inside, flip):
    """Return {metric: error} of a picture and its error per pixel (h, w), as shares of the peak.

    A pixel is inside where both pictures show the sphere, which ambient light keeps from black.
    flip: that error too, which takes a third of a second, where its package is at hand.
    """
    peak = truth.max()
    off = (pixels - truth) / peak
    both = inside & (pixels.max(axis=2) > 0.0)
    errors = {INSIDE: float(np.sqrt(np.mean(off[both] ** 2)))}
    if flip:
        with suppress(ImportError):
            shown = [srgb(one / peak).astype(np.float32) for one in (truth, pixels)]
            errors[FLIP] = difference.flip(*shown, False)
    return errors, np.abs(off).max(axis=2)


def remarks(exponent, found):
    """Yield what the points of one exponent say of Gouraud on finer meshes than Phong's."""
    by_key = {tuple(p.variant.split(" ")): p for p in found}
    pairs = [
        (fine, coarse)
        for (rate, n), fine in by_key.items()
        for (other, k), coarse in by_key.items()
        if rate == "gouraud" and other == "phong" and int(n) > int(k)
    ]
    pairs = [(fine, coarse) for fine, coarse in pairs if fine.error < coarse.error]
    winners = [(fine, coarse) for fine, coarse in pairs if study.cheaper(fine, coarse)]
    if winners:
        # the finest Phong that is beaten, by the cheapest that beats it
        fine, coarse = min(winners, key=lambda pair: (pair[1].error, pair[0].cost))
        kind, names = BEATS, (fine.variant, coarse.variant)
    elif any(not study.cheaper(coarse, fine) for fine, coarse in pairs):
        return  # noise decides
    else:
        kind, names = NEVER, ("", "")
    said = []
    for lang in ("en", "pt"):
        fine, coarse = (WORDS[name][lang] if name else "" for name in names)
        said.append(kind[lang].format(m=exponent, fine=fine, coarse=coarse))
    yield Remark(*said)
