"""The terms that the float64 reference models are made of: angles, Fresnel, microfacets, averages.

Written from the papers with angles and tangents. Directions are (n, 3) in the local frame, unit
unless said, and what is said of each is a column (n, 1). c is the cosine of an angle of incidence,
in [0, 1], n the index of refraction behind an interface over the one before it.
"""

import math

import numpy as np

_erfc = np.vectorize(math.erfc, otypes=[np.float64])


def unit(w):
    """Return directions (n, 3) in float64 with length 1."""
    w = np.asarray(w, np.float64)
    return w / np.linalg.norm(w, axis=1, keepdims=True)


def zenith(w):
    """Return the angle theta to the normal, in [0, pi]; w of any length."""
    return np.arctan2(np.hypot(w[:, :1], w[:, 1:2]), w[:, 2:])


def cosine(w):
    """Return cos(theta) as the sine of the elevation: exact at grazing too; w of any length."""
    return np.sin(np.arctan2(w[:, 2:], np.hypot(w[:, :1], w[:, 1:2])))


def tangent(w):
    """Return tan(theta), negative below the surface; w of any length."""
    return np.hypot(w[:, :1], w[:, 1:2]) / w[:, 2:]


def azimuth(w):
    """Return the angle phi about the normal, from the tangent, in [-pi, pi]; w of any length."""
    return np.arctan2(w[:, 1:2], w[:, :1])


def angle(a, b):
    """Return the angle between two directions, good at all angles (W. Kahan, 2006)."""
    return 2.0 * np.arctan2(length(a - b), length(a + b))


def half_cosine(L, V):
    """Return the cosine between L and the half vector, i.e. of half the angle between L and V."""
    return np.sin(np.arctan2(length(L + V), length(L - V)))


def length(w):
    """Return the length of vectors of any length."""
    return np.linalg.norm(w, axis=1, keepdims=True)


def cos_power(theta, exponent):
    """Return max(0, cos(theta))^exponent, from the half angle where cos(theta) is near 1."""
    front = theta < np.pi / 2.0
    theta = np.where(front, theta, 0.0)
    near = np.log1p(-2.0 * np.sin(np.minimum(theta, 1.0) / 2.0) ** 2)
    return front * np.exp(exponent * np.where(theta < 1.0, near, np.log(np.cos(theta))))


def mirror(V):
    """Return V turned by 180 degrees about the normal."""
    return V * [-1.0, -1.0, 1.0]


def _snell(c, n):
    """Return the angles of incidence and refraction, their sum or 1 if 0, if there is a ray."""
    c, n = np.broadcast_arrays(np.clip(c, 0.0, 1.0), n)
    s = np.sqrt((1.0 - c) * (1.0 + c))
    square = (n - 1.0) * (n + 1.0) + c**2  # (n cos(theta_t))^2
    i, t = np.arctan2(s, c), np.arctan2(s, np.sqrt(np.maximum(square, 0.0)))
    return i, t, np.where(i > 0.0, i + t, 1.0), square > 0.0


def refract(V, n):
    """Return the direction (n, 3) that V is refracted to, and where there is one (W. Snell, 1621).

    V may lie on either side; n is the index on the other side over that on V's.
    """
    _, theta, _, passes = _snell(np.abs(V[:, 2:]), n)
    flat = -np.sin(theta) * np.hstack([np.cos(azimuth(V)), np.sin(azimuth(V))])
    return np.hstack([flat, np.copysign(np.cos(theta), -V[:, 2:])]), passes


def F_dielectric(c, n):
    """Return the reflectance for unpolarised light by A. Fresnel's sines and tangents, 1823."""
    i, t, both, passes = _snell(c, n)
    F = 0.5 * ((np.sin(i - t) / np.sin(both)) ** 2 + (np.tan(i - t) / np.tan(both)) ** 2)
    return np.where(passes, np.where(i > 0.0, F, ((n - 1.0) / (n + 1.0)) ** 2), 1.0)


def T_dielectric(c, n):
    """Return 1 - F_dielectric without the cancellation (M. Born and E. Wolf, sec. 1.5.3)."""
    i, t, both, passes = _snell(c, n)
    s = 4.0 * np.sin(i) * np.minimum(c, 1.0) * np.sin(t) * np.cos(t) / np.sin(both) ** 2
    T = 0.5 * s * (1.0 + np.cos(i - t) ** -2.0)
    return passes * np.where(i > 0.0, T, 4.0 * n / (n + 1.0) ** 2)


def F_conductor(c, eta, k):
    """Return the reflectance of a metal of index eta + ik (Born and Wolf, ch. 14)."""
    c = np.clip(c, 0.0, 1.0)
    square = (eta - k) * (eta + k) + 2.0j * eta * k
    w = np.sqrt(square - (1.0 - c) * (1.0 + c))  # index times the cosine inside
    s, p = (c - w) / (c + w), (square * c - w) / (square * c + w)
    return 0.5 * (np.abs(s) ** 2 + np.abs(p) ** 2)


