"""The controls that appear while the mouse moves, and the typed number of a step."""

from __future__ import annotations

import time

from imgui_bundle import imgui

from lucida.app.ui.host import Host

from .foot import foot
from .session import LectureSession

CONTROLS_S = 2.0  # until controls disappear after the mouse stops
DIGITS = 3  # most digits of a step's number


class Controls:
    """The controls of a lecture."""

    def __init__(self) -> None:
        self._moved_s = 0.0  # when the mouse moved last
        self._typed = ""

    @property
    def shown(self) -> bool:
        """True while the mouse moves or a popup is open, and two seconds after that."""
        return time.monotonic() - self._moved_s < CONTROLS_S or bool(self._typed)

    def follow(self, host: Host) -> int | None:
        """Handle the mouse and digits. Call this once a frame. Return the entered step, from 0."""
        io = imgui.get_io()
        popup = imgui.PopupFlags_.any_popup_id | imgui.PopupFlags_.any_popup_level
        has_moved = host.moves and (io.mouse_delta.x or io.mouse_delta.y)
        if has_moved or imgui.is_popup_open("", int(popup)):
            self._moved_s = time.monotonic()
        if self.shown:
            host.animate()
        if io.want_text_input or io.key_ctrl or io.key_shift or io.key_alt:
            self._typed = ""
            return None
        for digit in range(10):
            if imgui.is_key_pressed(imgui.Key(int(imgui.Key._0) + digit)):
                self._typed = (self._typed + str(digit))[-DIGITS:]
        if not self._typed or not imgui.is_key_pressed(imgui.Key.enter):
            return None
        number, self._typed = int(self._typed) - 1, ""
        return number

    def draw(self, host: Host, session: LectureSession) -> int | str | None:
        """Draw the foot. Return the user's request, see foot()."""
        is_shown = not host.state.preferences.presentation or self.shown
        imgui.push_style_var(imgui.StyleVar_.alpha, float(is_shown))
        asked = foot(session, self._typed)
        imgui.pop_style_var()
        return asked
