"""The parts that commands share: the parser, the types of arguments, the camera, the progress bar.

It is quick to import: heavy modules are imported inside functions.
"""

from __future__ import annotations

import argparse
import contextlib
import re
import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NoReturn

from lucida.app.cameras.options import with_camera_options
from lucida.renderer.system.errors import LucidaError, one_line, visible

from .given_camera import say_changes, viewed

if TYPE_CHECKING:
    from tqdm import tqdm

    from lucida.renderer.camera.camera import Camera
    from lucida.renderer.files.cameras import PosedCamera
    from lucida.renderer.scene.model import Scene, View

DEFAULT_SIZE = (1280, 720)
BACKENDS = ("auto", "egl", "osmesa")
BAR_DELAY_S = 1.0
SAMPLES = tuple(k * k for k in range(1, 9))
TRACEBACK_VARIABLE = "LUCIDA_TRACEBACK"

SCENE_HELP = """\
a scene file (.toml), a model (.obj .ply .stl .off .glb .gltf), or the name
of a built-in scene (`lucida scene` lists them)"""
SIZE_HELP = f"""\
width and height in pixels (default: the size that the file of --view
states for its image; otherwise {DEFAULT_SIZE[0]}x{DEFAULT_SIZE[1]})"""
BACKEND_HELP = "the rasterizer's GL platform; auto: EGL, then OSMesa (default: auto)"


class Parser(argparse.ArgumentParser):
    """An argparse parser that reports mistakes in one line, and keeps line breaks in its texts."""

    def __init__(self, prog: str) -> None:
        super().__init__(
            prog=prog, formatter_class=argparse.RawTextHelpFormatter, allow_abbrev=False
        )
        self._negative_number_matcher = re.compile(r"-[\d.]")  # also "--eye -1,0,5"

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {one_line(message)}; see '{self.prog} --help'\n")


def say(*lines: str) -> None:
    """Print lines of text that may contain a user's names, with control characters escaped."""
    print(visible("\n".join(lines)))


def size(text: str, rows: tuple[int, int] | None = None) -> tuple[int, int]:
    """Parse `1280x720` as (width, height). rows: as in check_size()."""
    from lucida.renderer.images.frame import check_size

    width, cross, height = text.lower().partition("x")
    if not (cross and _is_whole(width) and _is_whole(height)):
        raise argparse.ArgumentTypeError(f"{text!r} is not a size; give e.g. 1280x720")
    try:
        return check_size((int(width), int(height)), rows)
    except LucidaError as error:
        raise argparse.ArgumentTypeError(f"{error.problem}; {error.remedy}") from None


def large_size(text: str) -> tuple[int, int]:
    """Parse the size of an image that is drawn in parts."""
    return size(text, (0, 1))


def samples(text: str) -> int:
    """Parse a square number of samples per pixel."""
    if not (_is_whole(text) and int(text) in SAMPLES):
        allowed = ", ".join(map(str, SAMPLES))
        raise argparse.ArgumentTypeError(f"{text!r} is not possible; give one of {allowed}")
    return int(text)


def whole(least: int, most: int, complaint: str) -> Callable[[str], int]:
    """Return a parser of whole numbers from `least` to `most`. complaint: for other numbers."""

    def parse(text: str) -> int:
        if not (_is_whole(text) and least <= int(text) <= most):
            raise argparse.ArgumentTypeError(f"{text!r} {complaint}")
        return int(text)

    return parse


def real(is_allowed: Callable[[float], bool], complaint: str) -> Callable[[str], float]:
    """Return a parser of the numbers that are allowed. complaint: for other numbers."""

    def parse(text: str) -> float:
        with contextlib.suppress(ValueError):
            if is_allowed(value := float(text)):
                return value
        raise argparse.ArgumentTypeError(f"{text!r} {complaint}")

    return parse


def add_size_option(
    parser: argparse.ArgumentParser, parse: Callable[[str], tuple[int, int]] = size
) -> None:
    """Add --size. It is None until the camera is known; see own_camera()."""
    parser.add_argument("--size", type=parse, metavar="WxH", help=SIZE_HELP)


