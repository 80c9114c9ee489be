"""Chords that come faster than frames: each key has its own modifiers."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from imgui_bundle import imgui

from app.window.keys import MODIFIERS, PRESS, REPEAT, KeyFrames

RELEASE = 0
CTRL, SHIFT, PLUS, ZERO = 341, 340, 61, 48  # as GLFW numbers them
NAMES = {
    CTRL: (imgui.Key.mod_ctrl, imgui.Key.left_ctrl),
    SHIFT: (imgui.Key.mod_shift, imgui.Key.left_shift),
    PLUS: (imgui.Key.equal,),
    ZERO: (imgui.Key._0,),
}
MODS = int(imgui.Key.mod_ctrl) | int(imgui.Key.mod_shift)


def give(key: int, code: int = 0, action: int = 0, modifiers: int = 0) -> None:
    """As ImGui's backend does."""
    for name in NAMES[key]:
        imgui.get_io().add_key_event(name, action == PRESS)


def chord(*keys: int) -> list[tuple[int, ...]]:
    """Pressed and let go at once, the modifiers first, as xdotool and remote desktops do."""
    return [(key, 0, action, 0) for action in (PRESS, RELEASE) for key in keys]


@pytest.fixture
def io() -> Iterator[imgui.IO]:
    before = imgui.get_current_context()
    context = imgui.create_context()
    imgui.set_current_context(context)
    io = imgui.get_io()
    io.set_ini_filename("")  # it would be written to the current folder
    io.display_size, io.delta_time = imgui.ImVec2(200, 200), 1 / 60
    io.backend_flags |= int(imgui.BackendFlags_.renderer_has_textures)
    yield io
    imgui.set_current_context(before) if before is not None else None
    imgui.destroy_context(context)


def pressed(io: imgui.IO, keys: KeyFrames | None = None) -> list[tuple[str, int]]:
    """Return the keys that a frame sees pressed, and their modifiers."""
    imgui.new_frame()
    found = [
        (name, io.key_mods & MODS)
        for name, key in (("+", imgui.Key.equal), ("0", imgui.Key._0))
        if imgui.is_key_pressed(key, False)
    ]
    imgui.end_frame()
    if keys is not None:
        keys.begin_frame()
    return found


PLUSES = chord(CTRL, SHIFT, PLUS) * 3 + chord(CTRL, ZERO) + chord(PLUS) + chord(CTRL, PLUS)
SEEN = [("+", MODS)] * 3 + [("0", int(imgui.Key.mod_ctrl)), ("+", 0)]
SEEN += [("+", int(imgui.Key.mod_ctrl))]


@pytest.mark.parametrize("at_once", range(1, len(PLUSES) + 1))
def test_each_key_has_its_own_modifiers(io: imgui.IO, at_once: int) -> None:
    """However many events come between two frames."""
    keys, seen = KeyFrames(give), []
    for first in range(0, len(PLUSES), at_once):
        for event in PLUSES[first : first + at_once]:
            keys.take(*event)
        seen += pressed(io, keys)
    for _ in PLUSES:
        seen += pressed(io, keys)
    assert seen == SEEN


def test_without_it_modifiers_are_lost(io: imgui.IO) -> None:
    """Else there would be nothing to do for it."""
    seen = []
    for event in PLUSES:
        give(*event)
    for _ in PLUSES:
        seen += pressed(io)
    assert seen != SEEN


def test_characters_stay_between_the_keys_that_they_came_between() -> None:
    given: list[tuple[int, ...]] = []
    keys = KeyFrames(lambda *event: given.append(event))
    typed = [*chord(PLUS), (ord("+"),), *chord(ZERO), (ord("0"),)]
    for event in typed:
        keys.take(*event)
    for _ in typed:
        keys.begin_frame()
    assert given == typed


def test_repeats_are_left_to_imgui() -> None:
    """They would wait, one a frame, and go on long after the key was let go."""
    given: list[tuple[int, ...]] = []
    keys = KeyFrames(lambda *event: given.append(event))
    keys.take(PLUS, 0, PRESS, 0)
    for _ in range(9):
        keys.take(PLUS, 0, REPEAT, 0)
    assert given == [(PLUS, 0, PRESS, 0)]
    assert all(key in MODIFIERS for key in (CTRL, SHIFT))
