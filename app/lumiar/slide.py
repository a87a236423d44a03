"""One slide of a lesson: title, pictures, formula and text, legible from the back of a room.

Lengths are in units of which a slide of 1920 x 1080 pixels has one for each pixel.
"""

import re
from typing import NamedTuple

from PIL import Image, ImageDraw, ImageFont

from .errors import Mistake
from .sheet import FONT, INK, PAPER

GREY, RULE = (96, 96, 102), (214, 214, 208)
ASK, REVEAL = (166, 68, 0), (0, 84, 134)  # deep enough for white letters, apart for all eyes
TINTS = {ASK: (252, 236, 222), REVEAL: (224, 238, 248)}
MARGIN, GAP, TOP, FOOT = 64, 40, 134, 76
SINGLE = 1040  # width of a picture that stands alone
ROW, UNDER = 450, 60  # heights of several pictures and of the captions below them
LARGEST, SMALLEST, LEADING = 44, 30, 1.36  # letters of a text, and its lines
FORMULA = 54  # letters of a formula, where there is room
SMALLEST_SIZE = (640, 360)
_TIED = re.compile(r" (?=[=≤≥≈+−^%] ?)|(?<= [=≤≥≈+−^]) |(?<=\bcos) |(?<=\d) (?=\d{3}\b)")


class Box(NamedTuple):
    """A text beside a coloured bar: what it is called, its colour, what it says."""

    tag: str
    colour: tuple[int, int, int]
    text: str


class Page(NamedTuple):
    """What a slide shows.

    pictures  (caption, bytes of sRGB) each, of the size that `places` tells; b"" is left open
    formula   a function of the height of letters [pixels] that returns (width, height, coverage)
    box       a Box, or None
    number    (which slide, of how many)
    """

    title: str
    pictures: tuple
    formula: object
    text: str
    box: Box | None
    footer: str
    number: tuple[int, int]


