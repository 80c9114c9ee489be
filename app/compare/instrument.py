"""The compare view, as the window takes it."""

from __future__ import annotations

from app.compare.actions import COMPARING
from app.compare.view import CompareView
from app.host.instrument import Instrument
from app.host.view import view_of
from app.pair.view import RasterView

SYNONYMS = {
    "Worst pixel": "error difference",
    "Compare raster and ray": "difference diff error flip",
}

INSTRUMENT = Instrument(
    lambda views: [CompareView(view_of(views, RasterView).linked)], COMPARING, synonyms=SYNONYMS
)
