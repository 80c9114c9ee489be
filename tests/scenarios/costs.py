"""The cost plot in the window: what it measures while it is seen, and that it stops."""

from __future__ import annotations

import math

from imgui_bundle import hello_imgui
from window_driver import Driver

from app.costs.model import Meter
from app.costs.view import COSTS, POINTS, CostsView
from app.host import layout

WINDOW = f"//###{COSTS}"


def meter(d: Driver) -> Meter:
    view = d.window.views[COSTS]
    assert isinstance(view, CostsView) and view.meter is not None
    return view.meter


def enter(d: Driver, **options: object) -> None:
    layout.switch("Loops")
    d.ctx.yield_(5)
    d.window.shell.stage.show(COSTS)
    d.window.change(d.window.state.with_options(costs=options))
    d.ctx.yield_(5)


def hide(d: Driver) -> None:
    d.window.shell.stage.show(COSTS, False)
    d.ctx.yield_(3)


def drive_frames_are_watched_while_they_are_seen(d: Driver) -> None:
    enter(d, against="frames", triangles=500, pixels=4800)
    d.until(lambda: len(meter(d).history) >= 12)
    assert meter(d).problems == {}
    assert all(math.isfinite(part) for pair in meter(d).history for part in pair)
    d.picture()
    hide(d)
    d.until(lambda: not meter(d).busy)
    counted = len(meter(d).history)
    d.ctx.yield_(20)
    assert len(meter(d).history) == counted


def drive_curves_against_triangles_and_pixels(d: Driver) -> None:
    for against in ("pixels", "triangles"):
        enter(d, against=against, triangles=2000, pixels=2400)
        d.until(lambda: meter(d).waiting > 0)
        d.until(lambda: meter(d).waiting == 0)
        samples = [
            one for one in meter(d).samples if one.case.triangles == 2000 or one.case.pixels == 2400
        ]
        assert {one.case.renderer for one in samples} == {"raster", "ray"}
        assert len(samples) >= 2 * POINTS
        assert len(meter(d).work) >= POINTS
        assert all(one.nodes > one.rays == one.pixels for one in meter(d).work.values())
        d.picture()
    d.ctx.item_click(f"{WINDOW}/frames##against")
    d.ctx.yield_(3)
    assert d.window.state.options.costs.against == "frames"
    hide(d)
    hello_imgui.switch_layout("Side by side")
    d.ctx.yield_(5)
