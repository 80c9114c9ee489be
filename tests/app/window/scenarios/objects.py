"""The scene in hand: choosing, the list, the inspector; adding, deleting."""

import numpy as np
from objects_window import (
    CTRL,
    ball,
    click,
    enter,
    held,
    in_list,
    item,
    now,
    opened,
    seen_at,
)
from option_changes import with_options
from window_driver import RASTER, RAY, Key

from lucida.app.instruments.objects.actions import ADDING
from lucida.app.instruments.objects.choosing import choose, chosen, rows_of
from lucida.app.instruments.objects.in_views import CHOSEN
from lucida.app.instruments.outside.view import OUTSIDE
from lucida.renderer.editing import objects

# Choosing.


def drive_a_double_click_leaves_no_mark_and_no_step(d):
    enter(d)
    click(d, seen_at(d, RASTER, "matte sphere"))
    marked, steps = d.state.marked, d.window.history.past
    assert marked is not None
    for view in (RAY, OUTSIDE):
        click(d, seen_at(d, view, "shiny sphere"), double=True)
        assert now(d) == ("shiny sphere",), view
        assert d.state.marked == marked, view
        assert d.window.history.past == steps, view
        d.window.amend(choose(d.state, ()))
    click(d, seen_at(d, RASTER, "matte sphere"), double=True)  # on the mark itself
    assert now(d) == ("matte sphere",)
    assert d.state.marked == marked
    assert d.window.history.past == steps


def drive_clicks_mark_pixels_unless_they_are_to_choose(d):
    enter(d)
    window = d.window
    click(d, seen_at(d, RASTER, "matte sphere"))
    assert window.state.marked is not None
    assert now(d) == ()
    d.change(marked=None)
    d.press(Key.v)
    assert window.state.options.objects.selects
    for view in (RASTER, OUTSIDE):
        click(d, seen_at(d, view, "matte sphere"))
        assert now(d) == ("matte sphere",), view
        with held(d, Key.mod_shift):
            click(d, seen_at(d, view, "shiny sphere"))
        assert now(d) == ("matte sphere", "shiny sphere"), view
        with held(d, Key.mod_shift):
            click(d, seen_at(d, view, "matte sphere"))
        assert now(d) == ("shiny sphere",), view
        assert window.state.marked is None
        d.press(Key.escape)


def drive_outlines_end_where_the_image_does(d):
    enter(d)
    window = d.window
    state = with_options(window.state, images={"resolution": (64, 64)}, objects={"handle": "none"})
    window.change(choose(state, (item(d, "floor"),)))
    d.settle()
    picture = d.picture().astype(int)
    orange = np.abs(picture - np.round(255 * np.array([*CHOSEN][:3]))).max(axis=2) < 12
    left, top, right, bottom = (round(edge) for edge in d.rect(RASTER))
    assert right - left == bottom - top  # there is room beside it
    assert orange[top:bottom, left:right].any()
    assert not orange[top:bottom, left - 40 : left - 1].any()
    assert not orange[top:bottom, right + 1 : right + 40].any()


# The list.


def drive_what_is_typed_edits_no_object(d):
    """Delete, Ctrl+A and D are the text's while a field has the keyboard."""
    enter(d)
    d.click(in_list(d, "box"))
    before, (selected,) = d.state.scene, chosen(d.state)
    d.click("//###Inspector/##name")
    for chord in (CTRL | Key.a, CTRL | Key.d):
        d.press(chord)
    d.press(Key.delete)
    assert len(d.state.scene.objects) == len(before.objects)
    assert chosen(d.state) == (selected,)
    d.press(Key.escape)


def drive_a_checkbox_hides_from_both_images(d):
    enter(d)
    before = d.agreeing_images()
    d.click(in_list(d, "matte sphere", "##shown"))
    assert next(r for r in rows_of(d.state.scene) if r.shown == "matte sphere").hidden
    after = d.agreeing_images()
    assert all(
        (np.abs(a - b).max(axis=2) > 8).mean() > 0.01 for a, b in zip(before, after, strict=True)
    )


# The inspector.


def drive_a_number_that_is_dragged_is_one_step(d):
    enter(d)
    window = d.window
    d.click(in_list(d, "matte sphere"))
    steps, radius = d.steps, ball(d, "matte sphere").radius
    middle = d.box("//###Inspector/##radius").get_center()
    d.drag((middle.x, middle.y), (middle.x + 30, middle.y))
    d.frames(3)
    assert ball(d, "matte sphere").radius != radius
    assert d.steps == steps + 1
    window.undo()
    assert ball(d, "matte sphere").radius == radius
    assert now(d) == ("matte sphere",)


# Adding.


def drive_every_shape_and_light_is_added_and_both_images_agree(d):
    enter(d)
    window = d.window
    *kinds, _ = ADDING  # the last one opens a dialog
    assert len(kinds) == len((*objects.SHAPES, *objects.LIGHTS))
    for action in kinds:
        before = {row.item for row in rows_of(window.state.scene)}
        action.run(window)
        (new,) = {row.item for row in rows_of(window.state.scene)} - before
        assert chosen(window.state) == (new,)
    d.agreeing_images()
    assert len(rows_of(window.state.scene)) == len(rows_of(d.start.scene)) + len(kinds)


# Many objects, large type.


def drive_a_long_list_draws_what_is_seen_and_follows_what_is_chosen(d):
    enter(d)
    balls = "".join(
        f'[[objects]]\ntype = "sphere"\nname = "ball {k}"\ncenter = [{k % 20}, 0, {k // 20}]\n'
        "radius = 0.4\n"
        for k in range(300)
    )
    opened(d, f'name = "kept"\n{balls}', "many")
    for name, other in (("ball 150", "ball 0"), ("ball 0", "ball 150")):
        d.window.amend(choose(d.state, (item(d, name),)))
        d.frames(4)
        assert d.ctx.item_exists(in_list(d, name))
        assert not d.ctx.item_exists(in_list(d, other))


def drive_the_column_grows_with_the_type(d):
    enter(d)
    window = d.window
    window.amend(choose(window.state, (item(d, "box"),)))

    def wide():
        return d.box("//###Objects/Add").get_width()

    before = wide()
    d.change(preferences={"font_scale": 1.5})
    d.until(lambda: wide() > 1.25 * before)
    d.change(preferences={"font_scale": 1.0})
    d.until(lambda: abs(wide() - before) <= 1)
