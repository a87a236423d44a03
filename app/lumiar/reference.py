"""Every model in float64 NumPy, written from the papers with angles where the shaders use products.

L and V are (n, 3) unit directions in the local frame, away from the surface; each function returns
scatter = f |N.L|, (n, 3) [1/sr], as the GLSL file of the same name does. Parameters are the file's.
"""

import numpy as np


def lambert(L, V, albedo=(0.8, 0.8, 0.8), form="normalised"):
    """Return rho/pi cos(theta) (J. H. Lambert, 1760), or k_d cos(theta) as the slide reads."""
    return _color(albedo) * _column(_cos_positive(L) / (1.0 if form == "slide" else np.pi))


def phong(L, V, kd, ks, shininess, form="slide", diffuse=True, specular=True, **_):
    """Return the diffuse and specular terms of B. T. Phong, CACM 18(6), 1975, divided by pi.

    form "normalised": each lobe has the albedo k at normal incidence (E. Lafortune and Y. Willems,
    CW 197, 1994, eq. 9).
    """
    mirrored = L * [-1.0, -1.0, 1.0]
    lobe = _cos_power(_angle(mirrored, V), shininess)
    scale = (shininess + 2.0) / (2.0 * np.pi) * _cos_positive(L)
    return _lobes(L, _color(kd) * diffuse, _color(ks) * specular, lobe, scale, form)


def blinn(L, V, kd, ks, shininess, form="slide", diffuse=True, specular=True, **_):
    """Return the diffuse and specular terms of J. F. Blinn, SIGGRAPH 1977, divided by pi.

    form "normalised": the lobe has the albedo k at normal incidence (F. Giesen, 2009).
    """
    half = L + V
    lobe = _cos_power(_angle(half, np.broadcast_to([0.0, 0.0, 1.0], half.shape)), shininess)
    m = shininess
    scale = (m + 2.0) * (m + 4.0) / (8.0 * np.pi * (2.0 ** (-m / 2.0) + m)) * _cos_positive(L)
    return _lobes(L, _color(kd) * diffuse, _color(ks) * specular, lobe, scale, form)


def _lobes(L, kd, ks, lobe, scale, form):
    cosine = _cos_positive(L)
    lit = np.where(cosine > 0.0, lobe, 0.0)
    shiny = lit / np.pi if form == "slide" else lit * scale
    return kd * _column(cosine / np.pi) + ks * _column(shiny)


def _angle(a, b):
    """Return the angle between two directions, good at all angles (W. Kahan, 2006, sec. 12)."""
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(1))


def _cos_power(angle, exponent):
    return np.where(angle < np.pi / 2.0, np.cos(np.minimum(angle, np.pi / 2.0)), 0.0) ** exponent


def _cos_positive(w):
    theta = np.arctan2(np.hypot(w[:, 0], w[:, 1]), w[:, 2])
    return np.maximum(np.cos(theta), 0.0) * (w[:, 2] > 0.0)


def _column(values):
    return values[:, None]


def _color(values):
    return np.asarray(values, np.float64)[None, :]
