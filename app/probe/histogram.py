"""A pixel's red, green and blue with the histogram of its image.

Each channel has its colour, legible on the panel.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, ImVec4, imgui

from app.images.histogram import VALUES, Histogram
from app.widgets import theme
from app.widgets.lettering import lettering

LINES = 4.2  # of text: as high as the three values
BARS = 0.55  # opacity, so that bars behind are visible
WHAT = "How many pixels of the whole image have each value, 0 to 255, as shown."

Bytes = tuple[int, int, int]
Shown = tuple[Bytes, tuple[float, float, float]]  # a pixel's bytes, and its colour, 0..1


def values_and_histogram(
    pixel: Shown | None, found: Histogram | None, is_traced: bool, fonts: theme.Fonts
) -> None:
    """Draw both over the width of the window. is_traced: False if there is no image for a
    histogram.
    """
    line, start = imgui.get_text_line_height(), imgui.get_cursor_screen_pos()
    width, high = imgui.get_content_region_avail().x, LINES * line
    draw = imgui.get_window_draw_list()
    far = ImVec2(start.x + 1.5 * line, start.y + high)
    if pixel is not None:
        draw.add_rect_filled(start, far, theme.u32(ImVec4(*pixel[1], 1.0)))
    draw.add_rect(start, far, theme.u32(theme.PLAIN))
    left = far.x + 0.5 * line
    imgui.push_font(fonts.mono, 0.0)
    for k, name in enumerate("RGB"):
        text = f"{name} {pixel[0][k]:3d}" if pixel is not None else f"{name}   -"
        at = ImVec2(left, start.y + (k + 0.5) * high / 3 - line / 2)
        draw.add_text(at, theme.u32(theme.legible(theme.CHANNELS[k])), text)
    left += imgui.calc_text_size("R 255").x + 0.7 * line
    imgui.pop_font()
    imgui.dummy(ImVec2(left - start.x, high))
    end = imgui.get_cursor_screen_pos()
    size = ImVec2(start.x + width - left, high)
    if is_traced and size.x > 4 * line:
        imgui.set_cursor_screen_pos(ImVec2(left, start.y))
        plot_counts(found, pixel[0] if pixel is not None else None, size, fonts)
        imgui.set_cursor_screen_pos(end)
        imgui.dummy(ImVec2(0, 0))


def plot_counts(
    found: Histogram | None, pixel: Bytes | None, size: ImVec2, fonts: theme.Fonts
) -> None:
    """Draw the three channels over one another, the pixel's own values as lines, and an axis."""
    low, draw = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    axis = imgui.get_font_size()
    graph = ImVec2(size.x, size.y - axis)
    high = ImVec2(low.x + graph.x, low.y + graph.y)
    draw.add_rect(low, high, theme.u32(theme.PLAIN))
    if found is None:
        draw.add_text(ImVec2(low.x + 0.4 * axis, low.y + 0.4 * axis), theme.u32(theme.DIM), "...")
        return
    imgui.push_style_var(imgui.StyleVar_.frame_padding, ImVec2(0, 0))
    imgui.push_style_color(imgui.Col_.frame_bg, theme.UNSEEN)
    for k, color in enumerate(theme.CHANNELS):
        shown = theme.legible(color)
        bars = ImVec4(shown.x, shown.y, shown.z, BARS)
        imgui.push_style_color(imgui.Col_.plot_histogram, bars)
        imgui.push_style_color(imgui.Col_.plot_histogram_hovered, bars)
        imgui.set_cursor_screen_pos(low)
        imgui.plot_histogram(
            f"##{'RGB'[k]}",
            found.counts[k],
            scale_min=0.0,
            scale_max=found.top,
            graph_size=graph,
        )
        imgui.pop_style_color(2)
    imgui.pop_style_color()
    imgui.pop_style_var()
    if imgui.is_item_hovered():
        _tell(found, (imgui.get_io().mouse_pos.x - low.x) / graph.x)
    for k, value in enumerate(pixel or ()):
        x = low.x + (value + 0.5) / VALUES * graph.x
        own = theme.u32(theme.legible(theme.CHANNELS[k]))
        draw.add_line(ImVec2(x, low.y), ImVec2(x, high.y), own, theme.line_px(1.5))
    with lettering(fonts.mono):
        for text, part in (("0", 0.0), ("128", 0.5), ("255", 1.0)):
            x = low.x + part * (graph.x - imgui.calc_text_size(text).x)
            draw.add_text(ImVec2(x, high.y), theme.u32(theme.DIM), text)


def _tell(found: Histogram, part: float) -> None:
    """Show the counts of the value under the mouse."""
    value = min(max(int(part * VALUES), 0), VALUES - 1)
    red, green, blue = (int(count) for count in found.counts[:, value])
    counted = f"\nCounted: one of {found.every**2} pixels." if found.every > 1 else ""
    imgui.set_tooltip(
        f"{value}: R {red}, G {green}, B {blue} pixels\n{WHAT}\n"
        f"Taller bars than there is room for are cut.{counted}"
    )
