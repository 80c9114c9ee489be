"""The outside view with its actions."""

from __future__ import annotations

from lucida.app.instruments.outside.actions import OUTSIDE
from lucida.app.instruments.outside.view import OutsideView


class Outside(OutsideView):
    actions = OUTSIDE
    synonyms = {
        "Show basis": "axes u v w",
        "Show volume": "frustum",
        "Show ray": "viewing",
        "Show bundle": "rays",
        "Handles: move eye": "gizmo translate",
        "Handles: turn basis": "gizmo rotate",
        "Handles: move plane": "gizmo distance focal length",
        "Handles: turn up": "gizmo rotate roll",
        "Fit all": "zoom extents",
        "Outside view": "3d world frustum wireframe scene",
    }
