"""What a gonioreflectometer measured, as a table in a file that tells what it holds; and back.

A .csv has comment lines, `# key: value`, then nothing but numbers, so that NumPy, pandas and
gnuplot read it; an .npz has the same as arrays. Exact pairs of directions come in an .npz too.
"""

import io
import json
import math
import zipfile
from typing import NamedTuple

import numpy as np

from .errors import Mistake, nearest, one_line
from .files import read_bytes
from .gonio import divided

LIMIT = 1 << 30  # bytes of a file that is read, and of the arrays in it
UNIT = 1e-4  # how far from 1 the length of a direction may be
CHECKED = 1 << 18  # directions checked at a time
MAGIC = "Lumiar measurement"
COLUMNS = {
    **dict.fromkeys(("theta_l", "phi_l", "theta_v", "phi_v"), "degrees"),
    **dict.fromkeys([f"scatter_{c}" for c in "rgb"] + [f"brdf_{c}" for c in "rgb"], "1/sr"),
    "model": "its number above",
}


class Measurement(NamedTuple):
    """A table of n directions; header tells in {key: text} how it was measured.

    light, detector  (n, 2) theta and phi of the two arms [degrees]
    scatter          (n, 3) f |cos theta_l| in red, green, blue [1/sr]
    model            (n,) which of the header's models, from 1
    """

    header: dict
    light: np.ndarray
    detector: np.ndarray
    scatter: np.ndarray
    model: np.ndarray

    @property
    def brdf(self):
        """f itself, (n, 3) [1/sr]; NaN where the light grazes, at exactly 90 degrees."""
        return divided(self.scatter, self.light[:, 0])

    @property
    def angles(self):
        """The detector's angle in the plane of incidence, negative on the light's side; (n,).

        In degrees; NaN for a detector that stands outside that plane.
        """
        away = np.cos(np.radians(self.detector[:, 1] - self.light[:, 1]))
        side = np.where(away > 0.0, -1.0, 1.0)
        on_axis = np.isin(self.detector[:, 0], (0.0, 180.0))
        return np.where((np.abs(away) > 1 - 1e-6) | on_axis, side * self.detector[:, 0], np.nan)


def written(measurement, ending):
    """Yield the bytes of a Measurement as a .csv, which tells what it holds, or as an .npz."""
    m = measurement
    if ending == ".npz":
        out, arms = io.BytesIO(), np.concatenate([m.light, m.detector], axis=1).T
        arrays = dict(zip(COLUMNS, arms, strict=False))
        header = np.array(json.dumps(m.header, ensure_ascii=False))
        np.savez(out, **arrays, scatter=m.scatter, brdf=m.brdf, model=m.model, header=header)
        yield out.getvalue()
        return
    yield f"# {MAGIC}\n".encode()
    for key, value in m.header.items():
        yield f"# {key}: {one_line(value, 10_000)}\n".encode()
    columns = ", ".join(f"{name} [{unit}]" for name, unit in COLUMNS.items())
    yield f"# columns: {columns}\n".encode()
    for i in range(0, len(m.light), 4096):
        some = slice(i, i + 4096)
        arms = np.concatenate([m.light[some], m.detector[some]], axis=1).tolist()
        values = np.concatenate([m.scatter[some], m.brdf[some]], axis=1).tolist()
        rows = zip(arms, values, m.model[some].tolist(), strict=True)
        form = ",".join(["%.12g"] * 4 + ["%.9g"] * 6 + ["%d"]) + "\n"
        yield "".join(form % (*a, *v, which) for a, v, which in rows).encode()


def read(path):
    """Return the Measurement that a file holds that `written` made; raise Mistake, file:line."""
    data = read_bytes(path, LIMIT, "a measurement, .csv or .npz")
    if data[:2] == b"PK":
        return _read_npz(path)
    header, rows, first = {}, [], f"its first line is '# {MAGIC}'"
    lines = data.decode("utf-8", "replace").splitlines()
    if not lines or lines[0].lstrip("\ufeff").strip() != f"# {MAGIC}":
        raise Mistake(f"{path}:1: no measurement of Lumiar's; {first}")
    for number, line in enumerate(lines[1:], 2):
        if line.startswith("#"):
            key, _, value = line[1:].partition(":")
            header[key.strip()] = value.strip()
        elif line.strip():
            rows.append(_row(line, f"{path}:{number}: "))
    names = [part.split("[")[0].strip() for part in header.pop("columns", "").split(",")]
    if names != [*COLUMNS]:
        raise Mistake(f"{path}:1: its columns are not '{', '.join(COLUMNS)}'; measure it again")
    values = np.array(rows).reshape(-1, len(COLUMNS))
    scatter, model = values[:, 4:7].astype(np.float32), values[:, -1].astype(int)
    return Measurement(header, values[:, :2], values[:, 2:4], scatter, model)


