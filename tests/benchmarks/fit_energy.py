"""Fit what one bounce loses, 1 - E(mu, alpha), to the rationals of glsl/lib/energy.glsl.

python tests/benchmarks/fit_energy.py prints the coefficients and the errors they leave; a minute.
The fit aims LOWER than the truth, and at an average that is MORE, so that no light is made: what is
given back is never more than what was lost, up to 1e-4.
Truth: E(mu) = int D_visible(m) G2/G1 dm (E. Heitz, 2014) over the slopes of the facets. Those that
reflect above the surface form a disc, r < t cos(phi) + sqrt(1 + t^2 cos^2(phi)), t = tan(theta):
with t cos(phi) = sinh(w) it is r < exp(w), which Gauss-Legendre resolves to 1e-9.
"""

import math
import sys

import numpy as np

erf = np.vectorize(math.erf, otypes=[float])
LOWER, MORE = {"ggx": 1e-4, "beckmann": 3.2e-4}, 6e-5


def smith(kind, c, alpha):
    at = alpha * np.sqrt(np.maximum(1 - c * c, 0)) / c
    if kind == "ggx":
        return 0.5 * (np.sqrt(1 + at * at) - 1)
    v = np.minimum(1 / np.maximum(at, 1e-300), 30.0)
    return np.maximum(0.5 * (erf(v) - 1) + np.exp(-v * v) / (2 * v * math.sqrt(math.pi)), 0)


def true_deficit(kind, mu, alpha, n=48):
    x, wx = np.polynomial.legendre.leggauss(n)
    s = math.sqrt(1 - mu * mu)
    t = max(s / mu, 1e-6)
    top = math.asinh(t)
    w = top * np.sin(x * math.pi / 2)
    dphi = (
        top
        * np.cos(x * math.pi / 2)
        * np.cosh(w)
        / np.sqrt(t * t - np.sinh(w) ** 2)
        * wx
        * math.pi
        / 2
    )
    rmax = np.exp(w) / alpha if kind == "ggx" else np.minimum(np.exp(w) / alpha, 6.2)
    top = np.arcsinh(rmax)[:, None]
    v = top * (x + 1) / 2
    r = np.sinh(v)
    p22 = 1 / (1 + r * r) ** 2 if kind == "ggx" else np.exp(-r * r)
    vis = mu + s * alpha * r * (np.sinh(w) / t)[:, None]
    iz = np.clip(2 * vis / (1 + (alpha * r) ** 2) - mu, 1e-300, 1)
    g2 = 1 / (1 + smith(kind, np.array(mu), alpha) + smith(kind, iz, alpha))
    return 1 - 2 * np.sum(
        p22 * r * np.cosh(v) / math.pi * top * wx / 2 * vis / mu * g2 * dphi[:, None]
    )


def minimax(N, M, d, steps=400):
    """Fit d by N p / (1 + M q): Sanathanan-Koerner, then Levenberg-Marquardt, Lawson weights."""
    n, m = N.shape[1], M.shape[1]

    def ev(c):
        return ((N @ c[:n]) / (1 + M @ c[n:]), 1 + M @ c[n:])

    den, starts = np.ones(len(d)), [np.zeros(n + m)]
    for _ in range(8):
        A = np.vstack([np.hstack([N, -M * d[:, None]]) / den[:, None], 1e-5 * np.eye(n + m)])
        starts.append(np.linalg.lstsq(A, np.r_[d / den, np.zeros(n + m)], rcond=None)[0])
        den = np.clip(abs(1 + M @ starts[-1][n:]), 0.05, None)
    c = min((c for c in starts if ev(c)[1].min() > 0.02), key=lambda c: abs(ev(c)[0] - d).max())
    w, damp, best = np.ones(len(d)), 1e-3, (9, c)
    f, D = ev(c)
    for k in range(steps):
        J = np.hstack([N, -M * f[:, None]]) / D[:, None]
        H = J.T @ (w[:, None] * J)
        for _ in range(8):
            c2 = c - np.linalg.solve(H + np.diag(damp * (np.diag(H) + 1e-14)), J.T @ (w * (f - d)))
            f2, D2 = ev(c2)
            if D2.min() > 0.02 and w @ (f2 - d) ** 2 < w @ (f - d) ** 2 * (1 + 1e-12):
                c, f, D, damp = c2, f2, D2, max(damp * 0.2, 1e-9)
                break
            damp = min(damp * 4, 1e3)
        e = abs(f - d)
        if e.max() < best[0]:
            best = e.max(), c.copy()
        if k >= 40:
            w = np.maximum(w * (e / e.max() + 0.02), 1e-7)
            w = np.maximum(w / w.max(), 1e-7)
    return best[1][:n], np.r_[1, best[1][n:]]


