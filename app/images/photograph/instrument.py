"""The photograph, as an instrument of the window. It has no view; the images show it."""

from __future__ import annotations

from app.images.photograph.actions import PHOTOGRAPH
from app.ui.instrument import Instrument

SYNONYMS = {
    "Photograph on the images": "overlay background hide show toggle",
    "Photograph over the images": "overlay blend",
    "Photograph where nothing is hit": "background backdrop behind",
    "Photograph more opaque": "opacity alpha blend",
    "Photograph less opaque": "opacity alpha transparent blend",
    "Undistort the photograph": "lens distortion rectify pinhole straighten",
    "Close the photograph": "remove background overlay",
}

INSTRUMENT = Instrument(lambda views: [], PHOTOGRAPH, synonyms=SYNONYMS)
