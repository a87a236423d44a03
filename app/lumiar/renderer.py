"""Owns the objects on the graphics card: Scene → linear radiance → displayed pixels."""

import math
import os
from contextlib import suppress
from typing import NamedTuple

import moderngl

from . import camera, compose, geometry, layout
from .errors import Mistake, one_line

STRIP = 1 << 23  # samples drawn at a time: bounds the memory (180 MB) and the longest wait
MESHES = 64  # kept on the graphics card
COMMON = 8192  # pixels a side that every driver draws; asking it takes a millisecond
INSTALL = "install a driver: on Debian or Ubuntu `apt install libegl1 libgl1-mesa-dri`"


class _Job(NamedTuple):
    """One object ready to draw: what to bind, how its faces wind, what to set."""

    array: object
    closed: bool
    winding: str
    uniforms: tuple


def open_context():
    """Return a moderngl context without a window, OpenGL 3.3 or later; raise Mistake if none."""
    with suppress(Exception):  # this is the fast way; moderngl's own tries more of them
        from glcontext import egl

        names = {"libgl": "libGL.so.1", "libegl": "libEGL.so.1"}
        raw = egl.create_context(mode="standalone", glversion=330, **names)
        return moderngl.create_context(context=raw, require=330)
    try:
        return moderngl.create_context(standalone=True, require=330)
    except Exception as error:  # moderngl raises nothing more specific
        reason = one_line(error, 120)
        raise Mistake(f"needs OpenGL 3.3, but none could be opened ({reason}); {INSTALL}") from None


def compiled(context, sources):
    """Return the program of sources {stage: Source}; raise Mistake naming file:line."""
    texts = {f"{stage}_shader": source.text for stage, source in sources.items()}
    try:
        return context.program(**texts)
    except moderngl.Error as error:
        from . import driverlog

        path, line, message = driverlog.locate(str(error), sources)
        where = f"{path}:{line}: " if path else ""
        raise Mistake(f"{where}the driver does not compile this: {message}") from None


class OnCard:
    """What holds objects in one OpenGL context, its own unless one is given."""

    def __init__(self, context=None):
        self.context = context or open_context()
        self._owns_context = context is None
        self._idle = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.release()

    def release(self):
        """Free everything on the graphics card; the second time does nothing."""
        if self.context is None:
            return
        with self.context:
            self._free()
            if self._idle:
                (attachment,) = self._idle.color_attachments
                attachment.release()
                self._idle.release()
        if self._owns_context:
            self.context.release()
        self.context = None

    def _free(self):
        """Free what the class itself has made, in the context."""

    def _free_framebuffer(self, framebuffer):
        """Free a framebuffer and what is attached to it; one that goes while bound is an error."""
        self._idle = self._idle or self.context.framebuffer([self.context.renderbuffer((1, 1))])
        self._idle.use()
        for attachment in (*framebuffer.color_attachments, framebuffer.depth_attachment):
            if attachment:
                attachment.release()
        framebuffer.release()


