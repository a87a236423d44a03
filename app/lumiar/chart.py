"""Points on two logarithmic axes as the text of an SVG: marks, intervals, a front, names.

What depends on the language is in a group of its own per language, so that the page shows one of
them; colours come from the page's style: c0 to c6 of a mark, and front, grid, bar, edge, note.
"""

import math
from html import escape
from typing import NamedTuple

from .notation import number

LANGUAGES = ("en", "pt")
WIDTH, HEIGHT = 360.0, 270.0  # units of the picture; letters have SIZE of them
LEFT, RIGHT, TOP, BOTTOM = 50.0, 12.0, 24.0, 46.0
SIZE, WIDE = 14.0, 0.6  # of letters, and their width over their size, about
COLOURS = 7
BEYOND = 1e12  # what no scale is stretched for, as an error where a formula overflows
SHAPES = (  # about 5 in each direction: told apart without any colour, too
    "M-5 0A5 5 0 0 1 5 0 5 5 0 0 1-5 0Z",
    "M-4.2-4.2H4.2V4.2H-4.2Z",
    "M0-6L5.5 3.8H-5.5Z",
    "M0-6.2L5.2 0 0 6.2-5.2 0Z",
    "M0 6L5.5-3.8H-5.5Z",
    "M-5.5-2H-2V-5.5H2V-2H5.5V2H2V5.5H-2V2H-5.5Z",
)
_STEPS = ((1.0,), (1.0, 3.0), (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 5.0, 7.0))


class Mark(NamedTuple):
    """A point: values x and y, the interval of one of them, what it is called in each language.

    style numbers its colour and shape; labels are written beside it where there is room, tip is
    shown when it is pointed at; best: on the front; ring: Lumiar's default.
    """

    x: float
    y: float
    interval: tuple
    style: int
    labels: dict
    tip: str
    best: bool = False
    ring: bool = False


class Axis(NamedTuple):
    """From low to high on `length` units; where `zero`, what is not above 0 stands before low."""

    low: float
    high: float
    length: float
    zero: bool = False

    def at(self, value):
        """Return where a value stands, in units from the start of the axis."""
        room = 36.0 if self.zero else 0.0
        if not value > 0.0:
            return room / 3.0
        share = math.log(value / self.low) / math.log(self.high / self.low)
        return room + min(max(share, 0.0), 1.0) * (self.length - room)

    def ticks(self):
        """Return [(value, label)]: powers of ten, or digits between them, as there is room."""
        decades = math.log10(self.high / self.low)
        powers = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        if decades > 2.0:
            step = math.ceil(decades / 6.0)
            values = [10.0**p for p in powers if p % step == 0]
        else:
            for digits in _STEPS:
                values = [d * 10.0**p for p in powers for d in digits]
                values = [v for v in values if 0.999 * self.low < v < 1.001 * self.high]
                if len(values) >= 3:
                    break
        inside = [v for v in values if 0.999 * self.low < v < 1.001 * self.high]
        return [(0.0, "0")] * self.zero + [(v, number(v)) for v in inside]


def fitted(values, length, least=4.0):
    """Return the Axis on which all values stand, with room around; high / low is at least least.

    What is BEYOND stands at its end.
    """
    some = [v for v in values if 0.0 < v < BEYOND] or [1.0]
    low, high = min(some), max(some)
    spare = max((high / low) ** 0.07, 1.15)
    low, high = low / spare, high * spare
    wider = math.sqrt(max(least / (high / low), 1.0))
    return Axis(low / wider, high * wider, length, any(not v > 0.0 for v in values))


def shapes():
    """Return the shapes of all marks, to stand once in a page before any `glyph`."""
    drawn = [f'<path id="m{i}" d="{way}"/>' for i, way in enumerate(SHAPES)]
    return f'<svg class="shapes"><defs>{"".join(drawn)}</defs></svg>'


def looks(style, full=True):
    """Return the class of a mark, full or hollow."""
    return f"c{style % COLOURS}{'' if full else ' open'}"


