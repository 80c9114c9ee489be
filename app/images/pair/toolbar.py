"""A strip above each image: which channel, how large, how magnified, and how it is displayed.

Owns its look. Everything on it is also in the menu "Image" and on keys; both images share it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from imgui_bundle import ImVec2, imgui

from lucida.app.images.imaging import (
    CHANNELS,
    COMPONENTS,
    TRANSFERS,
    lens_text,
    resolution_text,
    size_text,
)
from lucida.app.images.pair import choices
from lucida.app.images.pair.choices import Choice
from lucida.app.images.photograph.panel import entries
from lucida.app.images.placement import magnification_text
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import RESOLUTIONS
from lucida.app.ui import theme
from lucida.app.ui.rows import tip

PADDING = ImVec2(6, 2)
GAP = 2.0
_TOLD: dict[str, Mapping[Any, tuple[str, str]]] = {
    "channel": CHANNELS,
    "transfer": TRANSFERS,
    "component": COMPONENTS,
}
ARROW = 0.9  # the room of the triangle, in the font's size


@dataclass(frozen=True)
class Strip:
    """The inputs of the strip.

    name: of the view. ask_resolution: opens the box to type one. photo_size: of the open
    photograph, (0, 0) if unknown.
    """

    name: str
    ask_resolution: Callable[[], None]
    photo_size: tuple[int, int] = (0, 0)


def image_strip(strip: Strip, state: AppState) -> AppState:
    """Draw the strip into the current window."""
    imgui.push_style_var(imgui.StyleVar_.frame_padding, PADDING)
    imgui.push_style_color(imgui.Col_.button, theme.UNSEEN)
    imgui.push_id(f"strip {strip.name}")
    start, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    height = imgui.get_frame_height()
    far = ImVec2(start.x + room, start.y + height)
    imgui.get_window_draw_list().add_rect_filled(start, far, theme.u32(theme.PANEL))
    for place, (name, label, tooltip, menu) in enumerate(_PARTS):
        text = label(state)
        if not text or (name == "lens" and strip.name != "Raster"):
            continue
        width = _width(text)
        if width > room:
            break
        room -= width + GAP
        if place:
            imgui.same_line(0, GAP)
        if _drop_down(name, text, width):
            imgui.open_popup(name)
        low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
        tip(f"{told_now(state, name)}{tooltip}")
        imgui.set_next_window_pos(ImVec2(low.x, high.y + 2), imgui.Cond_.appearing)
        if imgui.begin_popup(name):
            state = menu(strip, state)
            imgui.end_popup()
    if room > 0 and _PARTS:
        imgui.same_line(0, 0)
        imgui.dummy(ImVec2(0, height))
    imgui.pop_id()
    imgui.pop_style_color()
    imgui.pop_style_var()
    imgui.set_cursor_screen_pos(ImVec2(start.x, far.y))
    return state


def told_now(state: AppState, part: str) -> str:
    """Return the meaning of a part's selected entry, for its tooltip: `sRGB: linear light through
    ...`.
    """
    told = _TOLD.get(part)
    return ": ".join(told[getattr(state.images, part)]) + ".\n" if told is not None else ""


def _drop_down(name: str, text: str, width: float) -> bool:
    """Draw a flat button with a small triangle after its text."""
    at = imgui.get_cursor_screen_pos()
    pressed = imgui.button(f"##{name}", ImVec2(width, 0))
    size, draw = imgui.get_font_size(), imgui.get_window_draw_list()
    color = imgui.get_color_u32(imgui.Col_.text)
    draw.add_text(ImVec2(at.x + PADDING.x, at.y + PADDING.y), color, text)
    x, y = at.x + width - PADDING.x - 0.25 * size, at.y + PADDING.y + 0.56 * size
    side = 0.22 * size
    draw.add_triangle_filled(
        ImVec2(x - side, y - 0.6 * side),
        ImVec2(x + side, y - 0.6 * side),
        ImVec2(x, y + 0.8 * side),
        theme.u32(theme.DIM),
    )
    return pressed


def _width(text: str) -> float:
    return imgui.calc_text_size(text).x + 2 * PADDING.x + ARROW * imgui.get_font_size()


def _entries(state: AppState, offered: Iterable[Choice], is_radio: bool = False) -> AppState:
    """Draw entries of a menu. is_radio: clicking the selected one does nothing."""
    for choice in offered:
        on = choice.is_on(state)
        pressed = imgui.menu_item(choice.label or choice.name, choice.keys, on)[0]
        if choice.tip:
            imgui.set_item_tooltip(choice.tip)
        if pressed and not (is_radio and on):
            state = choice.change(state)
    return state


def _channel(strip: Strip, state: AppState) -> AppState:
    return _entries(state, choices.CHANNEL)


def _resolution(strip: Strip, state: AppState) -> AppState:
    now = state.images.resolution
    state = _entries(state, choices.PIXEL_SIZE)
    imgui.separator()
    state = _entries(state, choices.RESOLUTION)
    imgui.separator()
    own = now is not None and now not in RESOLUTIONS
    name = f"Custom size ({size_text(now)})..." if own and now else "Custom size..."
    if imgui.menu_item(name, "Alt+S", own)[0]:
        strip.ask_resolution()
    imgui.separator()
    return _entries(state, choices.SAMPLE)


def _magnification(strip: Strip, state: AppState) -> AppState:
    state = _entries(state, (choices.FIT, *choices.MAGNIFICATION))
    imgui.separator()
    return _entries(state, (choices.GRID, choices.VALUES))


def _transfer(strip: Strip, state: AppState) -> AppState:
    for transfer, (name, tooltip) in TRANSFERS.items():
        if imgui.menu_item(name, "Alt+L", state.images.transfer == transfer)[0]:
            state = state.with_options(replace(state.options.images, transfer=transfer))
        imgui.set_item_tooltip(tooltip)
    return state


def _component(strip: Strip, state: AppState) -> AppState:
    return _entries(state, (choices.RGB, *choices.COMPONENT), is_radio=True)


def _lens(strip: Strip, state: AppState) -> AppState:
    return _entries(state, choices.LENS, is_radio=True)


def _photograph(strip: Strip, state: AppState) -> AppState:
    return entries(state, strip.photo_size)


def _photograph_text(state: AppState) -> str:
    options = state.options.photograph
    if not options.file:
        return ""
    return f"Photo {100 * options.opacity:.0f} %" if options.shown else "Photo off"


def _magnification_text(state: AppState) -> str:
    factor = state.images.magnification
    return "Fit" if factor is None else magnification_text(factor)


_PARTS = (
    (
        "channel",
        lambda state: CHANNELS[state.images.channel][0],
        "What both images show: colour, depth, normal or object (Alt+1 to Alt+4).",
        _channel,
    ),
    (
        "photograph",
        _photograph_text,
        "The photograph that is laid over the images: how opaque, where (Alt+P: on and off).",
        _photograph,
    ),
    (
        "lens",
        lens_text,
        "How a rasterizer, which has no matrix for a lens, draws its image.",
        _lens,
    ),
    (
        "resolution",
        lambda state: resolution_text(state.images),
        "How many pixels both images have: as many as fit the window, or a fixed number.",
        _resolution,
    ),
    (
        "magnification",
        _magnification_text,
        "How large a pixel of the images is on the screen (Ctrl+wheel over an image).",
        _magnification,
    ),
    (
        "transfer",
        lambda state: TRANSFERS[state.images.transfer][0],
        "How linear light becomes what the screen gets (Alt+L).",
        _transfer,
    ),
    (
        "component",
        lambda state: COMPONENTS[state.images.component][0],
        "All of a colour, or one of its channels (Alt+R, Alt+G, Alt+B).",
        _component,
    ),
)
