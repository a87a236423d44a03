"""What the measuring verbs, measure, formfactor, audit and bench, do with their options."""

import os
import sys

from . import options as given
from .errors import Mistake
from .supervise import limit_time
from .verbs import check_folder

PICTURES = ".png, .svg or .pdf"
AUDIT_TIME = 900.0  # seconds: every model there is takes about a minute
BENCH_TIME = 3600.0  # all studies take a quarter of that


def audit(options):
    """Print the data sheets of models; 1 when one is not as it claims, 2 when one is no model."""
    limit_time(options.timeout or AUDIT_TIME)
    import json

    from . import audit as sheets
    from . import catalog
    from .measure import Instrument

    names = [name for one in options.models for name in _models_of(one)] or catalog.names("model")
    if options.output:
        if len(names) > 1 or _ending(options.output) != ".png":
            raise Mistake(f"{options.output}: one page shows one model, as a .png")
        check_folder(options.output)
    found, code = {}, 0
    with Instrument() as instrument:
        for name in names:
            try:
                model = catalog.read("model", name, "", os.getcwd())
                found[name] = sheets.audit(model, instrument)
            except Mistake as mistake:
                if len(names) == 1:
                    raise
                print(f"lumiar: {mistake}", file=sys.stderr)
                code = 2
                continue
            if not options.json:
                print(sheets.text(found[name]), flush=True)
            if options.output:
                _write_page(options, found[name], model, instrument)
    if options.json:
        print(json.dumps(found, indent=2))
    return code or int(any(sheet["broken"] for sheet in found.values()))


def _models_of(name):
    """Return the models that a name stands for: itself, or every .glsl file of a folder."""
    if not os.path.isdir(name):
        return [name]
    if files := sorted(f for f in os.listdir(name) if f.endswith(".glsl")):
        return [os.path.join(name, f) for f in files]
    raise Mistake(f"{name}: holds no .glsl file; name a model")


def _write_page(options, sheet, model, instrument):
    from . import audit as sheets
    from . import files
    from .renderer import Renderer
    from .scenefile import system_language

    with Renderer(instrument.context) as renderer:
        lang = options.lang or system_language()
        files.write_whole(options.output, [sheets.page(sheet, model, instrument, renderer, lang)])
    print(options.output)


def measure(options):
    """Measure models: a table, a picture of lobes and albedo, or exact pairs of directions."""
    _check_measure(options)
    if options.timeout:
        limit_time(options.timeout)
    from . import files, measuring, tables
    from .measure import Instrument
    from .scenefile import system_language

    pairs = given.pairs(options)
    models = measuring.chosen(options.models, pairs, os.getcwd(), options.material)
    if options.directions:
        return _measure_exactly(models[0], options)
    overlays = [(os.path.basename(path), tables.read(path)) for path in options.overlay]
    setup = measuring.Setup(
        options.light or measuring.LIGHTS,
        options.azimuth or 0.0,
        options.detector,
        options.hemisphere or 0.0,
        options.aperture or 0.0,
        options.noise or 0.0,
        options.seed or 0,
    )
    table, drawn = None, b""
    with Instrument() as instrument:
        if options.out or not options.plot or setup.noise or setup.aperture:
            table = measuring.measurement(instrument, models, setup)
        if options.plot:
            lang, ending = options.lang or system_language(), _ending(options.plot)
            said = ", ".join(options.set)
            drawn = measuring.picture(
                instrument, models, setup, options.light, table, overlays, lang, ending, said
            )
    if options.out:
        files.write_whole(options.out, tables.written(table, _ending(options.out)))
        print(options.out)
    if options.plot:
        files.write_whole(options.plot, [drawn])
        print(options.plot)
    if not options.out and not options.plot:
        for chunk in tables.written(table, ".csv"):
            sys.stdout.write(chunk.decode())
    return 0


def _measure_exactly(model, options):
    from . import files, measuring, tables
    from .measure import Instrument

    L, V = tables.pairs(options.directions)
    with Instrument() as instrument:
        data, broken = measuring.exact(instrument, model, L, V)
    files.write_whole(options.out, [data])
    print(options.out)
    if broken:
        print(f"lumiar: {options.out}: {broken} of {len(L)} pairs are not finite", file=sys.stderr)
    return 0


