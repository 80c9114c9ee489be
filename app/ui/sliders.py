"""Sliders whose grab is drawn below their number, not on it. Otherwise they are ImGui's."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

from imgui_bundle import imgui

from lucida.app.ui import theme

Number = TypeVar("Number", int, float)

TRACK, GRAB = 0.1, 0.22  # of the frame's height, at its lower edge
GRAB_EM = 0.6


def slider_float(
    label: str, value: float, least: float, most: float, form: str = "%.3f", flags: int = 0
) -> tuple[bool, float]:
    """Same as imgui.slider_float()."""
    return _slider(imgui.slider_float, label, value, least, most, form, flags)


def slider_int(
    label: str, value: int, least: int, most: int, form: str = "%d", flags: int = 0
) -> tuple[bool, int]:
    """Same as imgui.slider_int()."""
    return _slider(imgui.slider_int, label, value, least, most, form, flags)


def part_of(value: float, least: float, most: float, logarithmic: bool) -> float:
    """Return a value's place between its bounds, from 0 to 1."""
    if most <= least:
        return 0.0
    value = min(max(value, least), most)
    if logarithmic and least > 0:
        return math.log(value / least) / math.log(most / least)
    return (value - least) / (most - least)


def _slider(
    widget: Callable[..., tuple[bool, Number]],
    label: str,
    value: Number,
    least: Number,
    most: Number,
    form: str,
    flags: int,
) -> tuple[bool, Number]:
    width = imgui.calc_item_width()
    for slot in (imgui.Col_.slider_grab, imgui.Col_.slider_grab_active):
        imgui.push_style_color(slot, theme.UNSEEN)
    changed, value = widget(label, value, least, most, form, flags)
    imgui.pop_style_color(2)
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    part = part_of(value, least, most, bool(flags & imgui.SliderFlags_.logarithmic))
    grab = min(GRAB_EM * imgui.get_font_size(), width)
    left, tall, right = low.x + part * (width - grab), high.y - low.y, low.x + width
    draw = imgui.get_window_draw_list()
    draw.add_rect_filled((low.x, high.y - TRACK * tall), (right, high.y), theme.u32(theme.LINE))
    color = theme.u32(theme.TEXT if imgui.is_item_active() else theme.PLAIN)
    corner = left, high.y - GRAB * tall
    draw.add_rect_filled(corner, (left + grab, high.y), color, theme.px(2))
    return changed, value
