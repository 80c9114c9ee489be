"""What the commands share: the parser, the types of arguments, the camera, the progress bar.

Knows nothing of single commands. Light to import: heavy modules are imported inside functions.
"""

from __future__ import annotations

import argparse
import contextlib
import math
import re
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NoReturn

from renderer.errors import LucidaError, one_line
from renderer.pixels import Indexing

if TYPE_CHECKING:
    from renderer.camera import Camera
    from renderer.scene.model import Scene, View

DEFAULT_SIZE = (1280, 720)
BACKENDS = ("auto", "egl", "osmesa")
SAMPLES = tuple(k * k for k in range(1, 9))
CAMERA_FIELDS = ("eye", "u", "v", "w", "distance", "viewport", "projection", "near", "far")
CAMERA_OPTIONS = (*CAMERA_FIELDS, "fit", "target", "up", "fov")
TRACEBACK_VARIABLE = "LUCIDA_TRACEBACK"

SCENE_HELP = """\
a scene file (.toml), a model (.obj .ply .stl .off .glb .gltf), or the name
of a built-in scene (`lucida scenes` lists them)"""
VIEW_HELP = "take the camera from this file, not the scene's own"
SIZE_HELP = f"width and height in pixels (default: {DEFAULT_SIZE[0]}x{DEFAULT_SIZE[1]})"
BACKEND_HELP = "the rasterizer's GL platform; auto: EGL, then OSMesa (default: auto)"


class Parser(argparse.ArgumentParser):
    """argparse whose mistakes are one line, and whose texts keep their line breaks."""

    def __init__(self, prog: str) -> None:
        super().__init__(
            prog=prog, formatter_class=argparse.RawTextHelpFormatter, allow_abbrev=False
        )
        self._negative_number_matcher = re.compile(r"-[\d.]")  # also "--eye -1,0,5"

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {one_line(message)}; see '{self.prog} --help'\n")


def size(text: str) -> tuple[int, int]:
    """`1280x720` as (width, height)."""
    from renderer.frame import check_size

    width, cross, height = text.lower().partition("x")
    if not (cross and _is_whole(width) and _is_whole(height)):
        raise argparse.ArgumentTypeError(f"{text!r} is not a size; give e.g. 1280x720")
    try:
        return check_size((int(width), int(height)))
    except LucidaError as error:
        raise argparse.ArgumentTypeError(f"{error.problem}; {error.remedy}") from None


def samples(text: str) -> int:
    """A square number of samples per pixel."""
    if not (_is_whole(text) and int(text) in SAMPLES):
        allowed = ", ".join(map(str, SAMPLES))
        raise argparse.ArgumentTypeError(f"{text!r} is not possible; give one of {allowed}")
    return int(text)


def threads(text: str) -> int:
    """A number of threads, 1 to 1024."""
    if not (_is_whole(text) and 1 <= int(text) <= 1024):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of threads; give 1 to 1024")
    return int(text)


def bounces(text: str) -> int:
    """A number of reflections, 0 to 16."""
    if not (_is_whole(text) and int(text) <= 16):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of reflections; give 0 to 16")
    return int(text)


def exposure_ev(text: str) -> float:
    """An exposure in stops, -32 to 32."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not -32 <= value <= 32:
        raise argparse.ArgumentTypeError(f"{text!r} is not an exposure; give -32 to 32 stops")
    return value


def indexing(text: str) -> Indexing:
    """`0` or `1`: where the counting of pixels begins."""
    if text not in ("0", "1"):
        raise argparse.ArgumentTypeError(f"{text!r} is not 0 or 1")
    return Indexing(int(text))


def numbers(count: int) -> Callable[[str], tuple[float, ...]]:
    """Gives a function that reads `count` numbers with commas between them."""

    def read(text: str) -> tuple[float, ...]:
        try:
            values = tuple(float(part) for part in text.replace(",", " ").split())
        except ValueError:
            values = ()
        if len(values) != count:
            example = "0,0,5" if count == 3 else "-0.5,0.5,-0.5,0.5"
            raise argparse.ArgumentTypeError(
                f"{text!r} is not {count} numbers; give e.g. {example}"
            )
        return values

    return read


def number(text: str) -> float:
    """One number."""
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number; give e.g. 1.5") from None


def add_camera_options(parser: argparse.ArgumentParser) -> None:
    """The camera's fields as options: each replaces the view's own."""
    group = parser.add_argument_group("camera", "each number replaces the scene's or view's own")
    three, four = numbers(3), numbers(4)
    group.add_argument("--eye", type=three, metavar="X,Y,Z", help="the position: --eye 0,0,5")
    group.add_argument(
        "--target",
        type=three,
        metavar="X,Y,Z",
        help="look at this point, with an orthonormal basis",
    )
    group.add_argument(
        "--up", type=three, metavar="X,Y,Z", help="what is upwards then (default: 0,1,0)"
    )
    for name, role in (("u", "right"), ("v", "up"), ("w", "back")):
        group.add_argument(f"--{name}", type=three, metavar="X,Y,Z", help=f"the basis: {role}")
    group.add_argument("--distance", type=number, metavar="D", help="of the viewport, along -w")
    group.add_argument(
        "--fov", type=number, metavar="DEG", help="vertical field of view, in the distance's place"
    )
    group.add_argument(
        "--viewport", type=four, metavar="L,R,B,T", help="left, right, bottom, top, as it stands"
    )
    group.add_argument("--projection", choices=("perspective", "parallel"), help="of the rays")
    group.add_argument("--near", type=number, metavar="N", help="clip plane, in units of w")
    group.add_argument("--far", type=number, metavar="F", help="clip plane, in units of w")
    group.add_argument(
        "--fit",
        action=argparse.BooleanOptionalAction,
        help="widen or heighten the viewport to the image's shape",
    )


def add_size_option(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--size", type=size, default=DEFAULT_SIZE, metavar="WxH", help=SIZE_HELP)


def add_from_option(parser: argparse.ArgumentParser) -> None:
    """--from 0 or 1, as `indexing`: always 0 unless it is given, so that scripts can rely on it."""
    parser.add_argument(
        "--from",
        dest="indexing",
        type=indexing,
        default=Indexing.ARRAY,
        metavar="0|1",
        help="count rows and columns from 0 (arrays) or 1 (lectures) (default: 0)",
    )


def with_camera_options(arguments: argparse.Namespace, view: View) -> View:
    """The view with what the options name: its fields, then where it looks, then how wide. A
    viewport stands as it is, whatever the image's shape, without --fit. Raises LucidaError."""
    given = {name: getattr(arguments, name) for name in CAMERA_OPTIONS}
    given = {name: value for name, value in given.items() if value is not None}
    if not given:
        return view
    _check_beside(given)
    fields = {name: given[name] for name in CAMERA_FIELDS if name in given}
    fit = given.get("fit", view.fit and "viewport" not in given)
    try:
        view = replace(view, camera=replace(view.camera, **fields), fit=fit)
        if "target" in given or "up" in given:
            view = _looking(view, given)
    except LucidaError as error:
        raise LucidaError(f"--{error.field}", error.problem, error.remedy) from None
    return _as_wide(view, given["fov"]) if "fov" in given else view


