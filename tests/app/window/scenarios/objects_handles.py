"""The scene in hand: its handles in the views."""

import numpy as np
from objects_window import (
    arrow,
    ball,
    drag_handle,
    enter,
    handle_px,
    in_image,
    item,
    now,
)
from option_changes import with_options
from window_driver import RASTER, Key

from lucida.app.instruments.objects.choosing import choose
from lucida.app.instruments.outside.view import OUTSIDE
from lucida.renderer.editing.changing import fields_of
from lucida.renderer.editing.moving import bounds_of


def drive_handles_move_in_the_images_and_outside(d):
    enter(d)
    window = d.window
    d.change(objects={"handle": "move"})
    for view in (RASTER, OUTSIDE):
        window.amend(choose(window.state, (item(d, "shiny sphere"),)))
        d.settle()
        steps, before = d.steps, np.asarray(ball(d, "shiny sphere").center)
        camera = window.state.view, window.state.options.outside.camera
        drag_handle(d, view, "shiny sphere", 1)
        by = np.asarray(ball(d, "shiny sphere").center) - before
        assert by[1] > 0.02, view
        assert not by[[0, 2]].any()
        assert d.steps == steps + 1
        assert (window.state.view, window.state.options.outside.camera) == camera
        assert now(d) == ("shiny sphere",)
        window.undo()
        assert np.array_equal(ball(d, "shiny sphere").center, before)


def drive_escape_and_undo_end_the_drag_of_a_handle(d):
    choose_to(d, "move", "shiny sphere")
    window = d.window
    for view in (RASTER, OUTSIDE):
        steps, before = d.steps, ball(d, "shiny sphere").center
        for end in (lambda: d.press(Key.escape), window.undo):
            grip, way = arrow(d, view, "shiny sphere", 1)
            d.move_to(tuple(grip))
            d.ctx.mouse_down(0)
            for length in (5, 25):
                d.move_to(tuple(grip + length * way))
            assert ball(d, "shiny sphere").center != before, view
            end()
            d.frames(3)
            d.ctx.mouse_teleport_to_pos(tuple(grip + 40 * way))  # the mouse is still down
            d.frames(3)
            d.ctx.mouse_up(0)
            d.frames(3)
            assert ball(d, "shiny sphere").center == before, view
            assert d.steps == steps
            assert now(d) == ("shiny sphere",)
        drag_handle(d, view, "shiny sphere", 1)  # and it can be dragged again
        assert ball(d, "shiny sphere").center != before
        window.undo()
        d.settle()


def choose_to(d, handle, name):
    """An object with handles that do this."""
    enter(d)
    state = with_options(d.state, objects={"handle": handle})
    d.window.change(choose(state, (item(d, name),)))
    d.settle()


def drive_handles_turn(d):
    window = d.window
    choose_to(d, "turn", "box")
    before, steps = fields_of(window.state.scene, item(d, "box")), d.steps
    middle = bounds_of(window.state.scene, [item(d, "box")]).mean(axis=0)
    start = np.asarray(in_image(d, RASTER, middle))
    radius = handle_px(d, RASTER)
    for part in (1.2, 1.0, 0.8):
        for angle in np.linspace(0, 2 * np.pi, 12, endpoint=False):
            grip = start + part * radius * np.array([np.cos(angle), np.sin(angle)])
            d.move_to(tuple(grip))
            if not window.views[RASTER].linked.guest.holds(RASTER):
                continue
            d.drag(tuple(grip), tuple(grip + 25 * np.array([-np.sin(angle), np.cos(angle)])))
            d.frames(3)
            after = fields_of(window.state.scene, item(d, "box"))
            assert after.rotate_deg != before.rotate_deg
            assert after.size == before.size
            assert d.steps == steps + 1
            return
    raise AssertionError("no ring was found")
