"""The loop stepper's panel: the controls, and one algorithm's code, canvas, variables, counters.

Owns the layout. Gets options and moments, returns wishes. What a moment is, is teach/stepper.py's.
"""

from __future__ import annotations

import functools
import inspect
from dataclasses import dataclass, replace
from typing import Literal

from imgui_bundle import ImVec2, imgui

from app import theme
from app.bounds import range_of
from app.lettering import at_most, lettering
from app.options import Pixel, StepperOptions
from app.panels.canvas import Marks, canvas
from app.panels.code import LINE, code, narrowed
from app.panels.sliders import slider_float, slider_int
from app.panels.stepper_plan import Need, Place, Plan, canvases_in, plan
from app.teach.loop_parts import (
    Canvas,
    DepthBuffer,
    bounding_box,
    color_at,
    intersect,
    viewing_ray,
)
from app.teach.recording import MOST_STEPS, Order, Recording
from app.teach.source import source_of
from app.teach.stepper import Moment
from app.theme import Fonts
from renderer.pixels import Indexing

CANVASES = ((4, 3), (8, 6), (16, 12), (32, 24), (64, 48))
ORDERS: dict[Literal["both", "object", "image"], str] = {
    "both": "both",
    "object": "object order",
    "image": "image order",
}
TITLES = {
    Order.OBJECT: "Object order: for each object, for each pixel",
    Order.IMAGE: "Image order: for each pixel, for each object",
}
WANTED_EM = 1.25  # of the code
LEAST_PX = 11.0  # of the code, at 100 %, unless the width forbids it
LONG = ("object", "ray", "hit", "closest")  # the variables that take a whole line
INDICES = ("i", "j", "rows", "columns")  # the variables that count pixels

Wish = Literal["", "first", "back", "play", "step", "pixel", "object", "last"]
_BUTTONS: tuple[tuple[Wish, str, str], ...] = (
    ("first", "First", "to the beginning (Home)"),
    ("back", "Back", "one step back (Left)"),
    ("play", "", "play and pause (Space)"),
    ("step", "Step", "one step: one line (Right)"),
    ("pixel", "Next pixel", "to where the next pixel's turn begins (Down)"),
    ("object", "Next object", "to where the next object's turn begins (Shift+Down)"),
    ("last", "Last", "to the end (End)"),
)


@dataclass(frozen=True)
class Picture:
    """OpenGL's names of an algorithm's pictures. depth: None in image order."""

    color: int | None
    depth: int | None


@dataclass(frozen=True)
class Answer:
    """What was asked for in a run's panel: a step to go to, a pixel whose turn is wanted."""

    step: int | None = None
    pixel: Pixel | None = None


def controls(options: StepperOptions, playing: bool) -> tuple[StepperOptions, Wish]:
    """The buttons, the speed, the canvas."""
    wish: Wish = ""
    width = imgui.calc_text_size("Pause").x + 2 * imgui.get_style().frame_padding.x
    for count, (name, label, tip) in enumerate(_BUTTONS):
        shown = ("Pause" if playing else "Play") if name == "play" else label
        needed = width if name == "play" else _button_width(shown)
        if count:
            _follow(needed)
        if imgui.button(f"{shown}###{name}", ImVec2(needed, 0)):
            wish = name
        imgui.set_item_tooltip(tip)
    options = _speed(options)
    options = _canvas_size(options)
    return _order(options), wish


def keys() -> Wish:
    """What the keys ask for, while the panel has them: they are taken from ImGui's navigation, to
    which Tab and Enter remain."""
    key, shift = imgui.Key, int(imgui.Key.mod_shift)
    focused = int(imgui.InputFlags_.route_focused)
    repeated = focused | int(imgui.InputFlags_.repeat)
    table: tuple[tuple[Wish, int, int], ...] = (
        ("play", int(key.space), focused),
        ("step", int(key.right_arrow), repeated),
        ("back", int(key.left_arrow), repeated),
        ("pixel", int(key.down_arrow), repeated),
        ("object", shift | int(key.down_arrow), repeated),
        ("first", int(key.home), focused),
        ("last", int(key.end), focused),
    )
    pressed = [wish for wish, chord, flags in table if imgui.shortcut(chord, flags)]
    return pressed[0] if pressed and not imgui.is_any_item_active() else ""


def _speed(options: StepperOptions) -> StepperOptions:
    width = 6.5 * imgui.get_font_size()
    _follow(width)
    imgui.set_next_item_width(width)
    changed, speed = slider_float(
        "##speed",
        options.speed,
        *range_of(StepperOptions, "speed"),
        "%.0f steps/s",
        imgui.SliderFlags_.logarithmic,
    )
    return replace(options, speed=speed) if changed else options


