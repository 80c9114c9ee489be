"""The sets of cameras, as an instrument of the window."""

from __future__ import annotations

from app.instruments.outside.view import OutsideView
from app.instruments.poses.actions import CHOOSING
from app.instruments.poses.view import PosesView
from app.ui.instrument import Instrument
from app.ui.view import view_of

SYNONYMS = {
    "Poses": "cameras colmap nerf transforms.json reconstruction photographs data set frusta",
    "Poses: frame the set": "zoom extents poses cameras fit",
}

INSTRUMENT = Instrument(
    lambda views: [PosesView(view_of(views, OutsideView))],
    CHOOSING,
    keyboard=(("arrows in Poses", "another camera; Home, End"),),
    synonyms=SYNONYMS,
)
