"""The camera that a command receives by --view or as its INPUT: a file of any format, or one of the
cameras in it. Anything ignored in the file is reported on standard error.

This module is quick to import.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import one_line

if TYPE_CHECKING:
    from lucida.renderer.files.cameras import CameraSet, PosedCamera

    Size = tuple[int, int]

VIEW_HELP = """\
take the camera from this file: a view file (.toml), or any other
of `lucida camera`; of several: transforms.json#12, sparse/0#IMG_7.jpg"""


def add_view_option(parser: argparse.ArgumentParser) -> None:
    """Add --view."""
    parser.add_argument("--view", metavar="FILE", help=VIEW_HELP)


def viewed(arguments: argparse.Namespace) -> PosedCamera | None:
    """Return the one camera of --view; None without it. Raises LucidaError.

    Report, in a line each, values that the file does not state or Lucida does not use.
    """
    if arguments.view is None:
        return None
    from lucida.renderer.files.cameras import read_chosen, without_choice
    from lucida.renderer.files.cameras.given import given

    file, which = without_choice(arguments.view)
    found, posed = read_chosen(given(file), which)
    say_notes(found, file)
    return posed


def say_notes(found: CameraSet, file: str) -> None:
    """Report on standard error values that a file does not state, and those that are not used."""
    for note in found.notes:
        print(f"lucida: {one_line(file)}: {one_line(note)}", file=sys.stderr)


def say_changes(posed: PosedCamera, size: Size | None) -> None:
    """Report on standard error if an image's aspect ratio is not the camera's own. size: the
    image's size.
    """
    own = posed.size
    if size is None or own is None or abs(size[0] - size[1] * own[0] / own[1]) <= 1:
        return
    shapes = f"{size[0]}x{size[1]} has another shape than the camera's own {own[0]}x{own[1]}"
    print(f"lucida: --size: {shapes}: its pixels are not as wide as high", file=sys.stderr)
