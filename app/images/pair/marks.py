"""The pixel under the mouse, the marked pixel, and those of the probe's pins.

This module has their appearance, and the keys that move the mark, but does not draw pixels.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from lucida.app.images.screen import Screen
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.areas import arrow_steps, claim_arrows, pixel_from

SMALLEST_FRAMED = 6  # a pixel at least this large gets a frame of its own size
NUMBERED = 32.0  # a pixel at least this large has numbers in it
TICK = 9.0  # length of the lines that point at a marked pixel
LARGEST_POINTED_AT = 24.0
CORNER = 0.32  # length of each corner of a pin's frame, relative to a side
_POPUP = int(imgui.WindowFlags_.popup)
_FLOATING = int(imgui.WindowFlags_.no_docking | imgui.WindowFlags_.no_saved_settings)


def draw_hovered(draw: imgui.ImDrawList, screen: Screen, pixel: Pixel) -> None:
    """Draw a frame around a pixel; its own border if that is large enough to see."""
    middle, half = _middle(screen, pixel)
    for grow, color in ((2.0, theme.rgb("#000000", 0.7)), (1.0, theme.MARK)):
        low, high = _square(middle, half, grow)
        draw.add_rect(low, high, theme.u32(color), 0.0, 1.0)


def draw_marked(draw: imgui.ImDrawList, screen: Screen, pixel: Pixel) -> None:
    """Draw a heavier frame. A small one is easier to find by lines towards it from all sides."""
    middle, half = _middle(screen, pixel)
    # The frame is thin around numbers, to fit between them and the neighbours'.
    grow, dark, bright = (0.5, 4.0, 2.0) if min(screen.cell) >= NUMBERED else (1.5, 5.0, 2.0)
    for width, color in ((dark, theme.rgb("#000000", 0.75)), (bright, theme.MARK)):
        low, high = _square(middle, half, grow)
        draw.add_rect(low, high, theme.u32(color), 0.0, width)
        if min(screen.cell) > LARGEST_POINTED_AT:
            continue
        for way in (ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1)):
            start = middle + way * (half + ImVec2(2, 2))
            draw.add_line(start, start + way * TICK, theme.u32(color), width)


def draw_pin(draw: imgui.ImDrawList, screen: Screen, pixel: Pixel, number: int) -> None:
    """Draw four corners with a number next to them, in the colour of its ray in the outside view.
    Only a mark has a whole frame. The number stays in the view.
    """
    middle, half = _middle(screen, pixel)
    low, high = _square(middle, half, 1.0)
    arm = (high - low) * CORNER
    for width, color in ((3.5, theme.rgb("#000000", 0.7)), (1.5, theme.RAY)):
        for x, toward_x in ((low.x, arm.x), (high.x, -arm.x)):
            for y, toward_y in ((low.y, arm.y), (high.y, -arm.y)):
                draw.add_line(ImVec2(x, y), ImVec2(x + toward_x, y), theme.u32(color), width)
                draw.add_line(ImVec2(x, y), ImVec2(x, y + toward_y), theme.u32(color), width)
    text = str(number)
    size = imgui.calc_text_size(text)
    near, end = screen.pane
    left, top = middle.x + half[0] + 3.0, middle.y - half[1] - size.y
    if near.x <= middle.x <= end.x and near.y <= middle.y <= end.y:
        left, top = min(left, end.x - size.x - 6.0), max(top, near.y)
    corner, far = ImVec2(left, top), ImVec2(left + size.x + 6.0, top + size.y)
    draw.add_rect_filled(corner, far, theme.u32(theme.rgb("#000000", 0.85)), 2.0)
    draw.add_text(ImVec2(left + 3.0, top), theme.u32(theme.RAY), text)


def claim_keys() -> bool:
    """Claim the arrow keys for the current item while the mouse is on it or it has the keyboard.

    Return True if they are claimed. After a key of ImGui's navigation (Tab, say), ImGui reports
    nothing as hovered until the mouse moves, so the mouse position decides. Menus, and a box that
    floats over the views, keep their keys.
    """
    resting = imgui.is_item_hovered(imgui.HoveredFlags_.no_nav_override) and not _in_a_box()
    if not (resting or imgui.is_item_focused()):
        return False
    claim_arrows()
    return True


def _in_a_box() -> bool:
    """Return True if a menu or a window that floats over the views has the keyboard."""
    context, here = imgui.get_current_context(), imgui.internal.get_current_window()
    window = context.nav_window
    if window is None or window.root_window.id_ == here.root_window.id_:
        return False
    if context.nav_layer == imgui.internal.NavLayer.menu or window.flags & _POPUP:
        return True  # ImGui lets the views be hovered in a menu's first frame
    return window.root_window.flags & _FLOATING == _FLOATING


def walked(pixel: Pixel | None, size: tuple[int, int], start: Pixel) -> Pixel | None:
    """Return the marked pixel after the arrow keys of this frame, or None if none was pressed.

    size: (width, height) of the image, which the mark does not leave. start: of a first mark.
    """
    steps = arrow_steps()
    if not any(steps):
        return None
    return start if pixel is None else pixel_from(pixel, steps, size)


def _middle(screen: Screen, pixel: Pixel) -> tuple[ImVec2, ImVec2]:
    """Return a pixel's centre on the screen, and half its width and height as framed."""
    half = [side / 2 if side >= SMALLEST_FRAMED else 5.0 for side in screen.cell]
    return screen.point(pixel[0] + 0.5, pixel[1] + 0.5), ImVec2(*half)


def _square(middle: ImVec2, half: ImVec2, grow: float) -> tuple[ImVec2, ImVec2]:
    reach = half + ImVec2(grow, grow)
    return middle - reach, middle + reach
