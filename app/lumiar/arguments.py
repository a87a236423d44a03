"""The options of each verb, argv → Namespace."""

import argparse
import re

from .errors import Mistake, nearest

argparse._ = str  # its words stay English, as ours are; looking for translations takes 2 ms


class _Help(argparse.HelpFormatter):
    """Help 100 columns wide; asking the terminal would import shutil and take 4 ms for nothing."""

    def __init__(self, prog):
        super().__init__(prog, max_help_position=34, width=100)


class _Parser(argparse.ArgumentParser):
    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        self._negative_number_matcher = re.compile(r"-\.?\d")  # so that -90:90:1 is no option

    def error(self, message):
        found = re.match(r"unrecognized arguments: (--\S+)", message)
        if found:
            options = [name for name in self._option_string_actions if name.startswith("--")]
            message = f"no option {found.group(1)}; {nearest(found.group(1), options)}"
        raise Mistake(f"{self.prog.split()[-1]}: {message}; `{self.prog} --help` tells more")


def parse(verb, argv):
    """Return the options of a verb as a Namespace; raise Mistake for what they cannot be."""
    about, fill = _VERBS[verb]
    parser = _Parser(
        prog=f"lumiar {verb}", allow_abbrev=False, description=about, formatter_class=_Help
    )
    fill(parser)
    return parser.parse_args(argv)


def _scene_options(parser):
    parser.add_argument(
        "scene", nargs="?", metavar="SCENE", help="default: a sphere under one light"
    )
    parser.add_argument("--model", metavar="NAME|FILE.glsl", help="model of all objects")
    parser.add_argument("--material", metavar="NAME", help="of all objects: gold, glass …")
    parser.add_argument("--mesh", metavar="NAME|FILE", help="mesh of all objects: torus:minor=0.2")
    parser.add_argument("--shading", metavar="RATE", help="flat, gouraud or phong")
    parser.add_argument(
        "--light",
        action="append",
        metavar="KIND[:KEY=VALUE…]",
        help="replaces the lights of the scene; again for more: point:position=2,3,4:intensity=80",
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="any value of the scene: shininess=80, camera.fov=20, object.2.kd=1,0,0",
    )


def _timeout(parser):
    text = "end after so long (default: 120)"
    parser.add_argument("--timeout", type=_seconds, metavar="SECONDS", help=text)


def _seconds(text):
    return _number(text, "a number of seconds above 0", lambda x: 0.0 < x <= 1e6)


def _limit(text):
    return _number(text, "a number, 0 or more", lambda x: x >= 0.0)


def _number(text, allowed, good):
    try:
        if good(float(text)):
            return float(text)
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"'{text}' is not {allowed}")


def _view(parser):
    _scene_options(parser)
    text = "the scene of the last window, as it was left"
    parser.add_argument("--restore", action="store_true", help=text)
    parser.add_argument("--lang", choices=("en", "pt"), help="language of the window")


def _capture(parser):
    _scene_options(parser)
    _timeout(parser)
    parser.add_argument("--size", metavar="WxH", help="pixels, as 1024x768")
    parser.add_argument("--samples", metavar="N", help="per pixel: 1, 4, 9, 16 …")
    parser.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="KEY=A,B,C",
        help="one picture for each value, on a captioned sheet; again for a grid",
    )
    text = (
        "in false colour: luminance, irradiance, illuminance, albedo, normal, or error:KEY=VALUE…"
    )
    parser.add_argument("--view", metavar="VIEW", help=text)
    parser.add_argument("-o", "--output", metavar="FILE", help=".png, .hdr or .npy")
    parser.add_argument("--strict", action="store_true", help="exit code 3 for broken pixels")
    parser.add_argument("--lang", choices=("en", "pt"), help="language of captions")


def _probe(parser):
    _scene_options(parser)
    _timeout(parser)
    parser.add_argument("--size", metavar="WxH", help="of the picture, as 1024x768")
    text = "pixel from the top left one, 0,0; or shares of width and height, as 0.5,0.5"
    parser.add_argument("--at", required=True, metavar="X,Y", help=text)
    parser.add_argument("--json", action="store_true", help="for programs")


