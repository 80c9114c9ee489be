"""The images while the camera moves: coarse where they must be, then full, then compared."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from option_changes import with_options
from window_driver import Driver

from lucida.app.images import pace as module
from lucida.app.images.live_raster import LiveRaster
from lucida.app.images.pair.view import RASTER, RAY
from lucida.app.images.request import ImageRequest
from lucida.app.ui.surface import Target
from lucida.renderer.images.coarseness import Coarseness


def live_raster(d: Driver) -> LiveRaster:
    textures = d.window.renderers.textures
    assert textures is not None
    return textures.raster


def number(found: LiveRaster) -> int:
    assert found.image is not None
    return found.image.number


def factor(found: LiveRaster) -> int:
    assert found.image is not None
    return found.image.factor


@contextmanager
def slow(d: Driver) -> Iterator[None]:
    """Let all images in motion be coarse, and let nothing rest."""
    pace = d.window.renderers._pace
    before = pace._coarseness, module.STILL_S
    pace._coarseness = Coarseness(1e-9, unknown=4)
    pace._factor, module.STILL_S = 1, 1e9
    try:
        yield
    finally:
        pace._coarseness, module.STILL_S = before


def drive_a_drag_shows_one_camera_and_one_size_in_each_frame(d: Driver) -> None:
    found, both = live_raster(d), d.window.renderers
    d.settle()
    frames: list[tuple[ImageRequest, int]] = []

    def look(_: Target) -> None:
        raster, ray = found.image, both.shown_ray(d.window.state)
        assert raster is not None and ray is not None
        assert ray.request.camera == raster.request.camera
        assert (ray.request.size, ray.factor) == (raster.request.size, raster.factor)
        frames.append((raster.request, raster.factor))

    x, y = d.point(RAY, 0.5, 0.5)
    d.ctx.mouse_teleport_to_pos((x, y))
    d.ctx.yield_()
    with slow(d):
        d.ctx.mouse_down(0)
        d.run.on_drawn = look
        try:
            for step in range(1, 9):
                before = len({request for request, _ in frames})
                d.ctx.mouse_teleport_to_pos((x + 9 * step, y + 3 * step))
                d.until(lambda before=before: len({request for request, _ in frames}) > before)
        finally:
            d.run.on_drawn = None
        d.stay = True
        coarse = d.picture()
        d.ctx.mouse_up(0)
    assert len(frames) >= 8 and {factor for _, factor in frames} <= {1, 4, 8}
    raster, _ = d.agreeing_images()
    assert both.ray_image is not None
    assert factor(found) == both.ray_image.factor == 1
    left, top, right, bottom = (round(edge) for edge in d.rect(RASTER))
    assert (coarse[top:bottom, left:right] != raster).any()
    last = number(found)
    d.ctx.yield_(20)
    assert number(found) == last  # at rest
    assert d.window.settled


def drive_images_are_on_the_screen_in_the_frame_of_their_change(d: Driver) -> None:
    found, seen, asked = d.window.renderers.textures, [], ["color"]
    assert found is not None
    left, top, right, bottom = (round(edge) for edge in d.rect(RASTER))
    raster_in = found.raster_in

    def ask(placement: Any, wanted: Any, look: Any, *more: Any, **named: Any) -> Any:
        asked.append(look.channel)
        return raster_in(placement, wanted, look, *more, **named)

    def look(target: Target) -> None:
        seen.append((asked[-1], hash(target.read()[top:bottom, left:right].tobytes())))

    found.raster_in, d.run.on_drawn = ask, look  # type: ignore[method-assign]
    try:
        d.ctx.yield_(3)
        d.window.change(with_options(d.window.state, images={"channel": "id"}))
        d.ctx.yield_(3)
    finally:
        d.run.on_drawn = None
        del found.raster_in  # type: ignore[attr-defined]
    colors = {number for channel, number in seen if channel == "color"}
    others = {number for channel, number in seen if channel == "id"}
    assert colors and others
    assert not colors & others
    assert len(others) == 1
