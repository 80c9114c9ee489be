"""The frame around a control or a view that a lecture points out.

What is pointed out is in the state (options.highlight).
"""

from __future__ import annotations

import contextlib
import zlib
from collections.abc import Iterator, Mapping

from imgui_bundle import ImVec2, imgui

from app.state.app_state import AppState
from app.ui import theme

Rect = tuple[float, float, float, float]  # left, top, right, bottom
_NOTHING = contextlib.nullcontext()


def pointed(name: str, state: AppState) -> contextlib.AbstractContextManager[None]:
    """Frame what is drawn inside, over the whole width, if it is pointed out. The first one is
    scrolled into sight, once; where nothing is pointed out any more, the window is scrolled back.
    """
    if state.options.highlight:
        return _pointed(name, state)
    _scroll_back()
    return _NOTHING


@contextlib.contextmanager
def _pointed(name: str, state: AppState) -> Iterator[None]:
    start, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    yield
    if name in state.options.highlight:
        style = imgui.get_style()
        beside, above = 0.7 * style.window_padding.x, 0.5 * style.item_spacing.y
        low = start - (beside, above)
        end = imgui.get_cursor_screen_pos().y - style.item_spacing.y
        draw = imgui.get_window_draw_list()
        # The window's own leaves no margin at the sides.
        top, bottom = draw.get_clip_rect_min().y, draw.get_clip_rect_max().y
        sides = low.x - beside, start.x + width + 2 * beside
        draw.push_clip_rect(ImVec2(sides[0], top), ImVec2(sides[1], bottom))
        frame(draw, low, ImVec2(start.x + width + beside, end + above))
        draw.pop_clip_rect()
        if name == state.options.highlight[0]:
            _scroll_to(state.options.highlight, start.y, end)


def _scroll_back() -> None:
    storage, key = imgui.get_state_storage(), imgui.get_id("pointed out")
    if storage.get_int(key, 0):
        storage.set_int(key, 0)
        imgui.set_scroll_y(0.0)


def _scroll_to(names: tuple[str, ...], top: float, end: float) -> None:
    """Scroll the window to what begins at `top`, if that is out of sight, and `names` are new to
    the window or its size is.
    """
    storage, key = imgui.get_state_storage(), imgui.get_id("pointed out")
    window_top, size = imgui.get_window_pos().y, imgui.get_window_size()
    digest = zlib.crc32(f"{names} {size.x:.0f} {size.y:.0f}".encode()) >> 1
    if storage.get_int(key, 0) == digest:
        return
    storage.set_int(key, digest)
    if top < window_top or end > window_top + size.y:
        imgui.set_scroll_from_pos_y(top - window_top - imgui.get_style().window_padding.y, 0.0)


def frame_views(state: AppState, rects: Mapping[str, Rect]) -> None:
    """Frame the views that are pointed out. rects: the rectangles of their contents."""
    for name, (left, top, right, bottom) in rects.items():
        if name.lower() in state.options.highlight:
            draw = imgui.get_foreground_draw_list()
            frame(draw, ImVec2(left + 1, top + 1), ImVec2(right - 1, bottom - 1))


def frame(draw: imgui.ImDrawList, low: ImVec2, high: ImVec2) -> None:
    """Draw the frame in the marked pixel's yellow with a dark edge, so that it shows on any
    colour.
    """
    draw.add_rect(low, high, theme.u32(theme.rgb("#000000", 0.6)), theme.px(4), theme.line_px(2))
    draw.add_rect(low, high, theme.u32(theme.MARK), theme.px(4), theme.line_px(1.2))