def _source(parser):
    _scene_options(parser)
    _timeout(parser)
    parser.add_argument("--object", type=int, default=1, metavar="N", help="which object, from 1")


def _info(parser):
    parser.add_argument("file", metavar="FILE", help="or the name of something shipped")
    parser.add_argument("--json", action="store_true", help="for programs")
    _timeout(parser)


def _compare(parser):
    parser.add_argument("a", metavar="A", help=".png, .jpg, .hdr or .npy: the reference")
    parser.add_argument("b", metavar="B", help="a picture of the same kind and size")
    parser.add_argument("-o", "--output", metavar="FILE.png", help="picture of the difference")
    parser.add_argument("--threshold", type=_limit, default=0.0, help="of a pixel that differs")
    for name, text in (
        ("rmse", "root mean square difference"),
        ("error", "largest difference of a channel"),
        ("share", "share of pixels over the threshold"),
        ("flip", "mean FLIP error"),
    ):
        parser.add_argument(f"--max-{name}", type=_limit, metavar="X", help=f"highest {text}")
    parser.add_argument("--json", action="store_true", help="for programs")
    _timeout(parser)


def _measure(parser):
    parser.add_argument(
        "models",
        nargs="+",
        metavar="MODEL[:KEY=VALUE…]",
        help="name or .glsl file: ward:alpha_x=0.3",
    )
    parser.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", help="in all models that have it"
    )
    text = "its values in all models: gold, glass …"
    parser.add_argument("--material", metavar="NAME", help=text)
    text = "of the light from the normal (default: 0,30,60,80)"
    parser.add_argument("--light", type=_angles, metavar="DEG[,DEG…]", help=text)
    text = "of the light about the normal, from the tangent"
    parser.add_argument("--azimuth", type=_between(-360.0, 360.0), metavar="DEG", help=text)
    scan = parser.add_mutually_exclusive_group()
    text = "scan in the plane of incidence, negative on the light's side (default: -90:90:1)"
    scan.add_argument("--detector", type=_steps, metavar="LOW:HIGH:STEP", help=text)
    text = "scan all directions instead, at these steps"
    scan.add_argument("--hemisphere", type=_between(0.01, 90.0), metavar="DEG", help=text)
    text = "half-angle of the detector's cone, over which the mean is taken"
    parser.add_argument("--aperture", type=_between(0.0, 90.0), metavar="DEG", help=text)
    text = "relative deviation of the detector's noise: 0.02"
    parser.add_argument("--noise", type=_between(0.0, 10.0), metavar="SIGMA", help=text)
    parser.add_argument("--seed", type=_seed, metavar="N", help="of the noise (default: 0)")
    text = ".csv or .npz; without it and --plot, CSV is printed"
    parser.add_argument("-o", "--out", "--output", metavar="FILE", help=text)
    text = "lobes and albedo: .png, .svg or .pdf"
    parser.add_argument("--plot", metavar="FILE", help=text)
    text = "a measurement to draw as points; again for more"
    parser.add_argument("--overlay", action="append", default=[], metavar="FILE", help=text)
    text = "exactly the pairs L, V (n,3) in it, to --out FILE.npz: scatter, surround"
    parser.add_argument("--directions", metavar="FILE.npz", help=text)
    parser.add_argument("--lang", choices=("en", "pt"), help="language of the picture")
    _timeout(parser)


def _formfactor(parser):
    text = "a point, 0,0,0, or a polygon's corners, '0,0,0 1,0,0 1,1,0'"
    parser.add_argument("--from", dest="here", required=True, metavar="X,Y,Z…", help=text)
    text = "of the patch at the point (default: 0,0,1)"
    parser.add_argument("--normal", metavar="X,Y,Z", help=text)
    text = "the polygon's corners, in order, in m"
    parser.add_argument("--to", dest="there", required=True, metavar="X,Y,Z…", help=text)
    text = "of Monte Carlo (default: 1000000)"
    parser.add_argument("--samples", type=_count, default=10**6, metavar="N", help=text)
    parser.add_argument("--seed", type=_seed, default=0, metavar="N", help="of it (default: 0)")
    parser.add_argument("--json", action="store_true", help="for programs")
    text = "a drawing of Nusselt's projection: .png, .svg or .pdf"
    parser.add_argument("-o", "--output", metavar="FILE", help=text)
    parser.add_argument("--lang", choices=("en", "pt"), help="language of the drawing")
    _timeout(parser)