def _check_measure(options):
    """Refuse options of `measure` that do not go together, before anything is opened."""
    if options.directions:
        alone = ("light", "azimuth", "detector", "hemisphere", "aperture", "noise", "seed")
        for name in (*alone, "plot", "overlay"):
            if getattr(options, name) not in (None, []):
                raise Mistake(f"--{name}: --directions measures exactly its pairs; leave one out")
        if len(options.models) > 1:
            raise Mistake(f"--directions: {len(options.models)} models; name one")
        if not options.out or _ending(options.out) != ".npz":
            raise Mistake("--directions: write where to, as in --out scatter.npz")
        if os.path.abspath(options.out) == os.path.abspath(options.directions):
            raise Mistake(f"{options.out}: would replace the directions; write to another file")
    if options.overlay and not options.plot:
        raise Mistake("--overlay: draws into a picture; add --plot lobes.png")
    _check_file(options.out, ".csv or .npz")
    _check_file(options.plot, PICTURES)


def formfactor(options):
    """Print solid angles and form factors of a patch or a polygon to a polygon, by every way."""
    _check_file(options.output, PICTURES)
    if options.timeout:
        limit_time(options.timeout)
    from . import factor_card
    from . import factor_table as table

    here, there = table.corners(options.here, "--from"), table.corners(options.there, "--to")
    target, chance = table.polygon(there, "--to"), (options.samples, options.seed)
    if len(here) == 1:
        normal = table.vector(options.normal or "0,0,1", "--normal")
        found = factor_card.with_card(table.patch(here[0], normal, target, *chance), target)
    elif options.normal:
        raise Mistake("--normal: a polygon has its own; leave it out, or give --from one point")
    elif options.output:
        raise Mistake("--output: Nusselt's projection is a patch's; give --from one point")
    else:
        found = table.polygons(table.polygon(here, "--from"), target, *chance)
    print(table.as_json(found) if options.json else table.as_text(found))
    if options.output:
        from . import files, hemisphere
        from .scenefile import system_language

        lang, ending = options.lang or system_language(), _ending(options.output)
        files.write_whole(options.output, [hemisphere.picture(found, target, lang, ending)])
    return 0


def bench(options):
    """Do studies of speed against error; 1 when --compare finds something worse."""
    limit_time(options.timeout or BENCH_TIME)
    from . import benching, ledger
    from .scenefile import system_language

    lang = options.lang or system_language()
    names = benching.chosen(options.studies)
    if os.path.exists(options.output) and not os.path.isdir(options.output):
        raise Mistake(f"{options.output}: is a file; name a folder for the report")
    old = ledger.read(options.compare) if options.compare else None

    def told(kind, value):
        if kind == "done":
            print(f"{ledger.table(value, lang)}\n", flush=True)
        elif kind == "made":
            facts = [
                f"{value['renderer']}; {value['cpu']}, {value['cores']} cores; {value['clock']}"
            ]
            facts.append(f"Lumiar {value['lumiar']} {value['commit']}; {value['date']}")
            print(*facts, "", sep="\n", flush=True)
        else:
            _tell_of_bench(kind, value, options.output)

    report = benching.run(names, options.output, options.quick, told)
    print(ledger.TEXT[lang]["front"])
    print(os.path.join(options.output, "report.html"))
    if not old:
        return 0
    lines, worse = ledger.changes(old, report)
    print(*lines or [f"{options.compare}: nothing changed beyond noise"], sep="\n")
    return int(worse)


def _tell_of_bench(kind, value, folder):
    """Say on standard error how far a bench is, and what becomes of an older report."""
    if kind == "begun":
        name, share, left = value
        text = f"{name}, {share:.0%} of the studies done, about {left:.0f} s left"
    elif kind == "kept":
        text = f"goes on: {', '.join(value)} done already"
    else:
        text = f"the report there is {value}; begins anew"
    print(f"lumiar: {folder}: {text}", file=sys.stderr, flush=True)


def _check_file(path, endings):
    if path:
        if not _ending(path) or _ending(path) not in endings.replace(",", "").split():
            raise Mistake(f"{path}: ends in {endings}; write one of these")
        check_folder(path)


def _ending(path):
    return os.path.splitext(path)[1].lower()
