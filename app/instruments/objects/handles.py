"""Handles in the 3D views that move, turn and scale the selection (ImGuizmo).

The result of a drag is the scene at its beginning transformed by one matrix, so that a drag of many
frames has no more rounding than one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from imgui_bundle import ImVec2, imgui, imguizmo

from lucida.app.instruments.outside.gizmo import (
    Handle,
    escaped,
    gizmo,
    let_go,
    manipulate,
    write,
)
from lucida.app.instruments.outside.tint import AXES, HELD
from lucida.app.state.options.objects import Handle as HandleKind
from lucida.app.ui import palettes, theme
from lucida.app.ui.guest import ShownIn
from lucida.renderer.camera.checks import Vector
from lucida.renderer.editing.changing import Item, fields_of
from lucida.renderer.editing.moving import Floats, bounds_of, matrix_of, transform
from lucida.renderer.files.schema import (
    DirectionalLightTable,
    ModelTable,
    PointLightTable,
    SphereTable,
)
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.memo import Memo

Operation = imguizmo.im_guizmo.OPERATION

LENGTH_PX, MOST_PART = 52.0, 0.24  # of a handle: at 100 %; its most, in parts of the shorter side
WIDE_PART = 0.08  # of the view's width, where that is longer
HEAD_PART = 0.12  # of a handle: its arrow's head at most
# ImGuizmo's own colours of x, y, z and the held handle, and their replacements.
COLORS = {
    **dict(zip(AXES.values(), palettes.CHANNELS, strict=True)),
    HELD: theme.rgb("#ffffff"),
}
DIGITS = 6  # of numbers that a handle has changed


@dataclass(frozen=True)
class _HandleDrag:
    """A drag of a handle.

    view: the one in which it began.
    scene, frame: at its beginning.
    latest: the scene now.
    matrix: the handle's now.
    """

    view: str
    items: tuple[Item, ...]
    scene: Scene
    latest: Scene
    frame: Floats
    matrix: Floats


class Handles:
    """The handles of all views. problem: the reason why the dragged item does not follow; "" if it
    does.
    """

    def __init__(self) -> None:
        self.problem = ""
        self._over: set[str] = set()
        self._drag: _HandleDrag | None = None
        self._count = 0
        self._placed = Memo(_placed)

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
        wanted: HandleKind,
        center: Vector,
        reach: float,
        fonts: theme.Fonts,
    ) -> Scene:
        """Draw the handles of some items into the current window. Return the scene as they have
        moved it.

        center, reach: of the scene. A directional light has no position, so its handles are at the
        centre.
        """
        drag = self._drag if self._drag is not None and self._drag.view == shown.name else None
        if drag is not None and (drag.items != items or drag.latest is not scene):
            let_go()  # something else has changed it, such as undo
            self.forget(shown.name)
            drag = None
        elif drag is not None and escaped():
            self.forget(shown.name)
            return drag.scene
        kind, operation, frame = self._placed(scene, items, wanted, center)
        frame = drag.matrix if drag is not None else frame
        found = None
        if operation is not None:
            length = length_px(shown.extent, imgui.get_window_size())
            asked = Handle(
                shown.name, frame, operation, gizmo.MODE.world, 2 * length / shown.extent.x, COLORS,
                HEAD_PART * length,
            )  # fmt: skip
            found = manipulate(asked, shown.camera, shown.origin, shown.extent, reach)
        if found is None:
            self.forget(shown.name)
            return scene
        # ImGuizmo is over a handle in all views alike.
        over = found.using or (found.over and imgui.is_window_hovered())
        (self._over.add if over else self._over.discard)(shown.name)
        if not found.using:
            if drag is not None:
                self.forget(shown.name)
            return scene
        if drag is None:
            self._count += 1
            drag = _HandleDrag(shown.name, items, scene, scene, frame, frame)
        if found.moved is not None:
            whole = operation == gizmo.OPERATION.scaleu
            scene, drag = self._moved(drag, scene, found.moved, kind, whole)
        self._drag = drag
        place = drag.matrix[:3, 3]
        write(self.problem, found.clip_from_world, place, shown.origin, shown.extent, fonts)
        return scene

    def _moved(
        self, drag: _HandleDrag, scene: Scene, result: Floats, handle: HandleKind, whole: bool
    ) -> tuple[Scene, _HandleDrag]:
        if not np.isfinite(result).all() or abs(np.linalg.det(result[:3, :3])) < 1e-30:
            return scene, drag
        try:
            now = cleaned(handle, drag.frame, result, whole)
            found = moved_by(drag.scene, drag.items, drag.frame, now)
        except LucidaError as error:  # the last good one stays
            self.problem = error.problem
            return scene, drag
        self.problem = ""
        return found, replace(drag, latest=found, matrix=now if handle == "scale" else result)


def length_px(image: ImVec2, room: ImVec2) -> float:
    """Return the length of handles, in ImGui's units: legible, but not too large for the view.

    image: the size of the whole image, which may be larger than the view.
    """
    width, height = min(image.x, room.x), min(image.y, room.y)
    wanted = max(theme.px(LENGTH_PX), WIDE_PART * width)
    return max(1.0, min(wanted, MOST_PART * min(width, height)))


def frame_of(scene: Scene, items: tuple[Item, ...], center: Vector) -> Floats:
    """Return the frame of handles, (4, 4): an item's own space, or the middle of several.

    A model's handles are at its middle too, because its origin may be anywhere.
    """
    if len(items) == 1:
        frame, fields = matrix_of(scene, items[0]), fields_of(scene, items[0])
        if isinstance(fields, DirectionalLightTable):
            frame[:3, 3] = center
        elif isinstance(fields, ModelTable):
            box = bounds_of(scene, items)
            frame[:3, 3] = frame[:3, 3] if box is None else box.mean(axis=0)
        return frame
    frame = np.eye(4)
    bounds = bounds_of(scene, items)
    frame[:3, 3] = center if bounds is None else bounds.mean(axis=0)
    return frame


def _placed(
    scene: Scene, items: tuple[Item, ...], wanted: HandleKind, center: Vector
) -> tuple[HandleKind, Operation | None, Floats]:
    kind = handle_of(scene, items, wanted)
    return kind, operation_of(scene, items, kind), frame_of(scene, items, center)


def handle_of(scene: Scene, items: tuple[Item, ...], wanted: HandleKind) -> HandleKind:
    """Return the kind of the handles. A light that has only a direction is turned when others are
    moved.
    """
    directed = all(isinstance(fields_of(scene, item), DirectionalLightTable) for item in items)
    return "turn" if wanted == "move" and directed else wanted


def operation_of(scene: Scene, items: tuple[Item, ...], handle: HandleKind) -> Operation | None:
    """Return the operation for ImGuizmo; None if nothing can be moved that way."""
    if not items or handle == "none":
        return None
    kinds: set[type] = {type(fields_of(scene, item)) for item in items}
    directions: set[type] = {DirectionalLightTable}
    if handle == "move":
        return None if kinds == directions else gizmo.OPERATION.translate
    if handle == "turn":
        placed: set[type] = {SphereTable, PointLightTable}
        return None if len(items) == 1 and kinds <= placed else gizmo.OPERATION.rotate
    if kinds <= directions | {PointLightTable}:  # they have no size
        return None
    alone = len(items) == 1 and SphereTable not in kinds
    # ImGuizmo scales along the object's own axes; several objects only as a whole.
    return gizmo.OPERATION.scale if alone else gizmo.OPERATION.scaleu


def moved_by(scene: Scene, items: tuple[Item, ...], frame: Floats, now: Floats) -> Scene:
    """Return the scene with items moved like a handle's frame. Raises LucidaError."""
    return transform(scene, items, now @ np.linalg.inv(frame))


