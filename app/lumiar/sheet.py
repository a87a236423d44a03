"""Pictures with captions laid out as one picture, legible from the back of a room."""

import math
import os

from .files import ASSETS

FONT = os.path.join(ASSETS, "fonts", "DejaVuSans.ttf")
PAPER, INK = (250, 250, 247), (24, 24, 28)


def lay_out(title, cells, columns=0):
    """Return ((width, height), bytes of sRGB) of a sheet.

    title    a line above all, may be empty
    cells    (caption, (width, height), bytes of sRGB) of each picture
    columns  pictures in a row; 0 makes the sheet a little wider than high
    """
    from PIL import Image, ImageDraw

    if not columns:
        wide = math.ceil(math.sqrt(len(cells) * 4 / 3))
        columns = min(wide, len(cells), 8)
    rows = [cells[i : i + columns] for i in range(0, len(cells), columns)]
    widths = [max(row[k][1][0] for row in rows if k < len(row)) for k in range(len(rows[0]))]
    gap = max(8, max(widths) // 40)
    total = sum(widths) + gap * (len(widths) + 1)
    top = _Line(title, max(20, min(total // 26, 48)), total - 2 * gap, heading=True)
    text = max(13, min(min(widths) // 14, 30))
    captions = [
        [_Line(c, text, w) for (c, _, _), w in zip(row, widths, strict=False)] for row in rows
    ]
    heights = [
        max(size[1] for _, size, _ in row) + max(line.height for line in lines)
        for row, lines in zip(rows, captions, strict=True)
    ]
    height = top.height + sum(heights) + gap * (len(rows) + 1)
    page = Image.new("RGB", (total, height), PAPER)
    pen = ImageDraw.Draw(page)
    top.draw(pen, gap, gap // 2, total - 2 * gap)
    y = top.height + gap
    for row, lines, row_height in zip(rows, captions, heights, strict=True):
        x = gap
        for (_, size, pixels), line, width in zip(row, lines, widths, strict=False):
            page.paste(Image.frombytes("RGB", size, pixels), (x + (width - size[0]) // 2, y))
            line.draw(pen, x, y + size[1], width)
            x += width + gap
        y += row_height + gap
    return page.size, page.tobytes()


class _Line:
    """A line of text wrapped to a width; a heading becomes a little smaller if that saves it."""

    def __init__(self, text, size, width, heading=False):
        from PIL import ImageFont

        self.font = ImageFont.truetype(FONT, size)
        needed = self.font.getlength(text)
        if heading and width < needed < 1.6 * width:
            size = int(size * width / needed)
            self.font = ImageFont.truetype(FONT, size)
        self.rows, row = [], ""
        for word in text.split():
            longer = f"{row} {word}".strip()
            if row and self.font.getlength(longer) > width:
                self.rows.append(row)
                longer = word
            row = longer
        self.rows += [row] if row else []
        self.step = int(size * 1.3)
        self.height = int(size * 0.5) + self.step * len(self.rows) if self.rows else 0

    def draw(self, pen, x, y, width):
        """Draw the line in the middle of a width, from y down."""
        for i, row in enumerate(self.rows):
            left = x + max(0, (width - self.font.getlength(row)) / 2)
            pen.text((left, y + self.step * i + self.step * 0.15), row, fill=INK, font=self.font)
