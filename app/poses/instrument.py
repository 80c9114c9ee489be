"""The sets of cameras, as an instrument of the window."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.host.view import view_of
from app.outside.view import OutsideView
from app.poses.actions import CHOOSING
from app.poses.view import PosesView

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