class Renderer(OnCard):
    """Draws scenes; release it or use `with`."""

    def __init__(self, context=None):
        super().__init__(context)
        self._programs, self._meshes, self._arrays, self._targets = {}, {}, {}, {}
        self._watches_loops = False
        self._drawn = (None, [])  # the last scene and its jobs: most frames draw it again

    def _free(self):
        buffers = [b for _, *three in self._meshes.values() for b in three if b]
        for made in (*self._arrays.values(), *self._programs.values(), *buffers):
            made.release()
        self._release_targets()

    @property
    def name(self):
        """The renderer and the version of its driver, as the driver tells them."""
        with self.context:  # another one, or none, may be the current one
            info = self.context.info
        return f"{info['GL_RENDERER']}, OpenGL {info['GL_VERSION']}"

    @property
    def may_cut_loops(self):
        """Whether what was drawn has loops, and this driver is known to cut long ones short."""
        return self._watches_loops and "llvmpipe" in self.name

    def strips(self, scene, linear=False):
        """Yield the picture of a scene as strips of rows, top first: (bytes, broken pixels).

        The bytes are sRGB, 3 per pixel, or, if linear, radiance, 3 float32 per pixel. broken counts
        the pixels whose radiance is NaN or infinite; sRGB shows them in magenta. Raises Mistake for
        a size the driver cannot draw, and for errors in shaders and meshes.
        """
        width, height = scene.size
        side = math.isqrt(scene.samples)
        self._check_size(width, height, side)
        rows = max(1, min(height, STRIP // (width * side * side)))
        for top in range(0, height, rows):
            with self.context:  # another renderer's may be the current one
                strip = self._strip(scene, linear, side, rows, top)
            yield strip

    def _strip(self, scene, linear, side, rows, top):
        width, height = scene.size
        count = min(rows, height - top)
        radiance, picture = self._target(width, rows, side, linear)
        radiance.viewport = (0, -top * side, width * side, height * side)
        self.draw(scene, radiance)
        self.present(scene, radiance, picture, linear)
        area, dtype, step = (0, 0, width, count), *(("f4", 16) if linear else ("f1", 4))
        finite = picture.read(area, 4, dtype=dtype)[step - 1 :: step]  # the top byte of alpha
        return picture.read(area, 3, dtype=dtype), finite.count(b"\0")

    def draw(self, scene, framebuffer):
        """Draw the linear radiance of a scene into a framebuffer with a depth buffer."""
        jobs = self._jobs(scene)
        framebuffer.use()
        framebuffer.clear(*scene.background, 0.0)
        for job in jobs:
            for member, value in job.uniforms:
                member.write(value)
            culling = moderngl.CULL_FACE if job.closed else moderngl.NOTHING
            self.context.enable_only(moderngl.DEPTH_TEST | culling)
            self.context.front_face = job.winding
            job.array.render()

    def present(self, scene, radiance, picture, linear=False):
        """Turn drawn radiance into pixels: mean of the samples, exposure, tone curve, sRGB."""
        constants = {
            "side": math.isqrt(scene.samples),
            "target": "linear" if linear else "display",
            "tone": scene.tone,
            "exposed": scene.exposure != 0.0 and not linear,
        }
        array = self._screen("present", constants)
        if "rig_exposure" in array.program:
            array.program["rig_exposure"].value = 2.0**scene.exposure
        radiance.color_attachments[0].use(0)
        picture.use()
        self.context.enable_only(moderngl.NOTHING)
        array.render(moderngl.TRIANGLES, vertices=3)

    def _jobs(self, scene):
        """Return what it takes to draw each object of a scene."""
        if self._drawn[0] is not scene:
            if len(self._meshes) > MESHES:
                self._forget_meshes()
            entries = [self._mesh(one) for one in scene.objects]
            placed = layout.arrange(scene, [entry[0] for entry in entries])
            jobs = [self._job(scene, *pair) for pair in zip(placed, entries, strict=True)]
            self._drawn = (scene, jobs)
        return self._drawn[1]

    def _job(self, scene, placed, entry):
        program = self._program(scene, placed)
        values = layout.uniforms(scene, placed)
        members = ((program.get(name, None), value) for name, value in values.items())
        uniforms = tuple((member, value) for member, value in members if member is not None)
        winding = "ccw" if camera.mirrors(placed.world) else "cw"  # y points down in clip space
        return _Job(self._array(program, entry), placed.closed, winding, uniforms)

    def _program(self, scene, placed):
        """Return the program for an object of a scene, compiled once."""
        texts = (placed.object.model.text, *(light.kind.text for light in scene.lights))
        facts = (scene.shading, placed.closed, placed.transformed)
        key = (*facts, *texts, *layout.constants(scene, placed).items())
        if key not in self._programs:
            self._programs[key] = self._compile(layout.sources(scene, placed))
        return self._programs[key]

    def _screen(self, rig, constants):
        key = (rig, *constants.items())
        if key not in self._programs:
            self._programs[key] = self._compile(compose.screen(rig, constants))
            self._arrays[key] = self.context.vertex_array(self._programs[key], [])
        return self._arrays[key]

    def _compile(self, sources):
        self._watches_loops |= any("rig_cut_short" in one.text for one in sources.values())
        return compiled(self.context, sources)

    def _mesh(self, one):
        """Return (Geometry, vertex, tangent and index buffer) of an object's mesh."""
        tangents = "tangent" in one.model.needs
        key = (one.mesh, one.crease, tangents, _state(one.mesh))
        if key not in self._meshes:
            mesh = geometry.load(one.mesh, crease=one.crease, tangents=tangents)
            buffers = (mesh.vertices, mesh.tangents, mesh.indices)
            made = (self.context.buffer(b) if len(b) else None for b in buffers)
            self._meshes[key] = (mesh, *made)
        return self._meshes[key]

    def _forget_meshes(self):
        """Make room on the graphics card: a slider may have named hundreds of shapes."""
        buffers = {b for _, *three in self._meshes.values() for b in three if b}
        for key in [key for key in self._arrays if key[-1] in buffers]:
            self._arrays.pop(key).release()
        for buffer in buffers:
            buffer.release()
        self._meshes.clear()
        self._drawn = (None, [])  # its arrays are gone, too

    def _array(self, program, entry):
        """Return the vertex array that feeds a mesh to a program, without what it does not take."""
        key = (program, entry[1])
        if key not in self._arrays:
            names = ("rig_vertex", "rig_vertex_normal")
            form = " ".join("3f" if name in program else "12x" for name in names)
            content = [(entry[1], form, *(name for name in names if name in program))]
            if "rig_vertex_tangent" in program:
                content.append((entry[2], "4f", "rig_vertex_tangent"))
            self._arrays[key] = self.context.vertex_array(program, content, entry[3])
        return self._arrays[key]

    def _target(self, width, rows, side, linear):
        """Return framebuffers (radiance, picture) for strips of a picture, kept while they fit."""
        key = (width, rows, side, linear)
        if key not in self._targets:
            self._release_targets()
            context, size = self.context, (width * side, rows * side)
            radiance = [context.texture(size, 4, dtype="f4")]
            radiance = context.framebuffer(radiance, context.depth_renderbuffer(size))
            pixels = context.texture((width, rows), 4, dtype="f4" if linear else "f1")
            picture = context.framebuffer([pixels])
            if context.error != "GL_NO_ERROR":
                raise Mistake(f"the driver has no memory for {width} x {rows} pixels; draw smaller")
            self._targets[key] = (radiance, picture)
        return self._targets[key]

    def _release_targets(self):
        for framebuffer in (f for pair in self._targets.values() for f in pair):
            self._free_framebuffer(framebuffer)
        self._targets.clear()

    def _check_size(self, width, height, side):
        if max(width, height) * side <= COMMON:
            return
        with self.context:
            info = self.context.info
        most = min(info["GL_MAX_TEXTURE_SIZE"], *info["GL_MAX_VIEWPORT_DIMS"])
        if max(width, height) * side > most:
            raise Mistake(
                f"size {width}x{height} with {side * side} samples is more than this driver draws; "
                f"allowed: up to {most // side} pixels a side, or {most} with samples = 1"
            )


def _state(path):
    """Return what changes when the mesh file at a path does; None for a built-in shape."""
    if not os.path.isabs(path):
        return None
    with suppress(OSError):  # loading it will tell
        status = os.stat(path)
        return status.st_size, status.st_mtime_ns
