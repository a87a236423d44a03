"""Diffuse models against the full model of Oren and Nayar: albedo, BRDF, and a picture."""

import numpy as np

from .. import catalog, measure, reference
from ..notation import number
from ..scene import Scene
from ..study import SHARE, Remark, Shown, points

TITLE = {"en": "Rough diffuse surfaces", "pt": "Superfícies difusas rugosas"}
SECONDS = (40.0, 5.0)
METRICS = {"albedo": SHARE, "brdf": SHARE, "picture": SHARE}
SIGMAS = (10.0, 30.0, 45.0)  # degrees
RHO = 0.8
DEGREES = (0.0, 30.0, 60.0, 75.0, 85.0)
VARIANTS = {  # variant: (model, form)
    "lambert": ("lambert", "normalised"),
    "qualitative": ("oren_nayar", "qualitative"),
    "full": ("oren_nayar", "full"),
    "eon": ("oren_nayar", "energy_preserving"),
}
OWN = {"lambert": ("albedo",), "oren_nayar": ("albedo", "sigma", "roughness", "form")}
WORDS = {
    **{f"sigma {s:g}": {"en": f"σ = {s:g}°", "pt": f"σ = {s:g}°"} for s in SIGMAS},
    "albedo": {"en": "albedo", "pt": "albedo"},
    "brdf": {"en": "BRDF, RMS of π f", "pt": "BRDF, RMS de π f"},
    "picture": {"en": "picture, RMS", "pt": "imagem, RMS"},
    "lambert": {"en": "Lambert", "pt": "Lambert"},
    "qualitative": {"en": "Oren-Nayar, the slide's", "pt": "Oren-Nayar do slide"},
    "full": {"en": "Oren-Nayar, full", "pt": "Oren-Nayar completo"},
    "eon": {"en": "EON", "pt": "EON"},
}


def run(bench):
    """Yield the Points and pictures of all roughnesses, and what the full model gains."""
    generator = np.random.default_rng(5)
    L, V = (measure.upper(generator.random((2000 if bench.quick else 20000, 2))) for _ in range(2))
    pairs = bench.instrument.pairs(L, V)
    jobs = {name: _job(name, 30.0, 0.5) for name in VARIANTS}
    costs = bench.costs(jobs, 1.0 if bench.quick else 12.0)
    for sigma in SIGMAS:
        true = _reflectance(reference.oren_nayar, L, V, sigma=np.radians(sigma), form="full")
        roughness, albedo = _fitted(L, V, true), _albedo(RHO, sigma)
        pictures = {name: bench.image(_scene(name, sigma, roughness, bench)) for name in VARIANTS}
        for name in VARIANTS:
            model, values = _job(name, sigma, roughness)
            own, _ = measure.albedo(
                bench.instrument, model, values, np.radians(DEGREES), transmits=False
            )
            found = bench.instrument.scatter(model, values, pairs).astype(np.float64)
            off = np.abs(pictures[name].astype(np.float64) - pictures["full"]).max(axis=2)
            errors = {
                "albedo": float(np.abs(own[:, 0] - albedo).max()),
                "brdf": _rms(np.pi * found / L[:, 2:] - true),
                "picture": _rms(off),
            }
            more = {"sigma": sigma} | ({"roughness": roughness} if name == "eon" else {})
            case, default = f"sigma {sigma:g}", name == "qualitative"
            yield from points(case, name, errors, costs[name], "ns", default, more)
            yield Shown(case, name, pictures[name], off)
    bench.instrument.forget(pairs)
    yield _gained(bench)


def _job(name, sigma, roughness, rho=RHO):
    """Return the (model, values) of a variant; roughness is EON's."""
    model, form = VARIANTS[name]
    model = catalog.read("model", model)
    own = {"form": form, "albedo": (rho,) * 3, "sigma": sigma, "roughness": roughness}
    return model, {**model.defaults(), **{k: v for k, v in own.items() if k in model.defaults()}}


def _scene(name, sigma, roughness, bench):
    """Return the Scene of a sphere, lit so that white that faces the light has radiance 1."""
    model, values = _job(name, sigma, roughness)
    size = (96, 96) if bench.quick else (256, 256)
    scene = Scene.default().set(model=model.name, size=size, samples=4)
    scene = scene.changed("light", f"directional:direction=1,1,1:irradiance={np.pi!r}")
    return scene.set(**{key: values[key] for key in OWN[model.name]})


def _reflectance(model, L, V, **values):
    """Return pi f in float64 by a function of `reference`, (n, 3)."""
    return np.pi * model(L, V, albedo=(RHO,) * 3, **values) / L[:, 2:]


def _fitted(L, V, true):
    """Return the roughness of EON whose BRDF is nearest to true, in steps of 0.02."""
    some = slice(None, None, max(1, len(L) // 2000))

    def off(r):
        eon = reference.oren_nayar, L[some], V[some]
        return _rms(_reflectance(*eon, roughness=r, form="energy_preserving") - true[some])

    return round(min(np.linspace(0.0, 1.0, 51).tolist(), key=off), 2)


def _albedo(rho, sigma):
    """Return the albedo of the full model in float64 at the angles of DEGREES."""
    L, V, weights = measure.albedo_pairs(np.radians(DEGREES), 0.0, 4, False)
    flat = (w.reshape(-1, 3) for w in (L, V))
    f = reference.oren_nayar(*flat, albedo=(rho,) * 3, sigma=np.radians(sigma), form="full")
    return np.einsum("km,km->k", f[:, 0].reshape(weights.shape), weights)


def _rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def _gained(bench):
    """Return the Remark on the energy that the full model and EON return of all, for white."""
    most = float(max(_albedo(1.0, sigma).max() for sigma in SIGMAS))
    angles, eon = np.radians(DEGREES), 0.0
    for roughness in (0.25, 0.5, 1.0):
        model, values = _job("eon", 0.0, roughness, 1.0)
        own, _ = measure.albedo(bench.instrument, model, values, angles, transmits=False)
        eon = max(eon, float(own.max()))
    full, less = number(most, 4, "pt"), number(eon, 4, "pt")
    return Remark(
        f"White, the full model returns up to {most:.3f} of the light, EON {eon:.3f}: where light"
        " goes round, as between walls, what matters is that it is not more than 1.",
        f"Branco, o modelo completo devolve até {full} da luz, o EON {less}: onde a luz"
        " circula, como entre paredes, importa que não passe de 1.",
    )
