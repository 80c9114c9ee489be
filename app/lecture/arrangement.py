"""The places of a step's views in the window."""

from __future__ import annotations

from collections.abc import Iterable

from app.lecture.model import Step
from app.ui import layout
from app.ui.view import DockedView


def arrange(views: Iterable[DockedView], step: Step) -> None:
    """Show a step's views in their places, and hide the others."""
    layout.arrange(views, _places(step))


def _places(step: Step) -> dict[str, str]:
    """Return the dock spaces of a step's views: a large one for the main view, one below for a
    second. The camera's panel is left of them; below them if only
    its section Lens is pointed out, which needs less room than a picture.
    """
    pictures = [name for name in step.views if name != "camera"]
    spaces = dict(zip(pictures, (layout.MAIN, layout.LOWER_SPACE), strict=False))
    if "camera" in step.views:
        is_below = step.highlight == ("lens",) and len(pictures) == 1
        spaces["camera"] = layout.LOWER_SPACE if is_below else layout.CAMERA_SPACE
    return {name.capitalize(): space for name, space in spaces.items()}