def add_drawing_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for drawing and displaying an image."""
    parser.add_argument(
        "--samples",
        type=samples,
        default=1,
        metavar="N",
        help="colour samples per pixel: 1, 4, 9, 16, 25, 36, 49 or 64 (default: 1)",
    )
    parser.add_argument(
        "--exposure",
        type=real(lambda stops: -32 <= stops <= 32, "is not an exposure; give -32 to 32 stops"),
        default=0.0,
        metavar="EV",
        help="brighten a picture's colours by 2^EV (default: 0)",
    )
    parser.add_argument("--backend", choices=BACKENDS, default="auto", help=BACKEND_HELP)
    parser.add_argument(
        "--shadows", action="store_true", help="with --renderer ray: objects shade one another"
    )
    parser.add_argument(
        "--mirrors",
        type=whole(0, 16, "is not a number of reflections; give 0 to 16"),
        default=0,
        metavar="N",
        help="with --renderer ray: specular surfaces reflect, N times at most (default: 0)",
    )


def check_is_scene(source: str) -> None:
    """Raise LucidaError if the source is a lecture's file instead of a scene."""
    if not source.lower().endswith(".toml"):
        return
    from lucida.app.lecture.reading import is_lecture

    if is_lecture(source):
        raise LucidaError("", "is a lecture, not a scene", f"lucida lecture {source}", source)


def own_camera(arguments: argparse.Namespace) -> PosedCamera | None:
    """Return the camera of --view; None without it. Raises LucidaError.

    Set arguments.size to the image's size: the user's, or else this camera's own.
    """
    posed = viewed(arguments)
    if arguments.size is None:
        arguments.size = (posed and posed.size) or DEFAULT_SIZE
    return posed


def scene_and_camera(
    arguments: argparse.Namespace, posed: PosedCamera | None = None
) -> tuple[Scene, Camera]:
    """Return the scene, and the camera of scene_and_view() for the image's size."""
    scene, view = scene_and_view(arguments, posed)
    return scene, view.for_size(arguments.size)


def scene_and_view(
    arguments: argparse.Namespace, posed: PosedCamera | None = None
) -> tuple[Scene, View]:
    """Return the scene, and the view of --view or else of the scene, with the camera's options.

    Set arguments.size to the image's size.
    posed: the result of own_camera().
    """
    from lucida.renderer.files import load_scene
    from lucida.renderer.scene.model import View

    # Check for quick mistakes first.
    posed = posed or own_camera(arguments)
    view = None
    if posed is not None:
        view = with_camera_options(arguments, View(posed.camera, posed.fit))
    check_is_scene(arguments.scene)
    scene = load_scene(arguments.scene)
    for note in scene.notes:
        print(f"lucida: {one_line(note)}", file=sys.stderr)
    if posed is not None:
        follows = arguments.viewport is not None or arguments.fit
        say_changes(posed, None if follows else arguments.size)
    return scene, view or with_camera_options(arguments, scene.view)


def say_nothing_is_hit(scene: Scene, camera: Camera) -> None:
    """Explain in one line on standard error why an image is empty, and how to aim at the scene."""
    from lucida.renderer.compare.why_black import middle_of, why_nothing_is_hit
    from lucida.renderer.scene import flatten

    flat = flatten(scene)
    aim = ",".join(f"{part:.4g}" for part in middle_of(flat))
    remedy = f"; --target={aim} looks at the middle of the scene" if scene.objects else ""
    why = why_nothing_is_hit(flat, camera).text
    print(f"lucida: nothing is hit: {why}{remedy}", file=sys.stderr)


@contextlib.contextmanager
def progress_bar(label: str) -> Iterator[Callable[[float], None]]:
    """Yield a function that takes fractions 0 to 1 and draws a bar on a terminal, after 1 s.

    If the ray tracer must be compiled, report that once in a line, also without a terminal.
    """
    from lucida.renderer.system import compile_note

    told = compile_note.note()  # about earlier compilation
    bar = _bar(label) if sys.stderr.isatty() else None

    def report(fraction: float) -> None:
        nonlocal told
        if compile_note.note() != told:
            told = compile_note.note()
            (bar.write if bar is not None else print)(f"lucida: {told}", file=sys.stderr)
        if bar is not None:
            bar.update(fraction - bar.n)

    with bar or contextlib.nullcontext():
        yield report


def _bar(label: str) -> tqdm[NoReturn]:
    from tqdm import tqdm

    layout = "{desc} {percentage:3.0f} % |{bar}| {elapsed}, {remaining} left"
    return tqdm(total=1.0, desc=label, bar_format=layout, leave=False, delay=BAR_DELAY_S)


def _is_whole(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) < 19
