"""The loop stepper with its actions."""

from __future__ import annotations

from lucida.app.instruments.stepper.actions import STEPPING
from lucida.app.instruments.stepper.view import StepperView


class Stepper(StepperView):
    actions = STEPPING
    heading = "Loop stepper, once it is clicked"
    synonyms = {
        "Loop stepper": "algorithm code debug",
    }