def _audit(parser):
    text = "name, .glsl file or folder of them (default: all that come with Lumiar)"
    parser.add_argument("models", nargs="*", metavar="MODEL", help=text)
    parser.add_argument("--json", action="store_true", help="for programs")
    parser.add_argument("-o", "--output", metavar="FILE.png", help="one model's sheet as a page")
    parser.add_argument("--lang", choices=("en", "pt"), help="language of the page")
    _timeout(parser)


def _bench(parser):
    text = "fresnel, lobes … (default: all)"
    parser.add_argument("studies", nargs="*", metavar="STUDY", help=text)
    text = "for report.html, .json and pictures; goes on with what is missing (default: bench)"
    parser.add_argument("-o", "--output", default="bench", metavar="FOLDER", help=text)
    parser.add_argument("--quick", action="store_true", help="coarser, in a tenth of the time")
    text = "tell what changed beyond noise since an older report; exit 1 if worse"
    parser.add_argument("--compare", metavar="OLD.json", help=text)
    parser.add_argument("--lang", choices=("en", "pt"), help="language of the tables")
    _timeout(parser)


def _between(low, high):
    return lambda text: _number(text, f"a number, {low:g} to {high:g}", lambda x: low <= x <= high)


def _seed(text):
    if text.isdecimal() and text.isascii() and len(text) <= 18:
        return int(text)
    raise argparse.ArgumentTypeError(f"'{text}' is not a whole number, 0 or more")


def _count(text):
    if text.isdecimal() and text.isascii() and len(text) < 9 and 1 < int(text) <= 10**7:
        return int(text)
    raise argparse.ArgumentTypeError(f"'{text}' is not a whole number, 2 to 10000000")


def _angles(text):
    angle = _between(0.0, 180.0)
    return tuple(dict.fromkeys(angle(part) for part in text.split(",")))


def _steps(text):
    try:
        low, high, step = map(float, text.split(":"))
        if -180.0 <= low <= high <= 180.0 and 1e-4 <= step <= 360.0:
            return low, high, step
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"'{text}' is not LOW:HIGH:STEP in degrees, as in -90:90:1")


def _lesson(parser):
    parser.add_argument("lesson", metavar="LESSON", help="`lumiar list lessons`, or a .toml file")
    text = "for its slides, .png each (default: the lesson's name)"
    parser.add_argument("-o", "--output", metavar="FOLDER", help=text)
    parser.add_argument("--lang", choices=("en", "pt"), help="language of the slides")
    parser.add_argument("--size", metavar="WxH", help="pixels (default: 1920x1080)")
    _timeout(parser)


def _list(parser):
    kinds = ("models", "lights", "meshes", "materials", "scenes", "lessons")
    parser.add_argument("kind", nargs="?", choices=kinds)
    parser.add_argument("--json", action="store_true", help="with every parameter, for programs")


_VERBS = {
    "view": ("Open a window, in which a scene is turned, lit and edited.", _view),
    "capture": ("Draw a scene to a picture, or to a captioned sheet of pictures.", _capture),
    "probe": ("Tell the light at one point of a picture, in watts and in lumens.", _probe),
    "info": ("Tell what a mesh, a model, a light, a scene or a Lumiar picture holds.", _info),
    "source": ("Print the GLSL of a scene, each stage exactly as compiled.", _source),
    "compare": ("Measure how picture B differs from A; exit 1 beyond a limit.", _compare),
    "audit": ("Test what models claim, and how exact and fast they are; exit 1 if broken.", _audit),
    "bench": ("Measure speed against error, study by study.", _bench),
    "measure": ("Measure models at any angles, as a gonioreflectometer would.", _measure),
    "formfactor": ("Tell solid angles and form factors from a patch or a polygon.", _formfactor),
    "lesson": ("Draw a lesson as slides, a question before each answer.", _lesson),
    "list": ("List what there is to choose from.", _list),
}
