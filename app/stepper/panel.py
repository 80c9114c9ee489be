"""The loop stepper's panel: the controls, and one algorithm's code, canvas, variables, counters.

Takes options and moments, returns wishes.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal, TypeVar

from imgui_bundle import ImVec2, imgui

from app.explaining.breaking import narrowed
from app.state.bounds import range_of
from app.state.options import Language, Notation, Pixel
from app.stepper.listing import Listing, listing, shown_lines
from app.stepper.loop_parts import (
    Canvas,
    DepthBuffer,
    bounding_box,
    color_at,
    intersect,
    viewing_ray,
)
from app.stepper.model import SHOWN, Moment
from app.stepper.numbers import TEXTS, numbers
from app.stepper.options import StepperOptions
from app.stepper.plan import (
    Need,
    Place,
    canvases_in,
    plan,
    plan_of_two,
)
from app.stepper.raster_parts import box_around, edge, prepared, project, shade, t_of, triangles
from app.stepper.recording import MOST_STEPS, Order, Recording
from app.stepper.source import shown_code, source_of
from app.widgets import theme
from app.widgets.canvas import Marks, canvas
from app.widgets.checks import checkbox
from app.widgets.lettering import fitting_words
from app.widgets.rows import follow
from app.widgets.sliders import slider_float, slider_int
from app.widgets.theme import Fonts
from renderer.pixels import Indexing

T = TypeVar("T")
Form = Literal["triangles", "rays"]
CANVASES: dict[tuple[int, int], str] = {
    (width, 3 * width // 4): f"{width} x {3 * width // 4} pixels" for width in (4, 8, 16, 32, 64)
}
ORDERS: dict[Literal["both", "object", "image"], str] = {
    "both": "both",
    "object": "object order",
    "image": "image order",
}
FORMS: dict[Form, str] = {
    "triangles": "by triangles",
    "rays": "by rays",
}
TITLES = {
    Order.RASTER: "Rasterization: for each triangle, for each pixel",
    Order.OBJECT: "Object order by rays: for each object, for each pixel",
    Order.IMAGE: "Image order: for each pixel, for each object",
}
SLIDER_EM = 14.0  # the least width of the slider next to a title

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


Answer = int | Pixel | None  # a step to go to, or a pixel whose turn is wanted
RunTextures = tuple[int | None, int | None]  # OpenGL names: the colour's, the depth buffer's


@dataclass(frozen=True)
class Shown:
    """The presentation of algorithms.

    orders: those that are side by side. canvas: its pixels, (width, height). indexing, notation: of
    code, numbers and captions. in_julia: show Julia, too.
    """

    orders: tuple[Order, ...]
    canvas: tuple[int, int]
    indexing: Indexing
    notation: Notation
    in_julia: bool


def controls(
    options: StepperOptions, playing: bool, has_triangles: bool
) -> tuple[StepperOptions, Wish]:
    """Draw the buttons, the speed, the canvas, and the form of object order if the scene allows
    both.
    """
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
    """Draw the switch for the same lines in Julia. What runs is Python in any case."""
    follow(imgui.calc_text_size("Julia").x + 1.5 * imgui.get_frame_height())
    changed, beside = checkbox("Julia", chosen == "julia")
    imgui.set_item_tooltip("the same lines in Julia, for reading; Python is what runs")
    return ("julia" if beside else "python") if changed else chosen


def keys() -> Wish:
    """Return what the keys ask for while the panel has them.

    They are taken from ImGui's navigation, which keeps Tab and Enter.
    """
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
    follow(width)
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
    # A lecture's file may ask for any size.
    own = {options.canvas: f"{options.canvas[0]} x {options.canvas[1]} pixels"}
    chosen = _combo("pixels", options.canvas, CANVASES | own)
    return options if chosen is None else replace(options, canvas=chosen, steps=(0, 0))


def _order(options: StepperOptions) -> StepperOptions:
    return replace(options, order=_combo("order", options.order, ORDERS) or options.order)


def _form(form: Form) -> Form:
    form = _combo("form", form, FORMS) or form
    imgui.set_item_tooltip(
        "object order, triangle by triangle, as graphics cards do it (spheres, which have none,\n"
        "are drawn before, by their rays), or each object by the rays of its pixels"
    )
    return form


def _combo(name: str, now: T, choices: Mapping[T, str]) -> T | None:
    """Draw a drop-down list. Return the entry that was clicked, if any."""
    width = max(imgui.calc_text_size(text).x for text in choices.values())
    width += 2.2 * imgui.get_frame_height()
    follow(width)
    imgui.set_next_item_width(width)
    chosen = None
    if imgui.begin_combo(f"##{name}", choices[now]):
        for key, text in choices.items():
            if imgui.selectable(text, key == now)[0]:
                chosen = key
        imgui.end_combo()
    return chosen


# One algorithm.


def run_panel(
    recording: Recording,
    moment: Moment | None,
    picture: RunTextures,
    room: ImVec2,
    fonts: Fonts,
    shown: Shown,
) -> Answer:
    """Draw code, canvas, variables and counters."""
    notes = [f"Python, counts {shown.indexing.told}"]
    if recording.order is Order.RASTER and len(recording.model.flat.spheres):
        notes.append("spheres by rays, first")  # which have no triangles
    note = "; ".join(notes)
    imgui.push_font(fonts.bold, 0.0)
    title = TITLES[recording.order]
    beside = imgui.calc_text_size(note).x + imgui.get_style().item_spacing.x
    if imgui.calc_text_size(title).x + beside > room.x:  # a row is worth more than its words
        title = title.partition(":")[0]
    imgui.align_text_to_frame_padding()
    imgui.text(title)
    imgui.pop_font()
    if note:
        follow(imgui.calc_text_size(note).x)
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.DIM, note)
    if moment is None:
        imgui.text_colored(theme.DIM, "running ...")
        return None
    follow(SLIDER_EM * imgui.get_font_size())
    step = _slider(recording, moment)
    corner, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    need, extent = _need(shown), (round(room.x), round(room.y))
    made = plan_of_two(extent, need) if shown.in_julia else plan(extent, need)

    def to(place: Place) -> ImVec2:
        imgui.set_cursor_screen_pos(ImVec2(corner.x + place.left, corner.y + place.top))
        return ImVec2(*place.size)

    lines = Listing(
        recording.source.lines, shown.notation, shown.indexing, shown.in_julia,
        _called(shown.notation, shown.indexing),
    )  # fmt: skip
    listing(lines, moment.line, to(made.code), fonts)
    place = to(made.canvases)
    imgui.begin_group()
    together = recording.order.has_depth and made.depth is None
    clicked = _canvases(recording, moment, picture, place, shown.indexing, together)
    imgui.end_group()
    if recording.order.has_depth and made.depth is not None:
        clicked = _depth(recording, moment, picture, to(made.depth)) or clicked
    numbers(moment, shown.indexing, shown.notation, to(made.numbers), made, fonts)
    return clicked or step


def _need(shown: Shown) -> Need:
    """Return the room that is needed. Of two runs side by side, the larger need counts."""
    lines = [
        narrowed(shown_lines(source_of(order.renderer).lines, shown.notation, shown.indexing))
        for order in shown.orders
    ]
    names = [names_of(order) for order in shown.orders]
    return Need(
        lines=max(lines, key=len),
        canvas=shown.canvas,
        has_depth=any(order.has_depth for order in shown.orders),
        em_px=imgui.get_font_size(),
        short=max(3 + sum(name not in TEXTS for name in one) for one in names),
        long=max(sum(name in TEXTS for name in one) for one in names),
    )


def names_of(order: Order) -> list[str]:
    """Return the names of an algorithm's visible variables."""
    return [name for name in SHOWN if name in order.renderer.__code__.co_varnames]


