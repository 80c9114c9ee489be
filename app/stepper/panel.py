"""One algorithm in the loop stepper: its code, canvas, variables and counters.

Takes moments, returns wishes. controls.py has the buttons above.
"""

from __future__ import annotations

import functools
import inspect
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.explaining.breaking import narrowed
from app.state.options import Notation, Pixel
from app.stepper.listing import Listing, listing, shown_lines
from app.stepper.loop_parts import (
    Canvas,
    DepthBuffer,
    color_at,
    intersect,
    viewing_ray,
)
from app.stepper.model import Moment
from app.stepper.numbers import numbers
from app.stepper.plan import Place, canvases_in, code_width, plan
from app.stepper.raster_parts import box_around, edge, prepared, project, shade, t_of, triangles
from app.stepper.recording import MOST_STEPS, Order, Recording
from app.stepper.source import shown_code, source_of
from app.widgets import theme
from app.widgets.canvas import Marks, canvas
from app.widgets.code import LINE, letters_in, row_count
from app.widgets.lettering import fitting_words
from app.widgets.rows import follow
from app.widgets.sliders import slider_int
from app.widgets.theme import Fonts
from renderer.pixels import Indexing

TITLES = {
    Order.RASTER: "Rasterization: for each triangle, for each pixel",
    Order.IMAGE: "Image order: for each pixel, for each object",
}
SLIDER_EM = 14.0  # the least width of the slider next to a title
BARE_SLIDER_EM = 8.5  # and of one next to the controls

Answer = int | Pixel | None  # a step to go to, or a pixel whose turn is wanted
RunTextures = tuple[int | None, int | None]  # OpenGL names: the colour's, the depth buffer's


@dataclass(frozen=True)
class Shown:
    """The presentation of algorithms.

    orders: those that are side by side. indexing, notation: of code, numbers and captions.
    in_julia: show Julia, too. is_low: there is no room for words that the algorithm can be known
    without.
    """

    orders: tuple[Order, ...]
    indexing: Indexing
    notation: Notation
    in_julia: bool
    is_low: bool

    @property
    def is_bare(self) -> bool:
        """True if the algorithm is alone, and its panel has no room for a heading."""
        return self.is_low and len(self.orders) == 1


def run_panel(
    recording: Recording,
    moment: Moment | None,
    picture: RunTextures,
    fonts: Fonts,
    shown: Shown,
) -> Answer:
    """Draw code, canvas, variables and counters."""
    step = None if shown.is_bare else _heading(recording, moment, shown, fonts)
    if moment is None:
        imgui.text_colored(theme.DIM, "running ...")
        return None
    corner, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    lines = Listing(
        recording.source.lines, shown.notation, shown.indexing, shown.in_julia,
        _called(shown.notation, shown.indexing),
    )  # fmt: skip
    em_px, extent = imgui.get_font_size(), (room.x, room.y)
    letters = letters_in(code_width(extent), em_px)
    rows = [row_count(_code_of(order, shown), letters) for order in shown.orders]
    made = plan(extent, (1 + shown.in_julia) * max(rows) * LINE * em_px + 0.5, em_px)

    def to(place: Place) -> ImVec2:
        imgui.set_cursor_screen_pos(ImVec2(corner.x + place.left, corner.y + place.top))
        return ImVec2(place.width, place.height)

    listing(lines, moment.line, to(made.code), fonts)
    place = to(made.canvases)
    imgui.begin_group()
    clicked = _canvases(recording, moment, picture, place, shown.indexing)
    imgui.end_group()
    place = to(made.numbers)
    numbers(moment, shown.indexing, shown.notation, place, made, fonts, counted=not shown.is_low)
    return clicked or step


def _code_of(order: Order, shown: Shown) -> tuple[str, ...]:
    """Return an algorithm's lines as they are shown."""
    return narrowed(shown_lines(source_of(order.renderer).lines, shown.notation, shown.indexing))


def _heading(recording: Recording, moment: Moment | None, shown: Shown, fonts: Fonts) -> int | None:
    """Draw the algorithm's name and the slider of its step. Return the step that it asks for."""
    room = imgui.get_content_region_avail()
    notes = [f"Python, counts {shown.indexing.told}"]
    if recording.order is Order.RASTER and len(recording.model.flat.spheres):
        notes.append("spheres by rays, first")  # which have no triangles
    note = "" if shown.is_low else "; ".join(notes)
    imgui.push_font(fonts.bold, 0.0)
    title = TITLES[recording.order]
    beside = imgui.calc_text_size(note).x + imgui.get_style().item_spacing.x
    if shown.is_low or imgui.calc_text_size(title).x + beside > room.x:  # a row is worth more
        title = title.partition(":")[0]
    imgui.align_text_to_frame_padding()
    imgui.text(title)
    imgui.pop_font()
    if note:
        follow(imgui.calc_text_size(note).x)
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.DIM, note)
    if moment is None:
        return None
    follow((BARE_SLIDER_EM if shown.is_low else SLIDER_EM) * imgui.get_font_size())
    return slider(recording, moment)


def slider(recording: Recording, moment: Moment) -> int | None:
    """Draw the slider of the run's step. Return the step that it asks for."""
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
    return step if changed else None


@functools.cache
def _called(notation: Notation, indexing: Indexing) -> dict[str, str]:
    """Return the sources of the functions that the loops call."""
    parts = (
        viewing_ray, intersect, color_at, Canvas, DepthBuffer,
        prepared, triangles, project, box_around, edge, t_of, shade,
    )  # fmt: skip
    return {
        part.__name__: shown_code(inspect.getsource(part).rstrip(), notation, indexing)
        for part in parts
    }


def _canvases(
    recording: Recording, moment: Moment, picture: RunTextures, room: ImVec2, indexing: Indexing
) -> Pixel | None:
    """Draw the canvas, with the depth buffer next to it or below. Return the clicked pixel."""
    name, size, has_depth = recording.order.name, recording.size, recording.order.has_depth
    label = imgui.get_text_line_height_with_spacing()
    spacing = imgui.get_style().item_spacing
    each, beside = canvases_in((room.x, room.y), size, has_depth, label, (spacing.x, spacing.y))
    extent = ImVec2(*each)
    dots = tuple((test.pixel, test.t < float("inf")) for test in moment.tests)
    corners = tuple((corner.x, corner.y) for corner in moment.corners or ())
    marks = Marks(moment.pixel, moment.box, dots if has_depth else (), corners)
    imgui.begin_group()
    imgui.text_colored(theme.DIM, _caption(moment, indexing, extent.x))
    clicked = canvas(picture[0], size, extent, marks, f"canvas##{name}")
    imgui.set_item_tooltip("a click goes to a pixel's turn")
    imgui.end_group()
    if not has_depth:
        return clicked
    if beside:
        imgui.same_line()
    imgui.begin_group()
    imgui.text_colored(theme.DIM, "depth")
    marks = Marks(moment.pixel, moment.box)
    clicked = canvas(picture[1], size, extent, marks, f"depth##{name}") or clicked
    imgui.set_item_tooltip("for each pixel the nearest t so far, near ones bright")
    imgui.end_group()
    return clicked


def _caption(moment: Moment, indexing: Indexing, width: float) -> str:
    """Return the line above the canvas: the pixel whose turn it is, as the window counts."""
    if moment.pixel is None:
        return "canvas"
    pixel = f"pixel {indexing.text(moment.pixel)}"
    for text in (f"canvas, {pixel} {indexing.told}", f"{pixel} {indexing.told}", pixel):
        if imgui.calc_text_size(text).x <= width:
            return text
    return fitting_words(pixel, width)
