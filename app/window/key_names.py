"""Translate GLFW's keyboard events to ImGui's.

ImGui's own backend queries the modifiers when it passes a key on. That is too late for a key that
has waited for its frame (keys.py), because Ctrl may have been released. This module uses the
event's own modifiers.
"""

from __future__ import annotations

import re

from imgui_bundle import imgui  # before glfw, so that both use the same GLFW library

# isort: split
import glfw

# For each modifier: its bit, its left and right key, and ImGui's name for it.
_MODIFIERS = (
    (glfw.MOD_CONTROL, (glfw.KEY_LEFT_CONTROL, glfw.KEY_RIGHT_CONTROL), imgui.Key.mod_ctrl),
    (glfw.MOD_SHIFT, (glfw.KEY_LEFT_SHIFT, glfw.KEY_RIGHT_SHIFT), imgui.Key.mod_shift),
    (glfw.MOD_ALT, (glfw.KEY_LEFT_ALT, glfw.KEY_RIGHT_ALT), imgui.Key.mod_alt),
    (glfw.MOD_SUPER, (glfw.KEY_LEFT_SUPER, glfw.KEY_RIGHT_SUPER), imgui.Key.mod_super),
)


def give_key(key: int, code: int, action: int, modifiers: int) -> None:
    """Pass a key's press or release to ImGui, after the modifiers that belong to it."""
    io, is_down = imgui.get_io(), action == glfw.PRESS
    for bit, keys, name in _MODIFIERS:  # on X11, a modifier is missing in its own event
        io.add_key_event(name, is_down if key in keys else bool(modifiers & bit))
    if named := NAMES.get(_on_layout(key, code)):
        io.add_key_event(named, is_down)


def _on_layout(key: int, code: int) -> int:
    """Return the key that the user's keyboard layout has at this position. GLFW names keys by their
    position on a US keyboard, and numbers character keys as ASCII does.
    """
    if not glfw.KEY_SPACE < key <= glfw.KEY_WORLD_2:
        return key
    sign = (glfw.get_key_name(key, code) or "").upper()
    return ord(sign) if len(sign) == 1 and sign.isascii() and ord(sign) in NAMES else key


def _named(name: str) -> str:
    """Return ImGui's name of a key for GLFW's, without its "KEY_"."""
    name = name.lower().replace("control", "ctrl")
    name = re.sub(r"^kp_(?=\d)", "keypad", name).replace("kp_", "keypad_")
    return re.sub(r"^(?=\d$)", "_", re.sub(r"^(left|right|up|down)$", r"\1_arrow", name))


NAMES = {
    getattr(glfw, name): imgui.Key.__members__[_named(name[4:])]
    for name in dir(glfw)
    if name.startswith("KEY_") and _named(name[4:]) in imgui.Key.__members__
}
