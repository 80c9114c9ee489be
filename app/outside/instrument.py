"""The outside view, as the window takes it."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.outside.actions import DIAGRAM, OUTSIDE
from app.outside.view import OutsideView

INSTRUMENT = Instrument(lambda views: [OutsideView()], (*DIAGRAM, *OUTSIDE))
