"""Implement `lucida lecture`: show a lecture in the window, or draw pictures of all its steps.

lecture/view.py draws the steps.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from lucida.app.instruments.laboratory.view import LABORATORY, LaboratoryView
from lucida.app.lecture.answer_log import AnswerLog
from lucida.app.lecture.model import Lecture, Step
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Theme
from lucida.renderer.system.atomic import check_writable
from lucida.renderer.system.errors import LucidaError

from .canvas import Target
from .capture import cut
from .launch import start_drawing
from .main_window import MainWindow
from .platform import start_platform
from .start import Start, begin_lecture, first_state
from .viewer import SCREENSHOT_LIMIT_S, WindowRun, save_png

if TYPE_CHECKING:
    from lucida.app.web.lecture.page import Still

THEMED = {"stepper", "costs", "probe", "mistakes", "poses"}  # views in the theme's colours
WORLD_TYPE = 1.5  # type size in stills of the world, relative to a hall's: phones show a third
QUIET_FRAMES = 4  # the layout needs two frames; afterwards nothing may change


def run_lecture(
    path: Path,
    lecture: Lecture,
    size: tuple[int, int] | None,
    log: AnswerLog | None,
    at: tuple[int, int] = (0, 0),
) -> int:
    """Open the window with a lecture. Return the exit status when it is closed.

    path: the lecture's file, read again when it is saved. log: records the answers. at: the first
    step and build to show, from 0. Without a display, draw that build once, into lucida.png, or
    lucida-2.png if that exists, and print a line. Raises LucidaError.
    """
    platform, picture = start_drawing(None, "the step")
    pictured = picture is not None
    start = Start(first_state(lecture, at)) if pictured else begin_lecture(lecture, at)
    run = WindowRun(platform, start.state, size, pictured, start=start)
    run.window.lecture.give(lecture, path, at, start.left)
    run.window.lecture.log = log
    if not pictured:
        print("The lecture starts in presentation mode: F9 turns that off and on.")
    return run.to_the_end(picture, tell=True)


def export_lecture(
    lecture: Lecture,
    path: Path,
    folder: Path,
    size: tuple[int, int],
    progress: Callable[[float], None] = lambda fraction: None,
) -> list[Path]:
    """Write a PNG of the window for each build into a new folder. Return the files.

    path: the lecture's file. size: the window's (width, height). Needs no display. Raises
    LucidaError.
    """
    is_new = not folder.exists()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise LucidaError("", "is a file", "give a folder to export into", str(folder)) from None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise LucidaError(
            "", f"cannot be made: {reason}", "export elsewhere", str(folder)
        ) from None
    files = [folder / name for name in _names(lecture)]
    for file in files:
        check_writable(file)

    def save(place: int, _window: MainWindow, target: Target) -> None:
        save_png(files[place], target.read())

    try:
        _draw_builds(lecture, path, size, save, progress)
    except LucidaError:
        if is_new:  # if the disk is full, remove the folder too
            with contextlib.suppress(OSError):
                folder.rmdir()
        raise
    return files


def _names(lecture: Lecture) -> list[str]:
    """Return the names of all builds' pictures: 07.png, or 07.2.png in a step of several builds."""
    digits = max(2, len(str(len(lecture.steps))))
    names = []
    for one in lecture.builds:
        build = f".{one.build + 1}" if lecture.count(one.number) > 1 else ""
        names.append(f"{one.number + 1:0{digits}}{build}.png")
    return names


def lecture_stills(
    lecture: Lecture,
    path: Path,
    size: tuple[int, int],
    progress: Callable[[float], None] = lambda fraction: None,
) -> list[list[Still]]:
    """Return pictures of the views in each build.

    They have no tools and the light theme, for prints. Views in the theme's colours are also drawn
    in the dark theme. The outside view's type is larger than in the window. path, size: as in
    export_lecture(). Needs no display. Raises LucidaError.
    """
    from lucida.app.web.lecture.page import Still

    lecture = replace(lecture, builds=tuple(replace(one, full=False) for one in lecture.builds))
    stills: list[list[Still]] = [[] for _ in lecture.builds]

    def take(place: int, window: MainWindow, target: Target) -> None:
        pixels = target.read()
        laboratory = window.views[LABORATORY]
        assert isinstance(laboratory, LaboratoryView)
        rects = window.shell.stage.rects
        places = {view: rects.get(view.capitalize()) for view in lecture.builds[place].views}
        pictures = {view: cut(pixels, rect) for view, rect in places.items() if rect is not None}
        if window.state.preferences.theme == "dark":
            for number, one in enumerate(stills[place]):
                if one.view in THEMED:
                    stills[place][number] = replace(one, dark=pictures[one.view])
            return
        for view, picture in pictures.items():
            drawn = laboratory.in_both_themes() if view == "laboratory" else None
            stills[place].append(Still(view, picture, drawn))

    _draw_builds(lecture, path, size, take, progress, for_print=True)
    return stills


def _draw_builds(
    lecture: Lecture,
    path: Path,
    size: tuple[int, int],
    take: Callable[[int, MainWindow, Target], None],
    progress: Callable[[float], None],
    for_print: bool = False,
) -> None:
    """Draw all builds in a window without a display, and take each once nothing changes any more.

    take: gets the build's index among all builds. for_print: draw no tools, and use the light
    theme; builds with a view of THEMED use the dark theme, too. Raises LucidaError.
    """
    platform = start_platform(want_display=False)
    state = first_state(lecture)
    if for_print:
        state = _for_still(state, lecture.builds[0], "light")
    run = WindowRun(platform, state, size, take_picture=True)
    run.ends_once_complete = False  # each build is a picture, not only the last
    window = run.window
    window.for_print = for_print
    window.lecture.give(lecture, path)
    place, quiet, began_s, count = 0, 0, time.monotonic(), len(lecture.builds)

    def drawn(target: Target) -> None:
        """Take each build, and continue with the next."""
        nonlocal place, quiet, began_s
        if place == count:
            return
        window.check()
        quiet = quiet + 1 if window.settled else 0
        step = lecture.builds[place]
        if quiet > QUIET_FRAMES:
            take(place, window, target)
            quiet, began_s = 0, time.monotonic()
            is_light = window.state.preferences.theme == "light"
            if for_print and is_light and THEMED.intersection(step.views):
                window.amend(_for_still(window.state, step, "dark"))
                return
            place += 1
            progress(place / count)
            if place < count:
                if for_print:
                    window.amend(_for_still(window.state, lecture.builds[place], "light"))
                window.lecture.advance(window, 1)
            else:
                run.params.app_shall_exit = True
        elif time.monotonic() - began_s > SCREENSHOT_LIMIT_S:
            raise LucidaError(
                f"step {step.number + 1}",
                f"was not complete after {SCREENSHOT_LIMIT_S:g} s",
                "try a smaller model or --size",
            )

    run.on_drawn = drawn
    run.run()


def _for_still(state: AppState, build: Step, theme: Theme) -> AppState:
    """Return the state with the preferences for a still of this build."""
    scale = WORLD_TYPE if "outside" in build.views else 1.0
    return state.with_options(replace(state.options.preferences, theme=theme, font_scale=scale))
