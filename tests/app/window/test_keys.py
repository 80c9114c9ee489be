"""Chords that come faster than frames: each key has its own modifiers."""

import glfw
import pytest
from imgui_bundle import imgui

from lucida.app.window.key_names import NAMES, give_key
from lucida.app.window.keys import MODIFIERS, PRESS, REPEAT, KeyFrames

RELEASE = 0
CTRL, SHIFT, PLUS, ZERO = 341, 340, 61, 48  # as GLFW numbers them
MODS = int(imgui.Key.mod_ctrl) | int(imgui.Key.mod_shift)
MASKS = {CTRL: 2, SHIFT: 1}  # as GLFW numbers their bits


def unwritten(character):
    raise AssertionError("no character was typed")


def chord(*keys):
    """Pressed and let go at once, the modifiers first, as xdotool and remote desktops do."""
    events, held = [], 0
    for action in (PRESS, RELEASE):
        for key in keys:
            events.append((key, 0, action, held))  # as on X11, where its own bit comes later
            held ^= MASKS.get(key, 0)
    return events


@pytest.fixture(autouse=True)
def us_keyboard(monkeypatch):
    """GLFW knows no keyboard before it is initialised."""
    monkeypatch.setattr(glfw, "get_key_name", lambda key, code: None)


@pytest.fixture
def io():
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


def pressed(io, keys=None):
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
def test_each_key_has_its_own_modifiers(io, at_once):
    """However many events come between two frames."""
    keys, seen = KeyFrames(give_key, unwritten), []
    for first in range(0, len(PLUSES), at_once):
        for event in PLUSES[first : first + at_once]:
            keys.take(*event)
        seen += pressed(io, keys)
    for _ in PLUSES:
        seen += pressed(io, keys)
    assert seen == SEEN


def test_characters_stay_between_the_keys_that_they_came_between():
    given = []
    keys = KeyFrames(*2 * (lambda *event: given.append(event),))
    typed = [*chord(PLUS), (ord("+"),), *chord(ZERO), (ord("0"),)]
    for event in typed:
        keys.take(*event)
    for _ in typed:
        keys.begin_frame()
    assert given == typed


def test_repeats_are_left_to_imgui():
    """They would wait, one a frame, and go on long after the key was let go."""
    given = []
    keys = KeyFrames(*2 * (lambda *event: given.append(event),))
    keys.take(PLUS, 0, PRESS, 0)
    for _ in range(9):
        keys.take(PLUS, 0, REPEAT, 0)
    assert given == [(PLUS, 0, PRESS, 0)]
    assert all(key in MODIFIERS for key in (CTRL, SHIFT))


def test_a_key_is_what_the_keyboard_has_in_its_place(io, monkeypatch):
    """Ctrl+Z is Ctrl+Z on a German keyboard, where GLFW says Y. A sign that is no key changes
    nothing.
    """
    labels = {glfw.KEY_Y: "z", glfw.KEY_SEMICOLON: "ö", glfw.KEY_A: "Ā"}
    monkeypatch.setattr(glfw, "get_key_name", lambda key, code: labels[key])
    for key in labels:
        give_key(key, 0, PRESS, 0)
    imgui.new_frame()
    expected = (imgui.Key.z, imgui.Key.semicolon, imgui.Key.a)
    assert [imgui.is_key_pressed(key, False) for key in expected] == [True] * 3
    assert not imgui.is_key_down(imgui.Key.y) and not imgui.is_key_down(imgui.Key.escape)
    imgui.end_frame()


def test_every_key_has_its_name():
    without = {name for name in dir(glfw) if name.startswith("KEY_")} - {
        name for name in dir(glfw) if name.startswith("KEY_") and getattr(glfw, name) in NAMES
    }
    assert without == {"KEY_F25", "KEY_UNKNOWN", "KEY_WORLD_1", "KEY_WORLD_2"}
    assert NAMES[glfw.KEY_KP_0] == imgui.Key.keypad0 and NAMES[glfw.KEY_UP] == imgui.Key.up_arrow
    assert NAMES[glfw.KEY_KP_ADD] == imgui.Key.keypad_add and NAMES[glfw.KEY_7] == imgui.Key._7
    assert NAMES[glfw.KEY_LEFT_CONTROL] == imgui.Key.left_ctrl