PAIRS = [(i, j) for i in range(5) for j in range(5 - i)]  # z^i v^j, total degree 4


def horner(c, x):
    r = c[-1]
    for k in c[-2::-1]:
        r = r * x + k
    return r


def quartic(c, z, v):
    return horner(
        [horner([k for k, ij in zip(c, PAIRS, strict=False) if ij[0] == i], v) for i in range(5)], z
    )


def fitted(kind, c, mu, a, T=np.float64):
    mu, a, (p, q) = T(mu), T(a), [[T(k) for k in s] for s in c]
    y, z, one = mu / (mu + a), a / (mu + a), T(1)
    if kind == "ggx":
        y0 = np.maximum(y, T(1e-30))
        return np.maximum(
            -a * mu * np.log(y0) + (one - a) * y * z * quartic(p, z, a) / quartic(q, z, a), T(0)
        )
    return np.maximum(y * z * z * quartic(p, z, a * a) / quartic(q, z, a * a), T(0))


def fitted_average(kind, c, a, T=np.float64):
    a, (p, q) = T(a), [[T(k) for k in s] for s in c]
    t = np.sqrt(a) if kind == "ggx" else a * a
    return (a if kind == "ggx" else a * a) * horner(p, t) / horner(q, t)


def average(f, alpha, n=96):
    """2 int f mu dmu, split at alpha, 3 alpha (fitted deficits bend there)."""
    x, w = np.polynomial.legendre.leggauss(n)
    v = np.arcsinh(1 / alpha) * (x + 1) / 2
    mu = np.minimum(alpha * np.sinh(v), 1)
    return np.sum(2 * mu * f(mu) * alpha * np.cosh(v) * w) * np.arcsinh(1 / alpha) / 2


def mus(a):
    return np.unique(
        np.clip(
            np.r_[
                a * np.geomspace(1e-4, 1, 16),
                a * np.linspace(0.05, 6, 40),
                np.linspace(0.02, 1, 24) ** 2,
                np.linspace(0.05, 1, 20),
            ],
            0,
            1,
        )
    )


def main(kind):
    alphas = np.unique(np.r_[np.geomspace(1e-3, 0.1, 9), np.linspace(0.05, 1, 30)])
    mu, a = np.array([(m, x) for x in alphas for m in mus(x)]).T
    d = np.array([true_deficit(kind, *s) for s in zip(mu, a, strict=False)])
    y, z = mu / (mu + a), a / (mu + a)
    base, pre, v = (
        (-a * mu * np.log(y), y * z * (1 - a), a) if kind == "ggx" else (0, y * z * z, a * a)
    )
    B = np.array([z**i * v**j for i, j in PAIRS]).T
    c = minimax(B * pre[:, None], B[:, 1:], d - LOWER[kind] - base)
    x = np.unique(np.r_[np.geomspace(1e-3, 1, 150), np.linspace(0.01, 1, 100)])
    avg = np.array([average(lambda m, k=k: fitted(kind, c, m, k, np.float64), k, 400) for k in x])
    t = np.sqrt(x) if kind == "ggx" else x * x
    P = np.array([t**i for i in range(7)]).T
    g = minimax(P * ((x if kind == "ggx" else x * x) / avg)[:, None], P[:, 1:5], np.ones(len(x)))
    g = g[0] * (1.0 + MORE), g[1]
    for name, k in zip(
        ("deficit p", "deficit q", "average p", "average q"), (*c, *g), strict=False
    ):
        print(kind, name, ", ".join(f"{s:.9g}" for s in k))
    worst, F = np.zeros(5), np.float32  # verify on other points, in float32
    where = None
    for k in np.unique(np.r_[np.geomspace(1e-3, 1, 31), np.linspace(0.0317, 1, 30)]):
        m = np.r_[mus(k * 0.93), np.linspace(0.01, 1, 34), 1e-6]
        t = np.array([true_deficit(kind, s, k) for s in m])
        e = fitted(kind, c, m.astype(F), k, F)
        ga, want = (
            fitted_average(kind, g, k, F),
            average(lambda s, k=k: fitted(kind, c, s, k, np.float64), k, 400),
        )
        W = e * (want / ga) - t
        out = -min(e.min(), 1 - e.max(), ga)
        now = np.array([abs(e - t).max(), abs(ga / want - 1), W.max(), -W.min(), out])
        if W.max() > worst[2]:
            where = m[W.argmax()], k
        worst = np.maximum(worst, now)
    print(
        kind,
        "float32: |deficit| {:.2e}, average rel {:.2e}, furnace +{:.2e} -{:.2e}".format(*worst[:4]),
        "most at mu, alpha",
        where,
        "out of range" if worst[4] > 0 else "in [0,1]",
    )
    return c, g


if __name__ == "__main__":
    for kind in sys.argv[1:] or ("ggx", "beckmann"):
        main(kind)