def cleaned(handle: HandleKind, frame: Floats, result: Floats, whole: bool = False) -> Floats:
    """Return the new frame of a handle, restricted to its kind of motion and in short numbers:
    ImGuizmo uses single precision, whose noise would end up in the scene's file.

    result: ImGuizmo's, (4, 4).
    whole: one axis scales all.
    """
    now = frame.copy()
    if handle == "move":
        offset = result[:3, 3] - frame[:3, 3]
        still = np.isclose(result[:3, 3], frame[:3, 3], rtol=1e-6, atol=0)
        short = [float(f"{part:.{DIGITS}g}") for part in offset]
        now[:3, 3] += np.where(still, 0.0, short)
    elif handle == "scale":
        sizes = [np.linalg.norm(matrix[:3, :3], axis=0) for matrix in (frame, result)]
        ratios = sizes[1] / sizes[0]
        if whole:
            ratios[:] = ratios[np.abs(np.log(ratios)).argmax()]
        now[:3, :3] *= [float(f"{ratio:.5g}") for ratio in ratios]
    else:
        left, _, right = np.linalg.svd(result[:3, :3] @ np.linalg.inv(frame[:3, :3]))
        now[:3, :3] = _turn_of(left @ right) @ frame[:3, :3]
    return now


def _turn_of(turn: Floats) -> Floats:
    """Return a rotation (3, 3) whose axis and angle are short numbers."""
    way = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    size = float(np.linalg.norm(way))
    if size < 1e-5:  # none, or half a turn, whose axis is not in there
        return turn
    axis = np.where(np.abs(way) < 1e-5 * size, 0.0, way)
    axis /= np.linalg.norm(axis)
    angle = np.radians(round(np.degrees(np.arctan2(size, np.trace(turn) - 1)), 4))
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    found: Floats = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return found