def F_schlick(c, f0):
    """Return f0 + (1 - f0)(1 - c)^5 (C. Schlick, Eurographics 1994, eq. 15)."""
    return f0 + (1.0 - f0) * (1.0 - np.clip(c, 0.0, 1.0)) ** 5


def F_f82(c, f0, f82):
    """Return Schlick's curve less b c (1 - c)^6, f82 at c = 1/7 (N. Hoffman, MAM 2019)."""
    c = np.clip(c, 0.0, 1.0)
    return np.clip(F_schlick(c, f0) - _dip(f0, f82) * c * (1.0 - c) ** 6, 0.0, 1.0)


def _dip(f0, f82):
    return (F_schlick(1.0 / 7.0, f0) - f82) / (6.0**6 / 7.0**7)


def F_slide(c, n):
    """Return F of R. Cook and K. Torrance, 1982, with the slide's g = sqrt(n^-2 + c^2) - 1.

    Wrong on purpose: more than 1 at many angles. Its pole at g = -c is cut off at 1e-3.
    """
    g = np.sqrt(n**-2.0 + c**2) - 1.0
    ratio = (c * (g + c) - 1.0) / (c * (g - c) + 1.0)
    away = np.where(np.abs(g + c) < 1e-3, 1e-3, g + c)
    return 0.5 * ((g - c) / away) ** 2 * (1.0 + ratio**2)


def average_dielectric(n):
    """Return 2 int F c dc for a scalar n (J. Walsh, 1926; S. Duntley, 1942); n < 1: from inside.

    The closed form loses digits near n = 1 as 1e-16 / (n - 1)^2.
    """
    if n < 1.0:
        return 1.0 - n**2 * (1.0 - average_dielectric(1.0 / n))
    if n - 1.0 < 1e-8:
        return 0.0
    plus, minus, log = n**2 + 1.0, (n - 1.0) * (n + 1.0), math.log1p(n - 1.0)
    return (
        0.5
        + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) ** 2)
        + n**2 * minus**2 / plus**3 * math.log((n - 1.0) / (n + 1.0))
        - 2.0 * n**3 * (n**2 + 2.0 * n - 1.0) / (plus**2 * minus)
        + 8.0 * n**4 * (n**4 + 1.0) * log / (plus**3 * minus**2)
    )


def average_schlick(f0):
    """Return 2 int F_schlick c dc."""
    return f0 + (1.0 - f0) / 21.0


def average_f82(f0, f82):
    """Return 2 int F_f82 c dc."""
    return average_schlick(f0) - _dip(f0, f82) / 126.0


def D(H, alpha_x, alpha_y, distribution):
    """Return the density of normals [1/sr] at H above the surface, of any length; int D cos = 1.

    beckmann: B. Walter et al., EGSR 2007, eq. 25, alpha being the slide's m; ggx: eq. 33; stretched
    as E. Heitz, JCGT 3(2), 2014, sec. 5.
    """
    slope, phi = tangent(H), azimuth(H)
    q = (slope * np.cos(phi) / alpha_x) ** 2 + (slope * np.sin(phi) / alpha_y) ** 2
    shape = np.exp(-q) if distribution == "beckmann" else (1.0 + q) ** -2.0
    return shape * (1.0 + slope**2) ** 2 / (np.pi * alpha_x * alpha_y)


def smith_lambda(w, alpha_x, alpha_y, distribution):
    """Return Lambda of directions on either side (Heitz 2014, sec. 5), with the exact erfc."""
    alpha = np.hypot(alpha_x * np.cos(azimuth(w)), alpha_y * np.sin(azimuth(w)))
    return lambda_at(alpha * np.abs(tangent(w)), distribution)


def lambda_at(t, distribution):
    """Return Lambda where t = alpha tan(theta)."""
    if distribution != "beckmann":
        return 0.5 * t * np.tan(0.5 * np.arctan(t))  # (1/cos(x) - 1) / 2 with tan(x) = t
    t = np.maximum(t, 0.02)  # from here down Lambda underflows
    return 0.5 * (t * np.exp(-(t**-2.0)) / math.sqrt(math.pi) - _erfc(1.0 / t))


def G_smith(L, V, alpha_x, alpha_y, distribution):
    """Return the height-correlated masking and shadowing (Heitz 2014, eq. 99)."""
    return 1.0 / (1.0 + sum(smith_lambda(w, alpha_x, alpha_y, distribution) for w in (L, V)))


def G_separable(L, V, alpha_x, alpha_y, distribution):
    """Return G1(L) G1(V) (Walter et al. 2007, eq. 23)."""
    one, other = (1.0 + smith_lambda(w, alpha_x, alpha_y, distribution) for w in (L, V))
    return 1.0 / (one * other)


def G_v_groove(L, V):
    """Return min(1, 2 n.h n.v / v.h, 2 n.h n.l / v.h) (J. Blinn, SIGGRAPH 1977)."""
    lower = np.minimum(cosine(L), cosine(V))
    return np.minimum(1.0, 2.0 * cosine(L + V) * lower / half_cosine(L, V))
