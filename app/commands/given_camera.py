"""The camera that a command is given, by --view or as its INPUT: a file of any format, or one of
the cameras in it. What was left out of it is said on standard error.

Knows nothing of formats (renderer/camera_formats/). Light to import.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from renderer.errors import LucidaError, one_line

if TYPE_CHECKING:
    from collections.abc import Sequence

    from renderer.camera_formats import PosedCamera
    from renderer.camera_formats.given import Given

    Size = tuple[int, int]

STANDARD_INPUT = "-"

VIEW_HELP = """\
take the camera from this file: a view file (.toml), or any other
of `lucida camera`; of several: transforms.json#12, sparse/0#IMG_7.jpg"""
IGNORE_HELP = "take a camera with a lens's distortion as a pinhole;\nsay what that changes"


def add_view_option(parser: argparse.ArgumentParser, help: str = VIEW_HELP) -> None:
    """--view, and what else says how its file is taken."""
    parser.add_argument("--view", metavar="FILE", help=help)
    add_distortion_option(parser)


def add_distortion_option(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--ignore-distortion", action="store_true", help=IGNORE_HELP)


def viewed(arguments: argparse.Namespace) -> PosedCamera | None:
    """Return the one camera of --view; None without it. Where its file does not say for which
    size it is, a line says which one is taken. Raises LucidaError."""
    if arguments.view is None:
        return None
    from renderer.camera_formats import Options, read_chosen, without_choice

    file, which = without_choice(arguments.view)
    options = Options(ignore_distortion=arguments.ignore_distortion)
    found, posed = read_chosen(source_of(file), which, options=options)
    if found.sizing:
        print(f"lucida: {one_line(file)}: {one_line(found.sizing)}", file=sys.stderr)
    return posed


def source_of(file: str) -> Given:
    """A file, a folder, or what standard input brings. Raises LucidaError."""
    from renderer.camera_formats.given import LARGEST_BYTES, Given, given
    from renderer.scene.reading import check_bytes

    if file != STANDARD_INPUT:
        return given(file)
    name = "standard input"
    data = sys.stdin.buffer.read(LARGEST_BYTES + 1)
    check_bytes(len(data), LARGEST_BYTES, name)
    if not data:
        raise LucidaError("", "is empty", "give a camera's text", name)
    return Given(name, data)


def check_lens(posed: PosedCamera, source: str, arguments: argparse.Namespace) -> None:
    """Raises LucidaError, naming the source: a lens is never dropped in silence."""
    from renderer.camera_formats import Options
    from renderer.camera_formats.formats import check_distortion

    try:
        check_distortion([posed], Options(ignore_distortion=arguments.ignore_distortion))
    except LucidaError as error:
        raise error.in_file(source) from None


def say_changes(cameras: Sequence[PosedCamera], size: Size | None = None) -> None:
    """A line each on standard error: a lens that is left out, and what that moves; and an image of
    another shape than the camera's own, where the viewport stands. size: of that image."""
    from app.cameras.described import ignored_text

    if told := ignored_text(cameras):
        print(f"lucida: {one_line(told)}", file=sys.stderr)
    own = cameras[0].size
    if size is None or own is None or abs(size[0] - size[1] * own[0] / own[1]) <= 1:
        return
    shapes = f"{size[0]}x{size[1]} has another shape than the camera's own {own[0]}x{own[1]}"
    print(f"lucida: --size: {shapes}: its pixels are not as wide as high", file=sys.stderr)
