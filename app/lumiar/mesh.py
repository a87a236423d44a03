"""Triangle meshes as arrays: what a file holds, made ready to be lit."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Polygons:
    """What a mesh file holds, as it holds it: polygons over shared positions.

    positions  (V, 3) float64, in the file's own unit
    corners    (C,) int64, the position index of each polygon corner, polygon after polygon
    sizes      (P,) int64, the number of corners of each polygon, every one at least 3
    normals    (N, 3) float64 and normal_of (C,) int64: the normal index of each corner, -1 for none
    uvs        (U, 2) float64 and uv_of (C,) int64: the texture coordinate of each corner, -1 for none
    notes      what was repaired while reading, one short phrase each
    """

    positions: np.ndarray
    corners: np.ndarray
    sizes: np.ndarray
    normals: np.ndarray | None = None
    normal_of: np.ndarray | None = None
    uvs: np.ndarray | None = None
    uv_of: np.ndarray | None = None
    notes: tuple[str, ...] = ()
