"""The data sheet in the window: claims with verdicts, float error and cost at these very values."""

import time

from imgui_bundle import imgui

from . import captions, examine, hostile, measure
from .auditor import Auditor
from .errors import Mistake
from .labels import BAD, BRIGHT, DIM, GOOD, WHITE
from .phrases import TEXT
from .stopwatch import Stopwatch

LOOK = 0.25  # seconds between two looks at what is still being audited
_FLAGS = imgui.TableFlags_.row_bg | imgui.TableFlags_.sizing_stretch_prop


class Datasheet:
    """The tool "sheet" of the drawer: what is known of the chosen object's model."""

    def __init__(self, now):
        context, renderer = now.stage.context, now.stage.renderer
        self._instrument = measure.Instrument(context)
        self._watch = Stopwatch(context, self._instrument)
        self.driver = renderer.name
        self.auditor = Auditor(self.driver)
        self._pairs, self._known, self._errors, self.sheet = {}, (None, None), None, None

    def release(self):
        """Stop the audit, and free what is on the card."""
        self.auditor.release()
        self._watch.release()
        self._instrument.release()

    @property
    def errors(self):
        """{"scatter" or "surround": figures} at the values shown, {} without a reference, None."""
        return self._errors

    @property
    def cost(self):
        """The Stopwatch, with what it knows of the picture shown."""
        return self._watch

    def draw(self, now):
        """Draw the sheet of the chosen object's model; the scene stays."""
        words, lang = TEXT[now.state.lang]["sheet"], now.state.lang
        chosen = now.scene.objects[now.state.chosen :] or now.scene.objects[-1:]
        model, values = (chosen[0].model, chosen[0].values) if chosen else (None, {})
        self._measure(now, model, values)
        imgui.push_text_wrap_pos(0.0)
        if model:
            imgui.text_colored(BRIGHT, model.header.get("model", model.name))
            imgui.text_colored(DIM, model.header.get("paper", ""))
            imgui.separator_text(words["claims"])
            self._claims(words, captions.TEXT[lang]["sheet"])
            imgui.separator_text(words["error"])
            self._float_error(words)
        else:
            imgui.text(words["none"])
        imgui.separator_text(words["cost"])
        self._costs(words, now, model)
        imgui.pop_text_wrap_pos()
        return now.scene

    def _measure(self, now, model, values):
        """Measure a little where there is time for it, and ask to be drawn again for the rest."""
        state = (now.shown, model, values)
        if self._known != state:
            self._known, self._errors = state, None
            self._watch.forget()
        self.sheet = self.auditor.sheet(model) if model else None
        audits = model and self.sheet is None
        if audits:
            now.state.wake = min(now.state.wake, time.monotonic() + LOOK)
        if not now.rests:
            now.state.wake = min(now.state.wake, time.monotonic() + LOOK)
        elif now.fault or now.shown is None:
            return
        elif model and self._errors is None:
            self._errors = self._error(model, values)
            now.state.restless = True
        else:
            stage, timed = now.stage, None if audits else model  # an audit would be timed, too
            try:
                due = self._watch.step(now.shown, timed, values, stage.renderer, stage.cost)
            except Mistake:  # the stage tells of it
                due = False
            now.state.restless |= due

    def _error(self, model, values):
        """Return {what: figures} of float32 against float64, on ordinary directions."""
        if model.transmits not in self._pairs:
            fair = hostile.ordinary(model.transmits)
            self._pairs[model.transmits] = fair, self._instrument.pairs(*fair)
        fair, pairs = self._pairs[model.transmits]
        found = {}
        for what, reference in examine.references(model).items():
            try:
                measured = getattr(self._instrument, what)(model, values, pairs)
                found[what] = examine.deviation(model, values, what, reference, measured, *fair)
            except (TypeError, KeyError, Mistake):
                continue  # another model of that name, or one that does not compile
        return found

    def _claims(self, words, names):
        sheet = self.sheet
        if sheet is None:
            imgui.text_colored(DIM, words["measuring"])
            return
        if "fault" in sheet:
            imgui.text_colored(BAD, sheet["fault"])
            return
        rows = [("", *words["claim"])]
        for name, said in sheet["claims"].items():
            sign = "✓" if said["verdict"].startswith("holds") else "✗"
            claimed = names.get(said["claimed"], said["claimed"])
            rows.append((sign, names[name], claimed, names[said["verdict"]]))
        places, letters = _columns(rows)
        _row(rows[0], (DIM,) * 4, places, letters)
        for row, said in zip(rows[1:], sheet["claims"].values(), strict=True):
            color = GOOD if row[0] == "✓" else DIM if said["agrees"] else BAD
            _row(row, (color, WHITE, WHITE, color), places, letters)
            self._found(said, words)
        for line in sheet["broken"]:
            imgui.text_colored(BAD, _told(line, words))
        hard = sheet["hostile"]
        counts = [f"{hard[kind]:,}".replace(",", " ") for kind in ("nan", "infinite", "negative")]
        number = f"{hard['evaluations']:,}".replace(",", " ")
        imgui.text_colored(DIM, words["counted"].format(number, *counts))

    def _found(self, said, words):
        em = imgui.get_font_size()
        if said["worst"] > 0.0:
            imgui.indent(1.5 * em)
            imgui.text_colored(DIM, _told(f"{said['what']} ({said['where']})", words))
            imgui.unindent(1.5 * em)

    def _float_error(self, words):
        if self._errors is None:
            imgui.text_colored(DIM, words["measuring"])
        elif not self._errors:
            imgui.text_colored(DIM, words["no reference"])
        for what, found in (self._errors or {}).items():
            if len(self._errors) > 1:
                imgui.text(what)
            if found is None:
                imgui.text_colored(DIM, words["black"])
                continue
            rows = [(words[key], f"{found[key]:.1e}") for key in ("max", "inherent", "p99")]
            place = _told(found["where"].partition(";")[0], words)
            _table(f"error {what}", [*rows, (words["where"], place)])

    def _costs(self, words, now, model):
        watch, wait, rows = self._watch, words["measuring"], []
        if model:
            ns, lambert = watch.evaluation or (None, None)
            said = wait if ns is None else f"{ns:.2f} ns" if ns > 0.05 else words["free"]
            rows.append((words["evaluation"], said))
            if ns is not None and lambert > 0.0:
                rows.append((words["times"], f"{ns / lambert:.1f}"))
        picture = wait if watch.picture is None else f"{1e3 * watch.picture:.2f} ms"
        rows.append((words["picture"], picture))
        _table("cost", rows)
        if watch.picture is not None:
            honest = watch.clock.startswith("timer")
            imgui.text_colored(DIM, words["card" if honest else "wall"])
        if now.shown:
            size = words["size"].format(*now.shown.size, now.shown.samples)
            imgui.text_colored(DIM, size)
        imgui.text_colored(DIM, self.driver)