def _canvas_size(options: StepperOptions) -> StepperOptions:
    def name(size: tuple[int, int]) -> str:
        return f"{size[0]} x {size[1]} pixels"

    width = imgui.calc_text_size("64 x 48 pixels").x + 2.2 * imgui.get_frame_height()
    _follow(width)
    imgui.set_next_item_width(width)
    if imgui.begin_combo("##pixels", name(options.canvas)):
        for size in CANVASES:
            if imgui.selectable(name(size), size == options.canvas)[0]:
                options = replace(options, canvas=size, steps=(0, 0))
        imgui.end_combo()
    return options


def _order(options: StepperOptions) -> StepperOptions:
    width = imgui.calc_text_size("object order").x + 2.2 * imgui.get_frame_height()
    _follow(width)
    imgui.set_next_item_width(width)
    if imgui.begin_combo("##order", ORDERS[options.order]):
        for key, text in ORDERS.items():
            if imgui.selectable(text, key == options.order)[0]:
                options = replace(options, order=key)
        imgui.end_combo()
    return options


# One algorithm.


def run_panel(
    recording: Recording,
    moment: Moment | None,
    picture: Picture,
    room: ImVec2,
    fonts: Fonts,
    alone: bool,
    em_px: float,
) -> Answer:
    """Code, canvas, variables and counters, in a room. alone: the other algorithm is not shown.
    em_px: the size of type that was asked for, which the code follows."""
    imgui.push_font(fonts.bold, 0.0)
    title = TITLES[recording.order]
    if imgui.calc_text_size(title).x > room.x:
        title = title.partition(":")[0]
    imgui.text(title)
    imgui.pop_font()
    if moment is None:
        imgui.text_colored(theme.DIM, "running ...")
        return Answer()
    answer = _slider(recording, moment)
    corner, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    lines = narrowed(recording.source.lines)
    made = plan((round(room.x), round(room.y)), _need(recording, alone, em_px))

    def to(place: Place) -> ImVec2:
        imgui.set_cursor_screen_pos(ImVec2(corner.x + place.left, corner.y + place.top))
        return ImVec2(*place.size)

    _code(lines, moment, made.code_px, to(made.code), fonts)
    place = to(made.canvases)
    imgui.begin_group()
    answer = _canvases(recording, moment, picture, place, answer)
    imgui.end_group()
    _numbers(moment, to(made.numbers), made, fonts)
    return answer


def _need(recording: Recording, alone: bool, em_px: float) -> Need:
    """Two beside each other are shown alike, whichever needs more."""
    sources = [recording.source] if alone else [source_of(order.renderer) for order in Order]
    lines = [narrowed(source.lines) for source in sources]
    return Need(
        longest=max(len(line) for one in lines for line in one),
        lines=max(map(len, lines)),
        canvas=recording.size,
        has_depth=not alone or recording.order is Order.OBJECT,
        em_px=imgui.get_font_size(),
        wanted_px=WANTED_EM * em_px,
        least_px=LEAST_PX * imgui.get_style().font_scale_dpi,
    )


def _slider(recording: Recording, moment: Moment) -> Answer:
    """Where the run stands: dragged to any step."""
    most = max(1, len(recording) - 1)
    imgui.set_next_item_width(-1)
    note = f"step %d of {most}"
    if recording.truncated:
        note += f" (stopped after {MOST_STEPS}: take fewer pixels)"
    elif not recording.complete:
        note += " so far"
    changed, step = slider_int(
        f"##step {recording.order.name}", moment.step, 0, most, note,
        imgui.SliderFlags_.always_clamp,
    )  # fmt: skip
    return Answer(step=step if changed else None)


def _code(
    lines: tuple[str, ...], moment: Moment, size_px: float, room: ImVec2, fonts: Fonts
) -> None:
    """The code; where not all of it has room, the part around the present line."""
    line_px = LINE * size_px
    needed = len(lines) * line_px
    height = min(needed, max(1, int(room.y / line_px)) * line_px)  # no line is cut
    flags = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse
    imgui.begin_child("code", ImVec2(room.x, height), 0, flags)
    if needed > height:
        above = moment.line - int(0.5 * height / line_px)
        imgui.set_scroll_y(min(max(0.0, above * line_px), needed - height))
    with lettering(fonts.mono, size_px):
        code(lines, moment.line, size_px, room.x, _called())
    imgui.end_child()


@functools.cache
def _called() -> dict[str, str]:
    """The sources of what the loops call."""
    parts = (viewing_ray, bounding_box, intersect, color_at, Canvas, DepthBuffer)
    return {part.__name__: inspect.getsource(part).rstrip() for part in parts}


