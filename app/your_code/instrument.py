"""The view "Your code", as an instrument of the window."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.host.view import view_of
from app.outside.view import OutsideView
from app.your_code.actions import YOURS
from app.your_code.view import YourCodeView

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
