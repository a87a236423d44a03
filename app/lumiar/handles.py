"""The lights in the picture: a disc with its number where each stands, to be dragged."""

import math

from imgui_bundle import imgui

from . import navigate

SIZE = 0.8  # radius of a disc, in sizes of letters
_DARK, _PLAIN, _CHOSEN = 0xD0100C08, 0xFFE8E8E8, 0xFF80D8FF  # alpha, blue, green, red


class Handles:
    """What stands where in the picture that was drawn last.

    shown: whether there are any
    """

    def __init__(self):
        self.shown, self._places, self._reach = True, [], 0.0

    def draw(self, scene, view, left, chosen):
        """Mark the lights of a scene as drawn, its picture `left` pixels from the window's left.

        With None there are none. view: its (eye, target); chosen: index of the one that Alt moves.
        """
        io, self._places = imgui.get_io(), []
        if not self.shown or scene is None:
            return
        fine, ink = io.display_framebuffer_scale, imgui.get_background_draw_list()
        radius = SIZE * imgui.get_font_size()
        self._reach = 1.3 * radius * fine.x
        for i, light in enumerate(scene.lights):
            place = navigate.standing(light)
            place = place and navigate.pixel(place, scene.camera, *view, scene.size)
            wide, high = scene.size
            if not place or not (0.0 <= place[0] < wide and 0.0 <= place[1] < high):
                continue
            self._places.append((i, (left + place[0], place[1])))
            at = ((left + place[0]) / fine.x, place[1] / fine.y)
            colour, text = _CHOSEN if i == chosen else _PLAIN, str(i + 1)
            near = math.dist(at, io.mouse_pos) < 1.3 * radius and not io.want_capture_mouse
            ink.add_circle_filled(at, radius, _DARK)
            ink.add_circle(at, radius, colour, 0, 3.0 if near else 1.5)
            size = imgui.calc_text_size(text)
            ink.add_text((at[0] - 0.5 * size.x, at[1] - 0.5 * size.y), colour, text)

    def at(self, place):
        """Return the index of the light whose disc is at a pixel of the window, or None."""
        near = [(math.dist(place, spot), i) for i, spot in self._places]
        distance, index = min(near, default=(math.inf, None))
        return index if distance < self._reach else None
