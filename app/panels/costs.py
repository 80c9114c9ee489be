"""The cost plot's panel: both renderers' times against triangles, or pixels.

Owns the plot's look and its controls. Knows nothing of how times are measured.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, implot

from app import theme
from app.options import CostOptions
from app.teach.costs import (
    LEAST_PIXELS,
    LEAST_TRIANGLES,
    MOST_PIXELS,
    MOST_TRIANGLES,
    RENDERERS,
    Renderer,
    Sample,
    growth_text,
)

TITLES: dict[Renderer, str] = {"raster": "raster, object order", "ray": "ray, image order"}
TOP_TRIANGLES = 1_000_000  # of the slider and the plot
AGAINST: tuple[Literal["triangles", "pixels"], ...] = ("triangles", "pixels")


@dataclass(frozen=True)
class Told:
    """What the panel shows. waiting: how many cases are to be measured yet. problems: why a
    renderer cannot be measured."""

    samples: Sequence[Sample]
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
    # The one that is plotted along the axis is not to be chosen.
    width = min(22 * imgui.get_font_size(), 0.6 * imgui.get_content_region_avail().x)
    imgui.set_next_item_width(width)
    logarithmic = imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp
    if options.against == "pixels":
        changed, value = imgui.slider_int(
            "triangles", options.triangles, LEAST_TRIANGLES, TOP_TRIANGLES, "%d", logarithmic
        )
        if changed:
            options = replace(options, triangles=min(max(value, LEAST_TRIANGLES), MOST_TRIANGLES))
    else:
        changed, value = imgui.slider_int(
            "pixels", options.pixels, LEAST_PIXELS, MOST_PIXELS, "%d", logarithmic
        )
        if changed:
            options = replace(options, pixels=min(max(value, LEAST_PIXELS), MOST_PIXELS))
    return options, again


def plot(options: CostOptions, told: Told, size: ImVec2) -> None:
    """The times, both axes logarithmic: a loop over n is a straight line that climbs like n."""
    if not implot.begin_plot("##costs", size, implot.Flags_.no_mouse_text | implot.Flags_.no_menus):
        return
    unit = options.against
    implot.setup_axes(unit, "milliseconds")
    x, y = implot.ImAxis_.x1, implot.ImAxis_.y1
    implot.setup_axis_scale(x, implot.Scale_.log10)
    implot.setup_axis_scale(y, implot.Scale_.log10)
    least, most = extent(unit)
    implot.setup_axis_limits(x, least / 1.5, most * 1.5, implot.Cond_.always)
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
        spec = implot.Spec()
        spec.line_color = spec.marker_fill_color = spec.marker_line_color = color_of(renderer)
        spec.line_weight = theme.line_px(2.2)
        spec.marker = implot.Marker_.circle
        spec.marker_size = theme.px(4.5)
        label = f"{TITLES[renderer]}  {growth_text(chosen, unit)}"
        implot.plot_line(f"{label}###{renderer}", counts[order], times[order], spec)
    implot.end_plot()


def color_of(renderer: Renderer) -> ImVec4:
    """Blue and orange, which everybody tells apart; orange is the rays' everywhere."""
    return theme.RAY if renderer == "ray" else theme.BASIS["w"]


def extent(unit: Literal["triangles", "pixels"]) -> tuple[int, int]:
    """The least and the most that is plotted."""
    return (100, TOP_TRIANGLES) if unit == "triangles" else (1200, 1_228_800)


def _times(samples: Sequence[Sample]) -> tuple[float, float]:
    """The lowest and highest time on the axis, in ms: whole powers of ten around all."""
    times = [1e3 * max(one.time_s, 1e-6) for one in samples] or [1.0]
    low = 10.0 ** np.floor(np.log10(min(times)))
    high = 10.0 ** np.ceil(np.log10(max(times) * 1.05))
    return float(low), float(max(high, 10 * low))
