"""What the user can put right, said in one line."""


class Mistake(Exception):
    """A fault in what the user gave; its one line names the place and what to write there."""


def one_line(text, limit=300):
    """Return `text` as one printable line of at most `limit` characters.

    Control characters and line breaks become spaces, so that no file name or driver log can break
    the promise of a one-line message.
    """
    line = " ".join("".join(c if c.isprintable() else " " for c in str(text)).split())
    return line if len(line) <= limit else line[: limit - 1] + "…"


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
