"""The mistakes: lines made wrong by the mouse, their pictures on the screen."""

from __future__ import annotations

import numpy as np
from maximised import Maximised
from option_changes import with_options
from window_driver import Driver

from lucida.app.instruments.mistakes.view import MISTAKES, MistakesView
from lucida.app.instruments.outside.view import OUTSIDE, OutsideView
from lucida.app.state.options.mistakes import MistakesOptions
from lucida.renderer.images import to_srgb8

ALONE = Maximised(MistakesView, "mistakes")


def _options(d: Driver) -> MistakesOptions:
    return d.window.state.options.mistakes


def _item(name: str) -> str:
    """In any of the view's parts."""
    return ALONE.item(f"**/{name}")


def _on_screen(d: Driver, name: str, size: tuple[int, int]) -> np.ndarray:
    """The middles of a picture's pixels as the window shows them, (H, W, 3)."""
    box = d.ctx.item_info(_item(name)).rect_full
    d.ctx.mouse_teleport_to_pos((3, 3))
    d.ctx.yield_(2)
    y = np.linspace(box.min.y, box.max.y, 2 * size[1] + 1)[1::2].astype(int)
    x = np.linspace(box.min.x, box.max.x, 2 * size[0] + 1)[1::2].astype(int)
    return d.picture()[y][:, x]


def _is_shown(d: Driver, name: str, light: np.ndarray, size: tuple[int, int]) -> bool:
    wanted = to_srgb8(light, d.window.state.images.exposure_ev).astype(int)
    seen = _on_screen(d, name, size)
    return bool((np.abs(seen.astype(int) - wanted).max(axis=2) <= 6).mean() > 0.95)


def _choose(d: Driver, line: str, mistake: str) -> None:
    d.ctx.item_click(_item(f"line {line}"))
    d.ctx.yield_(2)
    d.ctx.item_click(f"//$FOCUSED/{mistake}")
    d.settle()


def drive_lines_are_made_wrong_and_right_again(d: Driver) -> None:
    view = ALONE.open(d, columns=32)
    assert _options(d).chosen == ("rows count upwards",)
    made = view.made
    assert made is not None
    size = made.of.size
    assert _is_shown(d, "right", made.right, size)
    assert _is_shown(d, "wrong", made.wrong, size)
    _choose(d, "direction", "along +w")
    assert _options(d).chosen == ("rows count upwards", "along +w")
    again = view.made
    assert again is not None and len(again.mistakes) == 2
    d.window.undo()
    d.settle()
    assert _options(d).chosen == ("rows count upwards",)
    _choose(d, "y", "correct")
    assert _options(d).chosen == ()
    made = view.made
    assert made is not None and not made.mistakes
    ALONE.close(d)
    assert view.made is None


def drive_a_click_marks_a_pixel_in_all_views(d: Driver) -> None:
    view = ALONE.open(d, columns=16)
    d.ctx.item_click(_item("wrong"))
    d.settle()
    assert d.window.state.marked is not None
    made = view.made
    assert made is not None and made.ray is not None
    d.ctx.item_click(_item("wrong"))
    d.settle()
    assert d.window.state.marked is None
    ALONE.close(d)


def drive_the_outside_view_shows_the_wrong_camera(d: Driver) -> None:
    d.window.shell.stage.show(OUTSIDE)
    d.settle()
    d.window.shell.stage.show(MISTAKES)
    d.window.change(with_options(d.window.state, marked=(100, 100)))
    d.settle()
    view = d.window.view(MistakesView)
    names = {item.name for item in d.window.view(OutsideView).extensions.lines}
    assert view.made is not None and {"second edges", "second ray"} <= names
    _ = d.picture()
    d.window.change(with_options(d.window.state, mistakes={"chosen": ()}))
    d.settle()
    assert not d.window.view(OutsideView).extensions.lines
    d.window.change(with_options(d.window.state, mistakes={"chosen": ("no eye",)}))
    d.settle()
    assert d.window.view(OutsideView).extensions.lines
    d.window.shell.stage.show(MISTAKES, False)
    d.settle()
    assert not d.window.view(OutsideView).extensions.lines  # who is not seen shows nothing
