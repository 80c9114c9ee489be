"""The actions of the guided lecture, of the loop stepper and of the probe.

Owns their names and keys. What they do is the views'. The stepper's keys hold while it has the
keyboard and are read by its panel: here they are only shown, so that no key has two meanings.
"""

from __future__ import annotations

from imgui_bundle import imgui

from app.host.action import Action, Key, Window, changing
from app.lecture.view import LectureView
from app.state.app_state import AppState
from app.stepper.panel import Wish
from app.stepper.view import StepperView

STEPPER = "Stepper"  # the view's name


def _given(window: Window) -> bool:
    return window.view(LectureView).is_given


def _restorable(window: Window) -> bool:
    return _given(window) and not imgui.get_io().want_text_input


def _stepping(wish: Wish, name: str, keys: str) -> Action:
    return Action(
        "Lecture/Loop stepper",
        f"Stepper: {name}",
        lambda window: window.view(StepperView).ask(wish),
        keys,
        can=lambda window: STEPPER in window.shell.stage.rects,
        separated=wish == "play",
    )


def _pinned(state: AppState) -> AppState:
    pins, pixel = state.options.probe.pins, state.marked
    if pixel is None or pixel in pins:
        return state
    return state.with_options(probe={"pins": (*pins, pixel)})


STEPPING: tuple[tuple[Wish, str, str], ...] = (
    ("play", "play and pause", "Space"),
    ("step", "one line on", "Right"),
    ("back", "one line back", "Left"),
    ("pixel", "to the next pixel's turn", "Down"),
    ("object", "to the next object's turn", "Shift+Down"),
    ("first", "to the beginning", "Home"),
    ("last", "to the end", "End"),
)

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
        "Step before",
        lambda w: w.view(LectureView).advance(w, -1),
        "Page Up",
        (int(Key.page_up),),
        can=_given,
    ),
    Action(
        "Lecture",
        "Back to the step's own state",
        lambda w: w.view(LectureView).restore(w),
        "Backspace",
        (int(Key.backspace),),
        can=_restorable,
    ),
    Action("Lecture", "End the lecture", lambda w: w.view(LectureView).leave(w), can=_given),
    *(_stepping(wish, name, keys) for wish, name, keys in STEPPING),
    Action(
        "Lecture",
        "Pin the marked pixel",
        changing(_pinned),
        can=lambda w: w.state.marked is not None,
        separated=True,
    ),
    Action(
        "Lecture",
        "Let all pins go",
        changing(lambda state: state.with_options(probe={"pins": ()})),
        can=lambda w: bool(w.state.options.probe.pins),
    ),
)
