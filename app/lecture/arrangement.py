"""The places of a step's views in the window."""

from __future__ import annotations

from collections.abc import Iterable

from app.host import layout
from app.host.view import DockedView
from app.lecture.model import Step

LAID_OUT = 8  # frames until every view has its place


class Arrangement:
    """Puts the views of a step into their places. count: how often it has done so."""

    def __init__(self) -> None:
        self.count = 0
        self._frames = 0  # that were drawn since then
        self._docks: dict[str, int] = {}  # where the views were then

    def arrange(self, views: Iterable[DockedView], step: Step) -> None:
        """Show a step's views in their places, and hide the others."""
        layout.arrange(views, _places(step))
        self._frames = 0
        self.count += 1

    def is_kept(self, views: Iterable[DockedView], step: Step) -> bool:
        """Return True if the views are where they were put. Call once a frame."""
        docks = layout.docks(views)
        self._frames += 1
        if self._frames <= LAID_OUT:
            self._docks = docks
        return docks == self._docks and set(docks) == set(_places(step))


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
