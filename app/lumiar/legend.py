"""What a false-colour picture says of its colours, drawn below it: a scale bar, or swatches."""

from PIL import Image, ImageDraw, ImageFont

from . import scale
from .sheet import FONT, INK, PAPER

NARROWEST = 260  # pixels that a legend needs; a smaller picture stands in the middle above it


def with_bar(size, pixels, title, ruler, swatches=()):
    """Return (size, bytes of sRGB) of a picture above a bar of its colours.

    size      (width, height) of the picture, pixels its bytes of sRGB
    title     the quantity and its unit
    ruler     the scale.Scale of the colours
    swatches  (colour, name) of what is not on the scale
    """
    page = _Page(size, pixels)
    page.write(title)
    page.bar(ruler)
    page.swatches(swatches)
    return page.finished()


def with_swatches(size, pixels, title, swatches):
    """Return (size, bytes of sRGB) of a picture above (colour, name) swatches; as `with_bar`."""
    page = _Page(size, pixels)
    page.write(title)
    page.swatches(swatches)
    return page.finished()


class _Page:
    """A page that grows downwards from its picture."""

    def __init__(self, size, pixels):
        self.width = max(NARROWEST, size[0])
        self.text = max(13, min(self.width // 28, 34))
        self.gap = self.text // 2
        self.font = ImageFont.truetype(FONT, self.text)
        self.y = size[1] + self.gap
        self.page = Image.new("RGB", (self.width, size[1] + 40 * self.text), PAPER)
        picture = Image.frombytes("RGB", size, pixels)
        self.page.paste(picture, ((self.width - size[0]) // 2, 0))
        self.pen = ImageDraw.Draw(self.page)

    def write(self, text):
        """Draw a text in the middle, in as many lines as it needs."""
        row, most = "", self.width - 2 * self.gap
        for word in [*text.split(" "), ""]:
            longer = f"{row} {word}".strip()
            if row and (not word or self.font.getlength(longer) > most):
                left = (self.width - self.font.getlength(row)) / 2
                self.pen.text((left, self.y), row, fill=INK, font=self.font)
                self.y += int(1.3 * self.text)
                longer = word
            row = longer

    def bar(self, ruler):
        """Draw the colours of a scale from left to right, with its marks below."""
        ticks = ruler.ticks()
        ends = [self.font.getlength(label) for _, label in (ticks[0], ticks[-1])]
        left = self.gap + max(1, int(ends[0] / 2))
        length = self.width - left - self.gap - max(1, int(ends[1] / 2))
        high = int(0.9 * self.text)
        self.y += self.gap // 2
        colours = Image.frombytes("RGB", (length, 1), scale.ramp(length))
        self.page.paste(colours.resize((length, high)), (left, self.y))
        self.y += high
        free = 0.0  # where the next label may begin
        for share, label in ticks:
            x = left + round(share * (length - 1))
            wide = self.font.getlength(label)
            shown = label and x - wide / 2 >= free
            down = self.gap if label else self.gap // 2
            self.pen.line(
                [(x, self.y), (x, self.y + down)], fill=INK, width=max(1, self.text // 14)
            )
            if shown:
                self.pen.text((x - wide / 2, self.y + down), label, fill=INK, font=self.font)
                free = x + wide / 2 + 0.6 * self.text
        self.y += self.gap + int(1.5 * self.text)

    def swatches(self, swatches):
        """Draw squares of colours with their names, in rows."""
        side, left = int(0.9 * self.text), self.gap
        self.y += self.gap // 2 if swatches else 0
        for colour, name in swatches:
            wide = int(1.4 * self.text + self.font.getlength(name) + self.text)
            if left > self.gap and left + wide > self.width:
                left, self.y = self.gap, self.y + int(1.5 * self.text)
            box = (left, self.y, left + side, self.y + side)
            self.pen.rectangle(box, fill=tuple(colour), outline=INK)
            at = (left + 1.4 * self.text, self.y - 0.15 * self.text)
            self.pen.text(at, name, fill=INK, font=self.font)
            left += wide
        self.y += int(1.5 * self.text) if swatches else 0

    def finished(self):
        """Return (size, bytes of sRGB) of the page, cut where it is empty."""
        page = self.page.crop((0, 0, self.width, self.y + self.gap // 2))
        return page.size, page.tobytes()
