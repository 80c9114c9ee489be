"""Areas that are controls: what is drawn there by hand takes the mouse and the keyboard.

ImGui's own invisible button is left out by Tab and the arrow keys, unless asked.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from lucida.app.state.options.shared import Pixel

LEAP = 10  # with Shift
ARROWS = {
    imgui.Key.left_arrow: (-1, 0),
    imgui.Key.right_arrow: (1, 0),
    imgui.Key.up_arrow: (0, -1),
    imgui.Key.down_arrow: (0, 1),
}
_LEFT = imgui.ButtonFlags_.mouse_button_left


def press_area(name: str, size: ImVec2) -> bool:
    """Add a button that the caller draws. Return True if it was clicked, or pressed by a key."""
    return bool(imgui.invisible_button(name, size, imgui.ButtonFlags_.enable_nav))


def mouse_area(name: str, size: ImVec2, buttons: int = _LEFT) -> bool:
    """Add an item that the mouse holds at a place. Return True if it was clicked.

    The keyboard reaches it, for its arrow keys; Enter and Space have no place, and do nothing.
    """
    clicked = imgui.invisible_button(name, size, buttons | imgui.ButtonFlags_.enable_nav)
    context = imgui.get_current_context()
    if imgui.is_item_active() and context.active_id_source != imgui.internal.InputSource.mouse:
        imgui.internal.clear_active_id()
    return bool(clicked and context.nav_activate_id != imgui.get_item_id())


def press_point() -> ImVec2:
    """Return where the current item is pressed: at the mouse, or in its middle if by a key."""
    if imgui.get_current_context().nav_activate_id != imgui.get_item_id():
        return imgui.get_mouse_pos()
    return (imgui.get_item_rect_min() + imgui.get_item_rect_max()) / 2


def claim_arrows() -> None:
    """Take the arrow keys from ImGui's navigation, for the current item."""
    for key in ARROWS:
        imgui.internal.set_key_owner(key, imgui.get_item_id())


def arrow_steps() -> tuple[int, int]:
    """Return how far the pressed arrow keys go, to the right and down; with Shift, LEAP times."""
    io = imgui.get_io()
    if io.want_text_input or io.key_ctrl or io.key_alt or io.key_super:
        return 0, 0
    pressed = [way for key, way in ARROWS.items() if imgui.is_key_pressed(key)]
    step = LEAP if io.key_shift else 1
    return step * sum(x for x, _ in pressed), step * sum(y for _, y in pressed)


def focused_steps() -> tuple[int, int]:
    """Return arrow_steps() if the keyboard is on the current item, which claims the keys."""
    if not imgui.is_item_focused():
        return 0, 0
    claim_arrows()
    return arrow_steps()


def pixel_from(pixel: Pixel, steps: tuple[int, int], size: tuple[int, int]) -> Pixel:
    """Return the pixel to which steps to the right and down lead. They do not leave the image."""
    row, column = pixel[0] + steps[1], pixel[1] + steps[0]
    return min(max(row, 0), size[1] - 1), min(max(column, 0), size[0] - 1)
