"""The scene in hand: its handles in the views."""

import numpy as np
from objects_window import (
    arrow,
    ball,
    drag_handle,
    enter,
    item,
    now,
)
from option_changes import with_options
from window_driver import RASTER, Driver, Key

from lucida.app.instruments.objects.choosing import choose
from lucida.app.instruments.outside.view import OUTSIDE


def drive_handles_move_in_the_images_and_outside(d):
    enter(d)
    window = d.window
    d.change(objects={"handle": "move"}, images={"resolution": (80, 60)})
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
    for view, end in ((RASTER, _escape), (OUTSIDE, Driver.undo)):
        steps, before = d.steps, ball(d, "shiny sphere").center
        grip, way = arrow(d, view, "shiny sphere", 1)
        d.move_to(tuple(grip))
        d.ctx.mouse_down(0)
        for length in (5, 25):
            d.move_to(tuple(grip + length * way))
        assert ball(d, "shiny sphere").center != before, view
        end(d)
        d.frames()
        d.ctx.mouse_teleport_to_pos(tuple(grip + 40 * way))  # the mouse is still down
        d.ctx.mouse_up(0)
        d.frames()
        assert ball(d, "shiny sphere").center == before, view
        assert d.steps == steps
        assert now(d) == ("shiny sphere",)
    drag_handle(d, view, "shiny sphere", 1)  # and it can be dragged again
    assert ball(d, "shiny sphere").center != before


def _escape(d):
    d.press(Key.escape)


def choose_to(d, handle, name):
    """An object with handles that do this."""
    enter(d)
    state = with_options(d.state, objects={"handle": handle}, images={"resolution": (80, 60)})
    d.window.change(choose(state, (item(d, name),)))
    d.settle()
