"""The outside view while it moves: coarse where that is needed, by smooth passages, as one step."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from imgui_bundle import hello_imgui
from window_driver import Driver

from app.outside.projected import Strokes
from app.views import outside_ground
from app.views.outside import OUTSIDE, OutsideView
from app.views.outside_ground import Ground


def view(d: Driver) -> OutsideView:
    found = d.window.views[OUTSIDE]
    assert isinstance(found, OutsideView)
    return found


def ground(d: Driver) -> Ground:
    found = view(d)._ground
    assert found is not None
    return found


def enter(d: Driver) -> None:
    if hello_imgui.current_layout_name() != "Outside view":
        hello_imgui.switch_layout("Outside view")
        d.ctx.yield_(5)
    d.settle()


@contextmanager
def pace(frame_s: float, still_s: float) -> Iterator[None]:
    """What a picture may take of a frame, and after how long a view is at rest."""
    before = outside_ground.FRAME_S, outside_ground.STILL_S
    outside_ground.FRAME_S, outside_ground.STILL_S = frame_s, still_s
    try:
        yield
    finally:
        outside_ground.FRAME_S, outside_ground.STILL_S = before


def drag(d: Driver) -> list[tuple[int, int]]:
    """Turns the view; gives how coarse it was, and how wide its lines' picture, after each step."""
    at = view(d).scope
    assert at is not None
    x, y = at.origin.x + 0.62 * at.extent.x, at.origin.y + 0.85 * at.extent.y
    d.ctx.mouse_teleport_to_pos((x, y))
    d.ctx.yield_()
    d.ctx.mouse_down(0)
    seen = []
    for step in range(1, 6):
        before = view(d).primitives
        d.ctx.mouse_teleport_to_pos((x + 12 * step, y + 4 * step))
        d.until(lambda before=before: view(d).primitives is not before)
        size = view(d).size_px
        assert size is not None
        seen.append((ground(d).factor, size[0]))
    d.ctx.mouse_up(0)
    d.ctx.yield_()
    return seen


def drive_a_scene_that_is_too_slow_is_coarse_while_the_view_moves(d: Driver) -> None:
    enter(d)
    full = view(d).size_px
    assert full is not None
    with pace(frame_s=1e-9, still_s=1e9):
        assert drag(d) == [(outside_ground.COARSEST, full[0])] * 5
        assert not view(d).settled
        coarse = d.picture()
    d.settle()
    assert ground(d).factor == 1
    assert view(d).size_px == full
    number = ground(d)._drawn
    sharp = d.picture()
    assert (coarse != sharp).any()
    d.ctx.yield_(20)
    assert ground(d)._drawn == number  # at rest


def drive_a_scene_that_is_fast_enough_stays_full(d: Driver) -> None:
    enter(d)
    full = view(d).size_px
    assert full is not None
    with pace(frame_s=1e9, still_s=1e9):
        assert drag(d) == [(1, full[0])] * 5
    d.settle()


def drive_the_other_cameras_motion_leaves_the_scene_as_it_is(d: Driver) -> None:
    enter(d)
    at = view(d).scope
    assert at is not None  # else it would follow, to see all
    d.window.change(d.window.state.with_options(outside={"camera": at.camera}))
    d.settle()
    number = ground(d)._drawn
    for name in ("eye.x", "distance"):
        before = view(d).primitives
        d.drag_field(name, 40)
        d.until(lambda before=before: view(d).primitives is not before)
        assert ground(d).factor == 1
    assert ground(d)._drawn == number
    assert [p for p in view(d).primitives if isinstance(p, Strokes)]
    d.settle()
