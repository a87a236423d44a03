"""The plots of the window: they follow the sliders, and the mouse over the picture."""

from imgui_bundle import imgui

from . import (
    captions,
    catalog,
    charts,
    curves,
    facing,
    files,
    labels,
    panels,
    plotfiles,
    readout,
    solids,
    units,
)
from .difference import LUMINANCE
from .errors import Mistake, one_line
from .sight import Sight

LIGHT = 45.0  # degrees from the normal, until another angle is asked for
GRAZING = 89.0
LOOK = 0.1  # seconds between two looks at what is being made
CALM = 0.35  # seconds without a change after which a scale may shrink
KINDS = ("polar", "curve", "lobe", "albedo", "fresnel")


class Plots:
    """A tool of the drawer; see there. drawn is the plotfiles.Drawn that is shown.

    kind is one of KINDS; painting is the plotfiles.Painting that is being made, or None; others
    holds (Shader, values or None, label or "") of each model that the chosen object's is compared
    with, None for values of its own.
    """

    def __init__(self, now):
        self._bench, self._charts = curves.Bench(now.stage.context), charts.Charts()
        self._solids = solids.Solids()
        self.sight, self.kind, self.drawn, self.others = Sight(), KINDS[0], None, []
        self._theta, self._phi, self._light = LIGHT, 0.0, None
        self._same, self._log = False, None
        self._scale, self._scaled, self._changed = None, (), 0.0
        self._held = False
        self._said, self.painting = ("", labels.BAD), None

    def release(self):
        """Free what is on the card, and what ImPlot has; what is being saved is waited for."""
        if self.painting:
            self.painting.release()
        self._bench.release()
        self._charts.release()
        self._solids.release()

    def draw(self, now):
        """Draw the plots and return the scene."""
        words = captions.TEXT[now.state.lang]
        if not now.shown or not now.shown.objects:
            imgui.text(words["plots"]["no object"])
            return now.scene
        self._bench.turn()
        self.sight.look(now)
        chosen = min(now.state.chosen, len(now.shown.objects) - 1)
        models = curves.compared(now.shown.objects[chosen], self.others, self._same)
        pixel = self.sight.directions(chosen, self._light)
        aim = curves.Aim(self._theta, self._phi, self._phi)
        if pixel:
            aim = curves.aimed(*pixel)
            self._theta, self._phi = aim.theta, aim.phi % 360.0
        tabs = words["plots"]["tabs"]
        imgui.set_next_item_width(-1.0)
        self.kind = labels.pick("kind", self.kind, [(kind, tabs[kind]) for kind in KINDS])
        self._measure(models, aim, pixel, now)
        self._plot(models, words)
        self._tell(models, words["plots"])
        self._ask_light(now.shown, models[0], words["plots"])
        self._list(models, words["plots"])
        self._save(now, words["plots"])
        now.state.restless = now.state.restless or self._bench.busy
        if self._held:
            now.state.wake = min(now.state.wake, self._changed + CALM)
        return now.scene

    def _measure(self, models, aim, pixel, now):
        """Measure what the plot shows; settle on a scale."""
        bench, kind, found = self._bench, self.kind, []
        for one in models:
            if kind == "fresnel":
                found.append(bench.facet(one))
            elif kind == "albedo":
                found.append(bench.albedo(one, aim.phi, now.rests))
            else:
                found.append((bench.lobe if kind == "lobe" else bench.curve)(one, aim))
        some = [(one, its) for one, its in zip(models, found, strict=True) if its is not None]
        parts = zip(*some, strict=True) if some else ((), ())
        self.drawn = plotfiles.Drawn(kind, *map(tuple, parts), aim, pixel)
        self._held = False
        if kind in plotfiles.LOBES:
            self._settle(tuple(one.label for one in models), now.time)

    def _settle(self, labels, now):
        """Take the scale that suits the curves; while they change it only grows."""
        shown = self.drawn.shown
        data, key = [one.f for one in shown], (self.kind, self._log, labels)
        if not self._scaled or key != self._scaled[0]:
            self._scale = None
        elif len(data) != len(self._scaled[1]) or any(
            a is not b for a, b in zip(data, self._scaled[1], strict=True)
        ):
            self._changed = now
        self._scaled = key, data
        wanted = panels.scale(shown, self._log)
        held = self._scale if now - self._changed < CALM else None
        if not held or (wanted.log == held.log and wanted.high > held.high):
            self._scale = wanted
        self._held = self._scale != wanted

    def _plot(self, models, words):
        """Draw what was measured."""
        kind, drawn = self.kind, self.drawn
        width, room = imgui.get_content_region_avail()
        em = imgui.get_font_size()
        whole = kind == "polar" and any(one.highest > 90.0 for one in models)
        high = width * (1.0 if whole else 0.62 if kind == "polar" else 0.72)
        size = (width, max(9.0 * em, min(high, room - 14.0 * em)))
        colours = {
            one.label: charts.COLOURS[i % len(charts.COLOURS)] for i, one in enumerate(models)
        }
        shown = [(one, colours[one.label]) for one in drawn.shown]
        marks = charts.marks(drawn.aim, drawn.pixel)
        if kind in ("albedo", "fresnel"):
            labels = (words["incidence"], words["share"])
            marks = [mark for mark in marks if mark.letter in "LV"]
            if kind == "fresnel":
                labels = (words["plots"]["facet"], words["plots"]["reflected"])
                marks = charts.facet_marks(drawn.pixel, "constant" in models[0].shader.claims)
            read = self._charts.shares(size, shown, marks, labels)
        elif kind == "lobe":
            read = self._solids.draw(size, shown, self._scale, drawn.aim, marks)
        else:
            f = self.value(models[0])
            f = None if f is None else float(f @ LUMINANCE)
            draw = self._charts.polar if kind == "polar" else self._charts.cartesian
            read = draw(size, shown, self._scale, marks, f, words)
        if read:
            charts.tooltip(*read, " sr⁻¹" if kind in plotfiles.LOBES else "")

    def value(self, one):
        """Return f (3,) of a Chosen model at the L and V that are marked, None without these."""
        return self._bench.value(one, *self.drawn.pixel) if self.drawn.pixel else None

    def _tell(self, models, words):
        """Say what is looked at and what was found there, or how to look at something."""
        sight, pixel, faults = self.sight, self.drawn.pixel, self._bench.faults
        for fault in dict.fromkeys(faults):
            labels.wrapped(fault, labels.BAD)
        if self.kind == "fresnel":
            for one in models:
                if "F_facet" not in one.shader.defines:
                    labels.wrapped(words["no fresnel"].format(one.label), labels.DIM)
        if pixel:
            L, V = pixel
            angles = (facing.theta(L), facing.theta(V), facing.turn(L, V))
            labels.wrapped(words["at"].format(*sight.pixel, *angles))
            f, off = self.value(models[0]), abs(self.drawn.aim.angle(L)[1])
            if f is not None:
                _large(f"f(L, V) = {readout.number(units.luminance(f) / units.EFFICACY)} sr⁻¹")
            if L[2] < 0.0 and not models[0].shader.transmits:
                labels.wrapped(words["below"], labels.DIM)
            elif self.kind in ("polar", "curve") and off >= 1.0:
                labels.wrapped(words["off"].format(off), labels.DIM)
        elif sight.follows and sight.pixel:
            there = sight.facing
            why = "background" if not there else "other" if there.lights else "around"
            labels.wrapped(words[why], labels.DIM)
        else:
            labels.wrapped(words["hint"], labels.DIM)

    def _ask_light(self, scene, one, words):
        """Ask where the light comes from, and for the scale of f."""
        sight, em = self.sight, imgui.get_font_size()
        _label(words["light"])
        options = [(True, words["pixel"]), (False, words["by hand"])]
        sight.follows = labels.pick("light", sight.follows, options)
        there = sight.facing if sight.follows else None
        if there and len(there.lights) > 1:
            _label("")
            names = [(n, f"{n} {scene.lights[n - 1].kind.name}") for n in there.lights]
            self._light = labels.pick("which", self._light or names[0][0], names)
        most = 180.0 - GRAZING + 90.0 if one.highest > 90.0 else GRAZING
        sides = [("θₗ", "_theta", most)]
        if "tangent" in one.shader.needs:
            sides.append((words["azimuth"], "_phi", 360.0))
        for label, name, high in sides:
            _label(label)
            imgui.set_next_item_width(-0.5 * em)
            here = getattr(self, name)
            moved, value = imgui.slider_float(f"##{name}", here, 0.0, high, "%.1f°")
            if moved:
                setattr(self, name, min(max(value, 0.0), high))
                sight.follows = False
        if self.kind in plotfiles.LOBES:
            _label(words["scale"])
            imgui.set_next_item_width(-0.5 * em)
            options = [(None, words["auto"]), (False, words["linear"]), (True, words["log"])]
            self._log = labels.pick("log", self._log, options)

    def _list(self, models, words):
        """List the models with their colours; one may be added, the others taken away."""
        imgui.separator()
        for i, one in enumerate(models):
            imgui.push_id(i)
            imgui.text_colored((*charts.COLOURS[i % len(charts.COLOURS)], 1.0), "■")
            imgui.same_line()
            imgui.text(one.label)
            if i:
                imgui.same_line()
                if imgui.small_button("×"):
                    del self.others[i - 1]
                imgui.set_item_tooltip(words["remove"])
            imgui.pop_id()
        imgui.set_next_item_width(-0.5 * imgui.get_font_size())
        name = labels.choice(
            "add", words["add"], lambda: [("", words["now"]), *catalog.names("model")]
        )
        if name == "":
            first = models[0]
            kept = words["as it was"].format(first.label)
            self.others.append((first.shader, dict(first.values), kept))
        elif name:
            try:
                self.others.append((catalog.read("model", name), None, ""))
            except Mistake as mistake:
                self._said = (one_line(mistake), labels.BAD)
        if any(values is None for _, values, _ in self.others):
            self._same = imgui.checkbox(words["same"], self._same)[1]

    def _save(self, now, words):
        """Offer the plot as a table and as a picture."""
        imgui.separator()
        imgui.begin_disabled(not self.drawn.shown or self.painting is not None)
        pressed = ""
        for name in ("copy", "csv", "png"):
            if imgui.button(words[name]):
                pressed = name
            imgui.same_line()
        imgui.new_line()
        imgui.end_disabled()
        if pressed == "copy":
            imgui.set_clipboard_text(plotfiles.csv(self.drawn))
            self._said = (words["copied"], labels.GOOD)
        elif pressed:
            path = files.unused("lumiar-plot", f".{pressed}")
            try:
                if pressed == "png":
                    self.painting = plotfiles.Painting(self.drawn, now.state.lang, path)
                    self._said = (words["saving"].format(path), labels.DIM)
                else:
                    files.write_whole(path, [plotfiles.csv(self.drawn).encode()])
                    self._said = (words["saved"].format(path), labels.GOOD)
            except OSError as error:
                self._said = (one_line(error), labels.BAD)
        self._paint(now, words)
        if self._said[0]:
            labels.wrapped(*self._said)

    def _paint(self, now, words):
        """See whether the picture that is being made is there."""
        fault = self.painting.end() if self.painting else None
        if fault is not None:
            saved = (words["saved"].format(self.painting.path), labels.GOOD)
            self._said = (fault, labels.BAD) if fault else saved
            self.painting.release()
            self.painting = None
        elif self.painting:
            now.state.wake = min(now.state.wake, now.time + LOOK)


def _label(text):
    """Write what the next widget is about, at its left."""
    begin, em = imgui.get_cursor_pos_x(), imgui.get_font_size()
    imgui.align_text_to_frame_padding()
    imgui.text(text)
    imgui.same_line(begin + 6.0 * em)
    imgui.set_next_item_width(-0.5 * em)


def _large(text):
    imgui.push_font(None, 1.25 * imgui.get_style().font_size_base)
    imgui.text_colored(labels.BRIGHT, text)
    imgui.pop_font()
