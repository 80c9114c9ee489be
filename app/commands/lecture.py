"""`lucida lecture [FILE]`: a guided lecture, or its steps as pictures, a page or a PDF."""

from __future__ import annotations

import argparse
import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import LucidaError, counted, one_line

from . import arguments as common
from .view import window_size

if TYPE_CHECKING:
    from lucida.app.lecture.model import Lecture

NAME = "lecture"
EXPORT_SIZE = (1920, 1080)
STILLS_SIZE = (1600, 900)
PRINT_SIZE = (1600, 1040)  # the pictures fill a landscape page
PAGES = (".html", ".htm", ".pdf")

DESCRIPTION = """\
Give a guided lecture: steps of text, each with its own scene, camera and views.
Without FILE: the built-in lecture, "Images, rays and cameras". A second one, "Cameras beyond
the formula", is called cameras-beyond-the-formula.
It starts in presentation mode: capitals are 1/50 of the window's height."""

EPILOG = """\
in the lecture:
  Page Down, Right    next, or the end of a movement
  Page Up, Left       back
  R                   play the current build again
  End                 continue at the step where it was left last time, until you change steps
  Backspace           back to the step's own scene, camera and views
  Ctrl+Z              undo changes, then the move to the step
  F9                  presentation mode off and on; text keeps its size
A file is read again whenever it is saved. docs/lectures.md describes the format.

examples:
  lucida lecture
  lucida lecture cameras-beyond-the-formula
  lucida lecture my-lecture.toml
  lucida lecture my-lecture.toml --step 3.2
  lucida lecture my-lecture.toml --check
  lucida lecture --export slides --size 1280x720
  lucida lecture --export lecture.html
  lucida lecture --export handout.pdf --no-answers
  lucida lecture --answers answers.jsonl
  lucida lecture --results answers.jsonl -o class.html

exit status: 0 done, 2 a mistake (one line says file, line and field), 130 interrupted"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument(
        "file",
        nargs="?",
        metavar="FILE",
        help="a lecture file (.toml), or a built-in lecture's name",
    )
    either = parser.add_mutually_exclusive_group()
    either.add_argument(
        "--check",
        action="store_true",
        help="only check file, scenes, formulas and hiding exercises; not with --export",
    )
    either.add_argument(
        "--export",
        metavar="OUT",
        help="a page for any browser (.html), its print (.pdf), or a folder of PNGs",
    )
    either.add_argument(
        "--answers", metavar="FILE", help="record answers in FILE, one per line, without names"
    )
    either.add_argument(
        "--results",
        metavar="FILE",
        nargs="+",
        help="write a page (-o) of a class's mistakes, from --answers",
    )
    parser.add_argument(
        "--step",
        type=_place,
        default=(0, 0),
        metavar="N",
        help="begin at a step, or its build: N.B",
    )
    parser.add_argument(
        "--no-answers",
        action="store_true",
        help="with --export OUT.html or OUT.pdf: leave out answers and solutions",
    )
    parser.add_argument("-o", dest="output", metavar="OUT.html", help="the page of --results")
    parser.add_argument(
        "--outside",
        action="store_true",
        help="allow the lecture to read files outside its folder",
    )
    parser.add_argument(
        "--size",
        type=window_size,
        metavar="WxH",
        help="the size in pixels (--export: "
        f"{EXPORT_SIZE[0]}x{EXPORT_SIZE[1]}; page: {STILLS_SIZE[0]}x{STILLS_SIZE[1]}; "
        f"print: {PRINT_SIZE[0]}x{PRINT_SIZE[1]})",
    )


def _place(text: str) -> tuple[int, int]:
    """Return step and build from 0 of a text such as 3 or 3.2."""
    numbers = re.fullmatch(r"([1-9]\d{0,3})(?:\.([1-9]\d?))?", text)
    if numbers is None:
        raise argparse.ArgumentTypeError(f"{text!r} is not a step; give 3, or 3.2 for a build")
    return int(numbers[1]) - 1, int(numbers[2] or 1) - 1


def run(arguments: argparse.Namespace) -> int:
    from lucida.app.lecture.reading import BUILTIN, BUILTINS, load_lecture
    from lucida.renderer.files.outside import OutsideError

    if arguments.output is not None and arguments.results is None:
        raise LucidaError("-o", "is for --results", "pictures of the steps: --export")
    if arguments.results is not None and arguments.output is None:
        raise LucidaError("--results", "has no page to write", "add -o class.html")
    as_page = arguments.export is not None and Path(arguments.export).suffix.lower() in PAGES
    if arguments.no_answers and not as_page:
        raise LucidaError("--no-answers", "is for a page", "add --export handout.pdf")
    named = {path.stem: path for path in BUILTINS.values()}
    file = arguments.file
    path = BUILTIN if file is None else named.get(file, Path(file))
    try:
        agreed = arguments.check or arguments.outside or arguments.results is not None
        lecture = load_lecture(path, None if agreed else frozenset())
    except OutsideError as error:
        raise LucidaError("", error.problem, "add --outside to agree", error.source) from None
    for note in lecture.notes if arguments.check else lecture.summary:
        print(f"lucida: {one_line(note)}", file=sys.stderr)
    if arguments.check:
        return _check(lecture, path, arguments.file or lecture.title)
    if as_page:
        return _export_page(arguments, lecture, path)
    if arguments.export is not None:
        if not arguments.export.strip():  # from an unset variable, for instance
            raise LucidaError("--export", "names no folder", "give one, or . for this one")
        ending = Path(arguments.export).suffix
        if ending[1:].isalpha() and not arguments.export.endswith(("/", os.sep)):
            remedy = "give .html, .pdf, or a folder (slides/)"
            raise LucidaError("--export", f"the ending {ending!r} is unknown", remedy)
        from lucida.app.window.lecturing import (
            export_lecture,  # after the quick checks, because it loads the window
        )

        folder = Path(arguments.export)
        size = arguments.size or EXPORT_SIZE
        with common.progress_bar("export") as progress:
            written = export_lecture(lecture, path, folder, size, progress)
        pictures = counted((len(written), "picture"))
        common.say(f"{arguments.export}: {pictures}, {size[0]}x{size[1]}")
        return 0
    if arguments.results is not None:
        return _results(arguments, lecture)
    from lucida.app.window.lecturing import run_lecture

    log = None
    if arguments.answers is not None:
        from lucida.app.lecture.answer_log import AnswerLog

        log = AnswerLog(Path(arguments.answers))
    return run_lecture(path, lecture, arguments.size, log, arguments.step)


def _export_page(arguments: argparse.Namespace, lecture: Lecture, path: Path) -> int:
    """Write the lecture as one HTML file, or print that as PDF."""
    from lucida.app.web import pdf
    from lucida.renderer.system.atomic import atomic_write, check_writable

    target = Path(arguments.export)
    check_writable(target)
    is_pdf = target.suffix.lower() == ".pdf"
    program = pdf.browser() if is_pdf else ""
    from lucida.app.web.lecture.page import page
    from lucida.app.window.lecturing import lecture_stills

    with common.progress_bar("export") as progress:
        size = arguments.size or (PRINT_SIZE if is_pdf else STILLS_SIZE)
        stills = lecture_stills(lecture, path, size, progress)
    html = page(lecture, stills, not arguments.no_answers, for_print=is_pdf)
    content = pdf.pdf(html, program) if is_pdf else html.encode()
    with atomic_write(target) as file:
        file.write(content)
    steps = counted((len(lecture.steps), "step"))
    common.say(f"{arguments.export}: {steps}, {len(content) / 1e6:.1f} MB")
    return 0


def _results(arguments: argparse.Namespace, lecture: Lecture) -> int:
    """Write a page about a class's answers."""
    from lucida.app.lecture.results import page, read_answers, summary
    from lucida.renderer.system.atomic import atomic_write

    answers, problems = read_answers(arguments.results)
    if not answers:
        remedy = "give files of lucida lecture --answers"
        raise LucidaError("--results", "; ".join(problems) or "have no answers", remedy)
    for problem in problems:
        print(f"lucida: {problem}", file=sys.stderr)
    html = page(answers, [step.title for step in lecture.steps])
    with atomic_write(arguments.output) as file:
        file.write(html.encode())
    common.say(one_line(f"{arguments.output}: {summary(answers)}"))
    return 0


def _check(lecture: Lecture, path: Path, name: str) -> int:
    """Print a summary of the lecture.

    Raises LucidaError for a formula that cannot be typeset, or an answer that is wrong.
    """
    from lucida.app.lecture.hidden_pixels import first_wrong_answer
    from lucida.app.lecture.typesetting import first_mistake
    from lucida.app.ui import formula
    from lucida.renderer.files.places import Places, located

    mistake = first_mistake(lecture.formulas)
    if mistake is not None:
        raise mistake
    wrong = first_wrong_answer(lecture)
    if wrong is not None:
        raise located(wrong, Places(path.read_text("utf-8-sig")), str(path))
    exercises = sum(build.exercise is not None for build in lecture.builds)
    unseen = "" if formula.available() else "; formulas not checked: no locale en_US.UTF-8 here"
    told = counted((len(lecture.steps), "step"), (exercises, "exercise"))
    common.say(f"{name}: {told}{unseen}")
    for file in lecture.outside:
        print(f"  reads {one_line(str(file))}, outside of its folder: the window asks first")
    return 0
