"""What the user can put right, said in one line."""


class Mistake(Exception):
    """A fault in what the user gave; its one line names the place and what to write there."""

    def __init__(self, text):
        super().__init__(one_line(text, 100_000))


def one_line(text, limit=300):
    """Return `text` as one printable line of at most `limit` characters, cut in its middle.

    Control characters and line breaks become blanks, bytes of a name that are no UTF-8 are shown as
    such, so that no file name or driver log can break the promise of a one-line message.
    """
    text = str(text).encode("utf-8", "backslashreplace").decode()
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    head = limit // 3
    return line if len(line) <= limit else f"{line[:head]}…{line[head + 1 - limit :]}"


def nearest(word, allowed):
    """Return what to write instead of `word`: the closest of `allowed`, and what else there is."""
    from difflib import get_close_matches  # 3 ms, and only a mistake needs it

    allowed = sorted(allowed)
    close = get_close_matches(str(word).lower(), [a.lower() for a in allowed], 6, 0.5)
    close = sorted((a for a in allowed if a.lower() in close), key=lambda a: close.index(a.lower()))
    guess = f"did you mean '{close[0]}'? " if close else ""
    shown = allowed if len(allowed) <= 16 else close or allowed[:10]
    more = ", …" if len(shown) < len(allowed) else ""
    return f"{guess}allowed: {', '.join(shown) or 'none'}{more}"
