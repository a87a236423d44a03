"""The nodes of a glTF document: which are in its scene, and where they are in it."""

import math

import numpy as np

from lumiar.errors import Mistake
from lumiar.formats.gltf_data import entry, listed, numbers, whole


def placed(document):
    """Return [(node, its 4x4 matrix to the scene)] for all nodes of the default scene."""
    nodes = listed(document, "nodes", "the file")
    children = [listed(node, "children", f"node {i}", int) for i, node in enumerate(nodes)]
    parent = {}
    for i, below in enumerate(children):
        for c in below:
            entry(document, "nodes", c, f"node {i}")
            if c in parent:
                raise Mistake(f"node {c} is a child of node {parent[c]} and of node {i}; keep one")
            parent[c] = i
    roots = [i for i in range(len(nodes)) if i not in parent]
    tree = list(roots)
    for i in tree:  # grows while it is walked; ends, as a node has at most one parent
        tree += children[i]
    if len(tree) < len(nodes):
        lost = min(set(parent).difference(tree))
        raise Mistake(f"node {lost} is its own ancestor; remove it from the children of a node")
    if "scene" in document or listed(document, "scenes", "the file"):
        index = whole(document, "scene", "the file", 0)
        where = f"scene {index}"
        roots = listed(entry(document, "scenes", index, "the file"), "nodes", where, int)
        for i in roots:
            entry(document, "nodes", i, where)
            if i in parent:
                raise Mistake(f"node {i} is in {where} and a child of node {parent[i]}; keep one")
        if len(set(roots)) < len(roots):
            raise Mistake(f"a node is twice in {where}; keep one")
    found = [(i, _matrix(nodes[i], f"node {i}")) for i in roots]
    with np.errstate(all="ignore"):  # what overflows is found in the positions
        for i, matrix in found:  # grows too
            found += [(c, matrix @ _matrix(nodes[c], f"node {c}")) for c in children[i]]
    return found


def _matrix(node, where):
    """Return the 4x4 matrix from the space of a node to that of its parent."""
    if "matrix" in node:
        if any(key in node for key in ("translation", "rotation", "scale")):
            raise Mistake(f"{where} has a matrix and a translation, rotation or scale; keep one")
        matrix = np.reshape(numbers(node, "matrix", 16, where), (4, 4)).T  # stored by columns
        if matrix[3].tolist() != [0, 0, 0, 1]:
            raise Mistake(f"{where}: the last row of its matrix is not 0 0 0 1; correct it")
        return matrix
    x, y, z, w = numbers(node, "rotation", 4, where, [0, 0, 0, 1])
    length = math.hypot(x, y, z, w)
    if not 0 < length < math.inf:
        raise Mistake(f"{where}: its rotation has length {length:g}; write a unit quaternion")
    x, y, z, w = x / length, y / length, z / length, w / length
    turn = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix = np.eye(4)
    matrix[:3, :3] = turn * np.array(numbers(node, "scale", 3, where, [1, 1, 1]))
    matrix[:3, 3] = numbers(node, "translation", 3, where, [0, 0, 0])
    return matrix