def _check_beside(given: dict[str, Any]) -> None:
    """Raises LucidaError where two options say the same."""
    for one, others in (("target", "uvw"), ("up", "uvw"), ("fov", ("distance",))):
        for other in others:
            if one in given and other in given:
                raise LucidaError(f"--{other}", f"is given beside --{one}", "give one of the two")


def _looking(view: View, given: dict[str, Any]) -> View:
    """The view towards --target, or, with --up alone, turned about its own direction."""
    from app.cameras.presets import look_at

    camera = view.camera
    ahead = [eye - back for eye, back in zip(camera.eye, camera.w, strict=True)]
    return look_at(view, camera.eye, given.get("target", ahead), given.get("up", (0.0, 1.0, 0.0)))


def _as_wide(view: View, fov_deg: float) -> View:
    """The view with a vertical field of view, by the viewport's distance."""
    from app.cameras.navigation import distance_for

    camera = view.camera
    if camera.is_parallel:
        problem = "is nothing that a parallel projection has"
        raise LucidaError("--fov", problem, "give --viewport, or --projection perspective")
    try:
        camera = replace(camera, distance=distance_for(camera, fov_deg))
    except LucidaError as error:
        raise LucidaError("--fov", error.problem, error.remedy) from None
    return replace(view, camera=camera)


def check_is_scene(source: str) -> None:
    """Raises LucidaError where a lecture's file is given in a scene's place."""
    if not source.lower().endswith(".toml"):
        return
    from app.teach.lecture.reading import is_lecture

    if is_lecture(source):
        raise LucidaError("", "is a lecture, not a scene", f"lucida lecture {source}", source)


def scene_and_camera(arguments: argparse.Namespace) -> tuple[Scene, Camera]:
    """The scene, and the camera of the view file or else of the scene, with the camera's options,
    for the image's size."""
    from renderer.scene import load_scene, load_view

    # The quick mistakes first.
    own_view = load_view(arguments.view) if arguments.view is not None else None
    if own_view is not None:
        own_view = with_camera_options(arguments, own_view)
    check_is_scene(arguments.scene)
    scene = load_scene(arguments.scene)
    view = own_view or with_camera_options(arguments, scene.view)
    return scene, view.for_size(arguments.size)


def say_nothing_is_hit(scene: Scene, camera: Camera) -> None:
    """One line on standard error: why an image shows nothing, and how to aim at the scene."""
    from renderer.nothing_hit import middle_of, why_nothing_is_hit
    from renderer.scene import flatten

    flat = flatten(scene)
    aim = ",".join(f"{part:.4g}" for part in middle_of(flat))
    remedy = f"; --target={aim} looks at the middle of the scene" if scene.objects else ""
    why = why_nothing_is_hit(flat, camera)
    print(f"lucida: nothing is hit: {why}{remedy}", file=sys.stderr)


@contextlib.contextmanager
def progress_bar(label: str) -> Iterator[Callable[[float], None]]:
    """A function that takes fractions 0 to 1 and draws a bar on a terminal, from 1 s on. On a
    terminal or not, a line says once that the ray tracer must be compiled, if it must."""
    from tqdm import tqdm

    from renderer import compile_note

    layout = "{desc} {percentage:3.0f} % |{bar}| {elapsed}, {remaining} left"
    hidden = not sys.stderr.isatty()
    with tqdm(
        total=1.0, desc=label, bar_format=layout, delay=1, leave=False, disable=hidden
    ) as bar:
        told = compile_note.note()  # of what was compiled before

        def report(fraction: float) -> None:
            nonlocal told
            if compile_note.note() != told:
                told = compile_note.note()
                tqdm.write(f"lucida: {told}", file=sys.stderr)
            bar.update(fraction - bar.n)

        yield report


def _is_whole(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) < 10
