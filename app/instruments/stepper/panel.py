"""The loop stepper's controls, and one algorithm: its code, canvas and variables.

Its functions take states and moments, and return states and wishes.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from imgui_bundle import ImVec2, imgui

from lucida.app.state.app_state import AppState
from lucida.app.state.options import Options
from lucida.app.ui import theme
from lucida.app.ui.canvas import Marks
from lucida.app.ui.checks import checkbox
from lucida.app.ui.explaining import symbols
from lucida.app.ui.lettering import underline
from lucida.app.ui.rows import button_width, follow, tip
from lucida.app.ui.theme import Fonts

from .drawing import Drawn, draw_program, written
from .model import Moment, Variable, Wish, describe
from .recording import MOST_STEPS, Recording

CANVASES = ((4, 3), (8, 6), (16, 12), (32, 24), (64, 48))
SLIDER_EM = 12.0  # the least width of the slider next to a title
PROGRAM = 0.68  # the program's share of the height
INDICES = ("i", "j", "rows", "columns")  # the variables that count pixels
EDGES = ("ea", "eb", "ec")


class Step(NamedTuple):
    """A wish with its button, its description, and its keys as text and as ImGui's numbers."""

    wish: Wish
    button: str
    told: str
    shown: str
    chord: int


_KEY = imgui.Key
STEPS = (
    Step("back", "Back", "one line back", "Left", int(_KEY.left_arrow)),
    Step("step", "Step", "one line on", "Right", int(_KEY.right_arrow)),
    Step("pixel", "Next pixel", "to the next pixel's turn", "Down", int(_KEY.down_arrow)),
    Step(
        "object",
        "Next object",
        "to the next object's turn",
        "Shift+Down",
        int(_KEY.mod_shift) | int(_KEY.down_arrow),
    ),
)


def controls(state: AppState) -> tuple[AppState, Wish]:
    """Draw the controls. Return the state after them, and the wish of a clicked button."""
    wish: Wish = ""
    for number, (name, label, told, keys, *_) in enumerate(STEPS):
        if number:
            follow(button_width(label))
        if imgui.button(f"{label}###{name}"):
            wish = name
        imgui.set_item_tooltip(f"{told} ({keys})")
    options = state.options.stepper
    sizes = list(dict.fromkeys([*CANVASES, options.canvas]))  # a lecture may ask for any size
    texts = [f"{width} x {height} pixels" for width, height in sizes]
    width = imgui.calc_text_size(texts[-1]).x + 2.2 * imgui.get_frame_height()
    follow(width)
    imgui.set_next_item_width(width)
    changed, number = imgui.combo("##pixels", sizes.index(options.canvas), texts)
    if changed:
        options = replace(options, canvas=sizes[number], steps=(0, 0))
    follow(imgui.calc_text_size("Julia").x + 1.5 * imgui.get_frame_height())
    changed, is_julia = checkbox("Julia", state.options.language == "julia")
    tip("the same lines in Julia; the code that runs is Python")
    if changed:
        language = replace(state.options, language="julia" if is_julia else "python")
        state = state.with_options(language)
    return state.with_options(options), wish


def keys() -> Wish:
    """Return the wish of a pressed key while the panel has the focus.

    The panel takes these keys from ImGui's navigation, which keeps Tab and Enter.
    """
    flags = int(imgui.InputFlags_.route_focused) | int(imgui.InputFlags_.repeat)
    pressed = [step.wish for step in STEPS if imgui.shortcut(step.chord, flags)]
    return pressed[0] if pressed and not imgui.is_any_item_active() else ""


def run_panel(
    title: str, recording: Recording, moment: Moment, texture: int, state: AppState, fonts: Fonts
) -> int | None:
    """Draw the title, the slider of the step, code, canvas and variables.

    texture: the canvas's texture. Return the step to which the slider was moved, or None.
    """
    imgui.push_font(fonts.bold, 0.0)
    imgui.align_text_to_frame_padding()
    imgui.text(title)
    imgui.pop_font()
    follow(SLIDER_EM * imgui.get_font_size())
    imgui.set_next_item_width(-1)
    most = max(1, len(recording) - 1)
    note = f"step %d of {most}"
    if recording.truncated:
        note += f" (stopped after {MOST_STEPS}: take fewer pixels)"
    flags = imgui.SliderFlags_.always_clamp
    changed, step = imgui.slider_int(f"##step {title}", moment.step, 0, most, note, flags)
    lines, lit = written(recording.source.lines, {moment.line: 1.0}, state)
    corners = tuple((corner.x, corner.y) for corner in moment.corners or ())
    marks, base = Marks(moment.pixel, moment.box, corners), state.options.indexing.value
    low, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    high = PROGRAM * room.y
    drawn = Drawn(lines, lit, texture, recording.size, marks, base)
    draw_program(drawn, low, ImVec2(room.x, high), fonts)
    imgui.set_cursor_screen_pos(low + ImVec2(0, high))
    imgui.begin_child("variables")
    _variables(moment.variables, state.options, fonts)
    imgui.end_child()
    return step if changed else None


def _variables(variables: tuple[Variable, ...], options: Options, fonts: Fonts) -> None:
    """Draw the variables, each in a line."""
    if not variables or not imgui.begin_table("numbers", 2, imgui.TableFlags_.no_saved_settings):
        return
    names = [symbols.program(one.name) for one in variables]
    widest = max(imgui.calc_text_size(name).x for name in names)
    imgui.table_setup_column("", imgui.TableColumnFlags_.width_fixed, widest)
    imgui.table_setup_column("", imgui.TableColumnFlags_.width_stretch)
    for shown, (name, value, changed) in zip(names, variables, strict=True):
        text, note, indexing = describe(value), "", options.indexing
        if name in INDICES:  # numbered like the code next to it
            text, note = describe(value, indexing.value), indexing.told
        elif name in EDGES:
            note = "inside" if value >= 0 else "outside"
        color = theme.legible(theme.MARK) if changed else theme.TEXT
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text_colored(theme.DIM, shown)
        imgui.table_next_column()
        imgui.push_text_wrap_pos(0.0)
        imgui.push_font(fonts.mono, 0.0)
        imgui.text_colored(color, text)
        imgui.pop_font()
        if changed:
            underline(color)
        if note:
            follow(imgui.calc_text_size(note).x)
            imgui.text_colored(theme.DIM, note)
        imgui.pop_text_wrap_pos()
    imgui.end_table()
