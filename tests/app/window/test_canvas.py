"""The canvas of the window: unfinished frames leave the picture as it was."""

import numpy as np
import pytest

from lucida.app.window.canvas import MOST_KEPT, WindowCanvas

SIZE = (30, 20)


@pytest.fixture
def canvas(gl):
    return WindowCanvas(gl)


def draw(canvas, gray, unfinished=False, size=SIZE):
    """A frame of one gray; what the canvas shows then."""
    drawn = canvas.bind(size, unfinished)
    assert drawn.size == size
    drawn.framebuffer.clear(gray, gray, gray)
    shown = canvas.shown
    return None if shown is None else np.unique(shown.read()).tolist()


def test_nothing_is_shown_before_a_frame_is_finished(canvas):
    assert draw(canvas, 0.2, unfinished=True) is None
    assert canvas.keeps
    assert draw(canvas, 0.4) == [102]
    assert not canvas.keeps


def test_an_unfinished_frame_leaves_the_picture(canvas):
    draw(canvas, 0.4)
    assert draw(canvas, 1.0, unfinished=True) == [102]
    assert draw(canvas, 0.8, unfinished=True) == [102]
    assert draw(canvas, 0.6) == [153]


def test_the_window_goes_on_whatever_is_never_finished(canvas):
    draw(canvas, 0.4)
    for _ in range(MOST_KEPT):
        assert draw(canvas, 1.0, unfinished=True) == [102]
    assert draw(canvas, 0.6, unfinished=True) == [153]


def test_a_picture_of_another_size_is_not_kept(canvas):
    draw(canvas, 0.4)
    assert draw(canvas, 0.6, unfinished=True, size=(40, 10)) == [153]
    assert canvas.shown.size == (40, 10)
