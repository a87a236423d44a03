"""What `lumiar bench` makes: studies one by one, a report that is whole after each of them."""

import datetime
import os
import platform
import subprocess
import time

import numpy as np

from . import __version__, colorimetry, files, image, ledger, page, plates, studies, study
from .bench import Bench
from .errors import Mistake, nearest

SAME = ("lumiar", "commit", "renderer", "cpu", "cores", "system", "clock", "quick")  # to go on


def chosen(names):
    """Return the names of the studies to do, all for none given; raise Mistake for others."""
    for name in names:
        if name not in studies.NAMES:
            raise Mistake(f"no study '{name}'; {nearest(name, studies.NAMES)}")
    return tuple(dict.fromkeys(names)) or studies.NAMES


def run(names, folder, quick, told):
    """Do the studies of these names and write FOLDER/report.json, points.csv, report.html.

    A report that is there already is gone on with, if it was made by the same program on the same
    machine and lacks some of them. told(kind, value) is called with "made" and the facts of the
    report, "new" and why an old one is left, "kept" and the names that are done, "begun" and (name,
    share of all the time, seconds left), "done" and each study of the report. Return the report.
    """
    os.makedirs(folder, exist_ok=True)
    with Bench(quick) as bench:
        made = facts(bench)
        report = _resumed(folder, names, made, told)
        pictures = plates.drawn(report["studies"], folder)
        told("made", report["made"])
        done = [one["name"] for one in report["studies"]]
        wanted = [name for name in names if name not in done]
        modules = {name: studies.load(name) for name in wanted}
        guess = {name: module.SECONDS[quick] for name, module in modules.items()}
        start, whole = time.monotonic(), sum(guess.values())
        for i, name in enumerate(wanted):
            left = sum(guess[one] for one in wanted[i:])
            if left < whole:  # as fast as it has been so far
                left *= (time.monotonic() - start) / (whole - sum(guess[o] for o in wanted[i:]))
            told("begun", (name, i / len(wanted), left))
            one = _study(name, modules[name], bench, folder)
            report["studies"] = sorted(
                [*report["studies"], one], key=lambda one: studies.NAMES.index(one["name"])
            )
            pictures |= plates.drawn([one], folder)
            _write(report, pictures, folder)
            told("done", one)
    return report


def facts(bench):
    """Return what a report says of how it was made."""
    return {
        "date": datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds"),
        "lumiar": __version__,
        "commit": _commit(),
        "renderer": bench.renderer.name,
        "cpu": _cpu(),
        "cores": os.cpu_count(),
        "system": f"{platform.system()} {platform.release()}",
        "python": platform.python_version(),
        "clock": bench.clock.said,
        "quick": bench.quick,
    }


def _resumed(folder, names, made, told):
    """Return the report to go on with: that of the folder, or an empty one."""
    fresh = {"schema": ledger.SCHEMA, "made": made, "studies": []}
    path = os.path.join(folder, "report.json")
    if not os.path.exists(path):
        return fresh
    old = ledger.read(path)
    other = [key for key in SAME if old["made"].get(key) != made[key]]
    if other:
        told("new", f"of another {other[0]}")
        return fresh
    done = [one["name"] for one in old["studies"]]
    if all(name in done for name in names):  # nothing was left over: once more
        told("new", "complete")
        return {**fresh, "studies": [one for one in old["studies"] if one["name"] not in names]}
    told("kept", done)
    return {**old, "made": {**made, "date": old["made"]["date"]}}


def _study(name, module, bench, folder):
    """Return one study of a report, its pictures written to the folder."""
    start = time.monotonic()
    found, shown, remarks = [], [], []
    for one in module.run(bench):
        if isinstance(one, study.Shown):
            shown.append(_pictures(name, one, folder))
        elif isinstance(one, study.Remark):
            remarks.append(one._asdict())
        else:
            found.append(one._replace(study=name))
    found = study.marked(found, module.METRICS)
    return {
        "name": name,
        "title": module.TITLE,
        "seconds": round(time.monotonic() - start, 2),
        "metrics": {key: metric._asdict() for key, metric in module.METRICS.items()},
        "words": module.WORDS,
        "points": [study.as_row(point) for point in found],
        "advice": ledger.advised(found, module.METRICS, module.WORDS),
        "remarks": remarks,
        "pictures": shown,
    }


def _pictures(name, shown, folder):
    """Write a picture and the map of its error; return what a report says of them."""
    stem = "-".join((name, shown.case, shown.variant)).replace(" ", "_").replace("/", "_")
    row = {"case": shown.case, "variant": shown.variant, "file": f"{stem}.png"}
    _png(folder, row["file"], colorimetry.srgb(np.nan_to_num(shown.pixels)))
    if shown.error is not None:
        error = np.nan_to_num(np.abs(shown.error))
        white = float(error.max())
        row |= {"error_file": f"{stem}-error.png", "white": white}
        _png(folder, row["error_file"], np.sqrt(np.repeat(error[..., None], 3, 2) / (white or 1)))
    return row


def _png(folder, name, values):
    height, width, _ = values.shape
    pixels = (values * 255.0 + 0.5).astype(np.uint8).tobytes()
    files.write_whole(os.path.join(folder, name), image.png((width, height), [pixels]))


def _write(report, pictures, folder):
    files.write_whole(os.path.join(folder, "report.json"), [ledger.as_json(report)])
    files.write_whole(os.path.join(folder, "points.csv"), [ledger.as_csv(report)])
    text = page.html(report, pictures)
    files.write_whole(os.path.join(folder, "report.html"), [text.encode()])


def _commit():
    """Return the commit of the checkout that runs, with a digest of what was changed since."""
    try:
        where = ("git", "-C", files.ROOT)
        at = subprocess.check_output(
            (*where, "rev-parse", "--short", "HEAD"), stderr=subprocess.DEVNULL, text=True
        )
        changed = subprocess.check_output(
            (*where, "diff", "HEAD", "--", "app", "glsl"), stderr=subprocess.DEVNULL
        )
    except (OSError, subprocess.CalledProcessError):
        return ""
    import hashlib

    return at.strip() + (f"+{hashlib.sha256(changed).hexdigest()[:8]}" if changed else "")


def _cpu():
    """Return the name of the processor."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8", errors="replace") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()
