"""Three colours, few wavelengths or many: black bodies, and metals under lamps, against sums."""

import csv
import os

import numpy as np

from .. import catalog, colorimetry, materials, spectrum, study
from ..files import ASSETS, GLSL, read_text
from ..study import Metric, Remark, Shown

TITLE = {
    "en": "Spectra: three colours or many wavelengths",
    "pt": "Espectros: três cores ou muitos comprimentos de onda",
}
SECONDS = (40.0, 6.0)
UV, DE = "du'v'", "dE2000"
METRICS = {
    UV: Metric(0.0011, 4e-6),  # radius of a step that is just seen: CIE TN 001:2014
    DE: Metric(1.0, 0.005),
}
SUMS = {False: (3, 4, 6, 8, 12, 16, 24, 32, 48, 95), True: (8, 95)}
FITS = {False: (8, 16, 24, 48, 95), True: (24,)}
TRIPLES = {False: (1, 2, 4, 8, 16), True: (1, 2, 8)}  # of wavelengths a metal is seen at
METALS = {
    False: (("gold", "D65"), ("gold", "A"), ("copper", "F11")),
    True: (("gold", "A"),),
}
STEPS = 128  # temperatures, and angles
BLACK_BODY, LAMPS = "black body", "all lamps"
KRYSTEK, RGB, METAL_RGB = "krystek", "three lines", "rgb"
NAMES = {"gold": ("gold", "ouro"), "copper": ("copper", "cobre")}
WORDS = {
    UV: {
        "en": "largest distance in CIE 1976 u'v'; 0.0011 is just seen",
        "pt": "maior distância em u'v' (CIE 1976); 0,0011 mal se vê",
    },
    DE: {
        "en": "largest CIEDE2000 difference; 1 is just seen",
        "pt": "maior diferença CIEDE2000; 1 mal se vê",
    },
    BLACK_BODY: {
        "en": "colour of a black body, 1000 to 20000 K",
        "pt": "cor de um corpo negro, 1000 a 20000 K",
    },
    LAMPS: {
        "en": "the worst of these metals and lamps",
        "pt": "o pior desses metais e lâmpadas",
    },
    KRYSTEK: {"en": "Krystek's fit, colour alone", "pt": "ajuste de Krystek, só a cor"},
    RGB: {
        "en": "Planck at 660, 538 and 437 nm as R, G, B",
        "pt": "Planck em 660, 538 e 437 nm como R, G, B",
    },
    METAL_RGB: {
        "en": "RGB: Fresnel at 660, 538 and 437 nm times the lamp's colour",
        "pt": "RGB: Fresnel em 660, 538 e 437 nm vezes a cor da lâmpada",
    },
    **{
        f"{n}": {"en": f"{n} wavelengths, CIE table", "pt": f"{n} comprimentos, tabela da CIE"}
        for n in SUMS[False]
    },
    **{
        f"{n} fit": {"en": f"{n} wavelengths, Wyman's fit", "pt": f"{n} comprimentos, Wyman"}
        for n in FITS[False]
    },
    **{
        f"{3 * n} bins": {"en": f"{3 * n} wavelengths", "pt": f"{3 * n} comprimentos de onda"}
        for n in TRIPLES[False]
    },
    **{
        f"{metal} {lamp}": {
            "en": f"{NAMES[metal][0]} under {lamp}, all angles",
            "pt": f"{NAMES[metal][1]} sob {lamp}, todos os ângulos",
        }
        for metal, lamp in METALS[False]
    },
}
READ = Remark(
    "In the pictures the upper half is as computed, the lower half the truth; to the left 20000 K,"
    " or grazing light.",
    "Nas imagens a metade de cima é a calculada, a de baixo a verdadeira; à esquerda 20000 K, ou"
    " luz rasante.",
)
TO_XYZ = np.linalg.inv(np.transpose([spectrum.rgb(axis) for axis in np.eye(3)]))


def run(bench):
    """Yield the points and pictures of this study."""
    yield READ
    yield from _black_bodies(bench)
    yield from _metals(bench)


