"""Number fields that are dragged like a slider or typed into.

A level shows the value's position in its range, and a menu resets the value.
"""

from __future__ import annotations

import functools
import math
from typing import NamedTuple

from imgui_bundle import ImVec2, ImVec4, imgui

from . import theme, typed
from .explaining import notation
from .rows import tip

NOISE = 1e-12  # smaller numbers are rounding errors of 0
LEAST = 1e-2  # least value when dragging on a logarithmic scale, as a fraction of its low end
FINE = 0.1  # shorter scales need more than the usual decimals
FLT_MAX = 3.4e38
WIDTH = 8  # characters of a number
DECIMALS = 4
HINT = "Drag, or double-click to type (1/3, sqrt(2)/2). Shift: large steps; Alt: small steps."


class Scale(NamedTuple):
    """The range of a field's level and drag, from low to high. Values outside it are legal.

    logarithmic: True for positive values that differ by factors.
    least, most: the limits of dragging, not of typing.
    whole: True to show whole numbers without decimals.
    """

    low: float
    high: float
    logarithmic: bool = False
    least: float = -FLT_MAX
    most: float = FLT_MAX
    whole: bool = False

    def place(self, value: float) -> float:
        """Return a value's place between low (0) and high (1), clamped."""
        low, high = self.low, self.high
        if self.logarithmic:
            if not value > 0:
                return 0.0
            low, high, value = math.log(low), math.log(high), math.log(value)
        if not math.isfinite(value):
            return 0.0
        return min(max((value - low) / (high - low), 0.0), 1.0)

    def speed(self, value: float) -> float:
        """Return the change of the value for one pixel of dragging."""
        if self.logarithmic:
            return max(abs(value), LEAST * self.low) * math.log(self.high / self.low) / 500
        return (self.high - self.low) / 400

    @property
    def limits(self) -> tuple[float, float]:
        """The limits of dragging; (0, 0) for none."""
        if self.logarithmic:
            return max(LEAST * self.low, self.least), self.most
        return (0.0, 0.0) if self.least == -FLT_MAX else (self.least, self.most)


@functools.lru_cache(1024)
def shown_number(
    value: float, characters: int, decimals: int = DECIMALS, is_fine: bool = False
) -> str:
    """Return a number with its usual decimals, or with as many digits as fit, aligned at the right.

    A pixel's fraction is complete, so that it matches calculations by hand. is_fine: True if the
    usual decimals are too few.
    """
    value = 0.0 if abs(value) < NOISE else value
    text, usual = notation.number(value), f"{value:z.{decimals}f}"
    if is_fine:
        text = f"{value:.7g}"
    elif len(text) < len(usual) <= WIDTH:
        text = usual
    for digits in range(6, 0, -1):
        if len(text) > characters:
            forms = f"{value:.{digits}g}", f"{value:.{digits - 1}e}"
            text = min((form.replace("e+0", "e").replace("e-0", "e-") for form in forms), key=len)
    return text.rjust(min(characters, WIDTH))


def number_field(
    label: str,
    value: float,
    width_px: float,
    scale: Scale,
    color: ImVec4,
    mono: imgui.ImFont | None,
    tooltip: str = "",
    marked: bool = False,
    reset: float | None = None,
    unit: str = "",
) -> tuple[bool, float]:
    """Draw a field. Return (has_changed, value).

    label: the id, not shown.
    marked: True to show it as wrong.
    reset: the value that its menu resets to; None for no such entry.
    unit: the text after the number.
    """
    imgui.set_next_item_width(width_px)
    imgui.push_font(mono, 0.0)
    room_px = width_px - 2 * imgui.get_style().frame_padding.x
    character_px = imgui.calc_text_size("0").x
    characters = int(room_px / character_px + 0.05)
    if characters < WIDTH + len(unit):
        unit = unit[:1].strip()
    decimals, is_fine = 0 if scale.whole else DECIMALS, scale.high - scale.low < FINE
    shown = shown_number(value, characters - len(unit), decimals, is_fine) + unit
    if marked:
        imgui.push_style_var(imgui.StyleVar_.frame_border_size, 0.1 * imgui.get_font_size())
        imgui.push_style_color(imgui.Col_.border, theme.ERROR)
    is_typed = typed.is_open(label)
    if is_typed:
        changed, new = typed.field(label, value)
    else:
        limits = scale.limits
        changed, new = imgui.drag_float(f"##{label}", value, scale.speed(value), *limits, shown)
        if imgui.is_item_active() and typed.take_over(label, value, changed):
            changed, new = False, value
        elif changed and math.isfinite(new):
            # The widget uses float32: restore the intended number.
            new = float(f"{new:.7g}")
    if marked:
        imgui.pop_style_color()
        imgui.pop_style_var()
    imgui.pop_font()
    if is_typed:
        return changed, new
    is_active = imgui.is_item_active()
    if not is_active or not imgui.get_io().want_text_input:
        _draw_level(value, scale, color)
    if tooltip and not marked and not is_active:  # an error has its own tooltip
        tip(f"{tooltip}\n{HINT}")
    if reset is not None and imgui.begin_popup_context_item(f"menu##{label}"):
        if imgui.menu_item(f"Reset to {reset:.7g}###reset", "", False)[0]:
            changed, new = reset != value, reset
        imgui.end_popup()
    return changed, new


def _draw_level(value: float, scale: Scale, color: ImVec4) -> None:
    """Draw a line along the field's lower edge, from zero to the value, and a grab at its end."""
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    unit = imgui.get_font_size() / 8
    left, width = low.x + 1.5 * unit, high.x - low.x - 3 * unit
    zero = 0.0 if scale.logarithmic else scale.place(0.0)
    start, end = left + zero * width, left + scale.place(value) * width
    draw = imgui.get_window_draw_list()
    draw.add_rect_filled(
        ImVec2(min(start, end), high.y - unit),
        ImVec2(max(start, end), high.y),
        theme.u32(color, 0.8),
    )
    draw.add_rect_filled(
        ImVec2(end - unit, high.y - 2 * unit), ImVec2(end + unit, high.y), theme.u32(color)
    )
