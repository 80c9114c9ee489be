"""The loop stepper, as an instrument of the window."""

from __future__ import annotations

from app.instruments.outside.view import OutsideView
from app.instruments.stepper.actions import STEPPING
from app.instruments.stepper.view import StepperView
from app.ui.instrument import Instrument
from app.ui.view import view_of

SYNONYMS = {
    "Loop stepper": "algorithm code debug",
}
INSTRUMENT = Instrument(
    lambda views: [StepperView(view_of(views, OutsideView))],
    STEPPING,
    heading="Loop stepper, once it is clicked",
    synonyms=SYNONYMS,
)
