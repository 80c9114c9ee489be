"""The cost plot's panel: both loops' steps and both renderers' times, against triangles or pixels.

It draws the plots and their controls, and describes them in words.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, implot
from numpy.typing import NDArray

from app.costs.growth import Point, count_growth, is_proportional, per_doubling
from app.costs.model import RENDERERS, WATCHED, Renderer, Sample
from app.costs.options import CostOptions
from app.costs.work import Work
from app.state.bounds import whole_range_of
from app.widgets import theme
from app.widgets.checks import radio_button
from app.widgets.rows import follow
from app.widgets.sliders import slider_int

TITLES: dict[Renderer, str] = {"raster": "raster, object order", "ray": "ray, image order"}
ORDERS: dict[Renderer, str] = {"raster": "Object order", "ray": "Image order"}
SMOOTHED = 9  # frames
SHORTEST_S = 1e-6  # a coarser clock reads 0
POWERS = tuple(10.0**k for k in range(-3, 10))  # that an axis may show
SMALL_EM = 21  # wide and high: a view that has no room for two plots
MARGIN = 1.5  # around the least and the most on an axis
AROUND_EM = 5.0  # above and below what is plotted: title, numbers, name of the axis
TITLES_PART = 0.45  # of the width that the lines' titles may take
Unit = Literal["triangles", "pixels"]
AGAINST: tuple[Literal["frames", "triangles", "pixels"], ...] = ("frames", "triangles", "pixels")


@dataclass(frozen=True)
class CostReport:
    """The contents of the panel.

    work, samples: of a growing number. history: the last frames' times, (raster, ray) in seconds.
    waiting: images and cases that are still to be counted and measured. problems: why a renderer
    cannot be measured. machine: where the times are from.
    """

    work: Sequence[Work]
    samples: Sequence[Sample]
    history: Sequence[tuple[float, float]]
    waiting: int
    problems: dict[str, str]
    machine: str = "on this machine"


class Steps(NamedTuple):
    """A kind of counted steps, which is a line of the plot.

    of: the field of Work.
    """

    of: Literal["set_up", "tested", "rays", "nodes"]
    title: str
    renderer: Renderer


STEPS = (
    Steps("set_up", "triangles set up", "raster"),
    Steps("tested", "pixels tested", "raster"),
    Steps("rays", "rays", "ray"),
    Steps("nodes", "nodes visited", "ray"),
)


class Line(NamedTuple):
    """A line of a plot, and the title at its right end."""

    title: str
    renderer: Renderer
    points: list[Point]


def controls(options: CostOptions, told: CostReport) -> tuple[CostOptions, bool]:
    """Draw the controls. Return the options, and True to measure everything again."""
    imgui.align_text_to_frame_padding()
    imgui.text("against")
    for name in AGAINST:
        follow(imgui.calc_text_size(name).x + 1.5 * imgui.get_frame_height())
        if radio_button(f"{name}##against", options.against == name):  # sliders have these names
            options = replace(options, against=name)
    label = "Measure here" if options.recorded else "Measure again"
    follow(imgui.calc_text_size(label).x + 2 * imgui.get_style().frame_padding.x)
    again = imgui.button(label)
    if again and options.recorded:
        options = replace(options, recorded=False)
    if told.waiting:
        waits = f"measuring, {told.waiting} to go ..."
        follow(imgui.calc_text_size(waits).x)
        imgui.text_colored(theme.DIM, waits)
    # The number on the axis has no slider.
    if options.against != "triangles":
        options = replace(options, triangles=_slider("triangles", options.triangles))
    if options.against != "pixels":
        options = replace(options, pixels=_slider("pixels", options.pixels))
    return options, again


def _slider(name: Unit, value: int) -> int:
    """Draw a logarithmic slider for a number."""
    width = min(22 * imgui.get_font_size(), 0.6 * imgui.get_content_region_avail().x)
    imgui.set_next_item_width(width)
    logarithmic = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    limits = whole_range_of(CostOptions, name)
    changed, chosen = slider_int(name, value, *limits, "%d", logarithmic)
    return chosen if changed else value


def frames_plot(told: CostReport, size: ImVec2) -> None:
    """Plot the last frames' times: each frame in pale, the median of the last few in strong
    colours.
    """
    if not implot.begin_plot(
        "##frames", size, implot.Flags_.no_mouse_text | implot.Flags_.no_menus
    ):
        return
    times = 1e3 * np.array(told.history, float).reshape(-1, 2)
    implot.setup_axes("frames", "milliseconds", implot.AxisFlags_.no_tick_labels)
    top = max(
        [
            0.1,
            *(float(smoothed(column[np.isfinite(column)]).max(initial=0.1)) for column in times.T),
        ]
    )
    limits = implot.Cond_.always
    implot.setup_axis_limits(implot.ImAxis_.x1, 0, WATCHED - 1, limits)
    implot.setup_axis_limits(implot.ImAxis_.y1, 0, _round_up(1.3 * top), limits)
    implot.setup_legend(implot.Location_.north_west)
    at = np.arange(WATCHED - len(times), WATCHED, dtype=float)
    for column, renderer in enumerate(RENDERERS):
        shown = np.isfinite(times[:, column])
        if shown.any():
            values = times[shown, column]
            steady = smoothed(values)
            pale = _spec(renderer)
            pale.line_color = ImVec4(pale.line_color.x, pale.line_color.y, pale.line_color.z, 0.35)
            pale.line_weight = theme.line_px(1.0)
            implot.plot_line(f"##{renderer}", at[shown], values, pale)
            label = f"{TITLES[renderer]}  {steady[-1]:8.2f} ms###{renderer}"
            implot.plot_line(label, at[shown], steady, _spec(renderer))
            implot.tag_y(float(steady[-1]), color_of(renderer), renderer)
    implot.end_plot()


def plot(options: CostOptions, told: CostReport, size: ImVec2) -> None:
    """Plot steps and times. All axes are logarithmic: a loop over n is a straight line that climbs
    like n.

    They are side by side if there is room, else one above the other. A small view shows only steps.
    """
    unit = options.against
    if unit == "frames":
        frames_plot(told, size)
        return
    gap = imgui.get_style().item_spacing
    if max(size.x, size.y) < SMALL_EM * imgui.get_font_size():
        _steps_plot(unit, told, size)
        return
    if size.x >= size.y:
        each = ImVec2((size.x - gap.x) / 2, size.y)
    else:
        each = ImVec2(size.x, (size.y - gap.y) / 2)
    _steps_plot(unit, told, each)
    if size.x >= size.y:
        imgui.same_line()
    _times_plot(unit, told, each)


def _steps_plot(unit: Unit, told: CostReport, size: ImVec2) -> None:
    """Plot the counts."""
    lines = [
        Line(steps.title, steps.renderer, sorted(points_of(told.work, unit, steps.of)))
        for steps in STEPS
    ]
    _lines_plot("steps, counted", unit, size, lines)


def _times_plot(unit: Unit, told: CostReport, size: ImVec2) -> None:
    """Plot the times."""
    lines = [
        Line(renderer, renderer, sorted((n, 1e3 * t) for n, t in times_of(told, unit, renderer)))
        for renderer in RENDERERS
    ]
    _lines_plot(f"milliseconds, {told.machine}", unit, size, lines)


def _lines_plot(title: str, unit: Unit, size: ImVec2, lines: list[Line]) -> None:
    """Plot lines with dots, and their titles at the right, below one another if there is room."""
    flags = implot.Flags_.no_mouse_text | implot.Flags_.no_menus | implot.Flags_.no_legend
    if not implot.begin_plot(title, size, flags):
        return
    lines = [line for line in lines if line.points]
    em, line_px = imgui.get_font_size(), imgui.get_text_line_height()
    titles_px = max((imgui.calc_text_size(line.title).x for line in lines), default=0.0) + 1.5 * em
    is_titled = size.y - AROUND_EM * em > (len(lines) + 1) * line_px
    if not is_titled or titles_px > TITLES_PART * size.x:
        is_titled, titles_px = False, 0.0
    implot.setup_axes(unit, "")
    x, y = implot.ImAxis_.x1, implot.ImAxis_.y1
    low, high = _powers_around([value for line in lines for _, value in line.points])
    for axis, least, most in ((x, *extent(unit)), (y, low, high)):
        implot.setup_axis_scale(axis, implot.Scale_.log10)
        first, last = least / MARGIN, most * MARGIN
        if axis == x:  # the titles' room is part of the axis
            last = first * (last / first) ** (1 / (1 - titles_px / (size.x - 4 * em)))
        implot.setup_axis_limits(axis, first, last, implot.Cond_.always)
        # As many powers of ten as fit side by side.
        across = (size.x - titles_px) / 2.5 if axis == x else size.y - AROUND_EM * em
        fit = max(1.0, across / (1.5 * em))
        every = max(1, math.ceil(math.log10(most / least) / fit))
        ticks = [power for power in POWERS[::every] if power <= most]
        implot.setup_axis_ticks(axis, ticks, [_written(power) for power in ticks])
    for line in lines:
        xs, ys = np.array(line.points, float).T
        implot.plot_line(line.title, xs.copy(), ys.copy(), _spec(line.renderer))
    draw = implot.get_plot_draw_list()
    implot.push_plot_clip_rect()
    ends = []
    for line in lines:
        dots = [implot.plot_to_pixels(*point) for point in line.points]
        for dot in dots:  # round: ImPlot's own are polygons of ten corners
            color, half = theme.u32(color_of(line.renderer)), theme.px(4.5)
            if line.renderer == "ray":
                draw.add_circle_filled(dot, half, color)
            else:  # another shape, for those who do not see the colour
                draw.add_rect_filled(dot - ImVec2(half, half), dot + ImVec2(half, half), color)
        ends.append((dots[-1].y - line_px / 2, dots[-1].x + em, line))
    if is_titled:
        ends.sort(key=lambda end: end[0])
        top = implot.get_plot_pos().y
        bottom = top + implot.get_plot_size().y - line_px
        places = apart([end[0] for end in ends], line_px, top, bottom)
        for place, (_, left, line) in zip(places, ends, strict=True):
            color = theme.u32(theme.legible(color_of(line.renderer)))
            draw.add_text(ImVec2(left, place), color, line.title)
    implot.pop_plot_clip_rect()
    implot.end_plot()


def apart(wanted: Sequence[float], least: float, low: float, high: float) -> list[float]:
    """Return places at least `least` apart, from low to high, near the wanted ones, in their
    ascending order.
    """
    places: list[float] = []
    for place in wanted:
        places.append(max(place, places[-1] + least if places else low))
    return [min(place, high - k * least) for k, place in enumerate(reversed(places))][::-1]


def points_of(work: Sequence[Work], unit: Unit, of: str) -> list[Point]:
    """Return (n, steps), one for each image."""
    return [(float(getattr(one, unit)), float(getattr(one, of))) for one in work]


def times_of(told: CostReport, unit: Unit, renderer: Renderer) -> list[Point]:
    """Return (n, seconds) of a renderer's samples."""
    return [
        (float(getattr(one, unit)), max(one.time_s, SHORTEST_S))
        for one in told.samples
        if one.case.renderer == renderer
    ]


