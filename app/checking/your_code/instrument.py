"""The view "Your code", as an instrument of the window."""

from __future__ import annotations

from app.checking.your_code.actions import YOURS
from app.checking.your_code.view import YourCodeView
from app.instruments.outside.view import OutsideView
from app.ui.instrument import Instrument
from app.ui.view import view_of

SYNONYMS = {
    "Your code": "python program student check homework viewing_ray",
    "Open Python code...": "student program .py your code",
    "Write code to begin with...": "starter template python",
    "Open a course's tasks...": "homework assignment exercise toml check your code",
    "Run your code": "check python again reload",
    "Stop your code": "endless loop kill",
}

INSTRUMENT = Instrument(
    lambda views: [YourCodeView(view_of(views, OutsideView))], YOURS, synonyms=SYNONYMS
)
