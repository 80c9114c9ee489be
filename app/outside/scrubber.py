"""The scrubber of the growing formula: a play button and its stages, for lecture and probe.

It plays while the outside view is visible. With reduced motion it jumps from stage to stage.
"""

from __future__ import annotations

import time

from imgui_bundle import ImVec2, imgui

from app.host.view import Host
from app.outside.growing import GROWS, shares, stage_at, stages_of, terms
from app.outside.options import OutsideOptions
from app.widgets import theme
from app.widgets.areas import focused_steps, mouse_area
from app.widgets.inline_math import inline_math
from app.widgets.rows import button_width

STAGE_S = 1.5
LABEL = 0.86  # of a stage's symbol, in parts of its room
TIP = "How the formula of the marked pixel grows in the outside view. Drag, or press Play (Y)."
PLAY_TIPS = {False: "play (Y)", True: "pause (Y)"}


class Scrubber:
    """The position of the formula, and the clock while it plays. view: the outside view's name."""

    def __init__(self, view: str) -> None:
        self._view = view
        self._began: tuple[float, float] | None = None  # the time and the position
        self._shown: float | None = None  # while it plays

    @property
    def playing(self) -> bool:
        return self._began is not None

    def toggle(self, host: Host) -> None:
        """Play on from here, or from the beginning; or pause. Open the outside view if needed."""
        if self.playing:
            self._began = None
            return
        now = host.state.of(OutsideOptions).formula
        end = len(stages_of(host.renderers.camera(host.state)))
        start = 0.0 if now is None or now >= end else now
        state = host.state.with_options(outside={"formula": start, "ray": True})
        if state.marked is None and min(host.renderers.size) > 0:
            width, height = host.renderers.size
            state = state.with_options(marked=(height // 3, 2 * width // 3))
        host.change(state)
        host.show(self._view)
        self._began, self._shown = (time.monotonic(), start), start
        host.animate()

    def follow(self, host: Host) -> None:
        """Move on while it plays. Call once a frame in which the outside view is visible."""
        if self._began is None:
            return
        if host.state.of(OutsideOptions).formula != self._shown or not host.moves:
            self._began = None  # undo, another step of a lecture, the mouse
            return
        began, start = self._began
        position = start + (time.monotonic() - began) / STAGE_S
        end = len(stages_of(host.renderers.camera(host.state)))
        if position >= end:
            position, self._began = float(end), None
        elif host.state.preferences.reduced_motion:
            position = int(position) + GROWS
        if position != self._shown:
            host.amend(host.state.with_options(outside={"formula": position}))
            self._shown = position
        if self.playing:
            host.animate()

    def draw(self, host: Host) -> None:
        """Draw the button and the stages in a row."""
        em = imgui.get_font_size()
        name = "Pause" if self.playing else "Play"
        wide = button_width("Pause")
        if imgui.button(f"{name}###formula", ImVec2(wide, 0)):
            self.toggle(host)
        imgui.set_item_tooltip(PLAY_TIPS[self.playing])
        imgui.same_line()
        corner = imgui.get_cursor_screen_pos()
        room = ImVec2(max(1.0, imgui.get_content_region_avail().x), imgui.get_frame_height())
        mouse_area("stages", room)
        camera = host.renderers.camera(host.state)
        symbols = terms(camera, host.state.options.notation)
        end = len(symbols)
        if imgui.is_item_active():
            part = (imgui.get_io().mouse_pos.x - corner.x) / room.x
            chosen = {"formula": min(max(end * part, 0.0), float(end)), "ray": True}
            host.apply(host.state.with_options(outside=chosen))
        if step := focused_steps()[0]:
            now = host.state.of(OutsideOptions).formula
            there = min(max(int(end if now is None else now) + (step > 0) - (step < 0), 0), end)
            host.apply(host.state.with_options(outside={"formula": float(there), "ray": True}))
        imgui.set_item_tooltip(TIP)
        position = host.state.of(OutsideOptions).formula
        _stages(end if position is None else position, symbols, corner, room, em)


def _stages(
    position: float, symbols: dict[str, str], corner: ImVec2, room: ImVec2, em: float
) -> None:
    """Draw the stages as a row of cells that fill one after another."""
    stages = tuple(symbols)
    draw, width, gap = imgui.get_window_draw_list(), room.x / len(stages), theme.px(2)
    for number, (stage, share) in enumerate(shares(position, stages).items()):
        low = ImVec2(corner.x + number * width, corner.y)
        high = ImVec2(low.x + width - gap, corner.y + room.y)
        draw.add_rect_filled(low, high, theme.u32(theme.FRAME), theme.px(3))
        filled = ImVec2(low.x + share * (high.x - low.x), high.y)
        draw.add_rect_filled(low, filled, theme.u32(theme.FILL), theme.px(3))
        if stage_at(position, stages) == stage:
            draw.add_rect(low, high, theme.u32(theme.MARK), theme.px(3), theme.line_px(2.0))
        made = inline_math(symbols[stage], em, theme.TEXT, most_px=LABEL * width)
        baseline = (low.y + high.y + made.ascent - made.descent) / 2
        made.draw((low.x + high.x - made.width) / 2, baseline, theme.TEXT)