def _black_bodies(bench):
    model = bench.formulas("black_body")
    base, quick = model.defaults(), bench.quick
    at = np.array([spectrum.planck(nm / 1000.0, 6500.0) for nm in (660, 538, 437)])
    white = np.array(spectrum.rgb(spectrum.xyz(spectrum.black_body(6500.0)))) / at
    white = tuple((white / (white @ at / 3.0)).tolist())
    jobs = {f"{n}": {"wavelengths": n} for n in SUMS[quick]}
    jobs |= {f"{n} fit": {"wavelengths": n, "observer": "fit"} for n in FITS[quick]}
    jobs |= {RGB: {"form": "rgb", "white": white}, KRYSTEK: {"form": "krystek"}}
    jobs = {name: (model, {**base, **values}) for name, values in jobs.items()}
    cosines = np.linspace(0.0, 1.0, STEPS)
    kelvin = 1e6 / (50.0 + 950.0 * cosines.astype(np.float32))
    truth = np.array([spectrum.xyz(spectrum.black_body(float(T))) for T in kelvin])
    spent = bench.costs(jobs, SECONDS[quick] * 0.6)
    for name, job in jobs.items():
        xyz = _measured(bench, job, cosines) @ TO_XYZ.T
        off = _apart(xyz, truth)
        facts = {"wavelengths": float(job[1]["wavelengths"])} if name not in (RGB, KRYSTEK) else {}
        errors = {UV: float(off.max())}
        yield from study.points(BLACK_BODY, name, errors, spent[name], "ns", name == "95", facts)
        if name in ("8", "24", RGB, KRYSTEK):
            yield Shown(BLACK_BODY, name, *_strip(xyz, truth, off))


def _metals(bench):
    spent, found = None, []
    for metal, lamp in METALS[bench.quick]:
        case = f"{metal} {lamp}"
        jobs = {f"{3 * n} bins": (metal_model(metal, lamp, n), {}) for n in TRIPLES[bench.quick]}
        jobs[METAL_RGB] = (metal_model(metal, lamp, 0), {})
        if not spent:  # the tables of the others hold other numbers, no more
            spent = bench.costs(jobs, SECONDS[bench.quick] * 0.3)
        cosines = np.linspace(0.0, 1.0, STEPS)
        truth, white = reflected(metal, lamp, cosines.astype(np.float32).astype(float))
        for name, job in jobs.items():
            xyz = _measured(bench, job, cosines) @ TO_XYZ.T
            lab = (colorimetry.lab(colours, white) for colours in (xyz, truth))
            off = colorimetry.difference(*lab)
            errors = {DE: float(off.max()), UV: float(_apart(xyz, truth).max())}
            found += study.points(case, name, errors, spent[name])
            if name in (METAL_RGB, "6 bins"):
                yield Shown(case, name, *_strip(xyz, truth, off))
    yield from found
    if not bench.quick:
        yield from together(found)


def together(found):
    """Yield a Point for each variant and metric with its largest error under all lamps.

    Lumiar's default has to do for all of them, so that it is held to this.
    """
    for variant, metric in dict.fromkeys((p.variant, p.metric) for p in found):
        own = [p for p in found if (p.variant, p.metric) == (variant, metric)]
        error, default = max(p.error for p in own), variant == METAL_RGB
        yield own[0]._replace(case=LAMPS, error=error, default=default)


def _measured(bench, job, cosines):
    """Return the colours (n, 3) of a (model, values) at cosines of incidence."""
    sines = np.sqrt((1.0 - cosines) * (1.0 + cosines))
    L = np.stack([sines, 0.0 * cosines, cosines], axis=1)
    pairs = bench.instrument.pairs(L, L)
    found = bench.instrument.scatter(*job, pairs).astype(np.float64)
    bench.instrument.forget(pairs)
    return found


def _apart(xyz, truth):
    one, other = colorimetry.chromaticity(xyz), colorimetry.chromaticity(truth)
    return np.linalg.norm(one - other, axis=1)


def metal_spectrum(name, nm):
    """Return (n, k) of a metal at wavelengths nm, linear between its published points."""
    rows = csv.DictReader(
        read_text(os.path.join(ASSETS, "materials", "spectra.csv"), 1 << 16, "a table").split("\n")
    )
    keys = ("wavelength_nm", "n", "k")
    points = [[float(row[key]) for key in keys] for row in rows if row["metal"] == name]
    at, n, k = np.transpose(points)
    return np.interp(nm, at, n), np.interp(nm, at, k)


