"""The panel as a class sees it: what a step of a lesson says, large, and its sliders alone."""

from imgui_bundle import imgui

from . import captions, compare, labels, sections
from .labels import BRIGHT, DIM
from .picture import in_language

LINES = 30.0  # lines of text that the height of a window has
SMALLEST = 0.7  # of that height, where there is more to say
_COLOURS = {"ask": (1.0, 0.7, 0.4, 1.0), "reveal": (0.5, 0.8, 1.0, 1.0)}


class Presenter:
    """The parts of the panel for a Stop of a lesson, or for any scene where there is none.

    images: of `Overlay`, by which a formula becomes a picture.
    """

    def __init__(self, images):
        self._images, self._formula, self._drawn = images, None, None
        self._shown, self._share = None, 1.0
        self.stop = self._beside = None

    def parts(self, document):
        """Return what `panel.draw` draws for the Stop of a Document, or where it has none."""
        self.stop, self._beside = document.stop, document.beside
        return (self._step,) if self.stop else (sections.model,)

    def _step(self, scene, state, words):
        step, part, lang = self.stop.step, self.stop.part, state.lang
        shown = (self.stop, lang, tuple(imgui.get_io().display_size))
        if shown != self._shown:
            self._shown, self._share = shown, 1.0
        elif imgui.get_scroll_max_y() > 0.0 and self._share > SMALLEST:
            self._share *= 0.94
            state.restless = True
        base = imgui.get_style().font_size_base
        imgui.push_font(None, self._share * base)
        imgui.push_text_wrap_pos(0.0)
        imgui.push_font(None, 1.3 * self._share * base)
        imgui.text_colored(BRIGHT, in_language(step.title, lang))
        imgui.pop_font()
        self._write_formula(step, lang, 1.25 * base)
        imgui.text_unformatted(in_language(step.caption, lang))
        if part:
            text = in_language(step.ask if part == "ask" else step.reveal, lang)
            _box(captions.TEXT[lang]["lesson"][part], _COLOURS[part], text)
        imgui.dummy((1.0, 0.3 * base))
        common = [key for key in step.sliders if compare.common(self._beside.comparison, key)]
        scene = sections.some(scene, state, words, common)
        self._own(state, words, [key for key in step.sliders if key not in common])
        imgui.push_font(None, 0.6 * self._share * base)
        imgui.text_colored(DIM, in_language(step.source, lang))
        imgui.pop_font()
        imgui.pop_text_wrap_pos()
        imgui.pop_font()
        return scene

    def _own(self, state, words, keys):
        """Draw a row in each picture for values of which every picture has one of its own."""
        comparison, pictures = self._beside.comparison, self._beside.pictures
        for i, (variant, one) in enumerate(zip(comparison.shown, pictures, strict=True)):
            if not keys or not one.scene:
                continue
            imgui.push_id(i)
            imgui.text_colored(DIM, in_language(one.caption, state.lang))
            after = sections.some(one.scene, state, words, keys)
            if after is not one.scene:
                comparison = compare.replaced(comparison, i, compare.edited(variant, after))
            imgui.pop_id()
        self._beside.show(comparison, labels.gesture(state))

    def _write_formula(self, step, lang, letters):
        """Write the formula as a picture, or as text where none can be made."""
        latex = in_language(step.formula, lang)
        if not latex:
            return
        wanted = (latex, round(letters))
        if wanted != self._formula:
            if self._drawn:
                self._images.drop(self._drawn[0])
            self._formula, self._drawn = wanted, self._picture(*wanted)
        imgui.dummy((1.0, 0.2 * letters))
        if self._drawn:
            image, size = self._drawn
            share = min(self._share, imgui.get_content_region_avail().x / size[0])
            imgui.image(image, (share * size[0], share * size[1]))
        else:
            imgui.text_unformatted(in_language(step.plain, lang))
        imgui.dummy((1.0, 0.2 * letters))

    def _picture(self, latex, letters):
        """Return (texture, (width, height)) of a formula in white, None where there is none."""
        try:
            from . import plots

            width, height, coverage = plots.formula(latex, letters)
        except (ImportError, OSError, ValueError):
            return None
        pixels = bytearray(b"\xff" * (4 * width * height))
        pixels[3::4] = coverage
        return self._images.image((width, height), bytes(pixels)), (width, height)


def _box(tag, colour, text):
    """Write a text beside a bar, below what it is called."""
    em = imgui.get_font_size()
    imgui.dummy((1.0, 0.2 * em))
    imgui.indent(0.7 * em)
    imgui.begin_group()
    imgui.text_colored(colour, tag)
    imgui.text_unformatted(text)
    imgui.end_group()
    imgui.unindent(0.7 * em)
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    ink = imgui.color_convert_float4_to_u32(colour)
    corner = (low.x - 0.7 * em, low.y)
    imgui.get_window_draw_list().add_rect_filled(corner, (low.x - 0.4 * em, high.y), ink)
