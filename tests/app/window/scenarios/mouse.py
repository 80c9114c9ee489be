"""The mouse over the images, and the keys that act where it is."""

from dataclasses import replace

import numpy as np
from window_driver import Key, changed

from lucida.app.images.pair.view import RASTER, RAY

SIZE = (400, 300)  # to project with


def drive_the_mouse_turns_moves_and_zooms(d):
    window, start = d.window, d.start.camera
    before = d.agreeing_images()
    for name in (RASTER, RAY):
        d.window.change(d.start)
        d.drag(d.point(name, 0.5, 0.5), d.point(name, 0.7, 0.45))
        camera = window.state.camera
        assert np.allclose(camera.basis.T @ camera.basis, np.eye(3))
        assert abs(camera.u[1]) < 1e-9  # no roll
        assert not np.allclose(camera.w, start.w)
    after = d.agreeing_images()
    assert min(changed(a, b) for a, b in zip(before, after, strict=True)) > 0.1
    d.window.change(d.start)
    d.settle()
    was = window.state.camera
    pixel = (window.renderers.size[1] // 2, window.renderers.size[0] // 2)
    parameter = window.renderers.depth_at(window.state, pixel)
    ray = window.renderers.camera(window.state).ray(*pixel, window.renderers.size)
    world = ray.origin + parameter * ray.direction
    for name, button, key in ((RASTER, 1, 0), (RAY, 2, 0), (RASTER, 0, Key.mod_shift)):
        d.window.change(d.start)
        d.until(lambda: window.renderers.depth_at(window.state, pixel) == parameter)
        if key:
            d.ctx.key_down(key)
        x, y = d.point(name, 0, 0)
        middle = (x + pixel[1] + 0.5, y + pixel[0] + 0.5)
        d.drag(middle, (middle[0] + 37, middle[1] - 21), button)
        if key:
            d.ctx.key_up(key)
        assert window.state.camera.w == was.w
        assert window.state.camera.eye != was.eye
        row, column, _ = window.renderers.camera(window.state).project(world, window.renderers.size)
        assert abs(row - (pixel[0] - 21)) < 0.05
        assert abs(column - (pixel[1] + 37)) < 0.05
    was = window.state.camera
    steps = d.steps
    d.ctx.mouse_teleport_to_pos(d.point(RASTER, 0.5, 0.6))
    d.ctx.mouse_wheel_y(2)
    d.ctx.mouse_wheel_y(1)
    d.frames(2)
    assert window.state.camera.eye != was.eye
    assert d.steps == steps + 1
    was = replace(start, projection="parallel")
    d.window.change(d.start.with_camera(was))
    d.ctx.mouse_teleport_to_pos(d.point(RAY, 0.3, 0.3))
    d.ctx.mouse_wheel_y(3)
    d.frames(2)
    assert window.state.camera.eye == was.eye
    assert window.state.camera.viewport[1] < was.viewport[1]
    d.agreeing_images()


def drive_the_object_under_the_mouse_is_framed(d):
    d.settle()
    window = d.window
    numbers = window.renderers.agreement.verdict.comparison.ray.channel("id")
    shiny = 2
    rows, columns = np.nonzero(numbers == shiny)
    k = len(rows) // 2
    x, y, right, bottom = d.rect(RASTER)
    height, width = numbers.shape
    at = x + (columns[k] + 0.5) / width * (right - x), y + (rows[k] + 0.5) / height * (bottom - y)
    d.move_to(at)
    d.press(Key.f)
    camera = window.state.camera
    assert (camera.u, camera.v, camera.w) == (
        d.start.camera.u,
        d.start.camera.v,
        d.start.camera.w,
    )
    center = window.state.scene.objects[shiny].shape.center
    seen = window.renderers.camera(window.state).project(center, SIZE)
    assert abs(seen.row - (SIZE[1] - 1) / 2) < 1
    assert abs(seen.column - (SIZE[0] - 1) / 2) < 1
    frame = d.agreeing_images()
    assert d.steps == 1
    d.press(Key.h)
    assert window.state == d.start
    assert frame[0].std() > 5


def drive_alt_and_a_drag_looks_around(d):
    start, goal = d.point(RASTER, 0.5, 0.5), d.point(RASTER, 0.6, 0.45)
    d.ctx.key_down(Key.mod_alt)
    d.drag(start, goal)
    d.ctx.key_up(Key.mod_alt)
    camera = d.state.camera
    assert np.allclose(camera.eye, d.start.camera.eye)
    assert not np.allclose(camera.w, d.start.camera.w)
    # The mouse went to the image's right: so does the view direction.
    turned = -np.asarray(camera.w) @ np.asarray(d.start.camera.u)
    assert turned > 0.05
    assert d.steps == 1
    d.agreeing_images()
