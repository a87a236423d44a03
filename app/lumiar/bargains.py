"""The tool that shows a study of `lumiar bench`: what a choice costs, how far off it is."""

import contextlib
import math
import os

import numpy as np
from imgui_bundle import imgui, implot

from . import charts, files, geometry, labels, ledger, study
from .bilingual import TEXT, name_of
from .chart import fitted
from .errors import Mistake
from .figures import series
from .notation import number
from .uses import used

OWN, SHIPPED = os.path.join("bench", "report.json"), ("docs", "bench", "report.json")
USED, LESS = charts.AMBER, charts.DIM  # colours: the scene's, all that is by the way
MARKERS = (  # of ImPlot, and the letters that look so: on the front, beside it
    *(("circle", "●○"), ("square", "■□"), ("up", "▲△"), ("diamond", "◆◇"), ("down", "▼▽")),
    *(("left", "◀◁"), ("right", "▶▷")),
)


class Bargains:
    """The tool "study" of the drawer; see there. chosen is what is shown: (study, case, metric).

    The report is that of the folder `bench`, if there is one, else the one that comes with Lumiar.
    """

    def __init__(self):
        self._charts = charts.Charts()
        self.chosen, self.fault, self.made = None, "", {}
        self._seen, self._studies, self._groups, self._count = (), {}, {}, ("", 0)

    def release(self):
        """Give back what ImPlot has."""
        self._charts.release()

    def draw(self, now):
        """Draw the points of the chosen study and what they say; the scene stays."""
        words = TEXT[now.state.lang]
        self._read()
        imgui.push_text_wrap_pos(0.0)
        if not self._groups:
            imgui.text(self.fault or words["none"])
        elif self.chosen or now.shown:
            self._show(now, words)
        imgui.pop_text_wrap_pos()
        return now.scene

    @property
    def points(self):
        """The Points that are shown."""
        return self._groups[self.chosen]

    def used(self, now, name):
        """Return the Points of a study that stand for what the scene does; see `uses`."""
        scene = now.shown
        if not scene or not scene.objects:
            return []
        thing = scene.objects[min(now.state.chosen, len(scene.objects) - 1)]
        if thing.mesh != self._count[0]:
            with contextlib.suppress(Mistake):
                self._count = thing.mesh, geometry.load(thing.mesh).triangle_count
        points = [p for key, group in self._groups.items() if key[0] == name for p in group]
        return used(name, points, thing, self._count[1], scene.shading, scene.lights)

    def _read(self):
        """Read the report, once for each time that it was written."""
        path = OWN if os.path.exists(OWN) else os.path.join(files.ROOT, *SHIPPED)
        try:
            seen = path, os.stat(path).st_mtime_ns
        except OSError:
            seen = path, None
        if seen == self._seen:
            return
        self._seen, self._studies, self._groups, self.fault = seen, {}, {}, ""
        try:
            report = ledger.read(path) if seen[1] else {"studies": [], "made": {}}
        except Mistake as mistake:
            self.fault = str(mistake)
            return
        self.made = report["made"]
        for one in report["studies"]:
            points = [study.from_row(row) for row in one["points"]]
            for key, group in study.grouped(points).items():
                if len(group) > 1 and all(p.error is not None for p in group):
                    self._studies[one["name"]] = one
                    self._groups[one["name"], *key] = group

    def _show(self, now, words):
        """Draw the choice of what is shown, its plot, its values and its sentences."""
        if self.chosen not in self._groups:
            self._begin(now)
        lang = now.state.lang
        self._pick(lang)
        one, mine = self._studies[self.chosen[0]], self.used(now, self.chosen[0])
        mine = [p for p in self.points if p in mine]
        names = {p.variant: name_of(one, p.variant)[lang] for p in self.points}
        for point in mine:
            imgui.text_colored((*USED, 1.0), f"{words['scene']}: {names[point.variant]}")
        _plot(self.points, mine, one["metrics"][self.chosen[2]], names, words, lang)
        for given in one["advice"]:
            if (given["case"], given["metric"]) == self.chosen[1:]:
                imgui.text(" ".join(given[lang]))
        for given in one["remarks"]:
            imgui.text(given[lang])
        _table(self.points, mine, names, words, lang)
        imgui.text_colored((*LESS, 1.0), f"{self.made['renderer']}; {self.made['date'][:10]}")

    def _begin(self, now):
        """Choose the first study that has something which the scene uses."""
        mine = [p for name in self._studies for p in self.used(now, name)]
        keys = [(p.study, p.case, p.metric) for p in mine]
        self.chosen = next((key for key in keys if key in self._groups), next(iter(self._groups)))

    def _pick(self, lang):
        """Draw what there is to choose: a study, then one of its cases, then a metric."""
        name, case, metric = self.chosen
        titles = {one: its["title"][lang] for one, its in self._studies.items()}
        imgui.push_item_width(-1.0)
        name = labels.choice("study", titles[name], [*titles.items()]) or name
        keys = [key for key in self._groups if key[0] == name]
        one = self._studies[name]
        cases = dict.fromkeys(key[1] for key in keys)
        case = case if case in cases else next(iter(cases))
        said = [(key, name_of(one, key)[lang]) for key in cases]
        case = labels.choice("case", dict(said)[case], said) or case
        metrics = [key[2] for key in keys if key[1] == case]
        metric = metric if metric in metrics else metrics[0]
        if len(metrics) > 1:
            said = [(key, name_of(one, key)[lang]) for key in metrics]
            metric = labels.choice("metric", dict(said)[metric], said) or metric
        imgui.pop_item_width()
        self.chosen = name, case, metric