def _canvases(
    recording: Recording, moment: Moment, picture: Picture, room: ImVec2, answer: Answer
) -> Answer:
    """The canvas, and in object order the depth buffer beside or below it: where it has room."""
    name, size = recording.order.name, recording.size
    label = imgui.get_text_line_height_with_spacing()
    spacing = imgui.get_style().item_spacing
    has_depth = recording.order is Order.OBJECT
    gap = spacing.x, spacing.y
    upper, lower, beside = canvases_in((room.x, room.y), size, has_depth, label, gap)
    first, rest = ImVec2(*upper), ImVec2(*lower)
    dots = tuple((test.pixel, test.t < float("inf")) for test in moment.tests)
    marks = Marks(moment.pixel, moment.box, dots if recording.order is Order.OBJECT else ())
    imgui.begin_group()
    imgui.text_colored(theme.DIM, "canvas")
    clicked = canvas(picture.color, size, first, marks, f"canvas##{name}")
    imgui.set_item_tooltip("a click goes to a pixel's turn")
    imgui.end_group()
    if has_depth:
        if beside:
            imgui.same_line()
        imgui.begin_group()
        imgui.text_colored(theme.DIM, "depth")
        again = canvas(picture.depth, size, rest, Marks(moment.pixel, moment.box), f"depth##{name}")
        imgui.set_item_tooltip("for each pixel the nearest t so far, near ones bright")
        imgui.end_group()
        clicked = clicked if clicked is not None else again
    return replace(answer, pixel=clicked) if clicked is not None else answer


def _numbers(moment: Moment, room: ImVec2, made: Plan, fonts: Fonts) -> None:
    """The counters and the variables, in columns beside one another where there is more width than
    height."""
    imgui.begin_child("numbers", room)
    flags = imgui.TableFlags_.sizing_stretch_same | imgui.TableFlags_.no_saved_settings
    with at_most(made.numbers_px), lettering(None, made.numbers_px):
        rows = _rows(moment)
        short = [row for row in rows if row.name not in LONG]
        each = -(-len(short) // made.columns)
        if imgui.begin_table("columns", made.columns, flags):
            imgui.table_next_row()
            for number in range(made.columns):
                imgui.table_next_column()
                _table(f"numbers {number}", short[number * each : (number + 1) * each], fonts)
            imgui.end_table()
        _table("texts", [row for row in rows if row.name in LONG], fonts)
    imgui.end_child()


@dataclass(frozen=True)
class _Row:
    """A number and its name; note: beside it; tip: what it is."""

    name: str
    text: str
    changed: bool = False
    note: str = ""
    tip: str = ""


def _rows(moment: Moment) -> list[_Row]:
    counters = moment.counters
    counted = (
        ("tests", counters.tests, "how often an object and a ray were intersected"),
        ("writes", counters.writes, "how often a pixel of the canvas was set"),
        ("overwrites", counters.overwrites, "writes to a pixel that had been set before"),
    )
    rows = [_Row(name, f"{count:>6}", tip=tip) for name, count, tip in counted]
    for one in moment.variables:
        note = Indexing.ARRAY.told if one.name in INDICES else ""  # as the code beside it
        rows.append(_Row(one.name, one.text, one.changed, note))
    return rows


def _table(name: str, rows: list[_Row], fonts: Fonts) -> None:
    if not rows or not imgui.begin_table(name, 2, imgui.TableFlags_.no_saved_settings):
        return
    widest = imgui.calc_text_size("overwrites").x
    imgui.table_setup_column("", imgui.TableColumnFlags_.width_fixed, widest)
    imgui.table_setup_column("", imgui.TableColumnFlags_.width_stretch)
    for row in rows:
        color = theme.legible(theme.MARK) if row.changed else theme.TEXT
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text_colored(theme.DIM, row.name)
        if row.tip:
            imgui.set_item_tooltip(row.tip)
        imgui.table_next_column()
        imgui.push_text_wrap_pos(0.0)
        imgui.push_font(fonts.mono, 0.0)
        imgui.text_colored(color, row.text)
        imgui.pop_font()
        if row.note:
            imgui.same_line()
            imgui.text_colored(theme.DIM, row.note)
        imgui.pop_text_wrap_pos()
    imgui.end_table()


def _follow(width: float) -> None:
    """The next item in this row, where it has room; else in the next one."""
    spacing = imgui.get_style().item_spacing.x
    end = imgui.get_item_rect_max().x + spacing + width
    edge = imgui.get_cursor_screen_pos().x + imgui.get_content_region_avail().x
    if end <= edge:
        imgui.same_line()


def _button_width(text: str) -> float:
    return imgui.calc_text_size(text).x + 2 * imgui.get_style().frame_padding.x
