"""The images while the camera moves: coarse where they must be, then full, then compared."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from imgui_bundle import hello_imgui
from window_driver import Driver

from app.compare.view import CompareView
from app.host.view import DockedView
from app.images import live_raster as module
from app.images.live_raster import LiveRaster
from app.images.request import ImageRequest
from app.pair.view import RASTER, RAY
from app.widgets.surface import Target
from renderer.coarseness import Coarseness
from renderer.frame import CHANNELS
from renderer.navigation import moved


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
    """OpenGL seems to run on a slow CPU; and nothing is refined."""
    found = live_raster(d)
    before = found.coarseness, module.MOVING_S
    found.coarseness = Coarseness(1e-9, 1e-9, module.COARSEST)
    found.coarseness.measured(1, 1, 1e-3)
    module.MOVING_S = 1e9
    try:
        yield
    finally:
        found.coarseness, module.MOVING_S = before


def drive_a_drag_is_coarse_then_full_then_compared(d: Driver) -> None:
    found, both = live_raster(d), d.window.renderers
    x, y = d.point(RAY, 0.5, 0.5)
    d.ctx.mouse_teleport_to_pos((x, y))
    d.ctx.yield_()
    with slow(d):
        d.ctx.mouse_down(0)
        factors, before = set(), d.window.state.camera
        for step in range(1, 9):
            drawn = number(found)
            d.ctx.mouse_teleport_to_pos((x + 9 * step, y + 3 * step))
            d.until(lambda drawn=drawn: number(found) > drawn)
            factors.add(factor(found))
            assert both.verdict(d.window.state) is None
        d.stay = True
        coarse = d.picture()
        d.ctx.mouse_up(0)
        assert factors == {module.COARSEST}
        assert d.window.state.camera != before
        assert found.unfinished
    raster, _ = d.agreeing_images()
    assert factor(found) == 1
    assert both.ray_image is not None
    assert both.ray_image.factor == 1
    left, top, right, bottom = (round(edge) for edge in d.rect(RASTER))
    assert (coarse[top:bottom, left:right] != raster).any()
    last = number(found)
    d.ctx.yield_(20)
    assert number(found) == last  # at rest
    assert d.window.settled


def drive_an_image_drawn_in_parts_is_the_same(d: Driver) -> None:
    """One frame has no time for all triangles."""
    found, both = live_raster(d), d.window.renderers
    parts = []

    def part_of(triangles: int) -> int:
        parts.append(triangles)
        return max(triangles // 5, 1)

    found.pace.part_of = part_of  # type: ignore[method-assign]
    try:
        x, y = d.point(RASTER, 0.5, 0.5)
        d.drag((x, y), (x + 60, y + 20))
        for _ in range(3):  # a motion that goes on shows something new
            drawn = number(found)
            d.drag((x, y), (x + 20, y - 10))
            d.until(lambda drawn=drawn: number(found) > drawn)
        d.agreeing_images()
    finally:
        del found.pace.part_of
    assert len(parts) >= 6
    assert both.agreement.pair is not None
    in_parts, here = both.agreement.pair[1], d.window.state
    d.window.change(here.with_camera(d.start.camera))
    d.settle()
    d.window.change(here)
    d.settle()
    at_once = both.agreement.pair[1]
    assert at_once is not in_parts
    for channel in CHANNELS:
        np.testing.assert_array_equal(in_parts.channel(channel), at_once.channel(channel))


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
        d.window.change(d.window.state.with_options(images={"channel": "id"}))
        d.ctx.yield_(3)
    finally:
        d.run.on_drawn = None
        del found.raster_in  # type: ignore[attr-defined]
    colors = {number for channel, number in seen if channel == "color"}
    others = {number for channel, number in seen if channel == "id"}
    assert colors and others
    assert not colors & others
    assert len(others) == 1


def drive_a_change_before_the_views_is_traced_while_they_are_drawn(d: Driver) -> None:
    d.settle()
    events: list[str] = []
    live, views = d.window.renderers.live, d.window.views.values()
    request, drawn = live.request, d.window.draw_view
    wanted = moved(d.window.state.camera, (0.05, 0.0, 0.0))

    def asked(what: ImageRequest, begin_at: int) -> None:
        if what.camera == d.window.renderers.camera(d.window.state):
            events.append("request")
        request(what, begin_at)

    def drawing(view: DockedView) -> None:
        events.append(view.name)
        drawn(view)

    live.request, d.window.draw_view = asked, drawing  # type: ignore[method-assign]
    try:
        d.window.change(d.window.state.with_camera(wanted))
        events.clear()
        d.ctx.yield_(2)
    finally:
        del live.request, d.window.draw_view
    first = events.index("request")
    assert not {view.name for view in views} & set(events[:first])
    d.agreeing_images()


def drive_the_compare_view_shows_coarse_images_as_they_are(d: Driver) -> None:
    found = live_raster(d)
    hello_imgui.switch_layout("Compare")
    d.ctx.yield_(5)
    d.window.shell.stage.show("Compare")
    d.ctx.yield_(3)
    d.window.change(d.window.state.with_options(compare={"mode": "wipe", "divider": 0.5}))
    d.settle()
    seen: list[tuple[int, np.ndarray]] = []

    def look(target: Target) -> None:
        left, top, right, bottom = box
        pixels = target.read()[top:bottom, left:right].astype(int)
        seen.append((factor(found), pixels))

    view = d.window.views["Compare"]
    assert isinstance(view, CompareView)
    d.until(lambda: view.screen is not None)
    assert view.screen is not None
    low, high = view.screen.visible
    box = round(low.x), round(low.y), round(high.x), round(high.y)
    d.run.on_drawn = look
    try:
        d.until(lambda: bool(seen))
        with slow(d):
            drawn = number(found)
            d.window.change(d.window.state.with_camera(moved(d.start.camera, (0.0, 0.001, 0.0))))
            d.until(lambda: number(found) > drawn)
            count = len(seen)
            d.until(lambda: len(seen) > count + 1)
    finally:
        d.run.on_drawn = None
        hello_imgui.switch_layout("Side by side")
        d.ctx.yield_(5)
    images = dict(reversed(seen))  # by factor: the full one before the change, and a coarse one,
    full, coarse = images[1], images[module.COARSEST]  # which the statistics may soon refine
    middle = full.shape[1] // 2
    before, after = full[:, : middle - 20], coarse[:, : middle - 20]
    assert (before != after).any()
    assert np.abs(before - after).mean() < 0.1 * full.std()  # nothing but coarser
