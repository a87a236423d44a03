"""The probe in the window: the table of `lumiar probe` for the pixel that was clicked."""

from imgui_bundle import imgui

from . import banner, captions, probe, readout
from .errors import Mistake, one_line
from .labels import BAD, DIM, GOOD, WHITE, wrapped
from .measure import Instrument

REST = 0.25  # seconds after which it is looked whether all is at rest
WIDE = 26.0  # sizes of letters from which four columns can be read
_FLAGS = (
    imgui.TableFlags_.row_bg
    | imgui.TableFlags_.borders_inner_v
    | imgui.TableFlags_.sizing_stretch_prop
)


class Prober:
    """The tool "probe" of the drawer. found is what `probe.measured` told of the picture, or None.

    It is measured while nothing moves: it takes some frames' time.
    """

    def __init__(self, now):
        self._instrument = Instrument(now.stage.context)
        self.found, self._seen, self._picked = None, (None, None), None
        self._fault, self._said = "", ""

    def release(self):
        """Free what is on the card."""
        self._instrument.release()

    def draw(self, now):
        """Draw the table and return the scene."""
        words, lang = captions.TEXT[now.state.lang]["probe"], now.state.lang
        at = tuple(map(int, now.picked)) if now.picked and now.shown else None
        inside = at and all(0 <= x < size for x, size in zip(at, now.shown.size, strict=True))
        if not inside:
            self.found, self._seen = None, (None, None)
            wrapped(words["click"], DIM)
            return now.scene
        stale = self._seen[0] is not now.shown or self._seen[1] != at
        if stale and now.rests:
            self._measure(now, at)
            stale = False
        elif stale:
            now.state.wake = min(now.state.wake, now.time + REST)
        banner.ring(now.corner, at)
        if self._fault:
            wrapped(self._fault, BAD)
        if self.found:
            name = now.document.name
            imgui.push_style_var(imgui.StyleVar_.alpha, 0.5 if stale else 1.0)
            self._tables(name, lang, words)
            imgui.pop_style_var()
            if imgui.button(words["copy"]):
                imgui.set_clipboard_text(readout.text(self.found, name, lang) + "\n")
                self._said = words["copied"]
            if self._said:
                imgui.same_line()
                imgui.text_colored(GOOD, self._said)
        return now.scene

    def _measure(self, now, at):
        """Probe the picture; a click chooses the object that it hits."""
        self._seen, self._fault, self._said = (now.shown, at), "", ""
        try:
            self.found = probe.measured(now.shown, at, now.stage.renderer, self._instrument)
        except Mistake as mistake:
            self.found, self._fault = None, one_line(mistake)
        if self._picked != now.picked and self.found and self.found["object"]:
            now.state.chosen = self.found["object"]["number"] - 1
        self._picked = now.picked

    def _tables(self, name, lang, words):
        place, quantities, *lights = readout.tables(self.found, name, lang)
        _table("place", place, 0)
        imgui.dummy((1.0, 0.5 * imgui.get_font_size()))
        if imgui.get_content_region_avail().x > WIDE * imgui.get_font_size():
            _table("quantities", quantities, 1)
        else:
            _blocks(quantities)
        for rows in lights:  # one light is a column: there is more room below than beside
            imgui.dummy((1.0, 0.5 * imgui.get_font_size()))
            _table("lights", [[*column] for column in zip(*rows, strict=True)], 1)
            wrapped(words["angles"], DIM)


def _table(name, rows, heads, about=1):
    """Draw rows of texts; the first `heads` rows and `about` columns say what the others are."""
    if imgui.begin_table(name, len(rows[0]), _FLAGS):
        for i, row in enumerate(rows):
            imgui.table_next_row()
            for k, text in enumerate(row):
                imgui.table_next_column()
                wrapped(text.strip(), DIM if k < about or i < heads else WHITE)
        imgui.end_table()


def _blocks(rows):
    """Draw a table below each other: what a row is, its first two values, then the third."""
    (_, *_, third), *rows = rows
    for i, (about, *values, rgb) in enumerate(rows):
        wrapped(about.strip(), DIM)
        _table(str(i), [values], 0, 0)
        wrapped(f"{third}: {rgb}", WHITE)
        imgui.dummy((1.0, 0.2 * imgui.get_font_size()))
