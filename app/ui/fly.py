"""Flying through a 3D view with the keys W, A, S, D, Q and E, while the mouse is over it.

navigation.py computes the motion. The view selects the camera that flies (Instrument.flown).
"""

from __future__ import annotations

from imgui_bundle import imgui

from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.renderer.camera.navigation import flown
from lucida.renderer.system.errors import LucidaError

Key = imgui.Key

# Right, up and forward.
KEYS = {
    Key.w: (0, 0, 1),
    Key.s: (0, 0, -1),
    Key.a: (-1, 0, 0),
    Key.d: (1, 0, 0),
    Key.q: (0, -1, 0),
    Key.e: (0, 1, 0),
}
SPEED = 0.35  # of the scene's reach, in a second
FASTER = 4.0  # with Shift
LONGEST_FRAME_S = 0.1  # a frame that took longer, or came after a rest, counts as that


def held() -> tuple[int, int, int]:
    """Return the direction of the pressed keys: right, up and forward.

    (0, 0, 0) if the keys mean something else (text, a shortcut with Ctrl or Alt, a menu).
    """
    io = imgui.get_io()
    popup = imgui.PopupFlags_.any_popup
    if io.want_text_input or io.key_ctrl or io.key_alt or io.key_super:
        return 0, 0, 0
    if imgui.is_popup_open("", int(popup)):
        return 0, 0, 0
    ways = [way for key, way in KEYS.items() if imgui.is_key_down(key)]
    right, up, forward = (sum(way[k] for way in ways) for k in range(3))
    return right, up, forward


def way_flown(reach: float, frame_s: float, faster: bool) -> float:
    """Return how far one frame moves, in world units. reach: the scene's. frame_s: the frame's
    duration.
    """
    return SPEED * reach * min(frame_s, LONGEST_FRAME_S) * (FASTER if faster else 1.0)


class Fly:
    """The state of a flight. It lasts while keys are held, stays in the view in which it began, and
    is one undo step.
    """

    def __init__(self) -> None:
        self._view: Instrument | None = None
        self._number = 0

    @property
    def under_way(self) -> bool:
        return self._view is not None

    def frame(self, host: Host, over: Instrument | None) -> None:
        """Advance the flight. Call once a frame. over: the view under the mouse."""
        right, up, forward = held()
        if not (right or up or forward):
            self._view = None
            return
        began = self._view is None
        if began:
            self._view = over
            self._number += 1
        camera = self._view.flown(host) if self._view is not None else None
        if self._view is None or camera is None:
            self._view = None
            return
        io = imgui.get_io()
        length = way_flown(host.focus.reach, io.delta_time, io.key_shift)
        try:
            camera = flown(camera, right * length, up * length, forward * length)
        except LucidaError:  # as far out as numbers go
            return
        # In the middle of a drag, both are one step.
        gesture = None if imgui.is_any_item_active() else ("fly", self._number)
        host.apply(self._view.with_flown(host.state, camera), gesture)
        host.animate()
