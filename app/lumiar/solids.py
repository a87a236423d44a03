"""Lobes in 3-D for the plots of the window, drawn by ImPlot3D: plain arrays on a dark ground."""

import math

import numpy as np
from imgui_bundle import imgui, implot3d

from .charts import DIM, Mark
from .difference import LUMINANCE

LAMP = np.array([0.35, 0.55, 0.76])  # from where a lobe is lit
COARSE = 2  # every so manieth angle of a lobe is drawn


class Solids:
    """What ImPlot3D needs in the current context of ImGui; release it."""

    def __init__(self):
        self._context, self._meshes = implot3d.create_context(), {}
        style = implot3d.get_style()
        for name in ("frame_bg", "plot_bg", "plot_border", "axis_grid", "axis_tick"):
            style.set_color(getattr(implot3d.Col_, name).value, (0.0, 0.0, 0.0, 0.0))

    def release(self):
        """Give it back."""
        implot3d.destroy_context(self._context)

    def draw(self, size, shown, scale, aim, marks):
        """Draw Lobes in 3-D, which the mouse turns; they are measured from the light of an Aim."""
        flags = implot3d.Flags_
        look = flags.canvas_only | flags.no_menus | flags.no_pan | flags.no_zoom | flags.no_clip
        if not implot3d.begin_plot("##lobe", size, look):
            return
        full = max((one.theta.max() for one, _ in shown), default=0.0) > 90.5
        bare = implot3d.AxisFlags_.no_decorations | implot3d.AxisFlags_.lock
        implot3d.setup_axes("", "", "", bare, bare, bare)
        implot3d.setup_axes_limits(-1, 1, -1, 1, -1.0 if full else 0.0, 1, implot3d.Cond_.always)
        implot3d.setup_box_scale(1.9, 1.9, 1.9 if full else 0.95)
        implot3d.setup_box_initial_rotation(25.0, 120.0)
        turn = np.linspace(0.0, 2.0 * math.pi, 73)
        _line3("##rim", (np.cos(turn), np.sin(turn), 0.0 * turn), DIM, 1.0)
        _line3("##plane", ([-1.0, 1.0], [0.0, 0.0], [0.0, 0.0]), DIM, 1.0)
        meshes, self._meshes = self._meshes, {}
        for i, (one, colour) in enumerate(shown):
            key = (id(one.f), scale, colour, len(shown))
            known = meshes.get(key)
            if known is None or known[0] is not one.f:
                known = one.f, *_triangles(one, scale, colour, 1.0 if len(shown) == 1 else 0.6)
            self._meshes[key] = known
            if not known[2].size:  # of a lobe that is black, ImPlot3D takes no colours
                continue
            spec = implot3d.Spec()
            spec.flags = (
                implot3d.TriangleFlags_.no_lines.value | implot3d.TriangleFlags_.no_markers.value
            )
            spec.fill_colors = known[2]
            implot3d.plot_triangle(f"##{i}", *known[1], spec=spec)
        phi = math.radians(aim.phi)
        for letter, w, _, colour in (*marks, Mark("N", (0.0, 0.0, 1.0), 0.0, DIM)):
            x, y, z = w
            x, y = x * math.cos(phi) + y * math.sin(phi), y * math.cos(phi) - x * math.sin(phi)
            _line3(f"##{letter}", ([0.0, x], [0.0, y], [0.0, z]), colour, 2.5)
            implot3d.push_style_color(implot3d.Col_.inlay_text.value, (*colour, 1.0))
            implot3d.plot_text(letter, 1.08 * x, 1.08 * y, 1.08 * z)
            implot3d.pop_style_color()
        implot3d.end_plot()


def _line3(name, places, colour, width):
    width *= imgui.get_font_size() / 15.0
    spec = implot3d.Spec(line_color=(*colour, 1.0), line_weight=width)
    spec.marker = implot3d.Marker_.none.value
    implot3d.plot_line(name, *map(_flat, places), spec=spec)


def _triangles(one, scale, colour, alpha):
    """Return ((x, y, z), colours) of a Lobe as triangles, lit so that its shape is seen."""
    theta, phi = one.theta[::COARSE], np.append(one.phi[:-1:COARSE], one.phi[-1])
    f = np.concatenate([one.f[::COARSE, :-1:COARSE], one.f[::COARSE, -1:]], axis=1)
    r = np.nan_to_num(scale.radius(f @ LUMINANCE), posinf=1.0)[..., None]
    theta, phi = np.meshgrid(np.radians(theta), np.radians(phi), indexing="ij")
    s = np.sin(theta)
    p = r * np.stack([s * np.cos(phi), s * np.sin(phi), np.cos(theta)], axis=-1)
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    corners = np.concatenate([np.stack(t, -2).reshape(-1, 3, 3) for t in ((a, b, c), (a, c, d))])
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    some = length > 1e-9
    light = 0.45 + 0.55 * np.maximum(normal[some] @ LAMP / length[some], 0.0)
    rgb = np.clip(255.0 * light[:, None] * np.array(colour), 0.0, 255.0).astype(np.uint32)
    packed = rgb[:, 0] | rgb[:, 1] << 8 | rgb[:, 2] << 16 | np.uint32(round(255 * alpha)) << 24
    return [*map(_flat, np.moveaxis(corners[some], -1, 0))], np.repeat(packed, 3)


def _flat(array):
    return np.ascontiguousarray(array, np.float64).ravel()
