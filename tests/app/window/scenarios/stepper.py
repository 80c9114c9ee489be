"""The loop stepper in the window: its buttons, keys and sliders; the image it ends in."""

import numpy as np
from window_driver import Key

from lucida.app.instruments.outside.projected import Strokes
from lucida.app.instruments.outside.view import OUTSIDE, OutsideView
from lucida.app.instruments.stepper.view import STEPPER

WINDOW = f"//###{STEPPER}"


def view(d):
    return d.window.views[STEPPER]


def enter(d, **options):
    d.change(stepper=options)
    d.layout("Loops")
    d.until(lambda: len(view(d).moments) > 0)


def press(d, name):
    d.click(f"{WINDOW}/###{name}")


def moments(d):
    return view(d).moments


def strokes(d, name):
    outside = d.window.views[OUTSIDE]
    assert isinstance(outside, OutsideView)
    found = [p for p in outside.primitives if isinstance(p, Strokes) and p.name == name]
    return sum(len(part.points) for part in found)


def drive_buttons_go_through_both_runs(d):
    enter(d, steps=(0, 0), canvas=(16, 12))
    steps = d.steps
    assert [moment.step for moment in moments(d)] == [0, 0]
    for count in (1, 2):
        press(d, "step")
        assert [moment.step for moment in moments(d)] == [count, count]
    press(d, "back")
    assert [moment.step for moment in moments(d)] == [1, 1]
    press(d, "pixel")
    by_object, by_image = moments(d)
    assert by_image.pixel == (0, 0) and by_object.triangle is not None
    press(d, "pixel")
    assert moments(d)[1].pixel == (0, 1)
    press(d, "object")
    assert moments(d)[1].pixel == (0, 1)
    assert d.steps == steps  # steps are nothing to undo
    enter(d, steps=(10**6, 10**6))
    by_object, by_image = moments(d)
    assert np.allclose(by_object.canvas, by_image.canvas, atol=1e-9)


def drive_the_outside_view_shows_the_ray_and_the_triangle(d):
    enter(d, steps=(0, 0), canvas=(16, 12))
    assert strokes(d, "ray") == strokes(d, "triangle") == 0
    d.change(stepper={"steps": (10, 49)})
    d.settle()
    assert strokes(d, "ray") > 0
    assert strokes(d, "triangle") > 0 and strokes(d, "bounding box") > 0
    d.stage.show(STEPPER, False)
    d.frames(4)
    assert strokes(d, "ray") == strokes(d, "triangle") == 0
    d.stage.show(STEPPER)
    d.frames(4)


def drive_the_keys_step(d):
    enter(d, steps=(5, 5), canvas=(16, 12))
    assert not d.renderers.is_tracing  # so that no verdict on both images is announced
    for key, steps in (("right_arrow", (6, 6)), ("left_arrow", (5, 5))):
        d.ctx.window_focus(WINDOW)
        d.frames(2)
        d.press(int(getattr(Key, key)))
        assert d.options.stepper.steps == steps
    d.change(stepper={"steps": (0, 0)})
    d.press(Key.down_arrow)
    assert moments(d)[1].pixel == (0, 0)