def glyph(style, more=""):
    """Return the SVG of a mark's shape."""
    return f'<use href="#m{style % len(SHAPES)}"{more}/>'


def svg(marks, titles, along="x", levels=(), lines=()):
    """Return (the SVG of marks, whether every one has its name beside it in every language).

    titles   (of x, of y), each {language: text}
    along    the axis of the intervals; "x" draws the front of the best marks, too
    levels   (value of y, {language: text}, shaded) of lines across, below it a ground if shaded
    lines    lists of marks, each joined by a line
    """
    across, up = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
    ends = [end for m in marks for end in m.interval]
    middles = {"x": [m.x for m in marks], "y": [m.y for m in marks]}
    middles[along] = middles[along] + [e for e in ends if e > 0.3 * min(map(abs, middles[along]))]
    x, y = fitted(middles["x"], across), fitted(middles["y"], up, 12.0)
    places = [(LEFT + x.at(m.x), TOP + up - y.at(m.y)) for m in marks]
    parts, taken = [_grid(x, y)], [_around(px, py, 7.0) for px, py in places]
    for value, texts, shaded in levels:
        if y.low < value < y.high:
            parts.insert(0, _level(TOP + up - y.at(value), texts, shaded, taken))
    if along == "x":
        parts.append(_front([p for p, m in zip(places, marks, strict=True) if m.best]))
    at = {id(m): p for m, p in zip(marks, places, strict=True)}
    for line in lines:
        way = "L".join(f"{at[id(m)][0]:.1f} {at[id(m)][1]:.1f}" for m in line)
        parts.append(f'<path class="line c{line[0].style % COLOURS}" d="M{way}"/>')
    bars = ""
    for mark, (px, py) in zip(marks, places, strict=True):
        low, high = map((x if along == "x" else y).at, mark.interval)
        if along == "x":
            bars += f"M{LEFT + low:.1f} {py:.1f}H{LEFT + high:.1f}"
        else:
            bars += f"M{px:.1f} {TOP + up - low:.1f}V{TOP + up - high:.1f}"
    parts.append(f'<path class="bar" d="{bars}"/>')
    for mark, (px, py) in zip(marks, places, strict=True):
        ring = f'<circle class="ring" cx="{px:.1f}" cy="{py:.1f}" r="9"/>' if mark.ring else ""
        look = looks(mark.style, mark.best or along == "y")
        drawn = glyph(mark.style, f' class="{look}" transform="translate({px:.1f} {py:.1f})"')
        parts.append(f"<g><title>{escape(mark.tip)}</title>{ring}{drawn}</g>")
    named = True
    for lang in LANGUAGES:
        names = [*_labels(marks, places, taken, lang)]
        named = named and len(names) == len(marks)
        parts.append(f'<g lang="{lang}">{_words(marks, names, titles, lang)}</g>')
    return f'<svg viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img">{"".join(parts)}</svg>', named


def _grid(x, y):
    """Return the lines of the ticks with their numbers, and those of the axes."""
    bottom, right, out = HEIGHT - BOTTOM, WIDTH - RIGHT, []
    across = "".join(f"M{LEFT + x.at(v):.1f} {TOP:g}V{bottom:g}" for v, _ in x.ticks())
    up = "".join(f"M{LEFT:g} {bottom - y.at(v):.1f}H{right:g}" for v, _ in y.ticks())
    edge = f"M{LEFT:g} {TOP:g}V{bottom:g}H{right:g}"
    out = [f'<path class="grid" d="{across}{up}"/><path class="edge" d="{edge}"/>']
    for value, label in x.ticks():
        at = f'x="{LEFT + x.at(value):.1f}" y="{bottom + 17:g}"'
        out.append(f'<text class="n middle" {at}>{label}</text>')
    for value, label in y.ticks():
        at = f'x="{LEFT - 5:g}" y="{bottom - y.at(value) + 5:.1f}"'
        out.append(f'<text class="n end" {at}>{label}</text>')
    return "".join(out)


