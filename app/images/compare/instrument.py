"""The compare view, as the window takes it."""

from __future__ import annotations

from app.images.compare.actions import COMPARING
from app.images.compare.view import CompareView
from app.images.pair.view import RasterView
from app.ui.instrument import Instrument
from app.ui.view import view_of

SYNONYMS = {
    "Worst pixel": "error difference",
    "Compare raster and ray": "difference diff error flip",
}

INSTRUMENT = Instrument(
    lambda views: [CompareView(view_of(views, RasterView).linked)], COMPARING, synonyms=SYNONYMS
)
