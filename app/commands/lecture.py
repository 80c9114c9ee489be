"""`lucida lecture [FILE]`: a guided lecture, or a picture of each of its steps."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from app.commands import arguments as common
from app.commands.view import window_size
from renderer.errors import LucidaError, one_line

if TYPE_CHECKING:
    from app.lecture.model import Lecture

NAME = "lecture"
EXPORT_SIZE = (1920, 1080)

DESCRIPTION = """\
Give a guided lecture: steps of text, each with its own scene, camera and views.
Without FILE: the built-in lecture, "Images, rays and cameras".
It starts in presentation mode, for a hall: capitals are 1/50 of the window's height."""

EPILOG = """\
in the lecture:
  Page Down, Right    uncover; next step    Page Up, Left       take back; previous step
  Shift+Page Down     uncover all of it
  Backspace           back to the step's own scene, camera and views
  Ctrl+Z              takes back changes, then the way to the step
  F9                  presentation mode off, and on again; the type stays as large
A file is read again whenever it is saved. docs/lectures.md describes the format.

examples:
  lucida lecture
  lucida lecture my-lecture.toml
  lucida lecture my-lecture.toml --check
  lucida lecture --export slides --size 1280x720

exit status: 0 done, 2 a mistake (one line says file, line and field), 130 interrupted"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("file", nargs="?", metavar="FILE", help="a lecture file (.toml)")
    either = parser.add_mutually_exclusive_group()
    either.add_argument(
        "--check",
        action="store_true",
        help="only read the file, scenes and formulas, try hiding answers; not with --export",
    )
    either.add_argument(
        "--export", metavar="DIR", help="write a PNG of each step into DIR; needs no display"
    )
    parser.add_argument(
        "--outside",
        action="store_true",
        help="agree that the lecture reads files outside of its folder",
    )
    parser.add_argument(
        "--size",
        type=window_size,
        metavar="WxH",
        help="the window's size in pixels "
        f"(with --export: default {EXPORT_SIZE[0]}x{EXPORT_SIZE[1]})",
    )


def run(arguments: argparse.Namespace) -> int:
    from app.lecture.reading import BUILTIN, load_lecture
    from renderer.scene.outside import OutsideError

    path = Path(arguments.file) if arguments.file is not None else BUILTIN
    try:
        lecture = load_lecture(path, None if arguments.check or arguments.outside else frozenset())
    except OutsideError as error:
        if arguments.export is not None:
            raise LucidaError("", error.problem, "add --outside to agree", error.source) from None
        from app.window.lecturing import ask_lecture

        return ask_lecture(path, error, arguments.size)
    if arguments.check:
        return _check(lecture, path, arguments.file or lecture.title)
    if arguments.export is not None:
        if not arguments.export.strip():  # from an unset variable, for instance
            raise LucidaError("--export", "names no folder", "give one, or . for this one")
        from app.window.lecturing import (
            export_lecture,  # after the quick checks, because it loads the window
        )

        folder = Path(arguments.export)
        size = arguments.size or EXPORT_SIZE
        with common.progress_bar("export") as progress:
            written = export_lecture(lecture, path, folder, size, progress)
        common.say(f"{arguments.export}: {len(written)} pictures, {size[0]}x{size[1]}")
        return 0
    from app.window.lecturing import run_lecture

    return run_lecture(path, lecture, arguments.size)


def _check(lecture: Lecture, path: Path, name: str) -> int:
    """Print a summary of the lecture.

    Raises LucidaError for a formula that cannot be typeset, or an answer that is wrong.
    """
    from app.lecture.hidden_pixels import first_wrong_answer
    from app.lecture.typesetting import first_mistake
    from app.widgets import formula
    from renderer.scene.places import Places, located

    mistake = first_mistake(lecture.formulas)
    if mistake is not None:
        raise mistake
    wrong = first_wrong_answer(lecture)
    if wrong is not None:
        raise located(wrong, Places(path.read_text("utf-8-sig")), str(path))
    exercises = sum(step.exercise is not None for step in lecture.steps)
    unseen = "" if formula.available() else "; formulas not checked: no locale en_US.UTF-8 here"
    told = common.counted((len(lecture.steps), "step"), (exercises, "exercise"))
    common.say(f"{name}: {told}{unseen}")
    for file in lecture.outside:
        print(f"  reads {one_line(str(file))}, outside of its folder: the window asks first")
    return 0