def places(size, count):
    """Return the (x, y, width, height) of `count` pictures on a slide of size (width, height)."""
    u = _unit(size)
    left, top, gap = round(MARGIN * u), round(TOP * u), round(GAP * u)
    if count == 1:
        width = min(round(SINGLE * u), size[0] // 2)
        height = min(size[1] - top - round((FOOT + 24) * u), round(0.88 * width))
        return [(left, top, width, height)]
    width = (size[0] - 2 * left - (count - 1) * gap) // count
    height = round(ROW * u + 0.6 * (size[1] - 1080 * u))  # a slide of 4:3 has more room
    return [(left + i * (width + gap), top, width, height) for i in range(count)]


def draw(page, size, letters=LARGEST):
    """Return the bytes of sRGB of a Page of size (width, height), and the height of its letters.

    They are as high as there is room for, up to `letters`, in units. Raises Mistake where there is
    no room.
    """
    u = _unit(size)
    canvas = _Canvas(size, u)
    canvas.title(page.title)
    spots = places(size, len(page.pictures))
    for (caption, pixels), (x, y, width, height) in zip(page.pictures, spots, strict=True):
        canvas.picture(pixels, (x, y, width, height))
        if len(spots) > 1:
            canvas.centred(caption, (x, y + height, width, UNDER * u))
    start, end, right = MARGIN * u, size[1] - (FOOT + 24) * u, size[0] - MARGIN * u
    if len(spots) == 1:
        x, y, width, _ = spots[0]
        areas = [(x + width + 1.4 * GAP * u, y, right, end)]
        columns = [(page.formula, page.text, page.box)]
    else:
        y, middle = (
            spots[0][1] + spots[0][3] + (UNDER + 14) * u,
            size[0] * (0.5 if page.box else 0.42),
        )
        areas = [(start, y, middle - GAP * u / 2, end), (middle + GAP * u / 2, y, right, end)]
        columns = [(page.formula, page.text, None), (None, "", page.box)]
        if not page.box:
            columns = [(page.formula, "", None), (None, page.text, None)]
    for column, area in zip(columns, areas, strict=True):
        letters = canvas.column(*column, area, letters, drawn=False)
    for column, area in zip(columns, areas, strict=True):
        canvas.column(*column, area, letters)
    canvas.footer(page.footer, page.number)
    return canvas.image.tobytes(), letters


def _unit(size):
    """Return the pixels of a unit on a slide of a size."""
    if size[0] < SMALLEST_SIZE[0] or size[1] < SMALLEST_SIZE[1]:
        least = "x".join(map(str, SMALLEST_SIZE))
        raise Mistake(f"{size[0]}x{size[1]}: too small to read a slide; allowed: {least} or more")
    return min(size[0] / 1920, size[1] / 1080)


def _font(size):
    return ImageFont.truetype(FONT, round(size))


def _wrapped(text, font, width):
    """Return the lines of a text no wider than `width`, [] if a word is."""
    lines, row = [], ""  # none ends within a formula or a number
    for word in _TIED.sub("\u00a0", text).split(" "):
        longer = f"{row} {word}".strip(" ")
        if row and font.getlength(longer) > width:
            lines.append(row)
            longer = word
        row = longer
    lines.append(row)
    return lines if all(font.getlength(line) <= width for line in lines) else []


class _Canvas:
    """A slide being drawn; lengths in pixels, u pixels a unit."""

    def __init__(self, size, u):
        self.image, self.u = Image.new("RGB", size, PAPER), u
        self.pen = ImageDraw.Draw(self.image)

    def title(self, text):
        """Draw the title, smaller where it must be."""
        room = self.image.width - 2 * MARGIN * self.u
        letters = 60 * self.u
        letters = min(letters, letters * room / _font(letters).getlength(text))
        bold = int(letters / 45)
        spot = (MARGIN * self.u, 72 * self.u)
        self.pen.text(spot, text, INK, _font(letters), "lm", stroke_width=bold, stroke_fill=INK)

    def picture(self, pixels, spot):
        """Draw a picture, or a question mark in its place."""
        x, y, width, height = spot
        if pixels:
            self.image.paste(Image.frombytes("RGB", (width, height), pixels), (x, y))
            return
        self.pen.rectangle((x, y, x + width - 1, y + height - 1), TINTS[ASK])
        middle = (x + width / 2, y + height / 2)
        self.pen.text(middle, "?", ASK, _font(280 * self.u), "mm")

    def centred(self, text, spot):
        """Draw a caption in the middle of a place, smaller where it must be."""
        x, y, width, height = spot
        letters = 34 * self.u
        letters = min(letters, letters * width / max(1, _font(letters).getlength(text)))
        self.pen.text((x + width / 2, y + height / 2), text, INK, _font(letters), "mm")

    def column(self, formula, text, box, area, letters, drawn=True):
        """Draw a formula, a text and a Box below each other; return the height of letters.

        It is the largest up to `letters`, in units, for which there is room.
        """
        x, y, right, bottom = area
        if formula:
            width, height, coverage = formula(FORMULA * self.u)
            share = min((right - x) / width, 0.5 * (bottom - y) / height)
            if share < 1.0:
                width, height, coverage = formula(0.98 * share * FORMULA * self.u)
            if drawn:
                mask = Image.frombytes("L", (width, height), coverage)
                self.image.paste(INK, (round(x), round(y)), mask)
            y += height + 30 * self.u
        letters, lines, inner = self._fitting(text, box, (right - x, bottom - y), letters)
        if not drawn:
            return letters
        size, pad = letters * self.u, 24 * self.u
        y = self._write(lines, x, y, size, INK)
        if box:
            y += 30 * self.u * bool(lines)
            end = y + 2.2 * pad + LEADING * size * (1 + len(inner))
            self.pen.rectangle((x, y, right, end), TINTS[box.colour])
            self.pen.rectangle((x, y, x + 10 * self.u, end), box.colour)
            y = self._write([box.tag], x + 1.5 * pad, y + 0.9 * pad, size, box.colour, 1)
            self._write(inner, x + 1.5 * pad, y + 0.3 * pad, size, INK)
        return letters

    def _fitting(self, text, box, room, most):
        """Return (height of letters [units], lines of the text, lines of the Box) for a room."""
        for letters in range(most, SMALLEST - 1, -1):
            font, pad = _font(letters * self.u), 24 * self.u
            lines = _wrapped(text, font, room[0]) if text else []
            inner = _wrapped(box.text, font, room[0] - 2.5 * pad) if box else []
            need = LEADING * letters * self.u * (len(lines) + len(inner) + bool(box))
            if box:
                need += 2.2 * pad + 30 * self.u * bool(lines)
            whole = bool(lines) == bool(text) and bool(inner) == bool(box)
            if whole and need <= room[1]:
                return letters, lines, inner
        said = box.text if box and (lines or not text) else text  # the longer one, or a long word
        raise Mistake(f"'{said[:40]}…' has no room on a slide; write less")

    def _write(self, lines, x, y, letters, colour, stroke=0):
        """Write lines from a place downwards, and return where the next one would stand."""
        for line in lines:
            bold = round(stroke * letters / 40)
            self.pen.text((x, y), line, colour, _font(letters), stroke_width=bold)
            y += LEADING * letters
        return y

    def footer(self, text, number):
        """Draw what the lesson is, and how far it has come."""
        u, (width, height) = self.u, self.image.size
        left, right, y = MARGIN * u, width - MARGIN * u, height - FOOT * u
        reached = left + (right - left) * number[0] / number[1]
        self.pen.rectangle((left, y, right, y + 3 * u), RULE)
        self.pen.rectangle((left, y, reached, y + 3 * u), GREY)
        middle = y + 36 * u
        self.pen.text((left, middle), text, GREY, _font(24 * u), "lm")
        self.pen.text((right, middle), f"{number[0]} / {number[1]}", GREY, _font(24 * u), "rm")
