"""Undo, keys, menus, switches."""

import numpy as np
from window_driver import IMAGES, Key

from lucida.app.images.pair.view import RASTER, RAY
from lucida.app.window.documents import KEYS

CTRL = Key.mod_ctrl


def drive_undo_and_redo(d):
    d.show_small()
    start = d.state
    d.drag_field("eye.x", 40)
    moved = d.state
    d.drag(d.point(RAY, 0.5, 0.5), d.point(RAY, 0.6, 0.5))
    turned = d.state
    assert d.steps == 3
    shift = Key.mod_shift
    d.press(CTRL | Key.z)
    assert d.state == moved
    d.press(CTRL | Key.z)
    assert d.state == start
    d.press(CTRL | shift | Key.z)
    assert d.state == moved
    d.press(CTRL | Key.y)
    assert d.state == turned
    d.undo()
    assert d.state == moved
    d.agreeing_images()


def drive_keys_and_menus(d):
    window = d.window
    d.ctx.mouse_move(IMAGES[RASTER])
    d.press(Key.p)
    assert window.state.camera.is_parallel
    d.press(Key.o)
    assert not window.state.keep_orthonormal
    d.press(Key.home)
    assert window.state.view == d.start.view
    d.menu("Camera/Canonical camera")
    assert window.state.camera.eye == (0, 0, 0)
    assert window.state.camera.viewport == (-0.5, 0.5, -0.5, 0.5)
    d.menu("Camera/Fit to the image's aspect ratio")
    d.settle()
    assert window.renderers.camera(window.state).viewport == (-0.5, 0.5, -0.5, 0.5)
    d.click("//Camera/Scene's view")
    assert window.state.camera == d.start.camera
    d.press(Key.f1)
    assert window.shell.documents.shown == KEYS
    d.press(Key.escape)
    assert not window.shell.documents.shown


def drive_shadows_and_mirrors_are_the_ray_images_alone(d):
    d.show_small()
    raster, ray = d.agreeing_images()
    d.menu("Image/Shadows (ray image only)")
    d.settle()
    raster_after, shaded = d.images()
    assert (np.abs(raster_after - raster) <= 3).all()
    assert (ray - shaded).max() > 30
    d.change(mirrors=True)
    d.settle()
    assert np.abs(d.images()[1] - shaded).max() > 30
    verdict = d.renderers.verdict(d.state)
    assert verdict.text.startswith("not compared")
    d.undo()
    d.undo()
    d.agreeing_images()


def drive_the_history_is_a_list(d):
    d.drag_field("eye.x", 30)
    d.drag_field("eye.z", 30)
    assert d.steps == 2
    d.menu("Edit/History/###step0")
    assert d.state == d.start
    assert len(d.window.history.future) == 2


def drive_undo_takes_back_a_number_that_is_not_legal_before_any_edit(d):
    d.type("eye.y", "2.5")
    edited = d.state
    assert edited != d.start
    d.type("left", "9")  # and right is smaller
    assert d.window.views["Camera"].has_pending
    d.press(CTRL | Key.z)
    assert d.state == edited
    assert not d.window.views["Camera"].has_pending
    d.press(CTRL | Key.z)
    assert d.state.camera == d.start.camera
