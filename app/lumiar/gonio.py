"""The two arms of a gonioreflectometer and its detector: where they stand and what is seen there.

Angles are in degrees, as on the instrument: theta from the normal, phi from the tangent. The model
is a function `evaluate(L, V)` of unit directions (n, 3) that returns scatter = f |N.L|, (n, 3)
[1/sr]; this module knows nothing of what computes it.
"""

import math

import numpy as np

BATCH = 1 << 18  # pairs evaluated at a time: bounds the memory
CONE = 64  # directions that stand for a detector's aperture


def divided(scatter, theta):
    """Return f = scatter / |cos theta| (n, 3), NaN at exactly 90 degrees; theta in degrees."""
    cos = np.abs(directions(theta, 0.0)[..., 2:])
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(cos > 0.0, scatter / cos, np.nan)


def directions(theta, phi):
    """Return unit directions (…, 3) at angles in degrees; multiples of 90 are hit exactly."""
    theta, phi = np.broadcast_arrays(np.asarray(theta, np.float64), phi)
    s = _sine(theta)
    return np.stack([s * _sine(phi + 90.0), s * _sine(phi), _sine(theta + 90.0)], axis=-1)


def _sine(degrees):
    """Return the sine, which is 0 and ±1 exactly where it ought to be."""
    turn = np.remainder(degrees, 360.0)
    fold = np.where(turn > 180.0, turn - 180.0, turn)
    value = np.sin(np.radians(np.minimum(fold, 180.0 - fold)))
    return np.where(turn > 180.0, -value, value)


def steps(low, high, step):
    """Return low, low + step, … up to high, in degrees, without what sums of steps round off."""
    return np.round(low + step * np.arange(math.floor((high - low) / step + 1e-9) + 1), 9)


def in_plane(lights, azimuth, angles):
    """Return (light (n, 2), detector (n, 2)) of a scan in the plane of incidence, in degrees.

    For each of the lights' angles the detector goes through `angles`, negative on the light's side.
    """
    theta_l, angle = (grid.ravel() for grid in np.meshgrid(lights, angles, indexing="ij"))
    phi = np.where(angle < 0.0, azimuth, azimuth + 180.0) % 360.0
    light = np.stack([theta_l, np.full_like(theta_l, azimuth)], axis=1)
    return light, np.stack([np.abs(angle), phi], axis=1)


def hemispherical(lights, azimuth, step, highest=90.0):
    """Return (light (n, 2), detector (n, 2)) of all directions up to `highest` from the normal.

    For each light a grid: theta = 0, step, …, and within it phi = 0, step, …, below 360 degrees.
    """
    around = steps(0.0, 360.0, step)
    around = around[around < 360.0]
    grid = np.meshgrid(lights, steps(0.0, highest, step), around, indexing="ij")
    theta_l, theta, phi = (axis.ravel() for axis in grid)
    light = np.stack([theta_l, np.full_like(theta_l, azimuth)], axis=1)
    return light, np.stack([theta, phi], axis=1)


def batched(evaluate, L, V):
    """Return evaluate(L, V) (n, 3) float32, asked for BATCH pairs at a time."""
    found = np.empty((len(L), 3), np.float32)
    for i in range(0, len(L), BATCH):
        found[i : i + BATCH] = evaluate(L[i : i + BATCH], V[i : i + BATCH])
    return found


def measured(evaluate, light, detector, aperture=0.0, opaque=True):
    """Return the scatter (n, 3) [1/sr] that a detector of some aperture sees; arms in degrees.

    aperture is the half-angle of the detector's cone, over which the mean is taken: CONE directions
    of equal solid angle on a spiral (H. Vogel, Mathematical Biosciences 44, 1979). Nothing comes
    through an `opaque` surface, so that what of the cone lies below its horizon counts as 0.
    """
    found = np.zeros((len(light), 3))
    chunk = BATCH // CONE if aperture else BATCH
    for i in range(0, len(light), chunk):
        L, V = directions(*light[i : i + chunk].T), directions(*detector[i : i + chunk].T)
        V = _cone(V, aperture) if aperture else V[:, None]
        L = np.broadcast_to(L[:, None], V.shape)
        scatter = np.asarray(evaluate(L.reshape(-1, 3), V.reshape(-1, 3)), np.float64)
        scatter = scatter.reshape(V.shape)
        if opaque:
            scatter = np.where(V[..., 2:] < 0.0, 0.0, scatter)
        found[i : i + chunk] = scatter.mean(axis=1)
    return found