def said(options: CostOptions, told: CostReport) -> list[tuple[Renderer, str]]:
    """Return what the plots show, a line for each loop.

    Only what is certain: counts, once there are enough, and that a time climbs in proportion, if
    its line is steep and straight.
    """
    unit = options.against
    if unit == "frames":
        return []
    lines: list[tuple[Renderer, str]] = []
    for renderer in RENDERERS:
        parts = []
        for steps in STEPS:
            if steps.renderer == renderer:
                points = points_of(told.work, unit, steps.of)
                growth = count_growth(points, unit)
                if growth == f"~ log {unit}":
                    rays = points_of(told.work, unit, "rays")[0][1]
                    each = per_doubling(points) / rays
                    growth += f" (+{each:.1f} for each ray, with twice the {unit})"
                if growth:
                    parts.append(f"{steps.title}{' ' if growth[0] == '~' else ': '}{growth}")
        if not told.waiting and is_proportional(times_of(told, unit, renderer)):
            parts.append(f"time ~ {unit} where its line is steep")
        if parts:
            lines.append((renderer, f"{ORDERS[renderer]}: {'; '.join(parts)}."))
    return lines


def smoothed(times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the median of each time and the few before it, to hide momentary disturbances."""
    if not len(times):
        return times
    padded = np.concatenate([np.repeat(times[:1], SMOOTHED - 1), times])
    return np.median(np.lib.stride_tricks.sliding_window_view(padded, SMOOTHED), axis=1)


def _spec(renderer: Renderer) -> implot.Spec:
    spec = implot.Spec()
    spec.line_color = color_of(renderer)
    spec.line_weight = theme.line_px(2.2)
    return spec


def color_of(renderer: Renderer) -> ImVec4:
    """Return blue or orange, which everybody can distinguish. Orange is for rays everywhere."""
    return theme.RAY if renderer == "ray" else theme.BASIS["w"]


def extent(unit: Unit) -> tuple[int, int]:
    """Return the least and the most that is plotted."""
    return (
        (100, whole_range_of(CostOptions, "triangles")[1])
        if unit == "triangles"
        else (1200, 1_228_800)
    )


def _powers_around(values: Sequence[float]) -> tuple[float, float]:
    """Return the range of the axis: whole powers of ten around all values."""
    known = values or [1.0]
    low = 10.0 ** np.floor(np.log10(min(known)))
    high = 10.0 ** np.ceil(np.log10(max(known) * 1.05))
    return float(low), float(max(high, 10 * low))


def _written(value: float) -> str:
    """Return a power of ten for an axis: 0.1, 100, 10k, 1M."""
    for unit, letter in ((1e6, "M"), (1e3, "k")):
        if value >= unit:
            return f"{value / unit:g}{letter}"
    return f"{value:g}"


def _round_up(value: float) -> float:
    """Round up to 1, 2 or 5 times a power of ten, so that the axis seldom moves."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(step * power for step in (1, 2, 5, 10) if step * power >= value))