def _plot(points, mine, metric, names, words, lang):
    """Draw errors against costs on logarithmic axes, those of the scene with a ring."""
    em, width = imgui.get_font_size(), imgui.get_content_region_avail().x
    if not implot.begin_plot("##bargain", (width, max(12.0 * em, 0.62 * width)), charts.FLAGS):
        return
    x = fitted([end for p in points for end in (p.cost, p.high)], 0.7 * width)
    y = fitted([p.error for p in points], 0.45 * width, 12.0)
    low = (x.low / 2.0 if x.zero else x.low, y.low / 4.0 if y.zero else y.low)
    implot.setup_axes(words[points[0].unit], words["error"], charts.FIXED, charts.FIXED)
    for axis, one, start in zip((implot.ImAxis_.x1, implot.ImAxis_.y1), (x, y), low, strict=True):
        implot.setup_axis_scale(axis.value, implot.Scale_.log10.value)
        implot.setup_axis_limits(axis.value, start, one.high, implot.Cond_.always)
        said = {value or start: number(value, 3, lang) for value, _ in one.ticks()}
        implot.setup_axis_ticks(axis.value, [*said], [*said.values()])
    implot.setup_finish()

    def at(cost, error):
        return max(cost, low[0]), min(max(error, low[1]), y.high)

    for name in ("visible", "floor"):
        if y.low < metric[name] < y.high:
            _line(f"##{name}", [low[0], x.high], [metric[name]] * 2, LESS, 1.0)
            implot.push_style_color(implot.Col_.inlay_text.value, (*LESS, 1.0))
            implot.plot_text(words[name], low[0], metric[name], (4.0 * em, -0.6 * em))
            implot.pop_style_color()
    places = {p.variant: at(p.cost, p.error) for p in points}
    _stairs([places[p.variant] for p in points if p.pareto], (x.high, y.high))
    for p, (colour, (shape, _)) in _styled(points):
        cost, error = places[p.variant]
        _line(f"##of {p.variant}", [max(p.low, low[0]), p.high], [error] * 2, colour, 1.0)
        _mark(p.variant, cost, error, shape, colour, p.pareto)
        if p in mine:
            _mark(f"ring {p.variant}", cost, error, "circle", USED, False, 0.65)
    if implot.is_plot_hovered():
        _tell(points, places, names, lang)
    implot.end_plot()


def _styled(points):
    """Yield (Point, (colour, one of MARKERS)), alike in a series."""
    styles = {}
    for point in points:
        kind = styles.setdefault(series(point.variant)[0], len(styles))
        yield point, (charts.COLOURS[kind % len(charts.COLOURS)], MARKERS[kind % len(MARKERS)])


def _stairs(places, ends):
    """Draw the front, from one of the best to the next."""
    way, least = [], ends[1]
    for cost, error in sorted(places):
        if error < least:
            way += [(cost, least), (cost, error)]
            least = error
    if way:
        _line("##front", *zip(*way, (ends[0], least), strict=True), (1.0, 1.0, 1.0), 2.0)


def _line(name, x, y, colour, width):
    spec = implot.Spec(line_color=(*colour, 0.7), line_weight=width)
    implot.plot_line(name, np.array(x, np.float64), np.array(y, np.float64), spec=spec)


def _mark(name, x, y, shape, colour, full, size=0.4):
    spec = implot.Spec(marker=implot.Marker_[shape].value, size=1.0)
    spec.marker_size, spec.line_weight = size * imgui.get_font_size(), 2.0
    spec.marker_line_color = (*colour, 1.0)
    spec.marker_fill_color = (*colour, 1.0 if full else 0.0)
    implot.plot_scatter(f"##{name}", np.array([x]), np.array([y]), spec=spec)


def _tell(points, places, names, lang):
    """Say at the mouse what the point next to it is."""
    mouse = imgui.get_mouse_pos()

    def away(point):
        place = implot.plot_to_pixels(*places[point.variant])
        return math.hypot(place.x - mouse.x, place.y - mouse.y)

    point = min(points, key=away)
    if away(point) < imgui.get_font_size() and imgui.begin_tooltip():
        imgui.text(names[point.variant])
        imgui.text(" · ".join(_numbers(point, lang)))
        imgui.end_tooltip()


def _numbers(point, lang):
    cost = number(point.cost, 3, lang)
    return number(point.error, 2, lang), f"{cost} {point.unit}"


def _table(points, mine, names, words, lang):
    """Draw the values, the cheapest first, those of the front bright, the scene's in colour."""
    flags = imgui.TableFlags_.row_bg | imgui.TableFlags_.sizing_stretch_prop
    if not imgui.begin_table("values", 3, flags):
        return
    for title in ("", words["error"], words["cost"]):
        imgui.table_setup_column(title)
    imgui.table_headers_row()
    for point, (colour, (_, letters)) in sorted(_styled(points), key=lambda pair: pair[0].cost):
        imgui.table_next_column()
        imgui.text_colored((*colour, 1.0), letters[0 if point.pareto else 1])
        imgui.same_line()
        colour = USED if point in mine else (1.0, 1.0, 1.0) if point.pareto else LESS
        for i, text in enumerate((names[point.variant], *_numbers(point, lang))):
            if i:
                imgui.table_next_column()
            imgui.text_colored((*colour, 1.0), text)
    imgui.end_table()
