"""What the float32-stable forms cost beside the naive ones, and how exact both are.

python tests/benchmarks/stable.py; nanoseconds are medians, the two forms of a pair in turns. Errors
are the largest relative ones above 1e-6 of the peak, against float64 (`reference_terms`).
"""

import statistics

import numpy as np

from lumiar import catalog, hostile, measure, reference_terms

ROUNDS = 5
HEAD = "// model   Form\n" + "".join(
    f'#include "lib/{name}.glsl"\n' for name in ("lobe", "fresnel", "microfacet")
)
BODY = (
    "vec3 scatter(vec3 L, vec3 V) {\n"
    "    if (L.z <= 0.0 || V.z <= 0.0) return vec3(0.0);\n    %s\n}\n"
)


def lobe(m):
    """Return the float64 function of Blinn's lobe with exponent m."""
    return lambda L, V: reference_terms.cos_power(reference_terms.zenith(L + V), m)


def beckmann(alpha):
    return lambda L, V: reference_terms.D(L + V, alpha, alpha, "beckmann")


def ggx(alpha):
    return lambda L, V: reference_terms.D(L + V, alpha, alpha, "ggx")


def dielectric(n):
    return lambda L, V: reference_terms.F_dielectric(reference_terms.half_cosine(L, V), n)


HALF = "vec3 H = normalize(L + V); "
TANGENT = "vec3 H = L + V; float t = H.z + length(H); "
FORMS = {  # name: (naive, stable, float64)
    "Blinn, m = 40": (
        HALF + "return vec3(pow(H.z, 40.0));",
        TANGENT + "return vec3(cos_power(dot(H.xy, H.xy) / (t * t), 40.0));",
        lobe(40.0),
    ),
    "Blinn, m = 10000": (
        HALF + "return vec3(pow(H.z, 1e4));",
        TANGENT + "return vec3(cos_power(dot(H.xy, H.xy) / (t * t), 1e4));",
        lobe(1e4),
    ),
    "Beckmann, 0.1": (
        HALF + "float c2 = H.z * H.z, m2 = 0.01;"
        " return vec3(exp((c2 - 1.0) / (m2 * c2)) / (PI * m2 * c2 * c2));",
        "return vec3(D_beckmann(L + V, vec2(0.1)));",
        beckmann(0.1),
    ),
    "Beckmann, 0.01": (
        HALF + "float c2 = H.z * H.z, m2 = 1e-4;"
        " return vec3(exp((c2 - 1.0) / (m2 * c2)) / (PI * m2 * c2 * c2));",
        "return vec3(D_beckmann(L + V, vec2(0.01)));",
        beckmann(0.01),
    ),
    "GGX, 0.1": (
        HALF + "float a2 = 0.01, d = H.z * H.z * (a2 - 1.0) + 1.0; return vec3(a2 / (PI * d * d));",
        "return vec3(D_ggx(L + V, vec2(0.1)));",
        ggx(0.1),
    ),
    "Fresnel, n = 1.5": (
        HALF + "float c = dot(L, H), t = sqrt(1.0 - (1.0 - c * c) / 2.25);"
        " float s = (c - 1.5 * t) / (c + 1.5 * t), p = (1.5 * c - t) / (1.5 * c + t);"
        " return vec3(0.5 * (s * s + p * p));",
        "return vec3(F_dielectric(min(0.5 * length(L + V), 1.0), 1.5).x);",
        dielectric(1.5),
    ),
}


def main():
    """Print a line for each pair of forms."""
    L, V = hostile.ordinary(False)
    exact_L, exact_V = (reference_terms.unit(w) for w in (L, V))
    high = (L[:, 2:] > 0.05) & (V[:, 2:] > 0.05)
    print(f"{'':18} naive ns  stable ns   ratio  naive error  stable error")
    with measure.Instrument() as instrument:
        pairs = instrument.pairs(L, V)
        for name, (*bodies, true) in FORMS.items():
            models = [
                catalog.parse("model", "form", "form.glsl", HEAD + BODY % body) for body in bodies
            ]
            rounds = [[instrument.cost(m, {})[0] for m in models] for _ in range(ROUNDS)]
            ratio = statistics.median(b / a for a, b in rounds)
            one, other = (statistics.median(times) for times in zip(*rounds, strict=True))
            exact = np.broadcast_to(true(exact_L, exact_V), (len(L), 1))
            counted = (exact > 1e-6 * exact.max()) & high
            errors = []
            for model in models:
                found = instrument.scatter(model, {}, pairs)[:, :1].astype(np.float64)
                off = np.abs(found - exact)[counted] / exact[counted]
                errors.append(off.max())
            figures = f"{one:8.2f} {other:10.2f} {ratio:7.2f}"
            print(f"{name:18} {figures} {errors[0]:12.1e} {errors[1]:13.1e}")


if __name__ == "__main__":
    main()
