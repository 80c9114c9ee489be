"""From a step to the state of the window.

Pure. Knows nothing of how a view is shown: that is the window's part of a step (lecture/view.py).
"""

from __future__ import annotations

from dataclasses import replace

from app.lecture.hiding import HideExercise
from app.lecture.model import Step
from app.lecture.step_options import own
from app.state.app_state import AppState, is_orthonormal


def state_of(step: Step, base: AppState) -> AppState:
    """The step's own state: its scene, its view and its options, whatever was there before; what
    an exercise asks to move is chosen.

    base: the present state, of which only what is the user's own stays, the language of programs,
    and where in a lecture it is.
    """
    options = replace(own(base.options), marked=step.pixel, highlight=step.highlight)
    keep = is_orthonormal(step.view.camera)
    state = AppState(step.scene, step.view, keep, options, base.step)
    if isinstance(step.exercise, HideExercise):
        state = state.with_options(objects={"chosen": (step.exercise.item,)})
    return state.with_options(**step.options)
