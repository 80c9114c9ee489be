"""The actions of the guided lecture: their names and keys. What they do is the view's."""

from __future__ import annotations

from imgui_bundle import imgui

from app.host.action import Action, Key, Window
from app.lecture.view import LectureView


def _given(window: Window) -> bool:
    return window.view(LectureView).is_given


def _restorable(window: Window) -> bool:
    return _given(window) and not imgui.get_io().want_text_input


LECTURE = (
    Action(
        "Lecture",
        'Begin "Images, rays and cameras"',
        lambda w: w.view(LectureView).give_builtin(),
    ),
    Action("Lecture", "Open lecture...", lambda w: w.files.open_lecture_dialog()),
    Action(
        "Lecture",
        "Next step",
        lambda w: w.view(LectureView).advance(w, 1),
        "Page Down",
        (int(Key.page_down),),
        can=_given,
        separated=True,
    ),
    Action(
        "Lecture",
        "Previous step",
        lambda w: w.view(LectureView).advance(w, -1),
        "Page Up",
        (int(Key.page_up),),
        can=_given,
    ),
    Action(
        "Lecture",
        "Play again",
        lambda w: w.view(LectureView).play(w),
        "R",
        (int(Key.r),),
        can=_restorable,
    ),
    Action(
        "Lecture",
        "Reset step",
        lambda w: w.view(LectureView).restore(w),
        "Backspace",
        (int(Key.backspace),),
        can=_restorable,
    ),
    Action(
        "Lecture",
        "Continue where it was left",
        lambda w: w.view(LectureView).go_on(w),
        "End",
        (int(Key.end),),
        can=lambda w: w.view(LectureView).was_left,
    ),
    Action("Lecture", "End the lecture", lambda w: w.view(LectureView).leave(w), can=_given),
)