def _level(height, texts, shaded, taken):
    """Return a line across and what it means where nothing is; shaded: below it, a ground.

    taken: the boxes of what is there, to which its own is added.
    """
    under = shaded and height + SIZE + 4.0 < HEIGHT - BOTTOM
    base, right = height + (SIZE + 1.0 if under else -4.0), WIDTH - RIGHT
    wide = WIDE * SIZE * max(map(len, texts.values()))
    boxes = {"end": (right - wide, right), "start": (LEFT + 4.0, LEFT + 4.0 + wide)}
    boxes = {side: (a, base - SIZE, b, base + 3.0) for side, (a, b) in boxes.items()}
    side = min(boxes, key=lambda side: sum(_meet(boxes[side], other) for other in taken))
    taken.append(boxes[side])
    at = f'class="note {side}" x="{boxes[side][2 if side == "end" else 0]:g}" y="{base:.1f}"'
    corners = f"M{LEFT:g} {height:.1f}H{right:g}V{HEIGHT - BOTTOM:g}H{LEFT:g}"
    ground = f'<path class="none" d="{corners}"/>' if shaded else ""
    out = ground + f'<path class="level" d="M{LEFT:g} {height:.1f}H{right:g}"/>'
    return out + "".join(
        f'<text lang="{lang}" {at}>{escape(text)}</text>' for lang, text in texts.items()
    )


def _front(places):
    """Return the stairs from one of the best marks to the next: below them nothing was found."""
    if not places:
        return ""
    way, least = "", HEIGHT
    for i, (px, py) in enumerate(sorted(places)):
        if i == 0:
            way = f"M{px:.1f} {TOP:g}V{py:.1f}"
            least = py
        elif py > least:
            way += f"H{px:.1f}V{py:.1f}"
            least = py
    return f'<path class="front" d="{way}H{WIDTH - RIGHT:g}"/>'


def _words(marks, names, titles, lang):
    """Return the titles and names in one language."""
    axes = (("end", WIDTH - RIGHT, HEIGHT - 8), ("start", 2.0, 15.0))
    out = [
        f'<text class="{side}" x="{x:g}" y="{y:g}">{escape(title[lang])}</text>'
        for (side, x, y), title in zip(axes, titles, strict=True)
    ]
    for where, (px, py), words in names:
        strong = " strong" if marks[where].best else ""
        out.append(f'<text class="label{strong}" x="{px:.1f}" y="{py:.1f}">{escape(words)}</text>')
    return "".join(out)


def _labels(marks, places, taken, lang):
    """Yield (index, place, text) of the names that find room, those of the front first."""
    taken = [*taken]
    order = sorted(range(len(marks)), key=lambda i: (not marks[i].best, not marks[i].ring))
    for i in order:
        text = marks[i].labels[lang]
        if not text:
            continue
        (px, py), wide = places[i], WIDE * SIZE * len(text) * (1.1 if marks[i].best else 1.0)
        spots = [(px + 10, py + 5), (px - 10 - wide, py + 5)]
        for up in (-10.0, 20.0) if text[0].isdigit() else (-10.0, 20.0, -25.0, 35.0):
            spots += [(px - wide / 2 + k * wide / 2, py + up) for k in (0.0, 0.8, -0.8)]
        for left, base in spots:
            box = (left - 2, base - SIZE + 1, left + wide + 2, base + 4)
            if _inside(box) and not any(_meet(box, other) for other in taken):
                taken.append(box)
                yield i, (left, base), text
                break


def _around(x, y, reach):
    return (x - reach, y - reach, x + reach, y + reach)


def _inside(box):
    edges = (LEFT + 1, TOP + 1, WIDTH - 2, HEIGHT - BOTTOM - 1)
    return box[0] > edges[0] and box[1] > edges[1] and box[2] < edges[2] and box[3] < edges[3]


def _meet(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
