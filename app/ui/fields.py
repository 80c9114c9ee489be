"""Number fields: dragged like a slider, or typed; with a level that shows the position of the
value, and a menu to reset, copy and paste it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.ui import pending, theme, typed
from lucida.app.ui.explaining import notation
from lucida.app.ui.explaining.arithmetic import number
from lucida.app.ui.rows import tip
from lucida.renderer.system.errors import LucidaError

LEAST = 1e-3  # where dragging a logarithmic value ends
FLT_MAX = 3.4e38
WIDTH = 8  # characters of a number
HINT = (
    "drag, or double-click to type (1/3, sqrt(2)/2); Shift: faster, Alt: slower; "
    "right-click: reset, copy, paste"
)


class Scale(NamedTuple):
    """The range that a field's level and its drag refer to: low to high. Values outside are legal.

    logarithmic: for values above 0 that differ by factors.
    least, most: the limits of dragging, not of typing.
    whole: show whole numbers without decimals.
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
            return max(abs(value), LEAST) * math.log(self.high / self.low) / 500
        return (self.high - self.low) / 400

    @property
    def limits(self) -> tuple[float, float]:
        """The limits of dragging; (0, 0) for none."""
        if self.logarithmic:
            return max(LEAST, self.least), self.most
        return (0.0, 0.0) if self.least == -FLT_MAX else (self.least, self.most)


def number_format(value: float, scale: Scale) -> str:
    """Return a format of eight characters for all but extreme values, so that nothing moves."""
    return f"%{WIDTH}.{_usual_decimals(value, scale)}f"


def _usual_decimals(value: float, scale: Scale) -> int:
    small_scene = scale.high - scale.low < 1.5 and abs(value) < 100
    return 4 if small_scene else 3


def is_extreme(value: float, scale: Scale) -> bool:
    """Return True if a number is too large or too small for the usual decimals."""
    return abs(value) >= 1000 or (scale.logarithmic and 0 < value < 0.01)


def fitting_format(value: float, scale: Scale, characters: int, tight: int = 0) -> str:
    """Return the usual format if it fits, otherwise one with as many digits as fit.

    A number with only a few more decimals gets all of them: -0.15625. For an extreme value, return
    its text.
    tight: the number of characters without a margin, for such decimals.
    """
    if scale.whole and value == round(value) and len(f"{value:.0f}") <= characters:
        return f"%{min(characters, WIDTH)}.0f"
    if is_extreme(value, scale):
        most = WIDTH + (value < 0)
        return densest(value, min(characters, most)).rjust(min(characters, WIDTH))
    # Most numbers have more decimals than that, which is quickly seen.
    whole = notation.number(value) if math.isclose(round(value, 6), value) else ""
    room = min(max(characters, tight), WIDTH)
    if whole and len(whole) <= room and math.isclose(float(whole), value):
        decimals = len(whole.partition(".")[2])
        if "e" not in whole and decimals > _usual_decimals(value, scale):
            return f"%{min(characters, room)}.{decimals}f"
    if characters >= WIDTH:
        return number_format(value, scale)
    for decimals in (3, 2, 1, 0):
        if len(f"{value:.{decimals}f}") <= characters:
            return f"%{characters}.{decimals}f"
    return densest(value, characters)


def unsigned_zero(form: str, value: float) -> str:
    """Return a format that shows 0.000 in place of -0.000."""
    if math.copysign(1.0, value) > 0 or "%" not in form:
        return form
    return form if any(digit in form % value for digit in "123456789") else form % 0.0


def densest(value: float, characters: int) -> str:
    """Return the number with as many digits as fit in these characters: 5400000, 1.235e-3."""
    if not math.isfinite(value):
        return str(value)
    fixed = (f"{value:.{decimals}f}" for decimals in range(characters, -1, -1))
    powers = (f"{value:.{decimals}e}" for decimals in range(characters, -1, -1))
    short = (f"{digits}e{int(power)}" for digits, _, power in (t.partition("e") for t in powers))
    texts = [text for text in (*fixed, *short) if len(text) <= characters]
    return max(texts, key=_digit_count, default=f"{value:.0e}".replace("e+0", "e"))


def _digit_count(text: str) -> int:
    """Return the number of significant digits."""
    return len(text.partition("e")[0].lstrip("-0.").replace(".", ""))


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
    """Draw a field. Return (whether it changed, its value).

    label: the id, not shown.
    marked: show it as wrong.
    reset: the value that its menu resets to; None for no such entry.
    unit: shown after the number.
    """
    imgui.set_next_item_width(width_px)
    imgui.push_font(mono, 0.0)
    room_px = width_px - 2 * imgui.get_style().frame_padding.x
    character_px = imgui.calc_text_size("0").x
    characters = int(room_px / character_px + 0.05)
    if characters < WIDTH + len(unit):
        unit = unit[:1].strip()
    tight = int(width_px / character_px) - len(unit)
    shown = unsigned_zero(fitting_format(value, scale, characters - len(unit), tight), value) + unit
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
        pending.here()
        imgui.pop_style_color()
        imgui.pop_style_var()
    imgui.pop_font()
    if is_typed:
        return changed, new
    is_active = imgui.is_item_active()
    if not is_active or not imgui.get_io().want_text_input:
        _draw_level(value, scale, color)
    if tooltip and not marked and not is_active:  # an error has its own tooltip
        whole = f"{value:.10g}\n" if is_extreme(value, scale) else ""
        tip(f"{whole}{tooltip}\n{HINT}")
    chosen = _menu(label, value, reset)
    if chosen is not None:
        return chosen != value, chosen
    return changed, new


def pasted_number() -> float | None:
    """Return the clipboard's text as one finite number; None if it is not one."""
    try:
        return number(imgui.get_clipboard_text())
    except (LucidaError, RuntimeError):  # RuntimeError: there is no clipboard
        return None


def _menu(label: str, value: float, reset: float | None) -> float | None:
    """Draw the field's context menu. Return the selected entry."""
    chosen = None
    if imgui.begin_popup_context_item(f"menu##{label}"):
        imgui.text_disabled(f"{label} = {value:.7g}")
        imgui.separator()
        if reset is not None and imgui.menu_item(f"Reset to {reset:.7g}###reset", "", False)[0]:
            chosen = reset
        if imgui.menu_item("Copy", "", False)[0]:
            imgui.set_clipboard_text(repr(value))
        held = pasted_number()
        if imgui.menu_item("Paste", "", False, held is not None)[0]:
            chosen = held
        imgui.end_popup()
    return chosen


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
