"""The mouse over the picture → another camera, or a light elsewhere."""

import math

from . import navigate, settings

LEFT, SHIFT, ALT = 0, 1, 4  # as glfw numbers buttons and modifier keys


class Hands:
    """What the mouse is doing to a scene; every method returns the Scene, and a key for History."""

    def __init__(self):
        self._doing, self._drags, self._place, self._lamp = None, 0, (0.0, 0.0), 0

    @property
    def holds(self):
        """Whether the picture is being dragged."""
        return self._doing is not None

    def press(self, button, held, lamp=0, grabbed=False):
        """Begin to drag: left turns, with Alt moves the light; the rest moves the view.

        lamp: index of the light; grabbed: whether it is held where it stands in the picture.
        """
        self._drags += 1
        self._lamp = lamp
        if button == LEFT and grabbed:
            self._doing = "carry"
        elif button != LEFT or held & SHIFT:
            self._doing = "pan"
        else:
            self._doing = "light" if held & ALT else "orbit"

    def release(self):
        """End what was begun."""
        self._doing = None

    def move(self, scene, shown, view, place):
        """Take a place of the mouse in pixels.

        shown: the scene as drawn, whose size and angle of view count; view: its (eye, target).
        """
        (x, y), self._place = self._place, place
        if not self._doing or shown is None:
            return scene, None
        dx, dy = (place[0] - x) / shown.size[1], (place[1] - y) / shown.size[1]
        key = (self._doing, self._drags)
        if self._doing in ("light", "carry"):
            return self._with_light(scene, (shown.camera, *view, dx, dy)), key
        turn = navigate.orbit if self._doing == "orbit" else navigate.pan
        return _with_camera(scene, turn(shown.camera, *view, dx, dy)), key

    def _with_light(self, scene, how):
        """Return the scene with its light moved, or, where that cannot be, the first that can."""
        for i in sorted(range(len(scene.lights)), key=lambda i: i != self._lamp):
            light = scene.lights[i]
            swings = navigate.movable(light) and self._doing == "light"
            if swings or navigate.standing(light):
                moved = (navigate.swing if swings else navigate.carry)(light, *how)
                for name, value in moved.items():
                    light = settings.light_with(light, name, value)
                return scene._replace(lights=(*scene.lights[:i], light, *scene.lights[i + 1 :]))
        return scene

    def wheel(self, scene, shown, view, notches):
        """Take a turn of the wheel."""
        return _with_camera(scene, navigate.zoom(shown.camera, *view, notches)), "wheel"


def framed(scene, size):
    """Return the scene for an area of that size, of which no side is lost where it is narrower.

    What frames itself does so anyway; a camera at a distance of its own sees the width it had.
    """
    camera, share = scene.camera, scene.size[0] * size[1] / (scene.size[1] * size[0])
    if share > 1.0 and (camera.position or camera.distance):
        half = math.atan(math.tan(math.radians(camera.fov) / 2.0) * share)
        camera = camera._replace(fov=min(170.0, 2.0 * math.degrees(half)))
    return scene._replace(size=size, camera=camera)


def _with_camera(scene, camera):
    return scene._replace(camera=camera._replace(fov=scene.camera.fov))
