"""argv → one of the verbs, in a supervised child; every mistake one line, exit codes as in HELP."""

import os
import sys

VERBS = (
    *("view", "capture", "probe", "info", "source", "compare"),
    *("measure", "formfactor", "audit", "bench", "lesson", "list"),
)
HELP = """usage: lumiar VERB … (lumiar VERB --help tells more)

  view [SCENE]     open a window: turn, light and edit a scene, watch your shader change
  capture [SCENE]  draw a scene to a picture: .png, or .hdr and .npy for linear radiance
  probe [SCENE]    the light at one point of its picture: radiance, irradiance, angles, shares
  info FILE        what a mesh, a model, a light, a scene or a Lumiar picture holds
  source [SCENE]   the GLSL of a scene, exactly as compiled
  compare A B      how two pictures differ; exit code 1 beyond a limit you give
  measure MODEL …  scatter, lobes and albedo of models at any angles: .csv, .npz or a picture
  formfactor       solid angles and form factors of polygons: exact, by Nusselt, by Monte Carlo
  audit [MODEL …]  the data sheet: claims tested, hard cases, float32 error, cost; 1 if broken
  bench [STUDY …]  speed against error of what Lumiar and others do; a report in a folder
  lesson NAME      a lesson as slides, .png in a folder; a question before each answer
  list             the models, lights, meshes, materials, scenes and lessons there are

SCENE is a shipped scene, a .toml file, a .png that Lumiar made, a mesh or a .glsl model.
exit codes: 0 done; 1 the renderer or the disk failed, compare found too much, bench --compare
something worse, or audit a broken claim; 2 a mistake in what was given; 3 broken pixels under
--strict; 130 and 143 interrupted and terminated"""


def main():
    """Run the command line in a supervised child, and end this process with its exit code."""
    import gc
    import signal

    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while all is still being imported
    from .supervise import supervised

    while (spare := os.open(os.devnull, os.O_RDWR)) < 3:
        pass  # in place of a closed stream, whose number a picture would get, and what drivers say
    os.close(spare)
    gc.disable()  # a short life makes little garbage, and looking for it takes milliseconds
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:  # closed by whoever started us
            stream.reconfigure(errors="backslashreplace")  # whatever the terminal can show
    code = supervised(lambda: run(sys.argv[1:]))
    os._exit(code)  # leaves out the interpreter's tidying-up


def run(argv):
    """Run a command line in this process and return its exit code."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # NumPy then starts sooner; ours is small
    from .errors import Mistake, one_line
    from .files import shortened

    try:
        return _dispatch(argv)
    except Mistake as mistake:
        print(f"lumiar: {one_line(shortened(str(mistake)))}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        raise  # not our disk: whoever read our output has gone, and supervise ends quietly
    except OSError as error:
        name = f" {error.filename}" if error.filename else ""
        print(f"lumiar: cannot write{name}: {one_line(error.strerror or error)}", file=sys.stderr)
        return 1
    except MemoryError:
        print("lumiar: not enough memory; draw a smaller picture or mesh", file=sys.stderr)
        return 1
    except Exception as error:
        return _own_fault(error)


def _dispatch(argv):
    from .errors import Mistake, nearest

    if not argv or argv[0] in ("-h", "--help", "help"):
        print(HELP)
        return 0
    if argv[0] == "--version":
        from . import __version__

        print(f"lumiar {__version__}")
        return 0
    if argv[0] not in VERBS:
        raise Mistake(f"no verb '{argv[0]}'; {nearest(argv[0], VERBS)}")
    from . import arguments

    if argv[0] in ("measure", "formfactor", "audit", "bench"):
        from . import lab as verbs
    else:
        from . import verbs
    return getattr(verbs, argv[0])(arguments.parse(argv[0], argv[1:]))


def _own_fault(error):
    """Tell of a mistake of ours, in one line with the place where it showed."""
    import traceback

    from .errors import one_line

    frame = traceback.extract_tb(error.__traceback__)[-1]
    place = f"{os.path.basename(frame.filename)}:{frame.lineno}"
    said = one_line(f"{type(error).__name__}: {error}")
    print(f"lumiar: a fault of Lumiar's own, at {place}: {said}; please report it", file=sys.stderr)
    return 1
