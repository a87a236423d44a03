"""What ImGui asks to be drawn, and finished pictures, into any framebuffer of ours."""

import ctypes
import struct

from imgui_bundle import imgui

from . import compose
from .card import OnCard, compiled
from .flatten import finish, flatten

_STATUS = imgui.ImTextureStatus
_FORM = "2f 2f 4f1"  # of imgui's vertices: position, texture, colour


class Overlay(OnCard):
    """Draws widgets and finished pictures in one context; release it, or use `with`."""

    def __init__(self, context):
        super().__init__(context)
        stages = {"vertex": "rigs/overlay.vert", "fragment": "rigs/overlay.frag"}
        sources = {stage: finish(flatten(name, {}, {}, {})) for stage, name in stages.items()}
        self._widgets = compiled(context, sources)
        self._plain = compiled(context, compose.screen("window", {}))
        self._screen = context.vertex_array(self._plain, [])
        self._textures, self._buffers, self._array = {}, (), None

    def _free(self):
        for texture in imgui.get_platform_io().textures if imgui.get_current_context() else ():
            texture.set_tex_id(0)
            texture.set_status(_STATUS.destroyed)
        made = (self._array, self._screen, *self._buffers, self._widgets, self._plain)
        for one in (*self._textures.values(), *filter(None, made)):
            one.release()

    def picture(self, texture, framebuffer, corner, part=None):
        """Draw a texture of sRGB, top row first, unchanged.

        corner (x, y) is where it begins, in pixels from the lower left; part (x, y, width, height)
        of the framebuffer is all that is covered.
        """
        framebuffer.use()
        framebuffer.viewport = (*corner, *texture.size)
        framebuffer.scissor = part
        self._plain["rig_corner"].value = corner
        self.context.enable_only(self.context.NOTHING)
        texture.use(0)
        self._screen.render(self.context.TRIANGLES, vertices=3)
        framebuffer.scissor = None

    def image(self, size, pixels):
        """Return a new texture of RGBA, for `imgui.image`, that `drop` frees."""
        made = self.context.texture(size, 4, pixels)
        made.filter = (self.context.LINEAR, self.context.LINEAR)
        self._textures[made.glo] = made
        return imgui.ImTextureRef(made.glo)

    def drop(self, image):
        """Free what `image` has made."""
        self._textures.pop(image.get_tex_id()).release()

    def widgets(self, data, framebuffer, size):
        """Draw imgui.ImDrawData over a framebuffer of size (width, height) in pixels."""
        for texture in imgui.get_platform_io().textures:
            if texture.status != _STATUS.ok:
                self._update(texture)
        if not data.valid or not data.total_vtx_count:
            return
        context, (width, height) = self.context, size
        (left, top), (wide, high) = data.display_pos, data.display_size
        across, down = width / wide, height / high
        framebuffer.use()
        framebuffer.viewport = (0, 0, width, height)
        context.enable_only(context.BLEND)
        context.blend_func = (
            *(context.SRC_ALPHA, context.ONE_MINUS_SRC_ALPHA),
            *(context.ONE, context.ONE_MINUS_SRC_ALPHA),
        )
        self._widgets["rig_area"].write(struct.pack("4f", left, top, 2.0 / wide, 2.0 / high))
        for commands in data.cmd_lists:
            self._upload(commands)
            for command in commands.cmd_buffer:
                x, y, right, below = command.clip_rect
                x, right = max(0, round((x - left) * across)), round((right - left) * across)
                y, below = max(0, round((y - top) * down)), round((below - top) * down)
                right, below = min(right, width), min(below, height)
                if right > x and below > y and command.elem_count:
                    framebuffer.scissor = (x, height - below, right - x, below - y)
                    self._textures[command.get_tex_id()].use(0)
                    self._array.render(
                        context.TRIANGLES, vertices=command.elem_count, first=command.idx_offset
                    )
        framebuffer.scissor = None

    def _upload(self, commands):
        """Bring the vertices and indices of one list to the card, into buffers that only grow."""
        lists = (commands.vtx_buffer, imgui.VERTEX_SIZE), (commands.idx_buffer, imgui.INDEX_SIZE)
        needs = [one.size() * size for one, size in lists]
        if not self._buffers or any(
            need > buffer.size for need, buffer in zip(needs, self._buffers, strict=True)
        ):
            for made in (self._array, *self._buffers):
                if made:
                    made.release()
            self._buffers = [self.context.buffer(reserve=max(2 * need, 1 << 16)) for need in needs]
            vertices, indices = self._buffers
            names = ("rig_position", "rig_uv", "rig_color")
            self._array = self.context.vertex_array(
                self._widgets, [(vertices, _FORM, *names)], indices, imgui.INDEX_SIZE
            )
        for (one, _), need, buffer in zip(lists, needs, self._buffers, strict=True):
            if need:
                buffer.orphan()
                buffer.write((ctypes.c_char * need).from_address(one.data_address()))

    def _update(self, texture):
        """Make, refresh or free the texture behind one of imgui's sheets of letters."""
        if texture.status == _STATUS.want_destroy:
            if texture.unused_frames > 0:
                self._textures.pop(texture.tex_id).release()
                texture.set_tex_id(0)
                texture.set_status(_STATUS.destroyed)
            return
        pixels = texture.get_pixels_array().reshape(texture.height, texture.width, -1)
        if texture.status == _STATUS.want_create:
            made = self.context.texture((texture.width, texture.height), 4, pixels.tobytes())
            made.filter = (self.context.LINEAR, self.context.LINEAR)
            self._textures[made.glo] = made
            texture.set_tex_id(made.glo)
        elif texture.status == _STATUS.want_updates:
            one = texture.update_rect
            part = pixels[one.y : one.y + one.h, one.x : one.x + one.w]
            self._textures[texture.tex_id].write(part.tobytes(), (one.x, one.y, one.w, one.h))
        texture.set_status(_STATUS.ok)
