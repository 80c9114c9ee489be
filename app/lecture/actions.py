"""The actions of the guided lecture: their names and keys. The view carries them out."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from imgui_bundle import imgui

from lucida.app.ui.action import Action
from lucida.app.ui.host import Host

from .reading import BUILTINS, load_lecture
from .view import LectureView


def _given(window: Host) -> bool:
    return window.view(LectureView).is_given


def _restorable(window: Host) -> bool:
    return _given(window) and not imgui.get_io().want_text_input


def _begin(path: Path, window: Host) -> None:
    window.view(LectureView).give(load_lecture(path), path)


LECTURE = (
    *(
        Action("Lecture", f'Begin "{title}"', partial(_begin, path))
        for title, path in BUILTINS.items()
    ),
    Action("Lecture", "Open lecture...", lambda w: w.files.open_dialog()),
    Action(
        "Lecture",
        "Next step",
        lambda w: w.view(LectureView).advance(w, 1),
        "Page Down",
        can=_given,
        separated=True,
    ),
    Action(
        "Lecture",
        "Previous step",
        lambda w: w.view(LectureView).advance(w, -1),
        "Page Up",
        can=_given,
    ),
    Action(
        "Lecture",
        "Play again",
        lambda w: w.view(LectureView).play(w),
        "R",
        can=_restorable,
    ),
    Action(
        "Lecture",
        "Reset step",
        lambda w: w.view(LectureView).restore(w),
        "Backspace",
        can=_restorable,
    ),
    Action(
        "Lecture",
        "Continue where you left off",
        lambda w: w.view(LectureView).go_on(w),
        "End",
        can=lambda w: w.view(LectureView).was_left,
    ),
    Action("Lecture", "End the lecture", lambda w: w.view(LectureView).leave(w), can=_given),
)
