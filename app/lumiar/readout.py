"""What a probe found, as a table to be read."""

import json
import math

from . import captions

_ROWS = (  # of the table: key of its words, radiometric key and unit, photometric ones, RGB
    ("L", "radiance_W_m2_sr", "W/(m² sr)", "luminance_cd_m2", "cd/m²", "radiance_rgb"),
    ("own", "emitted_W_m2_sr", "W/(m² sr)", "emitted_cd_m2", "cd/m²", "emitted_rgb"),
    ("E", "irradiance_W_m2", "W/m²", "illuminance_lx", "lx", "irradiance_rgb"),
    ("M", "exitance_W_m2", "W/m²", "luminous_exitance_lm_m2", "lm/m²", "exitance_rgb"),
    ("albedo", "albedo_to_eye", "", None, "", "albedo_to_eye_rgb"),
)


def as_json(found):
    """Return what `probe.measured` found as JSON; null for NaN and infinity."""
    return json.dumps(_plain(found), indent=2, ensure_ascii=False)


def text(found, scene, lang):
    """Return the table of what `probe.measured` found in the scene of a name, in en or pt."""
    parts = [_columns(rows) for rows in tables(found, scene, lang)]
    if found["lights"]:
        parts.append(captions.TEXT[lang]["probe"]["angles"])
    return "\n\n".join(parts)


def tables(found, scene, lang):
    """Return what `text` tells as tables, rows of texts: what is seen, its quantities, the lights.

    All but the first have a row that says what the columns are; without lights there are two.
    """
    words = captions.TEXT[lang]["probe"]
    (x, y), (width, height) = found["at_px"], found["size_px"]
    where = f"{x}, {y} {words['of']} {width} x {height}"
    lines = [[words["at"], f"{scene}: {where}" if scene else where]]
    lines.append([words["object"], _object(found["object"], words)])
    if found["object"]:
        lines.append([words["position"], f"{_list(found['position_m'])} m"])
        lines.append([words["normal"], _list(found["normal"])])
        distance, angle = found["distance_m"], found["theta_o_deg"]
        lines.append([words["eye"], f"{number(distance)} m, θₒ {angle:.4g}°"])
    table = [["", words["radiometric"], words["photometric"], words["rgb"]]]
    for name, watts, unit, lumens, other, rgb in _ROWS:
        if found[watts] is not None:
            about = words[name]
            if name == "M" and not found["exitance_exact"]:
                about += words["estimate"]
            photometric = f"{number(found[lumens])} {other}" if lumens else ""
            row = [about, f"{number(found[watts])} {unit}".strip(), photometric]
            table.append([*row, _list(found[rgb])])
    parts = [lines, table]
    if found["lights"]:
        rows = [[words["light"], "L cd/m²", "%", "E lx", "%", "E W/m²", "lm/W", *_OF_DIRECTIONS]]
        rows += [_light(light) for light in found["lights"]]
        parts.append(rows)
    return parts


def _plain(value):
    if isinstance(value, dict):
        return {key: _plain(its) for key, its in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(its) for its in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


_OF_DIRECTIONS = ("θᵢ °", "φ °", "f 1/sr", "albedo")


def _light(light):
    """Return the row of one light."""
    name = " ".join(filter(None, (str(light["number"]), light["kind"], light["name"])))
    shares = (light["share_of_luminance"], light["share_of_illuminance"])
    L, E = ("-" if share is None else f"{100.0 * share:.3g}" for share in shares)
    row = [name, number(light["luminance_cd_m2"]), L, number(light["illuminance_lx"]), E]
    keys = ("irradiance_W_m2", "efficacy_lm_W", "theta_i_deg", "azimuth_deg", "f_1_sr", "albedo")
    return row + [number(light[key]) for key in keys]


def _object(one, words):
    if one is None:
        return words["none"]
    name = f"{one['name']}, " if one["name"] else ""
    return f"{one['number']}: {name}{one['mesh'].rpartition('/')[2]}, {one['model']}"


def _columns(rows):
    """Return rows of texts as lines whose columns begin at the same letter."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = ("  ".join(t.ljust(w) for t, w in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)


def _list(numbers):
    return ", ".join(map(number, numbers))


def number(x):
    """Return a number as the table has it, to five digits; "-" for None."""
    return "-" if x is None else "0" if abs(x) <= 1e-12 else f"{x:.5g}"
