"""Areas drawn by hand that take the mouse and the keyboard, as controls do.

Tab and the arrow keys skip ImGui's own invisible button unless a flag is set.
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
    """Add an item that the mouse presses at a point. Return True if it was clicked.

    The keyboard can reach it for its arrow keys. Enter and Space do nothing: they have no point.
    """
    clicked = imgui.invisible_button(name, size, buttons | imgui.ButtonFlags_.enable_nav)
    context = imgui.get_current_context()
    if imgui.is_item_active() and context.active_id_source != imgui.internal.InputSource.mouse:
        imgui.internal.clear_active_id()
    return bool(clicked and context.nav_activate_id != imgui.get_item_id())


def press_point() -> ImVec2:
    """Return the point where the current item is pressed: the mouse, or its centre for a key."""
    if imgui.get_current_context().nav_activate_id != imgui.get_item_id():
        return imgui.get_mouse_pos()
    return (imgui.get_item_rect_min() + imgui.get_item_rect_max()) / 2


def claim_arrows() -> None:
    """Take the arrow keys from ImGui's navigation, for the current item."""
    for key in ARROWS:
        imgui.internal.set_key_owner(key, imgui.get_item_id())


def arrow_steps() -> tuple[int, int]:
    """Return the pressed arrow keys' steps to the right and down; Shift multiplies by LEAP."""
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
    """Return a pixel moved by steps to the right and down, clamped to the image."""
    row, column = pixel[0] + steps[1], pixel[1] + steps[0]
    return min(max(row, 0), size[1] - 1), min(max(column, 0), size[0] - 1)
