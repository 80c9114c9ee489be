"""Handles in the 3D views that move the selection along the world's axes (ImGuizmo).

The result of a drag is the scene at its beginning moved by one vector, so that a drag of many
frames has no more rounding than one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.outside.gizmo import Handle, escaped, gizmo, let_go, manipulate
from lucida.app.instruments.outside.tint import AXES, HELD
from lucida.app.ui import palettes, theme
from lucida.app.ui.guest import ShownIn
from lucida.renderer.editing.changing import Item
from lucida.renderer.editing.moving import Floats, bounds_of, shift
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.memo import Memo

LENGTH_PX, MOST_PART = 52.0, 0.24  # length at 100 %; its most, as a part of the shorter side
WIDE_PART = 0.08  # part of the view's width, if that is longer
# ImGuizmo's own colours of x, y, z and the held handle, and their replacements.
COLORS = {
    **dict(zip(AXES.values(), palettes.CHANNELS, strict=True)),
    HELD: theme.rgb("#ffffff"),
}
DIGITS = 6  # significant digits of a handle's motion


@dataclass(frozen=True)
class _HandleDrag:
    """A drag of a handle.

    view: the one in which it began.
    scene, start: the scene and the handle's place at its beginning.
    latest: the current scene.
    place: the handle's current place.
    """

    view: str
    items: tuple[Item, ...]
    scene: Scene
    latest: Scene
    start: Floats
    place: Floats


class Handles:
    """The handles of all views.
    problem: the reason that the dragged item does not follow, or "".
    """

    def __init__(self) -> None:
        self.problem = ""
        self._over: set[str] = set()
        self._drag: _HandleDrag | None = None
        self._count = 0
        self._placed = Memo(middle_of)

    @property
    def gesture(self) -> tuple[str, int]:
        """Return the key that joins the changes of one drag, for undo."""
        return ("objects' handles", self._count)

    @property
    def dragging(self) -> bool:
        return self._drag is not None

    def holds(self, view: str) -> bool:
        """Return True if the mouse is over a handle in a view, or drags one there."""
        return view in self._over

    def forget(self, view: str) -> None:
        """Note that a view has no handles now."""
        self._over.discard(view)
        if self._drag is not None and self._drag.view == view:
            self._drag, self.problem = None, ""

    def draw(
        self,
        shown: ShownIn,
        scene: Scene,
        items: tuple[Item, ...],
        reach: float,
    ) -> Scene:
        """Draw the handles of some items into the current window. Return the scene after their
        motion. reach: of the scene.
        """
        drag = self._drag if self._drag is not None and self._drag.view == shown.name else None
        if drag is not None and (drag.items != items or drag.latest is not scene):
            let_go()  # undo, for instance, has changed it
            self.forget(shown.name)
            drag = None
        elif drag is not None and escaped():
            self.forget(shown.name)
            return drag.scene
        place = drag.place if drag is not None else self._placed(scene, items)
        found = None
        if place is not None:
            length, frame = length_px(shown.extent, imgui.get_window_size()), np.eye(4)
            frame[:3, 3] = place
            asked = Handle(
                shown.name, frame, gizmo.OPERATION.translate, gizmo.MODE.world,
                2 * length / shown.extent.x, COLORS,
            )  # fmt: skip
            found = manipulate(asked, shown.camera, shown.origin, shown.extent, reach)
        if place is None or found is None:
            self.forget(shown.name)
            return scene
        # ImGuizmo reports the mouse over a handle for all views at once.
        over = found.using or (found.over and imgui.is_window_hovered())
        (self._over.add if over else self._over.discard)(shown.name)
        if not found.using:
            if drag is not None:
                self.forget(shown.name)
            return scene
        if drag is None:
            self._count += 1
            drag = _HandleDrag(shown.name, items, scene, scene, place, place)
        if found.moved is not None:
            scene, drag = self._moved(drag, scene, found.moved[:3, 3])
        self._drag = drag
        if self.problem:
            imgui.set_tooltip(self.problem)
        return scene

    def _moved(self, drag: _HandleDrag, scene: Scene, place: Floats) -> tuple[Scene, _HandleDrag]:
        if not np.isfinite(place).all():
            return scene, drag
        try:
            found = shift(drag.scene, drag.items, way_of(drag.start, place))
        except LucidaError as error:  # the last valid scene stays
            self.problem = error.problem
            return scene, drag
        self.problem = ""
        return found, replace(drag, latest=found, place=place)


def length_px(image: ImVec2, room: ImVec2) -> float:
    """Return the length of handles, in ImGui's units: legible, but not too large for the view.

    image: the size of the whole image, which may be larger than the view.
    """
    width, height = min(image.x, room.x), min(image.y, room.y)
    wanted = max(theme.px(LENGTH_PX), WIDE_PART * width)
    return max(1.0, min(wanted, MOST_PART * min(width, height)))


def middle_of(scene: Scene, items: tuple[Item, ...]) -> Floats | None:
    """Return the place of the handles, (3,): the items' middle; None if none has a place."""
    bounds = bounds_of(scene, items)
    return None if bounds is None else np.asarray(bounds.mean(axis=0))


def way_of(start: Floats, end: Floats) -> Floats:
    """Return a handle's motion, (3,), rounded: ImGuizmo uses single precision, whose noise would
    get into the scene's file.
    """
    still = np.isclose(end, start, rtol=1e-6, atol=0)
    short = [float(f"{part:.{DIGITS}g}") for part in end - start]
    return np.where(still, 0.0, short)
