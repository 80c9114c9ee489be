"""The actions of the guided lecture.

Owns their names and keys. What they do is views/lecture.py's.
"""

from __future__ import annotations

from imgui_bundle import imgui

from app.action import Action, Key, Window


def _given(window: Window) -> bool:
    return window.lecture.is_given


def _restorable(window: Window) -> bool:
    return _given(window) and not imgui.get_io().want_text_input


LECTURE = (
    Action("Lecture", 'Begin "Images, rays and cameras"', lambda w: w.lecture.give_builtin()),
    Action("Lecture", "Open lecture...", lambda w: w.files.open_lecture_dialog()),
    Action(
        "Lecture",
        "Next step",
        lambda w: w.lecture.advance(w, 1),
        "Page Down",
        (int(Key.page_down),),
        can=_given,
        separated=True,
    ),
    Action(
        "Lecture",
        "Step before",
        lambda w: w.lecture.advance(w, -1),
        "Page Up",
        (int(Key.page_up),),
        can=_given,
    ),
    Action(
        "Lecture",
        "Back to the step's own state",
        lambda w: w.lecture.restore(w),
        "Backspace",
        (int(Key.backspace),),
        can=_restorable,
    ),
)
