"""The division of the room among a layout's dock spaces.

Keeps the spaces' shares while the window is resized and from one start to the next. layout.py
decides where the spaces are and what is in them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from imgui_bundle import imgui

from app.host import layout

ARRANGING_FRAMES = 3  # until a layout's dock spaces exist again
RESTORING_FRAMES = 5  # at a start, until the layout of the session is there
ROUNDED_PX = 1.5  # largest rounding of a dock space's size by ImGui
LEAST_ROOM_PX = 200.0  # for both images; in less, ImGui's smallest sizes decide


@dataclass
class _Share:
    """The share of a space in the room that it was split from.

    room: the size of that room when the share was last set.
    size: the space's size at that time, which ImGui rounds. Shares from rounded sizes would drift.
    settling: the frames until the new sizes are there.
    again: the frames in which they are set again.
    known: True if the share comes from a session, not from the layout.
    """

    part: float = 0.5
    known: bool = False
    room: float = 0.0
    size: float = 0.0
    settling: int = 0
    again: int = 0

    def keep(self, node: imgui.internal.DockNode, parent: imgui.internal.DockNode, x: bool) -> None:
        size, room = (node.size.x, parent.size.x) if x else (node.size.y, parent.size.y)
        kept = (node.size_ref.x, parent.size_ref.x) if x else (node.size_ref.y, parent.size_ref.y)
        if not self.room and not self.known and 0 < kept[0] < kept[1]:
            self.part = kept[0] / kept[1]  # the layout's, or about what ImGui has saved
        if room != self.room or self.again:
            self.again = max(0, self.again - 1)
            size = max(1.0, float(round(self.part * room)))  # ImGui saves whole numbers
            new = (size, node.size.y) if x else (node.size.x, size)
            imgui.internal.dock_builder_set_node_size(node.id_, new)
            self.room, self.size, self.settling = room, size, 2
        elif self.settling:
            self.settling -= 1
        elif room > LEAST_ROOM_PX and abs(size - self.size) > ROUNDED_PX:  # moved by the user
            self.part, self.size = size / room, size


class Proportion:
    """Keeps the spaces' shares when the window is resized, and the camera's panel as wide as its
    numbers.

    ImGui alone would resize only one of the spaces. The user's own division stays, also when the
    views are rearranged.
    """

    def __init__(self) -> None:
        self._layout = ""
        self._shares: dict[tuple[str, str], _Share] = {}  # by layout and space
        self._em_px = 0.0
        self._camera = (0.0, 0.0)  # its last width, in pixels and in em, unrounded
        self._arranged = 0
        self._restoring = 0  # frames in which sizes that ImGui has saved are overruled

    def parts(self) -> dict[str, float]:
        """Return the spaces' shares, for a session. ImGui saves whole pixels, and the room may have
        another size at the next start.
        """
        return {"/".join(key): share.part for key, share in self._shares.items() if share.room}

    def restore(self, parts: dict[str, float]) -> None:
        """Restore a session's shares, before the first frame. Invalid ones are ignored."""
        for one in layout.LAYOUTS:
            for _, space, _, _ in one.splits:
                part = parts.get(f"{one.name}/{space}", 0.0)
                if 0.0 < part < 1.0:
                    self._shares[one.name, space] = _Share(part, known=True)
        self._restoring = RESTORING_FRAMES

    def keep(self, arranged: int = 0) -> None:
        """Update the shares. Call once a frame. arranged: a number that changes with each call of
        arrange().
        """
        shown = layout.current()
        anew = arranged != self._arranged or shown.name != self._layout or self._restoring > 0
        self._arranged, self._layout = arranged, shown.name
        self._restoring = max(0, self._restoring - 1)
        if not imgui.is_mouse_down(imgui.MouseButton_.left):
            self._widen_camera()
        for whole, space, direction, _ in shown.splits:
            # The camera's width follows its numbers. ImGui keeps the division elsewhere.
            if whole != layout.MAIN or space == layout.CAMERA_SPACE:
                continue
            across = direction in (imgui.Dir.left, imgui.Dir.right)
            axis = imgui.internal.Axis.x if across else imgui.internal.Axis.y
            node = _side(layout.node_of(space), axis)
            parent = node.parent_node if node is not None else None
            if node is None or parent is None or min(*parent.size, *node.size) <= 0:
                continue
            share = self._shares.setdefault((shown.name, space), _Share())
            if anew and share.room:
                share.again = ARRANGING_FRAMES
            share.keep(node, parent, across)

    def _widen_camera(self) -> None:
        """Widen the camera's panel if it is too narrow after the window was restored or enlarged.
        Its width follows the type size.
        """
        node = _side(layout.node_of(layout.CAMERA_SPACE), imgui.internal.Axis.x)
        parent = node.parent_node if node is not None else None
        if node is None or parent is None or not (parent.size.x > 0 and node.size.y > 0):
            return
        em_px = imgui.get_font_size()
        least = math.floor(layout.camera_width_px(parent.size.x, em_px))
        follows = em_px != self._em_px and self._em_px > 0  # the type's size has changed
        if abs(node.size.x - self._camera[0]) > ROUNDED_PX:  # moved by the user
            self._camera = node.size.x, node.size.x / (self._em_px or em_px)
        width = self._camera[1] * em_px
        self._em_px = em_px
        short = node.size.x < (least - 1 if least == self._camera[0] else least)
        if least >= 1 and (follows or short):
            width = max(min(width, 0.5 * parent.size.x) if follows else 0.0, least)
            imgui.internal.dock_builder_set_node_size(node.id_, (width, node.size.y))
            self._camera = width, self._camera[1]


def _side(
    node: imgui.internal.DockNode | None, axis: imgui.internal.Axis
) -> imgui.internal.DockNode | None:
    """Return the node, or the one around it, that is next to (x), or above or below (y),
    another.
    """
    while node is not None:
        parent = node.parent_node
        if parent is None or parent.split_axis == axis:
            return node
        node = parent
    return None
