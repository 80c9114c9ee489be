"""The image laboratory, as the window takes it."""

from __future__ import annotations

from app.instruments.laboratory.pages import PAGES
from app.instruments.laboratory.view import LaboratoryView
from app.ui.instrument import Instrument

SYNONYMS = {
    "Image laboratory": "representations storage formats",
    "Image laboratory: Function": "spectrum radiant energy light position",
    "Image laboratory: Pixels and shapes": "raster vector svg zoom",
    "Image laboratory: Projectors": "light adds additive mixing discs red green blue",
    "Image laboratory: Displays": "light screen phase cycle tube dlp lcd led oled subpixel",
    "Image laboratory: Raster": "resolution pixels count",
    "Image laboratory: Kinds": "bitmap grayscale colour float bits",
    "Image laboratory: Exposure": "float clipped high dynamic range hdr",
    "Image laboratory: Storage": "bytes megapixel size",
    "Image laboratory: Array": "memory row-major column-major canvas bytes numpy julia",
    "Image laboratory: How images are made": "pencil brush eye camera",
    "Image laboratory: From 3D to 2D": "conundrum dimension projection",
    "Image laboratory: From pixel to (u, v)": "ruler half pixel",
}

INSTRUMENT = Instrument(
    lambda views: [LaboratoryView()],
    synonyms=SYNONYMS,
    pages={f"Image laboratory: {kind.title}": {"page": page} for page, kind in PAGES.items()},
)
