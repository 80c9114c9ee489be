"""The arrow keys: who gets them, wherever the mouse rests and whatever has been clicked before."""

from __future__ import annotations

from imgui_bundle import hello_imgui
from option_changes import with_options
from window_driver import RASTER, RAY, Driver, Key

from lucida.app.instruments.stepper.view import STEPPER, StepperView
from lucida.app.ui import layout

START = (100, 120)
F3, ESCAPE = int(Key.f3), int(Key.escape)
PALETTE = int(Key.mod_ctrl) | int(Key.mod_shift) | int(Key.p)


def enter(d: Driver, name: str) -> None:
    """A layout, with a pixel marked."""
    layout.switch(name)
    d.ctx.yield_(5)
    d.window.change(with_options(d.window.state, marked=START))
    d.settle()


def leave(d: Driver) -> None:
    hello_imgui.switch_layout("Side by side")
    d.ctx.yield_(5)


def rest(d: Driver, name: str = RASTER) -> None:
    d.ctx.mouse_teleport_to_pos(d.point(name, 0.4, 0.4))
    d.ctx.yield_(2)


def right(d: Driver) -> int:
    """By how many columns one press moves the mark."""
    before = d.window.state.marked
    assert before is not None
    d.ctx.key_press(int(Key.right_arrow))
    d.ctx.yield_(2)
    after = d.window.state.marked
    assert after is not None
    assert after[0] == before[0]
    return after[1] - before[1]


def stands(d: Driver) -> tuple[int, int]:
    found = d.window.views[STEPPER]
    assert isinstance(found, StepperView)
    return d.window.state.options.stepper.steps


def drive_after_a_click_in_the_camera_panel_or_by_the_keyboard(d: Driver) -> None:
    """F3 and the palette show the keyboard's own frame; the mouse has not moved since."""
    enter(d, "Side by side")
    for item in ("//Camera/Canonical", "//Camera/Scene's view", d.field("eye.x")):
        d.ctx.item_click(item)
        d.ctx.yield_(2)
        rest(d, RAY if item == d.field("eye.x") else RASTER)
        assert [right(d), right(d)] == [1, 1], item
    for keys in ((F3,), (PALETTE, ESCAPE)):
        rest(d)
        for key in keys:
            d.ctx.key_press(key)
            d.ctx.yield_(3)
        assert [right(d), right(d)] == [1, 1], keys


def drive_a_box_over_the_views_keeps_its_keys(d: Driver) -> None:
    enter(d, "Side by side")
    d.window.files.open_dialog()
    d.ctx.yield_(3)
    assert d.window.files.dialog.is_open
    d.ctx.mouse_teleport_to_pos(d.point(RASTER, 0.02, 0.02))
    d.ctx.yield_(2)
    assert [right(d), right(d)] == [0, 0]
    d.ctx.key_press(ESCAPE)
    d.ctx.yield_(3)
    assert not d.window.files.dialog.is_open
    assert [right(d), right(d)] == [1, 1]


def drive_after_a_click_in_the_stepper(d: Driver) -> None:
    """Its own keys hold where the mouse is not on an image."""
    enter(d, "Loops")
    d.ctx.item_click(f"//###{STEPPER}/###step")
    d.ctx.yield_(2)
    before = stands(d)
    d.ctx.key_press(int(Key.right_arrow))
    d.ctx.yield_(2)
    assert stands(d) != before
    before = stands(d)
    rest(d, RASTER if RASTER in d.window.shell.stage.rects else RAY)
    assert [right(d), right(d)] == [1, 1]
    assert stands(d) == before
    leave(d)
