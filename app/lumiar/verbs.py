"""What each verb does with its options; each returns an exit code."""

import contextlib
import math
import os
import sys
import time

from . import options as given
from .errors import Mistake, one_line
from .supervise import limit_time

LESSON_TIME = 600.0  # seconds: dozens of pictures


def view(options):
    """Open a window with a scene, and return when it is closed."""
    limit_time(math.inf)
    from . import lesson as lessons
    from . import scenefile
    from .document import Document

    named = {**scenefile.shipped(), **lessons.shipped()}
    path = named.get(options.scene) or os.path.abspath(os.path.expanduser(options.scene or ""))
    path = path if path.endswith(".toml") else ""
    name = os.path.splitext(os.path.basename(options.scene or ""))[0]
    scene, fault = None, None
    try:
        scene = _viewed(options)
        document = Document(scene, name, path, options.restore)
    except Mistake as mistake:  # in a file, it can be put right while the window is open
        fault = mistake
        document = Document.expecting(lambda: _viewed(options), name, path, fault)
    try:
        from .desktop import has_display
        from .window import Viewer
    except ImportError as error:
        advice = "`lumiar capture` draws without a window"
        raise Mistake(f"no window can be opened here ({one_line(error, 120)}); {advice}") from None
    if fault and not has_display():
        raise fault
    lang = getattr(scene, "lang", "")
    lang = options.lang or (lang if lang in scenefile.LANGUAGES else "")
    with Viewer(document, lang or scenefile.system_language()) as viewer:
        viewer.run()
    return 0


def _viewed(options):
    """Return the Scene or the Lesson that the options of `view` describe."""
    from . import lesson as lessons

    if options.restore:
        from . import opening

        if options.scene:
            raise Mistake(f"--restore: opens the last scene, not {options.scene}; leave one out")
        return opening.kept()
    if not lessons.is_lesson(options.scene or "", os.getcwd()):
        return given.scene(options)
    keys = ("model", "material", "mesh", "shading", "light", "set")
    for key in (key for key in keys if getattr(options, key)):
        raise Mistake(f"--{key}: {options.scene} is a lesson; leave it out")
    return lessons.load(options.scene, os.getcwd())


def capture(options):
    """Draw a scene to a picture and print its path."""
    from . import image

    path = options.output or _default_output(options.scene)
    image.ending(path)
    check_folder(path)
    if options.timeout:
        limit_time(options.timeout)
    scene = given.scene(options)
    for key in ("size", "samples", "lang"):
        if getattr(options, key) is not None:
            scene = scene.changed(key, getattr(options, key), f"--{key}: ")
    if options.vary:
        scene = given.varied(scene, options.vary, options.size)
    from .renderer import Renderer

    renderer, progress = Renderer(), _Progress(path)
    if options.view:
        from . import falsecolour, views

        where, here = "--view: ", os.getcwd()
        view = views.chosen(options.view, where)
        broken = falsecolour.write(scene, path, view, renderer, where, here, progress)
    else:
        from . import picture

        broken = picture.write(scene, path, renderer, progress)
    print(path)
    if broken:
        cut = ", or its loops cut short after 65535 steps" * renderer.may_cut_loops
        what = options.view.partition(":")[0] if options.view else "radiance"
        text = f"{broken} pixels have no finite {what} (NaN or infinite{cut}); they are magenta"
        print(f"lumiar: {path}: {text}", file=sys.stderr)
    return 3 if broken and options.strict else 0


def probe(options):
    """Print what is at one pixel of a scene's picture."""
    if options.timeout:
        limit_time(options.timeout)
    scene = given.scene(options)
    if options.size:
        scene = scene.changed("size", options.size, "--size: ")
    if scene.panels:
        several = f"{options.scene}: a sheet of {len(scene.panels)} pictures"
        raise Mistake(f"{several}; probe a scene of one picture")
    from . import measure, readout, scenefile
    from . import probe as meter
    from .renderer import Renderer

    at = meter.place(options.at, scene.size)
    with Renderer() as renderer, measure.Instrument() as instrument:
        found = meter.measured(scene, at, renderer, instrument)
    lang = scenefile.system_language() if scene.lang == "system" else scene.lang
    name = options.scene or "lumiar"
    print(readout.as_json(found) if options.json else readout.text(found, name, lang))
    return 0


def source(options):
    """Print the GLSL of one object of a scene, exactly as compiled."""
    from . import geometry, layout

    if options.timeout:
        limit_time(options.timeout)
    scene = given.scene(options)
    if not 1 <= options.object <= len(scene.objects):
        raise Mistake(f"--object {options.object}: allowed: 1 to {len(scene.objects)}")
    meshes = [geometry.load(one.mesh, crease=one.crease) for one in scene.objects]
    placed = layout.arrange(scene, meshes)[options.object - 1]
    for stage, text in layout.sources(scene, placed).items():
        print(f"// ======== {stage} stage ========")
        print(text.text)
    return 0


