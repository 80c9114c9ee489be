"""The view of sets of cameras with its actions."""

from __future__ import annotations

from app.instruments.poses.actions import CHOOSING
from app.instruments.poses.view import PosesView


class Poses(PosesView):
    actions = CHOOSING
    keyboard = (("arrows in Poses", "another camera; Home, End"),)
    synonyms = {
        "Poses": "cameras colmap nerf transforms.json reconstruction photographs data set frusta",
        "Poses: frame the set": "zoom extents poses cameras fit",
    }