def _row(line, where):
    try:
        values = [float(part) for part in line.split(",")]
    except ValueError:
        values = []
    if len(values) != len(COLUMNS):
        raise Mistake(f"{where}a row is {len(COLUMNS)} numbers with commas between them")
    if not all(map(math.isfinite, (*values[:4], values[-1]))):
        raise Mistake(f"{where}an angle is not finite; write degrees")
    return values


def _read_npz(path):
    arms = [*COLUMNS][:4]
    found = arrays(path, [*arms, "scatter", "model", "header"], "a measurement, .csv or .npz")
    n = found["scatter"].shape[:1]
    good = all(found[k].shape == n and found[k].dtype.kind in "fiu" for k in (*arms, "model"))
    good = good and found["scatter"].shape == (*n, 3) and found["scatter"].dtype.kind == "f"
    try:
        header = {str(k): str(v) for k, v in json.loads(str(found["header"])).items()}
    except (ValueError, AttributeError):
        good = False
    if not good or not all(np.isfinite(found[name]).all() for name in arms):
        raise Mistake(f"{path}: its arrays are no measurement of Lumiar's; measure it again")
    light, detector = (np.stack([found[k] for k in two], 1) for two in (arms[:2], arms[2:]))
    return Measurement(header, light, detector, found["scatter"], found["model"])


def arrays(path, names, what):
    """Return {name: array} of an .npz; raise Mistake for one that is damaged or lacks any.

    Nothing pickled is ever loaded. `what` says what to name instead, as in "an .npz of pairs".
    """
    read_bytes(path, LIMIT, what, mapped=True)
    try:
        with zipfile.ZipFile(path) as archive:
            size = sum(entry.file_size for entry in archive.infolist())
        if size > LIMIT:
            raise Mistake(f"{path}: {size} bytes of arrays; allowed: up to {LIMIT}; split it")
        with np.load(path, allow_pickle=False) as file:
            held = file.files
            found = {name: file[name] for name in names if name in held}
    except Mistake:
        raise
    except Exception as error:  # zipfile, zlib and NumPy each raise their own
        objects = "Python objects" in str(error) or "allow_pickle" in str(error)
        why = "holds Python objects; save plain numbers" if objects else "damaged, or no .npz"
        raise Mistake(f"{path}: {why}; name {what}") from None
    for name in names:
        if name not in found:
            raise Mistake(f"{path}: no array '{name}'; {nearest(name, held)}; name {what}")
    return found


def pairs(path):
    """Return (L, V), (n, 3) float64 each, from an .npz; raise Mistake for what is no direction."""
    what = "an .npz with unit directions L and V, float64 (n, 3)"
    found = arrays(path, ("L", "V"), what)
    for name, array in found.items():
        if array.dtype.kind not in "fiu" or array.ndim != 2 or array.shape[1] != 3:
            raise Mistake(f"{path}: {name} is {array.dtype} {array.shape}; save float64 (n, 3)")
        for i in range(0, len(array), CHECKED):
            with np.errstate(over="ignore", invalid="ignore"):
                far = np.abs(np.linalg.norm(array[i : i + CHECKED], axis=1) - 1.0)
            if not (far <= UNIT).all():  # nor where it is NaN
                row = i + int(np.argmin(far <= UNIT))
                shown = ", ".join(f"{x:.6g}" for x in array[row])
                raise Mistake(f"{path}: {name}[{row}] = ({shown}) is not of length 1; divide by it")
    L, V = (np.asarray(array, np.float64) for array in found.values())
    if L.shape != V.shape:
        raise Mistake(f"{path}: {len(L)} L but {len(V)} V; save a pair in each row")
    return L, V
