"""The mistakes: lines made wrong by the mouse, their pictures on the screen."""

import numpy as np
from alone import Alone

from lucida.app.instruments.mistakes.view import MistakesView
from lucida.renderer.images import to_srgb8

ALONE = Alone(MistakesView, "mistakes")


def _options(d):
    return d.options.mistakes


def _item(name):
    """In any of the view's parts."""
    return ALONE.item(f"**/{name}")


def _on_screen(d, name, size):
    """The middles of a picture's pixels as the window shows them, (H, W, 3)."""
    box = d.box(_item(name))
    d.move_to((3, 3))
    y = np.linspace(box.min.y, box.max.y, 2 * size[1] + 1)[1::2].astype(int)
    x = np.linspace(box.min.x, box.max.x, 2 * size[0] + 1)[1::2].astype(int)
    return d.picture()[y][:, x]


def _is_shown(d, name, light, size):
    wanted = to_srgb8(light, d.state.images.exposure_ev).astype(int)
    seen = _on_screen(d, name, size)
    return bool((np.abs(seen.astype(int) - wanted).max(axis=2) <= 6).mean() > 0.95)


def _choose(d, line, mistake):
    d.click(_item(f"line {line}"))
    d.click(f"//$FOCUSED/{mistake}")
    d.settle()


def drive_lines_are_made_wrong_and_right_again(d):
    view = ALONE.open(d, columns=32)
    assert _options(d).chosen == ("rows count upwards",)
    made = view.made
    size = made.of.size
    assert _is_shown(d, "right", made.right, size)
    assert _is_shown(d, "wrong", made.wrong, size)
    _choose(d, "direction", "along +w")
    assert _options(d).chosen == ("rows count upwards", "along +w")
    again = view.made
    assert len(again.mistakes) == 2
    _choose(d, "y", "correct")
    assert _options(d).chosen == ("along +w",)
    assert len(view.made.mistakes) == 1
    ALONE.close(d)
    assert view.made is None


def drive_a_click_marks_a_pixel_in_all_views(d):
    view = ALONE.open(d, columns=16)
    d.click(_item("wrong"))
    d.settle()
    assert d.state.marked is not None
    assert view.made.ray is not None
    d.click(_item("wrong"))
    d.settle()
    assert d.state.marked is None
