"""An image in a window, pixel by pixel, with everything that is drawn over it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from lucida.app.images.placement import Placement
from lucida.app.images.screen import Box, Screen
from lucida.app.images.shown import Picture
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.host import Host
from lucida.renderer.images.frame import stored
from lucida.renderer.system.errors import describe

from .marks import draw_hovered, draw_marked, draw_pin
from .overlay import draw_legend, draw_note
from .pixelgrid import Values, draw_pixel_grid
from .rulers import draw_rulers

# Returns the visible part of a state's image in a window; None for no image.
Drawn = Callable[[AppState, Placement], Picture | None]


@dataclass(frozen=True)
class Pane:
    """An image's window.

    picture: called after the mouse has moved the camera. values: of some pixels, called likewise;
    None if the image shows no channel. error, note: shown over the outdated, darkened image.
    legend: explain the channel's colours.
    """

    picture: Drawn
    values: Values | None
    error: Exception | None = None
    note: str = ""
    legend: bool = True


def draw_pane(
    host: Host,
    pane: Pane,
    screen: Screen,
    room: Box,
    hovered: Pixel | None,
    on_pixels: Callable[[Host, Screen], None],
) -> None:
    """Draw the image into a box of the current window.

    hovered: the pixel under the mouse, which is framed. on_pixels: draws below everything else.
    """
    draw, state, fonts = imgui.get_window_draw_list(), host.state, host.fonts
    depths = host.renderers.depths() if stored(state.images.channel) == "depth" else None
    low, high = screen.visible
    picture = pane.picture(state, screen.placement)
    if picture is None:  # not ready; the window must not look like a black image
        draw.add_rect_filled(*room, theme.u32(theme.PANEL))
    else:
        _surround(draw, room, low, high)
    draw.push_clip_rect(*screen.pane, intersect_with_current_clip_rect=True)
    if picture is not None:
        draw.add_image(imgui.ImTextureRef(picture.texture.glo), low, high)
        on_pixels(host, screen)
    width, height = host.renderers.size
    for number, (row, column) in enumerate(state.options.probe.pins, 1):
        if row < height and column < width:
            draw_pin(draw, screen, (row, column), number)
    if state.marked is not None:
        draw_marked(draw, screen, state.marked)
    if picture is not None:
        if state.images.grid:  # numbers may reach over a mark
            draw_pixel_grid(draw, screen, state, pane.values, depths, fonts)
        draw.pop_clip_rect()
        draw_rulers(draw, screen, state, fonts, host.has_tools)
        draw.push_clip_rect(*screen.pane, intersect_with_current_clip_rect=True)
    if hovered is not None:
        draw_hovered(draw, screen, hovered)
    if picture is not None and host.has_tools and pane.legend:
        draw_legend(draw, screen, state, depths)
    if pane.error is not None or pane.note:
        text = describe(pane.error) if pane.error is not None else pane.note
        draw_note(draw, screen, text, pane.error is not None)
    draw.pop_clip_rect()


def _surround(draw: imgui.ImDrawList, room: Box, low: ImVec2, high: ImVec2) -> None:
    """Fill the rest of the window (whose own background would be drawn twice)."""
    start, end = room
    for corner, far in (
        (start, ImVec2(end.x, low.y)),
        (ImVec2(start.x, high.y), end),
        (ImVec2(start.x, low.y), ImVec2(low.x, high.y)),
        (ImVec2(high.x, low.y), ImVec2(end.x, high.y)),
    ):
        if far.x > corner.x and far.y > corner.y:
            draw.add_rect_filled(corner, far, theme.u32(theme.BACKGROUND))
