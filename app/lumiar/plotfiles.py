"""A plot of the window as a file: its numbers as a table, or a picture of it for a report."""

import contextlib
import math
import pickle
import subprocess
import sys
import tempfile
from typing import NamedTuple

import numpy as np

from . import __version__, facing, gonio, measuring, panels, tables
from .captions import TEXT
from .errors import one_line
from .files import python, write_whole

PATIENCE = 20.0  # seconds for a picture that is being made when the window closes
LOBES = ("polar", "curve", "lobe")  # the plots of f


class Drawn(NamedTuple):
    """What a plot shows: kind is one of those of `plots.single`; pixel (L, V) what is marked.

    models are Chosen (see `measuring`), shown what each has: a Curve, a Lobe, or an Albedo; aim
    says where the light stands and in which plane a Curve is, as `curves.Aim`.
    """

    kind: str
    models: tuple
    shown: tuple
    aim: object
    pixel: tuple | None = None


def csv(drawn):
    """Return the text of a table with its units: of f as `lumiar measure` writes it."""
    if drawn.kind in LOBES:
        return b"".join(tables.written(measurement(drawn), ".csv")).decode()
    albedo = drawn.kind == "albedo"
    share, angle = ("albedo", "theta_l") if albedo else ("F", "theta_facet")
    lines = [f"# Lumiar {'directional albedo' if albedo else 'Fresnel reflectance'}"]
    lines += [f"# {key}: {text}" for key, text in _header(drawn).items()]
    columns = [f"{angle} [degrees]", *(f"{share}_{c} [unitless]" for c in "rgb")]
    columns += ["error [unitless]"] * albedo + ["model [its number above]"]
    lines.append(f"# columns: {', '.join(columns)}")
    for i, one in enumerate(drawn.shown, 1):
        for row in zip(one.angles, one.values, one.error, strict=True):
            error = [f"{row[2]:.3g}"] * albedo
            numbers = [f"{row[0]:.12g}", *(f"{value:.9g}" for value in row[1]), *error, str(i)]
            lines.append(",".join(numbers))
    return "\n".join(lines) + "\n"


def measurement(drawn):
    """Return the tables.Measurement of a plot of f."""
    light, detector, scatter, number = [], [], [], []
    for i, one in enumerate(drawn.shown, 1):
        if drawn.kind == "lobe":
            grid = np.meshgrid(one.theta, (one.phi + drawn.aim.phi) % 360.0, indexing="ij")
            arm = np.stack([axis.ravel() for axis in grid], axis=1)
        else:
            arm = gonio.in_plane(np.zeros(1), drawn.aim.plane, one.angles)[1]
        detector.append(arm)
        light.append(np.tile([drawn.aim.theta, drawn.aim.phi % 360.0], (len(arm), 1)))
        scatter.append(one.f.reshape(-1, 3) * abs(math.cos(math.radians(drawn.aim.theta))))
        number.append(np.full(len(arm), i))
    parts = map(np.concatenate, (light, detector, scatter, number))
    light, detector, scatter, number = parts
    return tables.Measurement(_header(drawn), light, detector, scatter.astype(np.float32), number)


def png(drawn, lang):
    """Return the bytes of a picture of a plot, on white, with matplotlib."""
    from . import plots

    title = ", ".join(one.label for one in drawn.models)
    words, aim = TEXT[lang], drawn.aim
    under = ""
    if drawn.kind in ("polar", "curve") and drawn.pixel:
        L, V = drawn.pixel
        angles = facing.theta(L), facing.theta(V), facing.turn(L, V)
        under = "θₗ {:.1f}°, θᵥ {:.1f}°, φ {:.1f}°".format(*angles)
    elif drawn.kind in ("polar", "curve"):
        under = words["light"].format(round(aim.theta, 1))
    shown = drawn.shown
    if drawn.kind in LOBES:
        shown = [one._replace(light=round(one.light, 1)) for one in shown]
    return plots.single(drawn.kind, title, under, shown, _points(drawn), lang)


class Painting:
    """A picture of a plot that a process of its own writes, while the window goes on; release it.

    Raises OSError where no process can be started.
    """

    def __init__(self, drawn, lang, path):
        self.path = path
        self._told, self._said = (tempfile.TemporaryFile() for _ in "io")  # noqa: SIM115  by release
        pickle.dump((drawn, lang, path), self._told)
        self._told.seek(0)
        command, env = python("-c", "from lumiar import plotfiles; plotfiles.paint()")
        pipes = {"stdin": self._told, "stdout": subprocess.DEVNULL, "stderr": self._said}
        self._child = subprocess.Popen(command, env=env, **pipes)

    def release(self):
        """Wait for it, but not for ever."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._child.wait(PATIENCE)
        self._child.kill()
        self._child.wait()
        self._told.close()
        self._said.close()

    def end(self):
        """Return None while it goes on, then "", or the line of why there is no picture."""
        if self._child.poll() is None:
            return None
        self._said.seek(0)
        said = self._said.read().decode("utf-8", "replace").strip()
        return one_line(said.rpartition("\n")[2] or "no reason given") * bool(self._child.poll())


def paint():
    """Write the picture that a Painting asks for on the standard input."""
    drawn, lang, path = pickle.load(sys.stdin.buffer)  # from ourselves
    write_whole(path, [png(drawn, lang)])


def _points(drawn):
    """Return a Curve of one point for each model: f toward the V that is marked."""
    if not drawn.pixel or drawn.kind not in ("polar", "curve"):
        return []
    angle = drawn.aim.angle(drawn.pixel[1])[0]
    found = []
    for one in drawn.shown:
        f = np.array([[np.interp(angle, one.angles, channel) for channel in one.f.T]])
        found.append(
            panels.Curve(f"V: {one.label}", round(drawn.aim.theta, 1), np.array([angle]), f)
        )
    return found


def _header(drawn):
    """Return what a table says of itself, {key: text}."""
    told = {"program": f"Lumiar {__version__}, lumiar view", **measuring.described(drawn.models)}
    if drawn.kind in LOBES:
        told["light"] = f"{drawn.aim.theta:g} degrees from the normal"
        told["azimuth"] = f"{drawn.aim.phi % 360.0:g} degrees, of the light from the tangent"
        told["scatter"] = "f |cos theta_l|; brdf is f; theta from the normal, phi from the tangent"
    if drawn.pixel:
        for letter, w in zip("LV", drawn.pixel, strict=True):
            told[letter] = ", ".join(f"{x:.9g}" for x in w) + ", of the pixel, local frame"
    return told
