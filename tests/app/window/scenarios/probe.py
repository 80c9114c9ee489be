"""The pixel probe in the window: its numbers, live; the pins, the copies, the rays."""

import numpy as np
from window_driver import RASTER

from lucida.app.instruments.outside.projected import Strokes
from lucida.app.instruments.outside.view import OUTSIDE, OutsideView
from lucida.app.instruments.probe.view import PROBE
from lucida.app.ui import formula
from lucida.renderer.images.display import to_srgb8

WINDOW = f"//###{PROBE}"


def view(d):
    return d.window.views[PROBE]


def enter(d):
    """The probe, both images and the outside view."""
    d.layout("Probe")


def reading(d):
    d.settle()
    d.until(lambda: view(d).reading is not None)
    return view(d).reading


def check(d, found):
    """Compare with the traced image; test_probe_agrees.py has all numbers."""
    image = d.renderers.ray_image
    assert image.factor == 1
    frame, pixel = image.frame, found.pixel
    number = found.hit.object if found.hit is not None else -1
    if frame.id[pixel] != number:  # within rounding of an outline
        assert (frame.id[pixel[0] - 1 : pixel[0] + 2, pixel[1] - 1 : pixel[1] + 2] == number).any()
        return
    shown = to_srgb8(frame.color[pixel]).astype(int)
    assert np.abs(shown - found.bytes).max() <= 2


def drive_a_click_fills_the_probe(d):
    enter(d)
    d.move_to(d.point(RASTER, 0.3, 0.4))
    assert d.state.marked is None and d.window.hovered is not None
    check(d, reading(d))
    assert view(d).reading.pixel == d.window.hovered[1], "the mouse alone is followed"
    for x, y in ((0.5, 0.45), (0.5, 0.8), (0.97, 0.03)):
        d.click_at(d.point(RASTER, x, y))
        pixel = d.state.marked
        found = reading(d)
        assert found.pixel == pixel
        width, height = d.renderers.size
        assert abs(pixel[0] - y * height) <= 1.5 and abs(pixel[1] - x * width) <= 1.5
        check(d, found)
    assert found.hit is None  # the sky


def drive_pins_stay(d):
    enter(d)
    d.change(marked=(51, 71))
    d.settle()
    d.click(f"{WINDOW}/Pin")
    assert d.options.probe.pins == ((51, 71),)
    d.change(marked=(5, 6))
    d.settle()
    d.click(f"{WINDOW}/###pin0")
    assert d.state.marked == (51, 71)
    d.click(f"{WINDOW}/###pin0", 1)
    assert d.options.probe.pins == ()


def drive_pins_are_framed_in_both_images(d):
    d.layout("Side by side")
    plain = d.images()
    d.change(probe={"pins": ((40, 50), (9000, 9000))})
    d.settle()
    scale = plain[0].shape[1] / d.renderers.size[0]
    row, column = round(40.5 * scale), round(50.5 * scale)
    for before, after in zip(plain, d.images(), strict=True):
        differs = np.abs(after - before).max(axis=2) > 8
        near = differs[max(0, row - 40) : row + 40, max(0, column - 40) : column + 40]
        assert near.sum() > 30  # the frame and its number
        assert differs.sum() == near.sum()  # and nothing for the pixel that is not there
    d.undo()
    d.settle()


def lines(d, name):
    """Return the number of stretches of line of a name that the outside view shows."""
    outside = d.window.views[OUTSIDE]
    assert isinstance(outside, OutsideView)
    found = [p for p in outside.primitives if isinstance(p, Strokes) and p.name == name]
    return sum(len(part.points) for part in found)


def drive_rays_of_pins_stand_in_the_outside_view(d):
    enter(d)
    d.change(marked=(120, 150))
    d.settle()
    assert lines(d, "pin") == 0
    assert lines(d, "normal") > 0
    options = {"pins": ((20, 30), (100, 40))}
    d.change(probe=options)
    d.settle()
    assert lines(d, "pin") >= 2
    d.stage.show(PROBE, False)
    d.frames(4)
    assert [lines(d, name) for name in ("pin", "normal")] == [0, 0]
    d.stage.show(PROBE)
    d.frames(4)


def drive_without_the_locale_formulas_are_text(d):
    enter(d)
    d.change(marked=(120, 150))
    d.settle()
    typeset = d.picture()
    real, formula.available = formula.available, lambda: False
    try:
        d.frames(3)
        text = d.picture()
        assert (np.abs(typeset.astype(int) - text).max(axis=2) > 20).mean() > 0.002
    finally:
        formula.available = real