def noisy(scatter, sigma, generator):
    """Return what a detector with relative Gaussian noise of deviation sigma says of scatter."""
    return scatter * (1.0 + sigma * generator.standard_normal(scatter.shape))


def _cone(V, aperture):
    """Return CONE directions around each V (n, 3), (n, CONE, 3).

    The frame about V is that of T. Duff et al., Journal of Computer Graphics Techniques 6(1), 2017.
    """
    i = np.arange(CONE)
    drop = 2.0 * math.sin(math.radians(aperture) / 2.0) ** 2 * (i + 0.5) / CONE  # 1 - cos
    radius, turn = np.sqrt(drop * (2.0 - drop)), math.pi * (3.0 - math.sqrt(5.0)) * i
    x, y, z = V.T
    sign = np.copysign(1.0, z)
    a = -1.0 / (sign + z)
    one = np.stack([1.0 + sign * x * x * a, sign * x * y * a, -sign * x], axis=1)[:, None]
    other = np.stack([x * y * a, sign + y * y * a, -y], axis=1)[:, None]
    sideways = np.cos(turn)[:, None] * one + np.sin(turn)[:, None] * other
    return (1.0 - drop)[:, None] * V[:, None] + radius[:, None] * sideways


def lobe_angles(light, highest=90.0, eta=1.0, step=0.5):
    """Return detector angles in the plane that resolve a lobe however narrow it is, in degrees.

    Besides even steps from -highest to highest, ever finer ones toward the light's own direction,
    the mirror's, and, where highest is 180, those straight on and refracted (index eta).
    """
    bent = math.degrees(math.asin(min(1.0, math.sin(math.radians(light)) / eta)))
    near = np.geomspace(1e-3, 8.0, 48)
    parts = [steps(-highest, highest, step)]
    for centre in (light, -light, 180.0 - light, 180.0 - bent if light < 90.0 else bent):
        parts.append(centre + np.concatenate([-near, [0.0], near]))
    edge = highest if highest > 90.0 else highest - 0.01  # nothing is seen along a surface itself
    return np.unique(np.clip(np.concatenate(parts), -edge, edge))


def lobe(evaluate, light, azimuth=0.0, highest=90.0, eta=1.0):
    """Return (detector angles (n,), f (n, 3)) in the plane of incidence, all of a lobe resolved."""
    angles = lobe_angles(light, highest, eta)
    arms = in_plane(np.array([light]), azimuth, angles)
    return angles, divided(measured(evaluate, *arms, opaque=highest <= 90.0), light)


def full_lobe(evaluate, light, azimuth=0.0, highest=90.0, eta=1.0):
    """Return (theta (a,), phi (b,), f (a, b, 3)) over all directions; phi is from the light's."""
    theta = lobe_angles(light, highest, eta, 3.0)
    theta = np.unique(np.abs(theta[np.abs(theta) <= highest]))[::2]
    near = np.geomspace(0.05, 40.0, 24)
    phi = np.unique(np.concatenate([steps(0.0, 360.0, 5.0), 180.0 - near, 180.0 + near]))
    grid = (axis.ravel() for axis in np.meshgrid(theta, phi + azimuth, indexing="ij"))
    detector = np.stack([*grid], axis=1)
    arms = np.broadcast_to([light, azimuth], detector.shape), detector
    f = divided(measured(evaluate, *arms, opaque=highest <= 90.0), light)
    return theta, phi, f.reshape(len(theta), len(phi), 3)
