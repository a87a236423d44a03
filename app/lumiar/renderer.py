"""Owns the objects on the graphics card: Scene → linear radiance → displayed pixels."""

import math
import struct
from typing import NamedTuple

import moderngl

from . import camera, compose, layout
from .card import OnCard, compiled
from .stock import Stock
from .targets import Targets

STRIP = 1 << 23  # samples drawn at a time: bounds the memory (180 MB) and the longest wait


class _Job(NamedTuple):
    """Something ready to draw: what to bind, how and with which tests, what to set."""

    array: object
    flags: int
    winding: str
    uniforms: tuple
    textures: tuple
    vertices: int = -1  # all


class Renderer(OnCard):
    """Draws scenes; release it or use `with`."""

    def __init__(self, context=None):
        super().__init__(context)
        self._programs, self._screens = {}, {}
        self._stock, self._targets = Stock(self.context), Targets(self)
        self._watches_loops = False
        self._drawn = (None, "", [])  # the last scene and its jobs: most frames draw it again

    def _free(self):
        self._stock.release()
        for made in (*self._screens.values(), *self._programs.values()):
            made.release()
        self._targets.release()

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

    def strips(self, scene, linear=False, shows="radiance"):
        """Yield the picture of a scene as strips of rows, top first: (bytes, broken pixels).

        The bytes are sRGB, 3 per pixel, or, if linear, radiance, 3 float32 per pixel. broken counts
        the pixels whose radiance is NaN or infinite; sRGB shows them in magenta. shows is one of
        compose.SHOWS, in the middle of each pixel, 0 where no object is. Raises Mistake for a size
        the driver cannot draw, and for errors in shaders and meshes.
        """
        if shows != "radiance":
            scene, linear = scene._replace(samples=1), True
        width, height = scene.size
        side = math.isqrt(scene.samples)
        self._targets.check(width, height, side)
        rows = max(1, min(height, STRIP // (width * side * side)))
        for top in range(0, height, rows):
            with self.context:  # another renderer's may be the current one
                strip = self._strip(scene, linear, side, rows, top, shows)
            yield strip

    def pixel(self, scene, x, y, shows="radiance"):
        """Return what is in the middle of a pixel, 3 floats.

        x, y count from the top left pixel, which is 0, 0; see `strips` for shows. Of anything but
        radiance None where no object is.
        """
        width, height = scene.size
        scene = scene._replace(samples=1)
        self._targets.check(width, height, 1)
        with self.context:
            radiance, _ = self._targets.pair(1, 1, 1, True)
            radiance.viewport = (-int(x), -int(y), width, height)
            held = self._accumulated(scene, radiance, (int(x), int(y)), shows)
            *values, surface = struct.unpack("4f", held.read(components=4, dtype="f4"))
        return tuple(values) if surface or shows == "radiance" else None

    def show(self, scene, picture, top=0, rows=0):
        """Draw a scene into a framebuffer of its size: sRGB, top row first, as `strips`.

        Only so many rows from the one that `top` counts, where they are given.
        """
        (width, height), side = scene.size, math.isqrt(scene.samples)
        self._targets.check(width, height, side)
        rows = min(rows or height, height - top)
        with self.context:
            radiance, _ = self._targets.pair(width, height, side, False)
            radiance.viewport, picture.viewport = (0, 0, *radiance.size), (0, 0, *scene.size)
            radiance.scissor = (0, top * side, width * side, rows * side)
            picture.scissor = (0, top, width, rows)  # in place, for the very same pixels
            try:
                held = self._accumulated(scene, radiance, (0, 0), "radiance")
                self.present(scene, held, picture)
            finally:
                radiance.scissor = picture.scissor = None

    def forget(self, text=None):
        """Free the programs made with a GLSL file's text; look again at the files of meshes."""
        self._drawn = (None, "", [])
        for key in [key for key in self._programs if text and text in key]:
            program = self._programs.pop(key)
            self._stock.forget_program(program)
            if key in self._screens:
                self._screens.pop(key).release()
            program.release()

    def viewpoint(self, scene):
        """Return where the eye of a scene is, and what it looks at."""
        return layout.viewpoint(scene, [self._stock.mesh(one)[0] for one in scene.objects])

    def _strip(self, scene, linear, side, rows, top, shows):
        width, height = scene.size
        count = min(rows, height - top)
        radiance, picture = self._targets.pair(width, rows, side, linear)
        radiance.viewport = (0, -top * side, width * side, height * side)
        held = self._accumulated(scene, radiance, (0, top * side), shows)
        self.present(scene, held, picture, linear)
        area, dtype, step = (0, 0, width, count), *(("f4", 16) if linear else ("f1", 4))
        finite = picture.read(area, 4, dtype=dtype)[step - 1 :: step]  # the top byte of alpha
        return picture.read(area, 3, dtype=dtype), finite.count(b"\0")

    def _accumulated(self, scene, radiance, shift, shows):
        """Draw a scene in as many passes as it needs; return the framebuffer with their mean."""
        count = layout.passes(scene) if shows == "radiance" else 1
        if count == 1:
            self.draw(scene, radiance, shift=shift, shows=shows)
            return radiance
        total = self._targets.sum(radiance.size)
        total.scissor = radiance.scissor
        total.use()
        total.clear()
        array = self._screen("add", {})
        for number in range(count):
            self.draw(scene, radiance, (number, count), shift)
            array.program["rig_share"].value = 1.0 / count
            radiance.color_attachments[0].use(0)
            total.use()
            self.context.enable_only(moderngl.BLEND)
            array.render(moderngl.TRIANGLES, vertices=3)
        return total

    def draw(self, scene, framebuffer, part=(0, 1), shift=(0, 0), shows="radiance"):
        """Draw the linear radiance of a scene into a framebuffer with a depth buffer.

        part is which of how many passes this is; shift says where in the picture the framebuffer
        begins, in samples.
        """
        jobs = self._jobs(scene, shows)
        framebuffer.use()
        framebuffer.clear(*(scene.background if shows == "radiance" else (0.0,) * 3), 0.0)
        running = {"rig_pass": part, "rig_shift": shift}
        self.context.blend_func = moderngl.ONE, moderngl.ONE
        for job in jobs:
            for member, value in job.uniforms:
                member.write(value)
            for name, value in running.items():
                if name in job.array.program:
                    job.array.program[name].value = value
            for unit, texture in job.textures:
                texture.use(unit)
            self.context.enable_only(job.flags)
            self.context.front_face = job.winding
            job.array.render(vertices=job.vertices)

    def present(self, scene, radiance, picture, linear=False):
        """Turn drawn radiance into pixels: mean of the samples, exposure, tone curve, sRGB."""
        constants = {
            "side": math.isqrt(scene.samples),
            "target": "linear" if linear else "display",
            "tone": scene.tone,
            "exposed": scene.gain != 1.0 and not linear,
        }
        array = self._screen("present", constants)
        if "rig_exposure" in array.program:
            array.program["rig_exposure"].value = scene.gain
        radiance.color_attachments[0].use(0)
        picture.use()
        self.context.enable_only(moderngl.NOTHING)
        array.render(moderngl.TRIANGLES, vertices=3)

    def _jobs(self, scene, shows):
        """Return what it takes to draw a scene: its visible lights, then each object."""
        if self._drawn[0] is not scene or self._drawn[1] != shows:
            self._drawn = (None, "", [])  # should this scene fail: what the last needs may be gone
            self._stock.make_room()
            entries = [self._stock.mesh(one) for one in scene.objects]
            placed = layout.arrange(scene, [entry[0] for entry in entries])
            textures = self._stock.tables(scene, placed)
            jobs = self._backdrops(scene, placed, textures) if shows == "radiance" else []
            for number, pair in enumerate(zip(placed, entries, strict=True), 1):
                jobs.append(self._job(scene, *pair, number, textures, shows))
            self._drawn = (scene, shows, jobs)
        return self._drawn[2]

    def _job(self, scene, placed, entry, number, textures, shows):
        program = self._program(scene, placed, shows)
        values = layout.uniforms(scene, placed, number)
        winding = "ccw" if camera.mirrors(placed.world) else "cw"  # y points down in clip space
        culling = moderngl.CULL_FACE if placed.closed else moderngl.NOTHING
        flags, array = moderngl.DEPTH_TEST | culling, self._stock.array(program, entry)
        return _Job(array, flags, winding, *_bound(program, values, textures))

    def _backdrops(self, scene, placed, textures):
        """Return what it takes to draw the visible lights: first what surrounds, then shapes.

        What is infinitely far away adds to what is there already, as in a mirror.
        """
        surrounding, shapes, fixed, view = [], [], layout.of_lights(scene), None
        for number, light in enumerate(scene.lights, 1):
            if not light.visible:
                continue
            key = ("backdrop", number, light.kind.source, *fixed.items())
            if key not in self._programs:
                sources = compose.backdrop(light.kind, number, fixed)
                self._programs[key] = self._compile(sources)
                self._screens[key] = self.context.vertex_array(self._programs[key], [])
            view = view or layout.view(scene, placed)
            values = view | layout.of_light(light, scene.time, number)
            around = "environment" in light.kind.defines
            adds = bool(surrounding) if around else "reach" not in light.kind.defines
            flags = moderngl.NOTHING if around else moderngl.DEPTH_TEST
            flags |= moderngl.BLEND if adds else moderngl.NOTHING
            bound = _bound(self._programs[key], values, textures)
            job = _Job(self._screens[key], flags, "ccw", *bound, 3)
            (surrounding if around else shapes).append(job)
        return surrounding + shapes

    def _program(self, scene, placed, shows):
        """Return the program for an object of a scene, compiled once."""
        texts = (placed.object.model.source, *(light.kind.source for light in scene.lights))
        facts = (scene.shading, placed.closed, placed.transformed, shows, layout.shadows(scene))
        key = (*facts, *texts, *layout.constants(scene, placed).items())
        if key not in self._programs:
            self._programs[key] = self._compile(layout.sources(scene, placed, shows))
        return self._programs[key]

    def _screen(self, rig, constants):
        key = (rig, *constants.items())
        if key not in self._programs:
            self._programs[key] = self._compile(compose.screen(rig, constants))
            self._screens[key] = self.context.vertex_array(self._programs[key], [])
        return self._screens[key]

    def _compile(self, sources):
        self._watches_loops |= any("rig_cut_short" in one.text for one in sources.values())
        return compiled(self.context, sources)


def _bound(program, values, textures):
    """Return ((member, bytes), ...), ((unit, texture), ...): of all given what it takes."""
    members = ((program.get(name, None), value) for name, value in values.items())
    looked_up = [(name, texture) for name, texture in textures.items() if name in program]
    for unit, (name, _) in enumerate(looked_up):
        program[name].value = unit
    units = tuple((unit, texture) for unit, (_, texture) in enumerate(looked_up))
    return tuple((member, value) for member, value in members if member is not None), units
