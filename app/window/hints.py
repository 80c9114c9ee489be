"""The hints of the first start: four things to try, shown over the images until one is tried."""

from __future__ import annotations

import contextlib
from pathlib import Path

from imgui_bundle import ImVec2, imgui

from lucida.app.images.pair.view import RASTER, RAY
from lucida.app.lecture.actions import LECTURE
from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.host import Host
from lucida.app.ui.lettering import lettering
from lucida.app.ui.messages import overlay
from lucida.app.ui.stage import Rect

SEEN = "hints-seen"  # the file that records this
HINTS = {
    RASTER: (("Drag", "to turn the camera"), ("Click", "a pixel to mark it")),
    RAY: (("P", "for parallel projection"),),
}
BEGIN = "Begin the lecture"
WIDTH_EM = 16.0


class Hints:
    """The hints of a window. shown: True while they are visible. folder: the settings folder; None
    shows no hints.
    """

    def __init__(self, folder: Path | None) -> None:
        self._file = folder / SEEN if folder is not None else None
        self.shown = self._file is not None and not self._file.exists()
        self._first: AppState | None = None

    def draw(self, window: Host, rects: dict[str, Rect]) -> None:
        """Draw the hints over both images, and remove them for good once one was followed."""
        state = window.present
        if self.shown and self._was_followed(state):
            self.shown = False
            if self._file is not None:
                with contextlib.suppress(OSError):
                    self._file.parent.mkdir(parents=True, exist_ok=True)
                    self._file.touch()
        if not (self.shown and window.has_tools):
            return
        em, flags = imgui.get_font_size(), imgui.WindowFlags_
        for view in HINTS.keys() & rects.keys():
            left, _, right, bottom = rects[view]
            at, width = ImVec2((left + right) / 2, bottom - em), min(WIDTH_EM * em, right - left)
            passive = flags.no_focus_on_appearing | (flags.no_inputs if view == RASTER else 0)
            with overlay(f"##hints {view}", at, (0.5, 1), width, theme.ACCENT, int(passive)):
                for key, text in HINTS[view]:
                    with lettering(window.fonts.bold):
                        imgui.text(key)
                    imgui.same_line()
                    imgui.text(text)
                if view == RAY and imgui.button(BEGIN):
                    LECTURE[0].run(window)

    def _was_followed(self, state: AppState) -> bool:
        if self._first is None or state.scene is not self._first.scene:
            self._first = state  # a scene that was read meanwhile has a camera of its own
        return (
            state.camera != self._first.camera
            or state.marked not in (None, self._first.marked)
            or state.step is not None
        )
