"""The pixel probe in the window: its numbers, live; the pins, the copies, the rays."""

from __future__ import annotations

import numpy as np
from imgui_bundle import hello_imgui
from option_changes import with_options
from window_driver import RASTER, Driver

from lucida.app.instruments.outside.projected import Strokes
from lucida.app.instruments.outside.view import OUTSIDE, OutsideView
from lucida.app.instruments.probe.reading import Reading
from lucida.app.instruments.probe.view import PROBE, ProbeView
from lucida.app.ui import formula, layout
from lucida.renderer.images.display import to_srgb8

WINDOW = f"//###{PROBE}"


def view(d: Driver) -> ProbeView:
    found = d.window.views[PROBE]
    assert isinstance(found, ProbeView)
    return found


def enter(d: Driver) -> None:
    """The probe, both images and the outside view."""
    layout.switch("Probe")
    d.ctx.yield_(5)
    d.settle()


def leave(d: Driver) -> None:
    hello_imgui.switch_layout("Side by side")
    d.ctx.yield_(5)


def reading(d: Driver) -> Reading:
    d.settle()
    d.until(lambda: view(d).reading is not None)
    found = view(d).reading
    assert found is not None
    return found


def check(d: Driver, found: Reading) -> None:
    """Compare with the traced image; test_probe_agrees.py has all numbers."""
    image = d.window.renderers.ray_image
    assert image is not None and image.factor == 1
    frame, pixel = image.frame, found.pixel
    number = found.hit.object if found.hit is not None else -1
    if frame.id[pixel] != number:  # within rounding of an outline
        assert (frame.id[pixel[0] - 1 : pixel[0] + 2, pixel[1] - 1 : pixel[1] + 2] == number).any()
        return
    shown = to_srgb8(frame.color[pixel]).astype(int)
    assert np.abs(shown - found.bytes).max() <= 2


def drive_a_click_fills_the_probe(d):
    enter(d)
    d.ctx.mouse_teleport_to_pos(d.point(RASTER, 0.3, 0.4))
    d.ctx.yield_(4)
    assert d.window.state.marked is None and d.window.hovered is not None
    check(d, reading(d))
    assert view(d).reading.pixel == d.window.hovered[1], "the mouse alone is followed"
    for x, y in ((0.5, 0.45), (0.31, 0.42), (0.5, 0.8), (0.97, 0.03)):
        d.ctx.mouse_teleport_to_pos(d.point(RASTER, x, y))
        d.ctx.yield_(2)
        d.ctx.mouse_click(0)
        d.ctx.yield_(2)
        pixel = d.window.state.marked
        assert pixel is not None
        found = reading(d)
        assert found.pixel == pixel
        width, height = d.window.renderers.size
        assert abs(pixel[0] - y * height) <= 1.5 and abs(pixel[1] - x * width) <= 1.5
        check(d, found)
    assert found.hit is None  # the sky


def drive_pins_stay(d):
    enter(d)
    d.window.change(with_options(d.window.state, marked=(51, 71)))
    d.settle()
    d.ctx.item_click(f"{WINDOW}/Pin")
    d.ctx.yield_(2)
    assert d.window.state.options.probe.pins == ((51, 71),)
    d.window.change(with_options(d.window.state, marked=(5, 6)))
    d.settle()
    d.ctx.item_click(f"{WINDOW}/###pin0")
    d.ctx.yield_(2)
    assert d.window.state.marked == (51, 71)
    d.ctx.item_click(f"{WINDOW}/###pin0", 1)
    d.ctx.yield_(2)
    assert d.window.state.options.probe.pins == ()


def drive_pins_are_framed_in_both_images(d):
    leave(d)
    d.settle()
    plain = d.images()
    d.window.change(with_options(d.window.state, probe={"pins": ((40, 50), (9000, 9000))}))
    d.settle()
    scale = plain[0].shape[1] / d.window.renderers.size[0]
    row, column = round(40.5 * scale), round(50.5 * scale)
    for before, after in zip(plain, d.images(), strict=True):
        differs = np.abs(after - before).max(axis=2) > 8
        near = differs[max(0, row - 40) : row + 40, max(0, column - 40) : column + 40]
        assert near.sum() > 30  # the frame and its number
        assert differs.sum() == near.sum()  # and nothing for the pixel that is not there
    d.window.undo()
    d.settle()


def lines(d: Driver, name: str) -> int:
    """Return the number of stretches of line of a name that the outside view shows."""
    outside = d.window.views[OUTSIDE]
    assert isinstance(outside, OutsideView)
    found = [p for p in outside.primitives if isinstance(p, Strokes) and p.name == name]
    return sum(len(part.points) for part in found)


def drive_rays_of_pins_stand_in_the_outside_view(d):
    enter(d)
    d.window.change(with_options(d.window.state, marked=(120, 150)))
    d.settle()
    assert lines(d, "pin") == 0
    assert lines(d, "normal") > 0
    options = {"pins": ((20, 30), (100, 40))}
    d.window.change(with_options(d.window.state, probe=options))
    d.settle()
    assert lines(d, "pin") >= 2
    d.window.shell.stage.show(PROBE, False)
    d.ctx.yield_(4)
    assert [lines(d, name) for name in ("pin", "normal")] == [0, 0]
    d.window.shell.stage.show(PROBE)
    d.ctx.yield_(4)
    leave(d)


def drive_without_the_locale_formulas_are_text(d):
    enter(d)
    d.window.change(with_options(d.window.state, marked=(120, 150)))
    d.settle()
    typeset = d.picture()
    real, formula.available = formula.available, lambda: False
    try:
        d.ctx.yield_(3)
        text = d.picture()
        assert (np.abs(typeset.astype(int) - text).max(axis=2) > 20).mean() > 0.002
    finally:
        formula.available = real
