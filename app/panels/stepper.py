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
from app.lettering import lettering
from app.options import Language, Pixel, StepperOptions
from app.panels.canvas import Marks, canvas
from app.panels.checks import checkbox
from app.panels.code import code_size_px
from app.panels.listing import LEGIBLE_EM, Listing, listing
from app.panels.rows import follow
from app.teach.loop_parts import (
    Canvas,
    DepthBuffer,
    bounding_box,
    color_at,
    intersect,
    viewing_ray,
)
from app.teach.raster_parts import box_around, edge, prepared, project, shade, t_of, triangles
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
FORMS: dict[Literal["triangles", "rays"], str] = {
    "triangles": "by triangles",
    "rays": "by rays",
}
TITLES = {
    Order.RASTER: "Rasterization: for each triangle, for each pixel",
    Order.OBJECT: "Object order by rays: for each object, for each pixel",
    Order.IMAGE: "Image order: for each pixel, for each object",
}
# Panels so much wider than high have code, canvases and numbers beside one another, or the numbers.
ALL_BESIDE, NUMBERS_BESIDE = 1.9, 1.2
LEFT, UPPER = 0.64, 0.64  # the code's part of a panel whose numbers stand beside it
INDICES = ("i", "j", "rows", "columns")  # the variables that count pixels
RUNNING = f"Python, counts {Indexing.ARRAY.told}"

