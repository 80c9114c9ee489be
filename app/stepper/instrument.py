"""The loop stepper, as an instrument of the window."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.host.view import view_of
from app.outside.view import OutsideView
from app.stepper.actions import STEPPING
from app.stepper.view import StepperView

SYNONYMS = {
    "Loop stepper": "algorithm code debug",
}
INSTRUMENT = Instrument(
    lambda views: [StepperView(view_of(views, OutsideView))],
    STEPPING,
    heading="Loop stepper, once it is clicked",
    synonyms=SYNONYMS,
)
