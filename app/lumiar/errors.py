"""What the user can put right, said in one line."""


class Mistake(Exception):
    """A fault in what the user gave: one line naming the file, the place and what to write there."""


def one_line(text, limit=300):
    """Return `text` as one printable line of at most `limit` characters.

    Control characters and line breaks become spaces, so that no file name or driver log can break
    the promise of a one-line message.
    """
    line = " ".join("".join(c if c.isprintable() else " " for c in str(text)).split())
    return line if len(line) <= limit else line[: limit - 1] + "…"


def nearest(word, allowed):
    """Return what to write instead of `word`: the closest of `allowed`, then all of them."""
    from difflib import get_close_matches  # 3 ms, and only a mistake needs it

    allowed = sorted(allowed)
    close = get_close_matches(str(word).lower(), [a.lower() for a in allowed], 1, 0.5)
    listing = ", ".join(allowed) if allowed else "nothing"
    guess = next((a for a in allowed if close and a.lower() == close[0]), None)
    return f"did you mean '{guess}'? allowed: {listing}" if guess else f"allowed: {listing}"
