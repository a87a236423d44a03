"""What every reader ends with: its arrays checked against each other and made into Polygons."""

import numpy as np

from lumiar.errors import Mistake, one_line
from lumiar.polygons import Polygons

MOST_VERTICES = 10_000_000  # with MOST_CORNERS, keeps a refused file under 1.5 GB of memory
MOST_CORNERS = 50_000_000
NO_FACES = "no faces; a point cloud, lines or curves cannot be lit: write faces too"
FARTHEST = 1e18  # squares of float32 numbers beyond this overflow


def mistake(name, what, line=None):
    """Return the Mistake that says in one line `what` is wrong in file `name`, at a `line`."""
    shown = one_line(name, 1000)
    shown = shown if len(shown) <= 150 else "…" + shown[-149:]  # leaves room for the advice
    where = shown if line is None else f"{shown}:{line}"
    return Mistake(one_line(f"{where}: {what}"))


def limit(name, vertices=0, corners=0):
    """Raise a Mistake if a mesh of so many vertices or face corners is more than is read here."""
    for count, most, what in (
        (vertices, MOST_VERTICES, "vertices"),
        (corners, MOST_CORNERS, "face corners"),
    ):
        if count > most:
            raise mistake(name, f"{count} {what}, but at most {most} are read; simplify the mesh")


def float64(values):
    """Return `values` as float64; a signalling NaN, which some exporters leave, is quiet too."""
    with np.errstate(invalid="ignore"):
        return values.astype(np.float64)


def near(values):
    """Return True for each row of `values` that is finite and safe in float32 arithmetic."""
    return ((values >= -FARTHEST) & (values <= FARTHEST)).all(axis=1)


def all_near(values):
    """Return whether all of `values`, at least one, are finite and safe in float32 arithmetic."""
    return values.min() >= -FARTHEST and values.max() <= FARTHEST  # false for NaN, copies nothing


def polygons(
    name,
    positions,
    corners,
    sizes,
    normals=None,
    normal_of=None,
    uvs=None,
    uv_of=None,
    notes=(),
    first=0,
    line_of=lambda kind, index: None,
):
    """Return the Polygons of these arrays after checking all that a reader must promise.

    The arrays are as in Polygons, but whole numbers may be of any type. For the errors, the file
    counts from `first`, and `line_of("vertex" or "face", index)` is a line. Raises a Mistake for
    no polygon, a polygon of fewer than 3 corners, an index out of range, or a used position that
    is not finite. Other values that are not finite are repaired and noted.
    """
    notes = list(notes)
    if len(sizes) == 0:
        raise mistake(name, NO_FACES)
    limit(name, corners=len(corners))
    if sizes.min() < 3:
        face = int(np.argmax(sizes < 3))
        what = f"face {face + first} has {sizes[face]} corners; a face needs at least 3"
        raise mistake(name, what, line_of("face", face))
    for what, values, index, lowest in (
        ("vertex", positions, corners, 0),
        ("normal", normals, normal_of, -1),
        ("texture coordinate", uvs, uv_of, -1),
    ):
        if index is not None and (index.min() < lowest or index.max() >= len(values)):
            beyond = index >= len(values) if index.max() >= len(values) else index < lowest
            corner = int(np.argmax(beyond))
            face = int(np.searchsorted(np.cumsum(sizes), corner, side="right"))
            what = f"face {face + first} uses {what} {index[corner] + first} of {len(values)}"
            advice = (
                f"write {first} to {len(values) - 1 + first}" if len(values) else "write it too"
            )
            raise mistake(name, f"{what}; {advice}", line_of("face", face))
    positions = _used(name, positions, corners, notes, first, line_of)
    normals, normal_of = _finite("normals", normals, normal_of, notes)
    uvs, uv_of = _finite("texture coordinates", uvs, uv_of, notes)
    corners, sizes = corners.astype(np.int64), sizes.astype(np.int64)
    return Polygons(positions, corners, sizes, normals, normal_of, uvs, uv_of, tuple(notes))


def _used(name, positions, corners, notes, first, line_of):
    """Return positions that are all near: a bad one that no face uses moves to a used one."""
    if all_near(positions):
        return positions
    bad = ~near(positions)
    used = np.zeros(len(positions), bool)
    used[corners] = True
    if (bad & used).any():
        vertex = int(np.argmax(bad & used))
        x, y, z = positions[vertex]
        what = f"vertex {vertex + first} is at ({x:g}, {y:g}, {z:g}); write finite numbers to 1e18"
        raise mistake(name, what, line_of("vertex", vertex))
    notes.append(f"{bad.sum()} unused vertices are not finite")
    return np.where(bad[:, None], positions[corners[0]], positions)


def _finite(what, values, value_of, notes):
    """Return values and their indices, -1 where a value is not finite; None and None if none is."""
    if value_of is None:
        return None, None
    value_of, bad = value_of.astype(np.int64), ~near(values)
    if bad.any():
        notes.append(f"{bad.sum()} {what} are not finite: left out")
        values = np.where(bad[:, None], 0.0, values)
        value_of = np.where((value_of >= 0) & bad[value_of], -1, value_of)
    return (values, value_of) if value_of.max() >= 0 else (None, None)
