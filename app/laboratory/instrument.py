"""The image laboratory, as the window takes it."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.host.view import view_of
from app.laboratory.displays import DISPLAYS
from app.laboratory.pages import PAGE_TITLES
from app.laboratory.view import LaboratoryView
from app.outside.view import OutsideView

SYNONYMS = {
    "Image laboratory": "representations storage formats",
    "Image laboratory: Kinds": "bitmap grayscale colour float bits bytes storage megapixel",
    "Image laboratory: One bit": "bitmap dither dithering threshold ordered floyd steinberg",
    "Image laboratory: Exposure": "float clipped levels high dynamic range hdr",
    "Image laboratory: Projectors": "light adds additive mixing discs red green blue",
    "Image laboratory: Displays": "light screen phase cycle tube dlp lcd led oled",
    "Image laboratory: Array": "memory row-major column-major canvas bytes numpy julia c",
    "Image laboratory: Vector": "svg zoom",
}

PAGES: dict[str, dict[str, object]] = {
    **{f"Image laboratory: {title}": {"page": page} for page, title in PAGE_TITLES.items()},
    **{
        f"Display: {kind.title}": {"page": "displays", "display": name}
        for name, kind in DISPLAYS.items()
    },
}
INSTRUMENT = Instrument(
    lambda views: [LaboratoryView(view_of(views, OutsideView))], synonyms=SYNONYMS, pages=PAGES
)