def info(options):
    """Print what a file, or something shipped, holds."""
    from . import report

    if options.timeout:
        limit_time(options.timeout)
    print(report.describe(options.file, options.json))
    return 0


def compare(options):
    """Print how two pictures differ; 1 when a limit is passed."""
    import json

    from . import difference, files, image

    if options.timeout:
        limit_time(options.timeout)
    a, b = image.read(options.a), image.read(options.b)
    difference.check_alike(a, b, (options.a, options.b))
    result = difference.measure(a[0], b[0], options.threshold)
    limits = {
        "rmse": options.max_rmse,
        "max": options.max_error,
        "share": options.max_share,
        "flip": options.max_flip,
    }
    limits = {name: most for name, most in limits.items() if most is not None}
    result["flip"] = None  # takes seconds: left out where others decide
    if not limits or "flip" in limits:
        with contextlib.suppress(ImportError):  # no build for this Python
            result["flip"] = difference.flip(a[0], b[0], a[1])
        if "flip" in limits and result["flip"] is None:
            raise Mistake("--max-flip: FLIP is not measured here; give another limit")
    over = [name for name, most in limits.items() if result[name] > most]
    if limits and result["not_finite"]:
        over.append("not_finite")
    white = None
    if options.output:
        if image.ending(options.output) != ".png":
            raise Mistake(f"{options.output}: the difference is written as .png")
        check_folder(options.output)
        pixels, white = difference.picture(a[0], b[0])
        size = (a[0].shape[1], a[0].shape[0])
        files.write_whole(options.output, image.png(size, [pixels]))
    if options.json:
        shown = {"picture": options.output, "white": white} if options.output else {}
        print(json.dumps({**result, "over": over, **shown}, indent=2))
    else:
        unit = "radiance" if a[1] else "sRGB, 0 to 1"
        print(f"unit        {unit}")
        for name, value in result.items():
            shown = "not measured" if value is None else f"{value:.6g}"
            print(f"{name:11} {shown}{'  over the limit' if name in over else ''}")
        if options.output:
            print(f"{options.output}  (white: {white:.6g})")
    return 1 if over else 0


def lesson(options):
    """Draw a lesson as slides into a folder and print their paths."""
    from . import deck, scenefile
    from . import lesson as lessons
    from .parts import SCENE
    from .renderer import Renderer

    limit_time(options.timeout or LESSON_TIME)
    one = lessons.load(options.lesson, os.getcwd())
    size = SCENE["size"].read(options.size or "1920x1080", "--size: ")
    folder = options.output or one.name
    if os.path.exists(folder) and not os.path.isdir(folder):
        raise Mistake(f"{folder}: is a file; name a folder for the slides with -o")
    lang = options.lang or scenefile.system_language()
    with Renderer() as renderer:
        paths, broken = deck.write(one, folder, lang, size, renderer, _Progress(folder))
    print(*paths, sep="\n")
    if broken:
        text = f"{broken} pixels have no finite radiance (NaN or infinite); they are magenta"
        print(f"lumiar: {folder}: {text}", file=sys.stderr)
    return 0


def list(options):
    """Print the models, lights, meshes and scenes there are."""
    from . import report
    from .scenefile import system_language

    print(report.everything(options.kind, options.json, system_language()))
    return 0


def _default_output(scene):
    """Return the picture's name where none is given: the scene's, in the current folder."""
    path = os.path.splitext(os.path.basename(scene or "lumiar"))[0] + ".png"
    if scene and os.path.abspath(path) == os.path.abspath(scene):
        raise Mistake(
            f"{path}: would replace the picture that holds the scene; name another with -o"
        )
    return path


def check_folder(path):
    """Raise Mistake unless a file may be written at `path`: its folder is there, and it is none."""
    folder = os.path.dirname(os.path.abspath(path))
    if not os.path.isdir(folder):
        raise Mistake(f"{path}: there is no folder {folder}; make it, or write elsewhere")
    if os.path.isdir(path):
        raise Mistake(f"{path}: is a folder; name a file in it")


class _Progress:
    """Tells on standard error how far a picture is, once it takes more than a second."""

    def __init__(self, path):
        self.path, self.started = path, time.monotonic()
        self.told = self.started

    def __call__(self, share):
        now = time.monotonic()
        if now - self.started > 1.0 and (now - self.told > 0.5 or share == 1.0):
            self.told = now
            left = (now - self.started) * (1.0 - share) / share
            end = "\n" if share == 1.0 or not sys.stderr.isatty() else "\r"
            text = f"lumiar: {self.path}: {share:4.0%}, {left:.0f} s left"
            print(text, end=end, file=sys.stderr, flush=True)
