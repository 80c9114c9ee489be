"""The cost plot's panel: both renderers' times against triangles, or pixels.

Owns the plot's look and its controls. Knows nothing of how times are measured.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, implot
from numpy.typing import NDArray

from app import theme
from app.bounds import whole_range_of
from app.options import CostOptions
from app.panels.sliders import slider_int
from app.teach.costs import (
    RENDERERS,
    WATCHED,
    Renderer,
    Sample,
    growth_text,
)

TITLES: dict[Renderer, str] = {"raster": "raster, object order", "ray": "ray, image order"}
SMOOTHED = 9  # frames
AGAINST: tuple[Literal["frames", "triangles", "pixels"], ...] = ("frames", "triangles", "pixels")


@dataclass(frozen=True)
class Told:
    """What the panel shows. samples: of a growing number. history: the last frames' times,
    (raster, ray) in seconds. waiting: how many cases are to be measured yet. problems: why a
    renderer cannot be measured."""

    samples: Sequence[Sample]
    history: Sequence[tuple[float, float]]
    waiting: int
    problems: dict[Renderer, str]


def controls(options: CostOptions, told: Told) -> tuple[CostOptions, bool]:
    """(options, whether everything is to be measured again)."""
    imgui.align_text_to_frame_padding()
    imgui.text("against")
    for name in AGAINST:
        imgui.same_line()
        if imgui.radio_button(name, options.against == name):
            options = replace(options, against=name)
    imgui.same_line()
    again = imgui.button("Measure again")
    if told.waiting:
        imgui.same_line()
        imgui.text_colored(theme.DIM, f"measuring, {told.waiting} to go ...")
    # What is plotted along the axis is not to be chosen.
    if options.against != "triangles":
        options = replace(options, triangles=_slider("triangles", options.triangles))
    if options.against != "pixels":
        options = replace(options, pixels=_slider("pixels", options.pixels))
    return options, again


def _slider(name: Literal["triangles", "pixels"], value: int) -> int:
    """A number that differs by factors."""
    width = min(22 * imgui.get_font_size(), 0.6 * imgui.get_content_region_avail().x)
    imgui.set_next_item_width(width)
    logarithmic = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    limits = whole_range_of(CostOptions, name)
    changed, chosen = slider_int(name, value, *limits, "%d", logarithmic)
    return chosen if changed else value


def frames_plot(told: Told, size: ImVec2) -> None:
    """The last frames' times, as they come, and pale; strong: the median of the last few."""
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
    implot.end_plot()


def plot(options: CostOptions, told: Told, size: ImVec2) -> None:
    """The times, both axes logarithmic: a loop over n is a straight line that climbs like n."""
    unit = options.against
    if unit == "frames":
        frames_plot(told, size)
        return
    if not implot.begin_plot("##costs", size, implot.Flags_.no_mouse_text | implot.Flags_.no_menus):
        return
    implot.setup_axes(unit, "milliseconds")
    x, y = implot.ImAxis_.x1, implot.ImAxis_.y1
    implot.setup_axis_scale(x, implot.Scale_.log10)
    implot.setup_axis_scale(y, implot.Scale_.log10)
    least, most = extent(unit)
    implot.setup_axis_limits(x, least / 1.5, most * 1.5, implot.Cond_.always)
    implot.setup_axis_format(x, "%.0f")
    low, high = _times(told.samples)
    implot.setup_axis_limits(y, low, high, implot.Cond_.always)
    implot.setup_legend(implot.Location_.north_west)
    for renderer in RENDERERS:
        chosen = [one for one in told.samples if one.case.renderer == renderer]
        if not chosen:
            continue
        counts = np.array([float(getattr(one, unit)) for one in chosen])
        order = np.argsort(counts)
        times = np.array([1e3 * one.time_s for one in chosen])
        spec = _spec(renderer)
        spec.marker = implot.Marker_.circle
        spec.marker_size = theme.px(4.5)
        label = f"{TITLES[renderer]}  {growth_text(chosen, unit)}"
        implot.plot_line(f"{label}###{renderer}", counts[order], times[order], spec)
    implot.end_plot()


def smoothed(times: NDArray[np.float64]) -> NDArray[np.float64]:
    """The median of each time and the few before it: a moment's disturbance does not show."""
    if not len(times):
        return times
    padded = np.concatenate([np.repeat(times[:1], SMOOTHED - 1), times])
    return np.median(np.lib.stride_tricks.sliding_window_view(padded, SMOOTHED), axis=1)


def _spec(renderer: Renderer) -> implot.Spec:
    spec = implot.Spec()
    spec.line_color = spec.marker_fill_color = spec.marker_line_color = color_of(renderer)
    spec.line_weight = theme.line_px(2.2)
    return spec


def color_of(renderer: Renderer) -> ImVec4:
    """Blue and orange, which everybody tells apart; orange is the rays' everywhere."""
    return theme.RAY if renderer == "ray" else theme.BASIS["w"]


def extent(unit: Literal["triangles", "pixels"]) -> tuple[int, int]:
    """The least and the most that is plotted."""
    return (
        (100, whole_range_of(CostOptions, "triangles")[1])
        if unit == "triangles"
        else (1200, 1_228_800)
    )


def _times(samples: Sequence[Sample]) -> tuple[float, float]:
    """The lowest and highest time on the axis, in ms: whole powers of ten around all."""
    times = [1e3 * max(one.time_s, 1e-6) for one in samples] or [1.0]
    low = 10.0 ** np.floor(np.log10(min(times)))
    high = 10.0 ** np.ceil(np.log10(max(times) * 1.05))
    return float(low), float(max(high, 10 * low))


def _round_up(value: float) -> float:
    """To 1, 2 or 5 times a power of ten, so that the axis seldom moves."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(step * power for step in (1, 2, 5, 10) if step * power >= value))