Wish = Literal["", "first", "back", "play", "step", "pixel", "object", "last"]
_BUTTONS: tuple[tuple[Wish, str, str], ...] = (
    ("first", "First", "to the beginning (Home)"),
    ("back", "Back", "one step back (Left)"),
    ("play", "", "play and pause (Space)"),
    ("step", "Step", "one step: one line (Right)"),
    ("pixel", "Next pixel", "to where the next pixel's turn begins (Down)"),
    ("object", "Next object", "to where the next object's or triangle's turn begins (Shift+Down)"),
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


def controls(
    options: StepperOptions, playing: bool, has_triangles: bool
) -> tuple[StepperOptions, Wish]:
    """The buttons, the speed, the canvas; in which form object order is, where the scene leaves a
    choice."""
    wish: Wish = ""
    width = imgui.calc_text_size("Pause").x + 2 * imgui.get_style().frame_padding.x
    for count, (name, label, tip) in enumerate(_BUTTONS):
        shown = ("Pause" if playing else "Play") if name == "play" else label
        needed = width if name == "play" else _button_width(shown)
        if count:
            follow(needed)
        if imgui.button(f"{shown}###{name}", ImVec2(needed, 0)):
            wish = name
        imgui.set_item_tooltip(tip)
    options = _speed(options)
    options = _canvas_size(options)
    options = _order(options)
    if options.order != "image":
        imgui.begin_disabled(not has_triangles)
        form = _form(options.form if has_triangles else "rays")
        if has_triangles and form != options.form:
            options = replace(options, form=form, steps=(0, options.steps[1]))
        imgui.end_disabled()
    return options, wish


def language(chosen: Language) -> Language:
    """Whether the same lines stand beside it in Julia. What runs is Python in any case."""
    follow(imgui.calc_text_size("Julia").x + 1.5 * imgui.get_frame_height())
    changed, beside = checkbox("Julia", chosen == "julia")
    imgui.set_item_tooltip("the same lines in Julia, for reading; Python is what runs")
    return ("julia" if beside else "python") if changed else chosen


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
    width = 8 * imgui.get_font_size()
    follow(width + imgui.calc_text_size("steps/s").x)
    imgui.set_next_item_width(width)
    changed, speed = imgui.slider_float(
        "steps/s",
        options.speed,
        *range_of(StepperOptions, "speed"),
        "%.0f",
        imgui.SliderFlags_.logarithmic,
    )
    return replace(options, speed=speed) if changed else options


def _canvas_size(options: StepperOptions) -> StepperOptions:
    def name(size: tuple[int, int]) -> str:
        return f"{size[0]} x {size[1]}"

    width = imgui.calc_text_size("64 x 48").x + 2.2 * imgui.get_frame_height()
    follow(width + imgui.calc_text_size("pixels").x)
    imgui.set_next_item_width(width)
    if imgui.begin_combo("pixels", name(options.canvas)):
        for size in CANVASES:
            if imgui.selectable(name(size), size == options.canvas)[0]:
                options = replace(options, canvas=size, steps=(0, 0))
        imgui.end_combo()
    return options


def _order(options: StepperOptions) -> StepperOptions:
    width = imgui.calc_text_size("object order").x + 2.2 * imgui.get_frame_height()
    follow(width)
    imgui.set_next_item_width(width)
    if imgui.begin_combo("##order", ORDERS[options.order]):
        for key, text in ORDERS.items():
            if imgui.selectable(text, key == options.order)[0]:
                options = replace(options, order=key)
        imgui.end_combo()
    return options


def _form(form: Literal["triangles", "rays"]) -> Literal["triangles", "rays"]:
    width = imgui.calc_text_size("by triangles").x + 2.2 * imgui.get_frame_height()
    follow(width)
    imgui.set_next_item_width(width)
    if imgui.begin_combo("##form", FORMS[form]):
        for key, text in FORMS.items():
            if imgui.selectable(text, key == form)[0]:
                form = key
        imgui.end_combo()
    imgui.set_item_tooltip(
        "object order, triangle by triangle, as graphics cards do it (spheres, which have none,\n"
        "are drawn before, by their rays), or each object by the rays of its pixels"
    )
    return form


# One algorithm.


def run_panel(
    recording: Recording,
    moment: Moment | None,
    picture: Picture,
    room: ImVec2,
    fonts: Fonts,
    indexing: Indexing,
    in_julia: bool = False,
) -> Answer:
    """Code, canvas, variables and counters, in a room. indexing: how pixels are counted in what
    stands beside the code. in_julia: the code in Julia, too."""
    imgui.push_font(fonts.bold, 0.0)
    title = TITLES[recording.order]
    if imgui.calc_text_size(title).x > room.x:
        title = title.partition(":")[0]
    imgui.text(title)
    imgui.pop_font()
    notes = [] if in_julia else [RUNNING]  # the listings say it
    if recording.order is Order.RASTER and len(recording.model.flat.spheres):
        notes.append("spheres by rays, first")  # which have no triangles
    if notes:
        note = "; ".join(notes)
        follow(imgui.calc_text_size(note).x)
        imgui.text_colored(theme.DIM, note)
    if moment is None:
        imgui.text_colored(theme.DIM, "running ...")
        return Answer()
    answer = _slider(recording, moment)
    left = imgui.get_content_region_avail()
    below = imgui.get_cursor_screen_pos()
    lines = Listing(recording.source.lines, in_julia, _called())
    longest, count = _largest()  # of both: they are shown in one size
    em = imgui.get_font_size()
    if left.x > ALL_BESIDE * left.y:
        size_px = _code_px(longest, count, 0.46 * left.x, left.y, em)
        listing(lines, moment.line, size_px, ImVec2(0.46 * left.x, left.y), fonts)
        x = 0.48 * left.x
        imgui.set_cursor_screen_pos(ImVec2(below.x + x, below.y))
        imgui.begin_group()
        answer = _canvases(
            recording, moment, picture, ImVec2(0.26 * left.x, left.y), answer, indexing
        )
        imgui.end_group()
        imgui.set_cursor_screen_pos(ImVec2(below.x + 0.755 * left.x, below.y))
        _numbers(moment, ImVec2(0.245 * left.x, left.y), size_px, fonts)
        return answer
    if (
        left.x > NUMBERS_BESIDE * left.y and not in_julia
    ):  # the canvases below the code, the numbers right of both
        size_px = beside_px((left.x, left.y), em)
        listing(lines, moment.line, size_px, ImVec2(LEFT * left.x, UPPER * left.y), fonts)
        rest = left.y - (imgui.get_cursor_screen_pos().y - below.y)
        imgui.begin_group()
        answer = _canvases(
            recording, moment, picture, ImVec2(LEFT * left.x, rest), answer, indexing
        )
        imgui.end_group()
        imgui.set_cursor_screen_pos(ImVec2(below.x + (LEFT + 0.02) * left.x, below.y))
        _numbers(moment, ImVec2((0.98 - LEFT) * left.x, left.y), size_px, fonts)
        return answer
    size_px = _code_px(longest, count, left.x, 0.56 * left.y, em)
    listing(lines, moment.line, size_px, ImVec2(left.x, 0.58 * left.y), fonts)
    left = imgui.get_content_region_avail()
    below = imgui.get_cursor_screen_pos()
    imgui.begin_group()
    answer = _canvases(recording, moment, picture, ImVec2(0.52 * left.x, left.y), answer, indexing)
    imgui.end_group()
    imgui.set_cursor_screen_pos(ImVec2(below.x + 0.54 * left.x, below.y))
    _numbers(moment, ImVec2(0.46 * left.x, left.y), size_px, fonts)
    return answer


def _slider(recording: Recording, moment: Moment) -> Answer:
    """Where the run stands: dragged to any step."""
    most = max(1, len(recording) - 1)
    imgui.set_next_item_width(-1)
    note = f"step %d of {most}"
    if recording.truncated:
        less = "object order by rays" if recording.order is Order.RASTER else "fewer pixels"
        note += f" (stopped after {MOST_STEPS}: take {less})"
    elif not recording.complete:
        note += " so far"
    changed, step = imgui.slider_int(
        f"##step {recording.order.name}", moment.step, 0, most, note,
        imgui.SliderFlags_.always_clamp,
    )  # fmt: skip
    return Answer(step=step if changed else None)


def beside_px(room: tuple[float, float], em: float) -> float:
    """The code's size in a room (width, height) where the numbers stand right of it. em: the
    window's own size of type."""
    longest, count = _largest()
    return _code_px(longest, count, LEFT * room[0], UPPER * room[1], em)


def _code_px(longest: str, count: int, width: float, height: float, em: float) -> float:
    """The code's size: all of it where that can be read, else as wide as there is room."""
    least = LEGIBLE_EM * em
    return code_size_px(longest, width, min(1.6 * em, max(least, height / (1.22 * count))))


@functools.cache
def _largest() -> tuple[str, int]:
    """The longest line of both sources, and the number of lines of the longer one."""
    sources = [source_of(order.renderer) for order in Order]
    lines = [line for source in sources for line in source.lines]
    return max(lines, key=len), max(len(source.lines) for source in sources)


@functools.cache
def _called() -> dict[str, str]:
    """The sources of what the loops call."""
    parts = (
        viewing_ray, bounding_box, intersect, color_at, Canvas, DepthBuffer,
        prepared, triangles, project, box_around, edge, t_of, shade,
    )  # fmt: skip
    return {part.__name__: inspect.getsource(part).rstrip() for part in parts}


def _canvases(
    recording: Recording,
    moment: Moment,
    picture: Picture,
    room: ImVec2,
    answer: Answer,
    indexing: Indexing,
) -> Answer:
    """The canvas, and in object order the depth buffer beside or below it: where it has room."""
    name, size = recording.order.name, recording.size
    label = imgui.get_text_line_height_with_spacing()
    spacing = imgui.get_style().item_spacing
    height = max(20.0, room.y - label)
    first = rest = ImVec2(room.x, height)
    beside = False
    has_depth = recording.order.has_depth
    if has_depth:
        below = max(20.0, height - 2 * spacing.y)
        across = room.x - spacing.x
        half = ImVec2(0.5 * across, height)  # beside one another, of one size
        choices = (
            (ImVec2(room.x, 0.67 * below), ImVec2(room.x, 0.33 * below), False),
            (half, half, True),
        )
        first, rest, beside = max(
            choices, key=lambda one: min(one[0].x / size[0], one[0].y / size[1])
        )
    dots = tuple((test.pixel, test.t < float("inf")) for test in moment.tests)
    corners = tuple((corner.x, corner.y) for corner in moment.corners or ())
    marks = Marks(moment.pixel, moment.box, dots if has_depth else (), corners)
    imgui.begin_group()
    imgui.text_colored(theme.DIM, _caption(moment, indexing, room.x))
    clicked = canvas(picture.color, size, first, marks, f"canvas##{name}")
    imgui.set_item_tooltip("a click goes to a pixel's turn")
    imgui.end_group()
    if has_depth:
        if beside:
            imgui.same_line()
        imgui.begin_group()
        if beside:
            imgui.text_colored(theme.DIM, "depth")
        again = canvas(picture.depth, size, rest, Marks(moment.pixel, moment.box), f"depth##{name}")
        imgui.set_item_tooltip("for each pixel the nearest t so far, near ones bright")
        if not beside:  # a line above it would be taken from the canvas
            imgui.same_line()
            imgui.text_colored(theme.DIM, "depth")
        imgui.end_group()
        clicked = clicked if clicked is not None else again
    return replace(answer, pixel=clicked) if clicked is not None else answer


def _caption(moment: Moment, indexing: Indexing, width: float) -> str:
    """What stands above the canvas: which pixel's turn it is, as the window counts."""
    if moment.pixel is None:
        return "canvas"
    pixel = f"pixel {indexing.text(moment.pixel)} {indexing.told}"
    whole = f"canvas, {pixel}"
    return whole if imgui.calc_text_size(whole).x <= width else pixel


def _numbers(moment: Moment, room: ImVec2, code_px: float, fonts: Fonts) -> None:
    """The counters and the variables, in type about as large as the code's."""
    imgui.begin_child("numbers", room)
    em = imgui.get_font_size()
    with lettering(None, min(max(em, 0.92 * code_px), max(0.6 * em, room.x / 16))):
        _tables(moment, fonts)
    imgui.end_child()


def _tables(moment: Moment, fonts: Fonts) -> None:
    counters = moment.counters
    flags = imgui.TableFlags_
    if imgui.begin_table("counters", 2, flags.sizing_fixed_fit | flags.no_saved_settings):
        for name, count, tip in (
            ("tests", counters.tests, "how often an object or a triangle was tested at a pixel"),
            ("writes", counters.writes, "how often a pixel of the canvas was set"),
            ("overwrites", counters.overwrites, "writes to a pixel that had been set before"),
        ):
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_colored(theme.DIM, name)
            imgui.set_item_tooltip(tip)
            imgui.table_next_column()
            imgui.push_font(fonts.mono, 0.0)
            imgui.text(f"{count:>7}")
            imgui.pop_font()
        imgui.end_table()
    imgui.separator()
    if imgui.begin_table("variables", 2, flags.no_saved_settings):
        widest = imgui.calc_text_size("columns").x
        imgui.table_setup_column("", imgui.TableColumnFlags_.width_fixed, widest)
        imgui.table_setup_column("", imgui.TableColumnFlags_.width_stretch)
        for variable in moment.variables:
            color = theme.legible(theme.MARK) if variable.changed else theme.TEXT
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_colored(theme.DIM, variable.name)
            imgui.table_next_column()
            imgui.push_text_wrap_pos(0.0)
            imgui.push_font(fonts.mono, 0.0)
            imgui.text_colored(color, variable.text)
            imgui.pop_font()
            if variable.name in INDICES:
                imgui.same_line()
                imgui.text_colored(theme.DIM, Indexing.ARRAY.told)  # as the code beside it
            elif variable.note:
                imgui.same_line()
                imgui.text_colored(theme.DIM, variable.note)
            imgui.pop_text_wrap_pos()
        imgui.end_table()


def _button_width(text: str) -> float:
    return imgui.calc_text_size(text).x + 2 * imgui.get_style().frame_padding.x