def _slider(recording: Recording, moment: Moment) -> int | None:
    """Draw the slider of the run's step."""
    most = max(1, len(recording) - 1)
    imgui.set_next_item_width(-1)
    note = f"step %d of {most}"
    if recording.truncated:
        less = "object order by rays" if recording.order is Order.RASTER else "fewer pixels"
        note += f" (stopped after {MOST_STEPS}: take {less})"
    elif not recording.complete:
        note += " so far"
    changed, step = slider_int(
        f"##step {recording.order.name}", moment.step, 0, most, note,
        imgui.SliderFlags_.always_clamp,
    )  # fmt: skip
    return step if changed else None


@functools.cache
def _called(notation: Notation, indexing: Indexing) -> dict[str, str]:
    """Return the sources of the functions that the loops call."""
    parts = (
        viewing_ray, bounding_box, intersect, color_at, Canvas, DepthBuffer,
        prepared, triangles, project, box_around, edge, t_of, shade,
    )  # fmt: skip
    return {
        part.__name__: shown_code(inspect.getsource(part).rstrip(), notation, indexing)
        for part in parts
    }


def _canvases(
    recording: Recording,
    moment: Moment,
    picture: RunTextures,
    room: ImVec2,
    indexing: Indexing,
    together: bool,
) -> Pixel | None:
    """Draw the canvas, with the depth buffer next to it or below if they share a place."""
    name, size = recording.order.name, recording.size
    label = imgui.get_text_line_height_with_spacing()
    spacing = imgui.get_style().item_spacing
    gap = spacing.x, spacing.y
    upper, lower, beside = canvases_in((room.x, room.y), size, together, label, gap)
    first = ImVec2(*upper)
    dots = tuple((test.pixel, test.t < float("inf")) for test in moment.tests)
    corners = tuple((corner.x, corner.y) for corner in moment.corners or ())
    marks = Marks(moment.pixel, moment.box, dots if recording.order.has_depth else (), corners)
    imgui.begin_group()
    imgui.text_colored(theme.DIM, _caption(moment, indexing, first.x))
    clicked = canvas(picture[0], size, first, marks, f"canvas##{name}")
    imgui.set_item_tooltip("a click goes to a pixel's turn")
    imgui.end_group()
    if not together:
        return clicked
    if beside:
        imgui.same_line()
    return _depth(recording, moment, picture, ImVec2(lower[0], lower[1] + label)) or clicked


def _depth(
    recording: Recording, moment: Moment, picture: RunTextures, room: ImVec2
) -> Pixel | None:
    """Draw the depth buffer, with a line above it."""
    name, size = recording.order.name, recording.size
    rest = ImVec2(room.x, max(20.0, room.y - imgui.get_text_line_height_with_spacing()))
    imgui.begin_group()
    imgui.text_colored(theme.DIM, "depth")
    clicked = canvas(picture[1], size, rest, Marks(moment.pixel, moment.box), f"depth##{name}")
    imgui.set_item_tooltip("for each pixel the nearest t so far, near ones bright")
    imgui.end_group()
    return clicked


def _caption(moment: Moment, indexing: Indexing, width: float) -> str:
    """Return the line above the canvas: the pixel whose turn it is, as the window counts."""
    if moment.pixel is None:
        return "canvas"
    pixel = f"pixel {indexing.text(moment.pixel)} {indexing.told}"
    whole = f"canvas, {pixel}"
    return whole if imgui.calc_text_size(whole).x <= width else fitting_words(pixel, width)


def _button_width(text: str) -> float:
    return imgui.calc_text_size(text).x + 2 * imgui.get_style().frame_padding.x
