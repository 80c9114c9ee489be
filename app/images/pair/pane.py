"""An image in a window, pixel by pixel, with everything that is drawn over it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from imgui_bundle import ImVec2, imgui

from lucida.app.images.pair.dark_note import DarkNote, draw_dark_note
from lucida.app.images.pair.image_mouse import Grab, Seen, Zoom, ZoomAnchor, drag, magnify, wheel
from lucida.app.images.pair.marks import claim_keys, draw_hovered, draw_marked
from lucida.app.images.pair.overlay import draw_legend, draw_magnification, draw_note
from lucida.app.images.pair.pixelgrid import Values, draw_pixel_grid
from lucida.app.images.pair.rulers import draw_rulers
from lucida.app.images.placement import Placement
from lucida.app.images.screen import Box, Screen
from lucida.app.images.shown import Picture
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.areas import mouse_area

# Returns the visible part of a state's image in a window; None for no image.
Drawn = Callable[[AppState, Placement], Picture | None]


@dataclass(frozen=True)
class Pane:
    """One image's window. picture: asked after the mouse has moved the camera.
    values: of some pixels, likewise; None: they are not written.

    note: text over the image, which is darkened: it is not of now. dark: why an image as it should
    be is black. progress: of the image under way, 1 for none. hovered: the pixel
    under the mouse, to be marked here. depths: those that are
    shown white and darkest. legend: whether the channel's colours are explained. on_pixels:
    draws on the image, below everything else. held: the mouse is on something of another's.
    """

    seen: Seen
    picture: Drawn
    values: Values | None
    fonts: theme.Fonts
    note: str = ""
    is_error: bool = False
    dark: DarkNote | None = None
    progress: float = 1.0
    legend: bool = True
    has_tools: bool = True
    hovered: Pixel | None = None
    depths: tuple[float, float] | None = None
    on_pixels: Callable[[Screen], None] | None = None
    held: bool = False


@dataclass
class MouseState:
    """The drag under way, and the last aims of the wheel."""

    grab: Grab | None = None
    zoom: Zoom | None = None
    anchor: ZoomAnchor | None = None


@dataclass(frozen=True)
class PaneResult:
    """hovered: the pixel under the mouse. turned: what the wheel did, "" if it rests. keyed: True
    if the arrow keys are for the image.
    """

    state: AppState
    hovered: Pixel | None = None
    turned: Literal["", "wheel", "magnify"] = ""
    keyed: bool = False


def image_pane(
    pane: Pane,
    state: AppState,
    placed: Callable[[AppState], Placement],
    mouse: MouseState,
) -> PaneResult:
    """Draw the image into the rest of the current window, and handle the mouse over it.

    placed: its place there.
    """
    seen, io = pane.seen, imgui.get_io()
    start, avail = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    room = start, ImVec2(start.x + avail.x, start.y + avail.y)
    screen = Screen.here(placed(state))
    low, high = screen.visible
    imgui.set_cursor_screen_pos(low)
    buttons = imgui.ButtonFlags_
    if pane.held and mouse.grab is None:
        imgui.dummy(ImVec2(high.x - low.x, high.y - low.y))
        _draw(pane, state, screen, room, mouse.grab)
        return PaneResult(state)
    mouse_area(
        f"image##{seen.name}",
        ImVec2(high.x - low.x, high.y - low.y),
        buttons.mouse_button_left | buttons.mouse_button_right | buttons.mouse_button_middle,
    )
    over = imgui.is_item_hovered()
    keyed = claim_keys()
    hovered = screen.pixel(io.mouse_pos) if over else None
    before = state
    turned: Literal["", "wheel", "magnify"] = ""
    state, mouse.grab = drag(seen, state, mouse.grab, screen)
    if over and io.mouse_wheel and io.key_ctrl:
        state, mouse.anchor = magnify(state, io.mouse_wheel, screen, mouse.anchor)
        turned = "magnify"
    elif over and io.mouse_wheel:
        state, zoom = wheel(seen, state, mouse.zoom, io.mouse_wheel, screen)
        if zoom is not None:
            mouse.zoom, turned = zoom, "wheel"
    if state.images != before.images:
        screen = Screen(placed(state), screen.corner, screen.scale)
    _draw(pane, state, screen, room, mouse.grab)
    return PaneResult(state, hovered if mouse.grab is None else None, turned, keyed)


def _draw(pane: Pane, state: AppState, screen: Screen, room: Box, grab: Grab | None) -> None:
    draw = imgui.get_window_draw_list()
    low, high = screen.visible
    picture = pane.picture(state, screen.placement)
    if picture is None:  # yet: no part of it may be taken for a black image
        draw.add_rect_filled(*room, theme.u32(theme.PANEL))
    else:
        _surround(draw, room, low, high)
    draw.push_clip_rect(*screen.pane, intersect_with_current_clip_rect=True)
    if picture is not None:
        draw.add_image(imgui.ImTextureRef(picture.texture.glo), low, high)
        if pane.on_pixels is not None:
            pane.on_pixels(screen)
    if state.marked is not None:
        draw_marked(draw, screen, state.marked)
    if picture is not None and state.images.grid:  # numbers may reach over a mark
        draw_pixel_grid(draw, screen, state, pane.values, pane.depths, pane.fonts)
    if picture is not None:
        draw.pop_clip_rect()
        draw_rulers(draw, screen, state, pane.fonts, pane.has_tools)
        draw.push_clip_rect(*screen.pane, intersect_with_current_clip_rect=True)
    if pane.hovered is not None and grab is None:
        draw_hovered(draw, screen, pane.hovered)
    if pane.progress < 1.0:
        end = ImVec2(low.x + (high.x - low.x) * pane.progress, high.y)
        draw.add_rect_filled(ImVec2(low.x, high.y - 3), end, theme.u32(theme.RAY))
    if picture is not None:
        if pane.legend and pane.has_tools:
            draw_legend(draw, screen, state, pane.depths, pane.fonts)
        if pane.has_tools:
            draw_magnification(draw, screen, state)
    if pane.note:
        draw_note(draw, screen, pane.note, pane.is_error)
    elif pane.dark is not None:
        draw_dark_note(draw, pane.dark, screen)
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
