"""The plot of counted steps. Both axes are logarithmic, so a cost proportional to n is a straight
line that rises one power of ten for each power of ten of n.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, implot

from lucida.app.ui import theme

from .recorded import COSTS, Cost, Unit

MARGIN = 1.5  # around the least and the most on an axis
AROUND_EM = 5.0  # space for the title, the numbers and the axis's name
TITLES_PART = 0.45  # largest part of the width for the lines' titles


class Line(NamedTuple):
    """A line of a plot, and the title at its right end."""

    title: str
    is_ray: bool
    values: list[float]

    @property
    def color(self) -> ImVec4:
        return color_of(self.is_ray)


def color_of(is_ray: bool) -> ImVec4:
    """Return orange, the colour of rays everywhere, or blue, which differs for all viewers."""
    return theme.seen(theme.RAY if is_ray else theme.BASIS["w"])


def draw(unit: Unit, size: ImVec2) -> None:
    """Plot the steps of both loops, as lines with dots and titles at the right."""
    costs = COSTS[unit]
    columns = {name: [float(getattr(cost, name)) for cost in costs] for name in Cost._fields}
    xs = columns[unit]
    lines = (
        Line("triangles set up", False, columns["triangles"]),
        Line("pixels tested", False, columns["tested"]),
        Line("rays", True, columns["pixels"]),
        Line("nodes visited", True, columns["nodes"]),
    )
    flags = implot.Flags_.no_mouse_text | implot.Flags_.no_menus | implot.Flags_.no_legend
    if not implot.begin_plot("steps, counted", size, flags):
        return
    em, line_px = imgui.get_font_size(), imgui.get_text_line_height()
    titles_px = max(imgui.calc_text_size(line.title).x for line in lines) + 1.5 * em
    is_titled = size.y - AROUND_EM * em > (len(lines) + 1) * line_px
    if not is_titled or titles_px > TITLES_PART * size.x:
        is_titled, titles_px = False, 0.0
    implot.setup_axes(unit, "")
    x, y = implot.ImAxis_.x1, implot.ImAxis_.y1
    values = [value for line in lines for value in line.values]
    low = 10.0 ** math.floor(math.log10(min(values)))
    high = 10.0 ** math.ceil(math.log10(max(values)))
    for axis, least, most in ((x, xs[0], xs[-1]), (y, low, high)):
        implot.setup_axis_scale(axis, implot.Scale_.log10)
        first, last = least / MARGIN, most * MARGIN
        if axis == x:  # the titles' space is part of the axis
            last = first * (last / first) ** (1 / (1 - titles_px / (size.x - 4 * em)))
        implot.setup_axis_limits(axis, first, last, implot.Cond_.always)
        # Label as many powers of ten as fit side by side.
        across = (size.x - titles_px) / 2.5 if axis == x else size.y - AROUND_EM * em
        fit = max(1.0, across / (1.5 * em))
        every = max(1, math.ceil(math.log10(most / least) / fit))
        ticks = [10.0**k for k in range(-1, 9, every) if 10.0**k <= most]
        implot.setup_axis_ticks(axis, ticks, [_written(power) for power in ticks])
    for line in lines:
        spec = implot.Spec()
        spec.line_color, spec.line_weight = line.color, theme.line_px(2.2)
        implot.plot_line(line.title, np.array(xs), np.array(line.values), spec)
    drawing = implot.get_plot_draw_list()
    implot.push_plot_clip_rect()
    ends = []
    for line in lines:
        dots = [implot.plot_to_pixels(*point) for point in zip(xs, line.values, strict=True)]
        for dot in dots:  # ImPlot's own dots are polygons of ten corners
            color, half = theme.u32(line.color), theme.px(4.5)
            if line.is_ray:
                drawing.add_circle_filled(dot, half, color)
            else:  # another shape, for viewers who cannot see the colour
                drawing.add_rect_filled(dot - ImVec2(half, half), dot + ImVec2(half, half), color)
        ends.append((dots[-1].y - line_px / 2, dots[-1].x + em, line))
    if is_titled:
        ends.sort(key=lambda end: end[0])
        top = implot.get_plot_pos().y
        bottom = top + implot.get_plot_size().y - line_px
        places = apart([end[0] for end in ends], line_px, top, bottom)
        for place, (_, left, line) in zip(places, ends, strict=True):
            color = theme.u32(theme.legible(line.color))
            drawing.add_text(ImVec2(left, place), color, line.title)
    implot.pop_plot_clip_rect()
    implot.end_plot()


def apart(wanted: Sequence[float], least: float, low: float, high: float) -> list[float]:
    """Return ascending places at least `least` apart, from low to high, near the wanted ones."""
    places: list[float] = []
    for place in wanted:
        places.append(max(place, places[-1] + least if places else low))
    return [min(place, high - k * least) for k, place in enumerate(reversed(places))][::-1]


def _written(value: float) -> str:
    """Return a power of ten for an axis: 0.1, 100, 10k, 1M."""
    for unit, letter in ((1e6, "M"), (1e3, "k")):
        if value >= unit:
            return f"{value / unit:g}{letter}"
    return f"{value:g}"
