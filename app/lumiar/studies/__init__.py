"""The studies of `lumiar bench`, one module each: a truth, variants, their errors and costs.

A module holds TITLE {language: text}, SECONDS (full, quick), METRICS {name: study.Metric}, WORDS
{case, variant or metric: {language: text}}, and run(bench), which yields study.Point, Shown and
Remark; bench is a bench.Bench. Variants are GLSL, in glsl/studies or models that Lumiar has.
"""

from importlib import import_module

NAMES = (  # in the order of a report
    "fresnel",
    "lobes",
    "diffuse",
    "shading-rate",
    "area-light",
    "environment",
    "spectrum",
    "precision",
    "scale",
)


def load(name):
    """Return the module of a study."""
    return import_module(f"{__name__}.{name.replace('-', '_')}")
