"""The probe's panel: a pixel's formulas, the table of intersections, and the origin of its colour.

The functions take a state and a reading, and return a new state.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.instruments.outside.growing import lit_in
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import palettes, theme
from lucida.app.ui.explaining.notation import Line, number
from lucida.app.ui.formula import formula, lit
from lucida.app.ui.lettering import lettering
from lucida.app.ui.messages import wrapped
from lucida.app.ui.rows import button_width, follow
from lucida.app.ui.theme import Fonts
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.images.display import encode_srgb
from lucida.renderer.scene.model import Color

from .copying import as_latex, section_lines
from .reading import OUTSIDE, SEEN, Meeting, Reading

# Lines whose value is a colour, shown next to them.
_SWATCHED = ("ambient", "diffuse", "specular", "mirror", "sum", "reflectance", "background", "k_s")


Shown = tuple[tuple[int, int, int], Color]  # a pixel's bytes, and its colour, 0..1


@dataclass(frozen=True)
class Pin:
    """A pinned pixel with its current colour, 0..255; None while unknown."""

    pixel: Pixel
    color: tuple[int, int, int] | None


# The toolbar.


def toolbar(
    state: AppState, pixel: Pixel | None, reading: Reading | None, say: Callable[[str], None]
) -> AppState:
    """Draw the pixel, and the buttons.

    pixel: the marked one, or the one under the mouse. say: reports the copy.
    """
    indexing = state.options.indexing
    imgui.align_text_to_frame_padding()
    wrapped(f"{indexing.words(pixel)}, {indexing.told}" if pixel is not None else "no pixel")
    pins = state.options.probe.pins
    follow(button_width("Pin"))
    imgui.begin_disabled(pixel is None or pixel in pins)
    if imgui.button("Pin") and pixel is not None:
        state = state.with_options(replace(state.options.probe, pins=(*pins, pixel)))
    imgui.end_disabled()
    imgui.set_item_tooltip("keep this pixel in the list, and its ray in the outside view")
    follow(button_width("Copy"))
    imgui.begin_disabled(reading is None)
    if imgui.button("Copy") and reading is not None:
        imgui.set_clipboard_text(as_latex(reading, indexing))
        say("The pixel's ray is on the clipboard as LaTeX.")
    imgui.end_disabled()
    imgui.set_item_tooltip("the formulas with their numbers, as LaTeX")
    return state


def pin_row(state: AppState, pins: Iterable[Pin], pixel: Pixel | None) -> AppState:
    """Draw the pinned pixels as buttons: a click selects a pin, and a right click removes it."""
    indexing = state.options.indexing
    for count, pin in enumerate(pins):
        name = f"{count + 1}: {indexing.text(pin.pixel)}"
        side = imgui.get_frame_height()
        if count:
            follow(button_width(name) + side)
        if pin.color is not None:
            _swatch(tuple(part / 255 for part in pin.color), side)
            imgui.same_line(0, 0)
        if pin.pixel == pixel:
            imgui.push_style_color(imgui.Col_.text, theme.legible(theme.MARK))
        if imgui.button(f"{name}###pin{count}"):
            state = state.with_options(replace(state.options, marked=pin.pixel))
        if pin.pixel == pixel:
            imgui.pop_style_color()
        if imgui.is_item_clicked(imgui.MouseButton_.right):
            kept = tuple(one for one in state.options.probe.pins if one != pin.pixel)
            state = state.with_options(replace(state.options.probe, pins=kept))
        imgui.set_item_tooltip("click: go to this pixel; right-click: remove it")
    return state


# The reading.

_written = functools.lru_cache(maxsize=4)(section_lines)  # readings are compared by identity


def reading_panel(
    reading: Reading,
    indexing: Indexing,
    fonts: Fonts,
    stage: str = "",
) -> None:
    """Draw the reading. stage: the stage of the growing formula whose term is highlighted."""
    ray, hit, color = _written(reading, indexing)
    if _section("Ray", fonts):
        _lines(replace(one, latex=lit(one.latex, lit_in(one.latex, stage))) for one in ray)
    if reading.is_outside:
        wrapped(OUTSIDE, theme.legible(theme.MARK))
        return
    if _section("Objects along the ray", fonts):
        _table(reading, fonts)
    if reading.hit is not None and _section("Hit", fonts):
        _lines(hit)
    if _section("Colour", fonts):
        _lines(color, swatches=reading)


def _section(name: str, fonts: Fonts) -> bool:
    imgui.push_font(fonts.bold, 0.0)
    opened = imgui.collapsing_header(name, imgui.TreeNodeFlags_.default_open)
    imgui.pop_font()
    return opened


def _lines(lines: Iterable[Line], swatches: Reading | None = None) -> None:
    """Draw the lines, each with its name above the formula."""
    size_px = imgui.get_font_size()
    for count, line in enumerate(lines):
        if count:
            imgui.dummy(ImVec2(0, 0))
        _name(line, swatches)
        imgui.indent(0.6 * size_px)
        _formula(line, size_px)
        imgui.unindent(0.6 * size_px)


def _name(line: Line, swatches: Reading | None) -> None:
    """Draw the line's name and, if it results in one, its colour."""
    wrapped(line.name, theme.DIM)
    if swatches is not None and line.key.split(" ")[0] in _SWATCHED and len(line.value) == 3:
        light = np.array(line.value) * 2.0**swatches.exposure_ev
        side = 0.85 * imgui.get_text_line_height()
        imgui.same_line()
        _swatch(tuple(float(part) for part in encode_srgb(light)), side)


