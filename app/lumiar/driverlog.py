"""What a driver says of a shader, turned back into the file and line that a person wrote."""

import re

_FORMS = (
    re.compile(r"\d+:(\d+)\(\d+\):\s*(.*)"),  # Mesa: 0:7(32): error: …
    re.compile(r"\d+\((\d+)\)\s*:\s*(.*)"),  # NVIDIA: 0(7) : error C1008: …
    re.compile(r"ERROR:\s*\d+:(\d+):\s*(.*)"),  # AMD, Intel, Apple, glslang
)


def locate(log, sources):
    """Return the first error in a driver's log as (file, line, message).

    sources is {stage: flatten.Source}; which stage it was is read from the heading that moderngl
    puts above the log. The file is "" and the line 0 where the log names no line of ours.
    """
    stage = next((s for s in sources if f"{s}_shader" in log), None)
    lines = sources[stage].lines if stage else ()
    for line in map(str.strip, log.splitlines()):
        found = next(filter(None, (form.match(line) for form in _FORMS)), None)
        if not found or re.match(r"warning", found.group(2), re.IGNORECASE):
            continue
        number = int(found.group(1))
        message = re.sub(r"^(?:preprocessor )?error\b\s*(?:\w+\s*)?:\s*", "", found.group(2))
        if 1 <= number <= len(lines) and lines[number - 1][0]:
            return (*lines[number - 1], message)
    told = [line.strip() for line in log.splitlines() if line.strip(" =")]
    message = re.sub(r"^[\d:()]+\s*error\s*:\s*", "", told[-1]) if told else ""
    # Recursion, say, comes without a line: function `float f(float)' has static recursion
    for name in re.findall(r"[`'\"][\w ]*?(\w+)[('\"]", message):
        for place in _named(name, sources):
            return (*place, message)
    return "", 0, message or "the driver gives no reason"


def _named(name, sources):
    """Yield (file, line) of each line that names a function, the last stage first."""
    for source in reversed(sources.values()):
        for text, place in zip(source.text.split("\n"), source.lines, strict=False):
            if place[0] and re.search(rf"\w\s+{name}\s*\(", text):
                yield place
