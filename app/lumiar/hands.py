"""The mouse over the picture → another camera, or a light elsewhere."""

import math

from . import navigate, settings

LEFT, SHIFT, ALT = 0, 1, 4  # as glfw numbers buttons and modifier keys


class Hands:
    """What the mouse is doing to the picture that it began on.

    What it does is a function of (Scene, that scene as drawn, its (eye, target)) that returns the
    Scene, the same where nothing could be drawn; with it comes a key for History. None, None where
    it does nothing.
    """

    def __init__(self):
        self._doing, self._drags, self._place, self._height = None, 0, (0.0, 0.0), 1
        self._lamp = 0

    @property
    def holds(self):
        """Whether the picture is being dragged."""
        return self._doing is not None

    def press(self, button, held, height, lamp=0, grabbed=False):
        """Begin to drag: left turns, with Alt moves the light; the rest moves the view.

        height: of the picture, in pixels; lamp: index of the light; grabbed: whether it is held
        where it stands in the picture.
        """
        self._drags += 1
        self._height, self._lamp = max(1, height), lamp
        if button == LEFT and grabbed:
            self._doing = "carry"
        elif button != LEFT or held & SHIFT:
            self._doing = "pan"
        else:
            self._doing = "light" if held & ALT else "orbit"

    def release(self):
        """End what was begun."""
        self._doing = None

    def move(self, place):
        """Take a place of the mouse in pixels; return what it does, and a key."""
        (x, y), self._place = self._place, place
        if not self._doing:
            return None, None
        dx, dy = (place[0] - x) / self._height, (place[1] - y) / self._height
        turn = navigate.orbit if self._doing == "orbit" else navigate.pan

        def turned(scene, shown, view):
            if shown is None:
                return scene
            return _with_camera(scene, turn(shown.camera, *view, dx, dy))

        how = self._lamp, self._doing == "carry"

        def moved(scene, shown, view):
            return scene if shown is None else _moved(scene, *how, shown.camera, *view, dx, dy)

        lit = self._doing in ("light", "carry")
        return moved if lit else turned, (self._doing, self._drags)

    def wheel(self, notches):
        """Take a turn of the wheel; return what it does, and a key."""

        def zoomed(scene, shown, view):
            if shown is None:
                return scene
            return _with_camera(scene, navigate.zoom(shown.camera, *view, notches))

        return zoomed, "wheel"


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


def _moved(scene, index, carries, *how):
    """Return the scene with a light moved, or, where that cannot be, the first that can."""
    for i in sorted(range(len(scene.lights)), key=lambda i: i != index):
        light = scene.lights[i]
        swings = navigate.movable(light) and not carries
        if swings or navigate.standing(light):
            moved = (navigate.swing if swings else navigate.carry)(light, *how)
            for name, value in moved.items():
                light = settings.light_with(light, name, value)
            return scene._replace(lights=(*scene.lights[:i], light, *scene.lights[i + 1 :]))
    return scene
