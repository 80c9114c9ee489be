"""The image laboratory, as the window takes it."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.host.view import view_of
from app.laboratory.view import LaboratoryView
from app.outside.view import OutsideView

SYNONYMS = {
    "Image laboratory": "dither threshold bitmap bytes vector projector subpixel array histogram",
}

INSTRUMENT = Instrument(
    lambda views: [LaboratoryView(view_of(views, OutsideView))], synonyms=SYNONYMS
)