def _columns(rows):
    """Return where the columns of rows of a sign and three texts begin, and how large letters are.

    They are smaller where not all of it would stand side by side.
    """
    width, em = imgui.get_content_region_avail().x, imgui.get_font_size()
    texts = zip(*rows, strict=True)
    wide = [max(imgui.calc_text_size(text).x for text in column) + 0.7 * em for column in texts]
    share, more = min(1.0, width / sum(wide)), max(0.0, width - sum(wide)) / 3.0
    first, second, third, _ = (share * one for one in wide)
    return (0.0, first, first + second + more, first + second + third + 2.0 * more), share * em


def _row(texts, colors, places, letters):
    """Write a sign and three texts side by side."""
    begin = imgui.get_cursor_pos_x()
    imgui.push_font(None, letters)
    for text, color, place in zip(texts, colors, places, strict=True):
        if place:
            imgui.same_line(begin + place)
        imgui.text_colored(color, text)
    imgui.pop_font()


def _table(name, rows):
    """Draw (what, value) rows."""
    if imgui.begin_table(name, 2, _FLAGS):
        for what, value in rows:
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_colored(DIM, what)
            imgui.table_next_column()
            imgui.text(value)
        imgui.end_table()


def _told(line, words):
    """Return what an audit says in the language of the window."""
    for phrase, other in words["told"]:
        line = line.replace(phrase, other)
    return line
