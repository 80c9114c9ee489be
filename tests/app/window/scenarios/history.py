"""Undo, keys, menus, switches."""

from __future__ import annotations

import numpy as np
from window_driver import IMAGES, Driver, Key

from lucida.app.images.pair.view import RASTER, RAY

CTRL = int(Key.mod_ctrl)


def drive_undo_and_redo(d: Driver) -> None:
    d.drag_field("eye.x", 40)
    moved = d.window.state
    d.drag(d.point(RAY, 0.5, 0.5), d.point(RAY, 0.6, 0.5))
    turned = d.window.state
    assert len(d.window.history.past) == 2
    shift = int(Key.mod_shift)
    d.ctx.key_press(CTRL | int(Key.z))
    assert d.window.state == moved
    d.ctx.key_press(CTRL | int(Key.z))
    assert d.window.state == d.start
    d.ctx.key_press(CTRL | shift | int(Key.z))
    assert d.window.state == moved
    d.ctx.key_press(CTRL | int(Key.y))
    assert d.window.state == turned
    d.ctx.menu_click("//##MainMenuBar/Edit/Undo")
    assert d.window.state == moved
    d.agreeing_images()


def drive_keys_and_menus(d: Driver) -> None:
    window = d.window
    d.ctx.mouse_move(IMAGES[RASTER])
    d.ctx.key_press(int(Key.p))
    assert window.state.camera.is_parallel
    d.ctx.key_press(int(Key.o))
    assert not window.state.keep_orthonormal
    d.ctx.key_press(int(Key.home))
    assert window.state.view == d.start.view
    d.ctx.menu_click("//##MainMenuBar/Camera/Canonical camera")
    assert window.state.camera.eye == (0, 0, 0)
    assert window.state.camera.viewport == (-0.5, 0.5, -0.5, 0.5)
    d.ctx.menu_click("//##MainMenuBar/Camera/Fit to the image's aspect ratio")
    d.settle()
    assert window.renderers.camera(window.state).viewport == (-0.5, 0.5, -0.5, 0.5)
    d.ctx.item_click("//Camera/Scene's view")
    assert window.state.camera == d.start.camera
    d.ctx.key_press(int(Key.f1))
    d.ctx.yield_(2)
    assert d.ctx.window_info("//Mouse and keys").id_ != 0
    d.ctx.key_press(int(Key.escape))
    d.ctx.yield_(2)
    assert not window.shell.help


def drive_shadows_and_mirrors_are_the_ray_images_alone(d: Driver) -> None:
    raster, ray = d.agreeing_images()
    d.ctx.menu_click("//##MainMenuBar/View/Shadows (ray image only)")
    d.settle()
    raster_after, shaded = d.images()
    assert (np.abs(raster_after - raster) <= 3).all()
    assert (ray - shaded).max() > 30
    d.ctx.menu_click("//##MainMenuBar/View/Mirrors (ray image only)")
    d.settle()
    assert np.abs(d.images()[1] - shaded).max() > 30
    verdict = d.window.renderers.verdict(d.window.state)
    assert verdict is not None
    assert verdict.text.startswith("not compared")
    d.window.undo()
    d.window.undo()
    d.agreeing_images()


def drive_undo_takes_back_a_number_that_is_not_legal_before_any_edit(d: Driver) -> None:
    d.type("eye.y", "2.5")
    edited = d.window.state
    assert edited != d.start
    d.type("left", "9")  # and right is smaller
    assert d.window.views["Camera"].has_pending
    d.press(CTRL | int(Key.z))
    assert d.window.state == edited
    assert not d.window.views["Camera"].has_pending
    d.press(CTRL | int(Key.z))
    assert d.window.state.camera == d.start.camera
