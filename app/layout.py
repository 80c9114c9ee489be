"""Where the windows are docked.

Owns the names of the dock spaces and the default layout:

    +----------+-----------------+-----------------+
    |  camera  |      left       |      right      |
    +----------+-----------------+-----------------+

Further windows (outside view, instruments) get spaces below `left` and `right` by further splits
and layouts; each window only names its space. Knows nothing of what the windows show.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from imgui_bundle import hello_imgui, imgui

CAMERA_SPACE = "CameraSpace"
LEFT_SPACE = "MainDockSpace"  # HelloImGui's own name for what is left over
RIGHT_SPACE = "RightSpace"

CAMERA_WIDTH_EM = 19.5
LEAST_ROOM_PX = 200.0  # for both images; in less, ImGui's smallest sizes decide


def side_by_side(
    windows: Sequence[hello_imgui.DockableWindow], window_width_px: float, em_px: float
) -> hello_imgui.DockingParams:
    """The default layout: the camera's panel, and the two images at the same size."""
    params = hello_imgui.DockingParams()
    params.layout_name = "Side by side"
    camera = camera_width_px(window_width_px, em_px) / window_width_px
    params.docking_splits = [
        _split("MainDockSpace", CAMERA_SPACE, imgui.Dir.left, camera),
        _split("MainDockSpace", RIGHT_SPACE, imgui.Dir.right, 0.5),
    ]
    params.dockable_windows = list(windows)
    # A tab has a close button already.
    params.main_dock_space_node_flags = int(imgui.internal.DockNodeFlagsPrivate_.no_close_button)
    return params


def camera_width_px(window_width_px: float, em_px: float) -> float:
    """What the camera's panel needs for its numbers, but never most of a small window."""
    return min(0.4 * window_width_px, CAMERA_WIDTH_EM * em_px)


class Proportion:
    """Keeps the two images' shares of the room when the window is resized, and the camera's panel
    as wide as its numbers are.

    ImGui would give all of the difference to one of them. The user's own division stays.
    """

    def __init__(self) -> None:
        self._room = 0.0
        self._share = 0.5
        self._settling = 0  # frames until the new sizes are there

    def keep(self) -> None:
        """Call once a frame."""
        if not imgui.is_mouse_down(imgui.MouseButton_.left):
            self._widen_camera()
        node = _node(RIGHT_SPACE)
        parent = node.parent_node if node is not None else None
        if node is None or parent is None or not (parent.size.x > 0 and node.size.y > 0):
            return
        if not self._room and 0 < node.size_ref.x < parent.size_ref.x:
            self._share = node.size_ref.x / parent.size_ref.x  # as saved, or the layout's
        if parent.size.x != self._room:
            size = (max(1.0, self._share * parent.size.x), node.size.y)
            imgui.internal.dock_builder_set_node_size(node.id_, size)
            self._room, self._settling = parent.size.x, 2
        elif self._settling:
            self._settling -= 1
        elif parent.size.x > LEAST_ROOM_PX:
            self._share = node.size.x / parent.size.x

    def _widen_camera(self) -> None:
        """A window that was restored, or enlarged, may leave the panel less than it needs."""
        node = _node(CAMERA_SPACE)
        parent = node.parent_node if node is not None else None
        if node is None or parent is None or not (parent.size.x > 0 and node.size.y > 0):
            return
        least = math.floor(camera_width_px(parent.size.x, imgui.get_font_size()))
        if least >= 1 and node.size.x < least - 1:
            imgui.internal.dock_builder_set_node_size(node.id_, (least, node.size.y))


def _node(space: str) -> imgui.internal.DockNode | None:
    """A dock space; None while it is not there."""
    params = hello_imgui.get_runner_params().docking_params
    number = params.dock_space_id_from_name(space)
    return imgui.internal.dock_builder_get_node(number) if number is not None else None


def _split(
    space: str, new_space: str, direction: imgui.Dir, ratio: float
) -> hello_imgui.DockingSplit:
    split = hello_imgui.DockingSplit()
    split.initial_dock, split.new_dock = space, new_space
    split.direction, split.ratio = direction, ratio
    return split
