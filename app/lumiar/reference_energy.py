"""What a BRDF of single scattering loses, and the term that gives it back, in float64.

Directions and columns are as in `reference_terms`.
"""

import functools
import math

import numpy as np

from .reference_terms import azimuth, cosine, lambda_at, zenith


def oren_nayar(L, V, rho, r):
    """Return the BRDF EON [1/sr] of J. Portsmouth et al., JCGT 14(1), 2025.

    rho: albedo (1, 3); r: roughness in [0, 1]. With 1 - E_FON = r A (g - G(theta)/pi), r = 0 is
    no 0/0.
    """
    s = np.sin(zenith(L)) * np.sin(zenith(V)) * np.cos(azimuth(L) - azimuth(V))
    t = np.where(s > 0.0, np.maximum(cosine(L), cosine(V)), 1.0)
    g, average = 0.5 - 2.0 / (3.0 * np.pi), 2.0 / 3.0 - 28.0 / (15.0 * np.pi)
    A = 1.0 / (1.0 + g * r)
    mean = 1.0 - r * A * (g - average)
    often = rho**2 * mean / (1.0 - rho * (1.0 - mean))
    lost = r * A * (g - _fon_albedo(L)) * (g - _fon_albedo(V)) / (g - average)
    return (rho * A * (1.0 + r * s / t) + often * lost) / np.pi


def _fon_albedo(w):
    """Return G(theta)/pi of E_FON = A (1 + r G/pi), tan(theta) (1 - sin^3) by the elevation."""
    s, half_elevation = np.sin(zenith(w)), np.pi / 4.0 - zenith(w) / 2.0
    steep = s * np.tan(half_elevation) * (1.0 + s + s**2)
    return (s * (zenith(w) - s * np.cos(zenith(w))) + 2.0 / 3.0 * (steep - s)) / np.pi


def multiple_scattering(L, V, alpha, distribution, average):
    """Return what a lobe of F = 1 loses, as a BRDF [1/sr] (C. Kulla and A. Conty, SIGGRAPH 2017).

    average: the mean reflectance, (1, 3).
    """
    missing = lost_average(float(alpha), distribution)
    color = average**2 * (1.0 - missing) / (1.0 - average * missing)
    product = lost(cosine(L), alpha, distribution) * lost(cosine(V), alpha, distribution)
    return color * product / (np.pi * missing)


def lost(mu, alpha, distribution):
    """Return 1 - E(mu) of the isotropic lobe with height-correlated Smith and F = 1.

    Error below 1e-8, and below 1e-5 of the value for ggx.
    """
    low, high = _log_range(alpha, distribution)
    y = np.clip(np.log(np.maximum(mu, 1e-99) / alpha), low, high)
    series = _lost_series(float(alpha), distribution)
    x = (2.0 * y - low - high) / (high - low)
    scaled = np.polynomial.chebyshev.chebval(x, series)
    return np.maximum(scaled, 0.0) / (1.0 + np.exp(2.0 * y))


@functools.lru_cache(maxsize=256)
def lost_average(alpha, distribution):
    """Return 1 - E_avg = 2 int (1 - E) mu dmu, by Gauss-Legendre in log(mu)."""
    x, weight = np.polynomial.legendre.leggauss(200)
    low, high = _log_range(alpha, distribution)
    mu = alpha * np.exp(0.5 * (low + high + (high - low) * x))
    return float((mu**2 * lost(mu, alpha, distribution)) @ weight * (high - low))


def _log_range(alpha, distribution):
    """Return where E varies with log(mu / alpha); beckmann loses under 1e-40 from 20 alpha up."""
    top = 20.0 if distribution == "beckmann" else 1e9
    return math.log(1e-9), min(-math.log(alpha), math.log(top))


@functools.lru_cache(maxsize=64)
def _lost_series(alpha, distribution):
    """Return Chebyshev coefficients in log(mu / alpha) of (1 - E)(1 + (mu / alpha)^2)."""
    low, high = _log_range(alpha, distribution)

    def scaled(x):
        y = 0.5 * (low + high + (high - low) * x)
        mu = np.minimum(alpha * np.exp(y), 1.0)
        return (1.0 + np.exp(2.0 * y)) * [_lost_at(m, alpha, distribution) for m in mu.tolist()]

    degree = int((14 if distribution == "beckmann" else 7) * (high - low))
    return np.polynomial.chebyshev.chebinterpolate(scaled, degree)


def _lost_at(mu, alpha, distribution):
    """Return 1 - E at one mu: visible normals whose mirror ray is shadowed or below the surface.

    h = (phi, w), w the share of normals steeper than theta_h. Double exponential quadrature (H.
    Takahasi and M. Mori, 1974), since layers at the horizon and at grazing end every interval.
    """
    t = np.linspace(-3.3, 3.3, 80)
    x, rest = 1.0 / (1.0 + np.exp(-np.pi * np.sinh(t))), 1.0 / (1.0 + np.exp(np.pi * np.sinh(t)))
    weight = (t[1] - t[0]) * np.pi * np.cosh(t) * x * rest
    s = math.sqrt((1.0 - mu) * (1.0 + mu))
    masked, total = lambda_at(np.array(alpha * s / mu), distribution), 0.0
    for side in (1.0, -1.0):
        along = side * s * np.sin(np.pi / 2.0 * x)[:, None]  # sin(theta_v) cos(phi)
        limit = np.pi / 4.0 + np.arctan2(along, mu) / 2.0  # theta_h that mirrors v to the horizon
        up = _steeper(np.tan(limit) / alpha, distribution)
        last = (
            0.0 if side > 0.0 else _steeper(-mu / np.minimum(along, -1e-99) / alpha, distribution)
        )
        slope, step = alpha * _slope(up + (1.0 - up) * rest, distribution), (1.0 - up) * weight
        cos_l = np.hypot(along, mu) * np.sin(2.0 * (limit - np.arctan(slope)))
        cos_l = np.clip(cos_l, 1e-30, 1.0)
        shadow = lambda_at(alpha * np.sqrt((1.0 - cos_l) * (1.0 + cos_l)) / cos_l, distribution)
        inner = (1.0 + slope * along / mu) * shadow / (1.0 + shadow + masked) * step
        slope, step = alpha * _slope(last + (up - last) * rest, distribution), (up - last) * weight
        total += weight @ (inner + (1.0 + slope * along / mu) * step).sum(1) / 2.0
    return float(total / (1.0 + masked))


def _steeper(slope, distribution):
    return np.exp(-(slope**2)) if distribution == "beckmann" else 1.0 / (1.0 + slope**2)


def _slope(w, distribution):
    w = np.clip(w, 1e-300, 1.0)
    return np.sqrt(-np.log(w) if distribution == "beckmann" else (1.0 - w) / w)
