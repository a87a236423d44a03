"""What a renderer keeps on the graphics card: meshes, tables of lights, what hides them."""

import os
from contextlib import suppress

import moderngl

from . import geometry, layout

MESHES = 64  # kept on the graphics card


class Stock:
    """Meshes and tables on the card, made once; release it, in its context."""

    def __init__(self, context):
        self.context = context
        self.meshes, self.arrays = {}, {}
        self._textures, self._hiding = {}, (None, {})

    def release(self):
        """Free all of it."""
        self.forget_meshes()
        for texture in (*(t for _, t in self._textures.values()), *self._hiding[1].values()):
            texture.release()

    def mesh(self, one):
        """Return (Geometry, vertex, tangent and index buffer) of an object's mesh."""
        tangents = "tangent" in one.model.needs
        key = (one.mesh, one.crease, tangents, _state(one.mesh))
        if key not in self.meshes:
            mesh = geometry.load(one.mesh, crease=one.crease, tangents=tangents)
            buffers = (mesh.vertices, mesh.tangents, mesh.indices)
            made = (self.context.buffer(b) if len(b) else None for b in buffers)
            self.meshes[key] = (mesh, *made)
        return self.meshes[key]

    def make_room(self):
        """Forget the meshes when there are many: a slider may have named hundreds of shapes."""
        if len(self.meshes) > MESHES:
            self.forget_meshes()

    def forget_meshes(self):
        """Free every mesh and what feeds it to programs."""
        buffers = {b for _, *three in self.meshes.values() for b in three if b}
        for key in [key for key in self.arrays if key[-1] in buffers]:
            self.arrays.pop(key).release()
        for buffer in buffers:
            buffer.release()
        self.meshes.clear()

    def forget_program(self, program):
        """Free what feeds meshes to a program."""
        for key in [key for key in self.arrays if key[0] == program]:
            self.arrays.pop(key).release()

    def array(self, program, entry):
        """Return the vertex array that feeds a mesh to a program, without what it does not take."""
        key = (program, entry[1])
        if key not in self.arrays:
            names = ("rig_vertex", "rig_vertex_normal")
            form = " ".join("3f" if name in program else "12x" for name in names)
            content = [(entry[1], form, *(name for name in names if name in program))]
            if "rig_vertex_tangent" in program:
                content.append((entry[2], "4f", "rig_vertex_tangent"))
            self.arrays[key] = self.context.vertex_array(program, content, entry[3])
        return self.arrays[key]

    def tables(self, scene, placed):
        """Return {name: texture} of all that the lights of a scene look up."""
        found, kept = {}, {}
        given = [layout.tables(light, number) for number, light in enumerate(scene.lights, 1)]
        for name, texels in (pair for tables in given for pair in tables.items()):
            held = kept.get(id(texels)) or self._textures.pop(id(texels), None)
            held = held or (texels, self._made(*texels))
            kept[id(texels)], found[name] = held, held[1]
        for _, texture in self._textures.values():  # of scenes before
            texture.release()
        self._textures = kept
        if layout.shadows(scene):
            found |= self._hidden_by(placed)
        return found

    def _made(self, size, components, data, linear=False):
        texture = self.context.texture(size, components, data, dtype="f4")
        kind = moderngl.LINEAR if linear else moderngl.NEAREST
        texture.filter, texture.repeat_y = (kind, kind), False
        return texture

    def _hidden_by(self, placed):
        """Return {name: texture} of what shadow rays may meet, built anew when an object moves."""
        key = [(one.geometry, one.world) for one in placed]
        if self._hiding[0] != key:
            from . import occluders

            made = occluders.build(_triangles(key))
            for texture in self._hiding[1].values():
                texture.release()
            pairs = zip(
                ("rig_nodes", "rig_corners"), (made.nodes, made.corners), made.sizes, strict=True
            )
            self._hiding = (key, {name: self._made(size, 4, data) for name, data, size in pairs})
        return self._hiding[1]


def _triangles(placed):
    """Return the triangles (n, 3, 3) float32 of all that is placed, in the world."""
    import numpy as np

    found = []
    for mesh, world in placed:
        points = np.frombuffer(mesh.vertices, np.float32).reshape(-1, 6)[:, :3].astype(np.float64)
        matrix = np.reshape(world, (4, 4))
        points = points @ matrix[:3, :3].T + matrix[:3, 3]
        found.append(points.astype(np.float32)[np.frombuffer(mesh.indices, np.uint32)])
    return np.concatenate(found).reshape(-1, 3, 3)


def _state(path):
    """Return what changes when the mesh file at a path does; None for a built-in shape."""
    if not os.path.isabs(path):
        return None
    with suppress(OSError):  # loading it will tell
        status = os.stat(path)
        return status.st_size, status.st_mtime_ns