def reflected(metal, lamp, cosines):
    """Return XYZ (n, 3) of a lamp's light that a metal mirrors at cosines, and the lamp's own.

    Y of the lamp is 1. Sums over the CIE's wavelengths, every 5 nm, of A. Fresnel's reflectance
    with the complex index n + ik, in complex numbers.
    """
    nm, weights = _weights(lamp)
    n, k = metal_spectrum(metal, nm)
    return _fresnel(cosines[:, None], n + 1j * k) @ weights, weights.sum(axis=0)


def _fresnel(cosines, index):
    inside = np.sqrt(1.0 - (1.0 - cosines**2) / index**2)
    s = (cosines - index * inside) / (cosines + index * inside)
    p = (index * cosines - inside) / (index * cosines + inside)
    return (np.abs(s) ** 2 + np.abs(p) ** 2) / 2.0


def _weights(lamp):
    """Return wavelengths (n,) nm and what each adds to XYZ (n, 3) of a lamp of luminance 1."""
    powers, observer = spectrum.powers(lamp), spectrum.observer()
    nm = np.array([w for w in observer if w in powers], float)
    weights = np.array([np.multiply(powers[w], observer[w]) for w in nm])
    return nm, weights / weights[:, 1].sum()


def metal_model(metal, lamp, triples):
    """Return the catalog.Shader of a metal at three times so many wavelengths under a lamp.

    Each stands for an equal part of 400 to 700 nm (the ends for all beyond), at the mean of its
    light. 0: Lumiar's own three, each for a channel of the lamp's colour.
    """
    path = os.path.join(GLSL, "studies", "metal.glsl")
    text = read_text(path, catalog.SOURCE_LIMIT, "a GLSL file")
    if triples:
        n, k, rgb = _binned(metal, lamp, 3 * triples)
    else:
        values = materials.read(metal).values
        n, k = np.array(values["eta"]), np.array(values["k"])
        rgb = np.diag(spectrum.source(illuminant=lamp)[0])
    count = len(n) // 3
    tables = {"ETA": _vectors("vec3", n, 3), "K": _vectors("vec3", k, 3)}
    tables["RGB"] = _vectors("mat3", rgb, 9)
    lines = []
    for line in text.split("\n"):
        words = line.split("[")[0].split(" ")
        if line.startswith("const int TRIPLES"):
            line = f"const int TRIPLES = {count};"
        elif words[0] == "const":
            kind, name = words[1:3]
            line = f"const {kind} {name}[TRIPLES] = {kind}[TRIPLES]({tables[name]});"
        lines.append(line)
    return catalog.parse("model", f"{metal}_{lamp}_{count}", path, "\n".join(lines))


def _vectors(kind, numbers, size):
    rows = np.reshape(numbers, (-1, size))
    return ", ".join(f"{kind}({', '.join(f'{x:.9g}' for x in row)})" for row in rows)


def _binned(metal, lamp, count):
    nm, weights = _weights(lamp)
    fine = np.arange(nm[0], nm[-1] + 0.5)
    xyz = np.stack([np.interp(fine, nm, column) for column in weights.T], axis=1)
    xyz *= weights.sum(axis=0) / xyz.sum(axis=0)
    which = np.clip(((fine - 400.0) / 300.0 * count).astype(int), 0, count - 1)
    light = xyz.sum(axis=1)
    sums = np.array([xyz[which == i].sum(axis=0) for i in range(count)])
    means = np.array([fine[which == i] @ light[which == i] for i in range(count)])
    means /= np.array([light[which == i].sum() for i in range(count)])
    return *metal_spectrum(metal, means), np.array([spectrum.rgb(row) for row in sums])


def _strip(xyz, truth, off):
    """Return a picture, what was measured above the truth, and the errors in it."""
    rows = [np.array([spectrum.rgb(c) for c in one / one[:, 1:2]]) for one in (xyz, truth)]
    rows = [row / np.maximum(row.max(axis=1, keepdims=True), 1e-9) for row in rows]
    pixels = np.concatenate([np.repeat(np.maximum(row, 0.0)[None], 24, axis=0) for row in rows])
    return np.repeat(pixels, 2, axis=1).astype(np.float32), np.repeat(
        np.repeat(off[None], 48, axis=0), 2, axis=1
    )
