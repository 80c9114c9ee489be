"""One algorithm in the loop stepper: its code, canvas and variables.

Takes moments, returns wishes. controls.py has the buttons above.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.stepper.drawing import Drawn, draw_program, written
from lucida.app.instruments.stepper.model import Moment
from lucida.app.instruments.stepper.numbers import numbers
from lucida.app.instruments.stepper.recording import MOST_STEPS, Order, Recording
from lucida.app.state.app_state import AppState
from lucida.app.ui.canvas import Marks
from lucida.app.ui.rows import follow
from lucida.app.ui.theme import Fonts

TITLES = {Order.RASTER: "Object order: rasterization", Order.IMAGE: "Image order: ray tracing"}
SLIDER_EM = 12.0  # the least width of the slider next to a title
PROGRAM = 0.68  # of the height


def run_panel(
    recording: Recording, moment: Moment, texture: int, state: AppState, fonts: Fonts
) -> int | None:
    """Draw the name, the slider of the step, code, canvas and variables.

    texture: of the canvas. Return the step that the slider asks for.
    """
    imgui.push_font(fonts.bold, 0.0)
    imgui.align_text_to_frame_padding()
    imgui.text(TITLES[recording.order])
    imgui.pop_font()
    follow(SLIDER_EM * imgui.get_font_size())
    step = _slider(recording, moment)
    options = state.options
    lines, lit = written(recording.source.lines, {moment.line: 1.0}, state)
    corners = tuple((corner.x, corner.y) for corner in moment.corners or ())
    drawn = Drawn(
        lines, lit, texture, recording.size, Marks(moment.pixel, moment.box, corners),
        options.indexing.value,
    )  # fmt: skip
    low, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    high = PROGRAM * room.y
    draw_program(drawn, low, ImVec2(room.x, high), fonts)
    imgui.set_cursor_screen_pos(low + ImVec2(0, high))
    imgui.begin_child("variables")
    numbers(moment.variables, options.indexing, options.notation, fonts)
    imgui.end_child()
    return step


def _slider(recording: Recording, moment: Moment) -> int | None:
    """Draw the slider of the run's step. Return the step that it asks for."""
    most = max(1, len(recording) - 1)
    imgui.set_next_item_width(-1)
    note = f"step %d of {most}"
    if recording.truncated:
        note += f" (stopped after {MOST_STEPS}: take fewer pixels)"
    changed, step = imgui.slider_int(
        f"##step {recording.order.name}", moment.step, 0, most, note,
        imgui.SliderFlags_.always_clamp,
    )  # fmt: skip
    return step if changed else None