def _formula(line: Line, size_px: float) -> None:
    formula(filter(None, (line.latex, line.latex_numbers)), size_px, line.key)


def _table(reading: Reading, fonts: Fonts) -> None:
    met = [meeting for meeting in reading.meetings if meeting.nearest is not None]
    flags = imgui.TableFlags_
    if met and imgui.begin_table(
        "objects",
        3,
        flags.sizing_fixed_fit | flags.borders_inner_h | flags.no_host_extend_x,
    ):
        for name in ("object", "        t", ""):
            imgui.table_setup_column(name)
        imgui.table_headers_row()
        for meeting in met:
            _row(meeting, fonts)
        imgui.end_table()
    missed = [meeting.name for meeting in reading.meetings if meeting.nearest is None]
    if missed:
        count = "no object is" if not met else f"{len(missed)} other{'s' * (len(missed) > 1)}"
        text = "The ray hits no object." if not met else f"{count} not hit by the ray"
        imgui.text_colored(theme.DIM, text)
        imgui.set_item_tooltip("\n".join(missed[:40]) + ("\n..." if len(missed) > 40 else ""))
    elif not reading.meetings:
        imgui.text_colored(theme.DIM, "The scene has no objects.")


def _row(meeting: Meeting, fonts: Fonts) -> None:
    nearest = meeting.nearest
    assert nearest is not None
    wins = nearest.standing == SEEN
    color = theme.legible(theme.MARK) if wins else theme.TEXT if meeting.is_on_ray else theme.DIM
    imgui.table_next_row()
    imgui.table_next_column()
    imgui.push_font(fonts.bold if wins else None, 0.0)
    imgui.text_colored(color, meeting.name)
    imgui.pop_font()
    imgui.table_next_column()
    with lettering(fonts.mono):
        imgui.text_colored(color, f"{number(nearest.t, fixed=True):>9}")
    imgui.table_next_column()
    imgui.text_colored(color, "nearest" if wins else nearest.standing)


# Parts.


def color_row(shown: Shown | None, fonts: Fonts) -> None:
    """Draw a pixel's colour as displayed, and its red, green and blue.
    shown: None without a pixel.
    """
    side = imgui.get_text_line_height()
    _swatch(shown[1] if shown is not None else (0, 0, 0), side)
    with lettering(fonts.mono):
        for k, name in enumerate("RGB"):
            text = f"{name} {shown[0][k]:3d}" if shown is not None else f"{name}   -"
            follow(imgui.calc_text_size(text).x)
            imgui.text_colored(theme.legible(palettes.CHANNELS[k]), text)


def _swatch(color: Iterable[float], side: float) -> None:
    """Draw a square of a colour, 0..1."""
    red, green, blue = color
    at = imgui.get_cursor_screen_pos()
    far = ImVec2(at.x + side, at.y + side)
    draw = imgui.get_window_draw_list()
    draw.add_rect_filled(at, far, theme.u32(ImVec4(red, green, blue, 1.0)))
    draw.add_rect(at, far, theme.u32(theme.PLAIN))
    imgui.dummy(ImVec2(side, side))
