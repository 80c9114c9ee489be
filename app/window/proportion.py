"""The division of the window among a layout's dock spaces.

This module keeps the spaces' shares while the window is resized; ImGui saves their sizes. layout.py
decides where the spaces are and which views they contain.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from imgui_bundle import imgui

from lucida.app.ui import layout

ARRANGING_FRAMES = 3  # until a layout's dock spaces exist again
ROUNDED_PX = 1.5  # largest rounding of a dock space's size by ImGui
LEAST_ROOM_PX = 200.0  # for both images; in less, ImGui's smallest sizes decide


@dataclass
class _Share:
    """The share of a space in the parent space that it was split from.

    room: the parent's size when the share was last set.
    size: the space's size at that time, which ImGui rounds. Shares from rounded sizes would drift.
    settling: the number of frames until ImGui has the new sizes.
    again: the number of frames in which to set the sizes again.
    """

    part: float = 0.5
    room: float = 0.0
    size: float = 0.0
    settling: int = 0
    again: int = 0

    def keep(
        self,
        node: imgui.internal.DockNode,
        parent: imgui.internal.DockNode,
        other: imgui.internal.DockNode,
        x: bool,
    ) -> None:
        """Set the node's size from its share, or its share from its size. other: the node next to
        it.
        """
        size, room = (node.size.x, parent.size.x) if x else (node.size.y, parent.size.y)
        room -= imgui.get_style().docking_separator_size
        kept = (node.size_ref.x, other.size_ref.x) if x else (node.size_ref.y, other.size_ref.y)
        if not self.room and min(kept) > 0:
            self.part = kept[0] / sum(kept)  # the layout's, or what ImGui has saved
        if room != self.room or self.again:
            self.again = max(0, self.again - 1)
            size = max(1.0, float(round(self.part * room)))  # ImGui saves whole numbers
            left = max(1.0, room - size)
            for one, side in ((node, size), (other, left)):
                new = (side, one.size.y) if x else (one.size.x, side)
                imgui.internal.dock_builder_set_node_size(one.id_, new)
            self.room, self.size, self.settling = room, size, 2
        elif self.settling:
            self.settling -= 1
        elif room > LEAST_ROOM_PX and abs(size - self.size) > ROUNDED_PX:  # moved by the user
            self.part, self.size = size / room, size


class Proportion:
    """A layout manager that keeps the spaces' shares when the window is resized, and the camera's
    panel as wide as its numbers.

    ImGui alone would resize only one of the spaces. The user's own division is kept even when the
    views are rearranged.
    """

    def __init__(self) -> None:
        self._layout = ""
        self._shares: dict[tuple[str, str], _Share] = {}  # by layout and space
        self._arranged = 0

    def keep(self, arranged: int = 0) -> None:
        """Update the shares. Call once a frame. arranged: a number that changes with each call of
        arrange().
        """
        if min(layout.window_px()) < LEAST_ROOM_PX:
            self._layout = ""  # ImGui divides a tiny window; set all again afterwards
            return
        shown = layout.current()
        anew = arranged != self._arranged or shown.name != self._layout
        self._arranged, self._layout = arranged, shown.name
        if not imgui.is_mouse_down(imgui.MouseButton_.left):
            _keep_camera()
        for whole, space, direction, _ in shown.splits:
            if space == layout.CAMERA_SPACE:  # whose width follows its numbers
                continue
            across = direction in (layout.LEFT, layout.RIGHT)
            axis = imgui.internal.Axis.x if across else imgui.internal.Axis.y
            node = _side(layout.node_of(space), axis)
            parent = node.parent_node if node is not None else None
            if node is None or parent is None or min(*parent.size, *node.size) <= 0:
                continue
            other = _child(layout.node_of(whole), parent)
            if other is None or node.is_empty() or other.is_empty():
                continue  # the one with views fills the parent
            if tuple(node.size) == tuple(parent.size):  # nothing is next to it
                continue
            share = self._shares.setdefault((shown.name, space), _Share())
            if anew and share.room:
                share.again = ARRANGING_FRAMES
            share.keep(node, parent, other, across)


def _keep_camera() -> None:
    """Keep the camera's panel as wide as its numbers, at any type size."""
    node = _side(layout.node_of(layout.CAMERA_SPACE), imgui.internal.Axis.x)
    parent = node.parent_node if node is not None else None
    if node is None or parent is None or not (parent.size.x > 0 and node.size.y > 0):
        return
    width = math.floor(layout.camera_width_px(parent.size.x, imgui.get_font_size()))
    if width >= 1 and abs(node.size.x - width) >= 1:
        imgui.internal.dock_builder_set_node_size(node.id_, (width, node.size.y))


def _child(
    node: imgui.internal.DockNode | None, parent: imgui.internal.DockNode
) -> imgui.internal.DockNode | None:
    """Return the node, or the one around it, that is a child of `parent`."""
    while node is not None and (node.parent_node is None or node.parent_node.id_ != parent.id_):
        node = node.parent_node
    return node


def _side(
    node: imgui.internal.DockNode | None, axis: imgui.internal.Axis
) -> imgui.internal.DockNode | None:
    """Return the node, or the one around it, that has a neighbour along `axis`."""
    while node is not None:
        parent = node.parent_node
        if parent is None or parent.split_axis == axis:
            return node
        node = parent
    return None
