"""The loop stepper's actions.

Its keys work while it has the keyboard, and are read by its panel. They are listed here for
display, and so that no key has two meanings.
"""

from __future__ import annotations

from lucida.app.instruments.stepper.controls import STEPS, Step
from lucida.app.instruments.stepper.view import STEPPER, StepperView
from lucida.app.ui.action import Action


def _stepping(step: Step) -> Action:
    return Action(
        "Lecture/Loop stepper",
        f"Stepper: {step.told}",
        lambda window: window.view(StepperView).ask(step.wish),
        step.shown,
        binds=False,
        can=lambda window: window.is_visible(STEPPER),
        separated=step is STEPS[0],
    )


STEPPING = tuple(map(_stepping, STEPS))
