"""A strip above each image: which channel, how large, how magnified, and how it is displayed.

Everything on it is also in the menu "Image" and on keys; both images share it.
"""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import ImVec2, imgui

from lucida.app.images.imaging import CHANNELS, resolution_text
from lucida.app.images.pair.actions import (
    FACTORS,
    FIT,
    LINEAR,
    PIXELS,
    SHOWN_CHANNEL,
    SHOWN_COMPONENT,
    SIZES,
)
from lucida.app.images.photograph.actions import entries
from lucida.app.images.placement import magnification_text
from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.action import Action, draw_entry
from lucida.app.ui.host import Host
from lucida.app.ui.rows import tip

PADDING = ImVec2(6, 2)
GAP = 2.0
ARROW = 0.9  # the room of the triangle, in the font's size


def _channel_text(state: AppState) -> str:
    images = state.images
    if images.component != "rgb":
        return images.component.capitalize()
    linear = images.channel == "color" and images.transfer == "linear"
    return CHANNELS[images.channel][0] + ", linear" * linear


def _photograph_text(state: AppState) -> str:
    options = state.options.photograph
    if not options.file:
        return ""
    return f"Photo {100 * options.opacity:.0f} %" if options.shown else "Photo off"


def _magnification_text(state: AppState) -> str:
    factor = state.images.magnification
    return "Fit" if factor is None else magnification_text(factor)


# Of each part: its name, its text, "" to leave it out, its tooltip, and its entries.
PARTS: tuple[tuple[str, Callable[[AppState], str], str, tuple[Action, ...]], ...] = (
    (
        "channel",
        _channel_text,
        "What both images show: colour, depth, normal, object or distance z; all of a colour, or"
        " one channel.",
        (*SHOWN_CHANNEL, *SHOWN_COMPONENT, LINEAR),
    ),
    (
        "photograph",
        _photograph_text,
        "The photograph that is laid over the images: how opaque, where (Alt+P: on and off).",
        (),
    ),
    (
        "resolution",
        lambda state: resolution_text(state.images),
        "How many pixels both images have: as many as fit the window, or a fixed number.",
        SIZES,
    ),
    (
        "magnification",
        _magnification_text,
        "How large a pixel of the images is on the screen (Ctrl+wheel over an image).",
        (FIT, *FACTORS, *PIXELS),
    ),
)


def image_strip(view: str, host: Host) -> None:
    """Draw the strip into the current window. view: its name."""
    imgui.push_style_var(imgui.StyleVar_.frame_padding, PADDING)
    imgui.push_style_color(imgui.Col_.button, theme.UNSEEN)
    imgui.push_id(f"strip {view}")
    start, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    height = imgui.get_frame_height()
    far = ImVec2(start.x + room, start.y + height)
    imgui.get_window_draw_list().add_rect_filled(start, far, theme.u32(theme.PANEL))
    for place, (name, label, tooltip, actions) in enumerate(PARTS):
        text = label(host.state)
        if not text:
            continue
        width = imgui.calc_text_size(text).x + 2 * PADDING.x + ARROW * imgui.get_font_size()
        if width > room:
            break
        room -= width + GAP
        if place:
            imgui.same_line(0, GAP)
        if _drop_down(name, text, width):
            imgui.open_popup(name)
        low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
        tip(tooltip)
        imgui.set_next_window_pos(ImVec2(low.x, high.y + 2), imgui.Cond_.appearing)
        if imgui.begin_popup(name):
            for action in actions:
                draw_entry(action, host, first=action is actions[0])
            if name == "photograph":
                entries(host)
            imgui.end_popup()
    if room > 0:
        imgui.same_line(0, 0)
        imgui.dummy(ImVec2(0, height))
    imgui.pop_id()
    imgui.pop_style_color()
    imgui.pop_style_var()
    imgui.set_cursor_screen_pos(ImVec2(start.x, far.y))


def _drop_down(name: str, text: str, width: float) -> bool:
    """Draw a flat button with a small triangle after its text."""
    at = imgui.get_cursor_screen_pos()
    pressed = imgui.button(f"##{name}", ImVec2(width, 0))
    size, draw = imgui.get_font_size(), imgui.get_window_draw_list()
    draw.add_text(at + PADDING, imgui.get_color_u32(imgui.Col_.text), text)
    middle = at + ImVec2(width - PADDING.x - 0.25 * size, PADDING.y + 0.56 * size)
    side = 0.22 * size
    draw.add_triangle_filled(
        middle + ImVec2(-side, -0.6 * side),
        middle + ImVec2(side, -0.6 * side),
        middle + ImVec2(0, 0.8 * side),
        theme.u32(theme.DIM),
    )
    return bool(pressed)
