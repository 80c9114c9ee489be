"""Into the pixels: marks, magnification, rulers, values; on the screen's pixels."""

import numpy as np
from shown_pixels import ALT, SHIFT, magnified, placement, without_overlays
from window_driver import Key

from lucida.app.images.pair.view import RASTER, RAY


def drive_a_click_marks_a_pixel_in_both(d):
    window, before = d.window, d.agreeing_images()
    x, y, *_ = d.rect(RASTER)
    d.ctx.mouse_teleport_to_pos((x + 120, y + 150))
    d.frames()
    d.ctx.mouse_click(0)
    d.frames(2)
    assert window.state.marked == (150, 120)
    assert window.state.camera == d.start.camera
    assert d.steps == 1
    for was, now in zip(before, d.images(), strict=True):
        places = np.argwhere(np.abs(was - now).max(axis=2) > 40)
        assert len(places) > 20
        assert np.allclose((places.min(axis=0) + places.max(axis=0)) / 2, (150, 120), atol=1)
    # The keys move it, in the image that the mouse is over.
    d.move_to(d.point(RAY, 0.5, 0.5))
    d.press(Key.right_arrow)
    d.press(SHIFT | Key.down_arrow)
    assert window.state.marked == (160, 121), window.state.marked
    d.change(marked=(160, 15))
    d.ctx.key_press(SHIFT | Key.left_arrow, 2)
    d.press(Key.up_arrow)
    assert window.state.marked == (159, 0), "it stays in the image"
    d.ctx.key_press(SHIFT | Key.right_arrow, 3)
    d.frames(2)
    d.press(Key.escape)
    assert window.state.marked is None
    window.undo()
    assert window.state.marked == (159, 30)
    # Clicked again, it is gone; a drag marks nothing.
    x, y, *_ = d.rect(RAY)
    d.ctx.mouse_teleport_to_pos((x + 30, y + 159))
    d.frames()
    d.ctx.mouse_click(0)
    d.frames(2)
    assert window.state.marked is None
    d.drag(d.point(RAY, 0.5, 0.5), d.point(RAY, 0.6, 0.5))
    assert window.state.marked is None
    assert window.state.camera != d.start.camera


def drive_the_wheel_with_ctrl_magnifies_at_the_pointer(d):
    window = d.window
    d.change(images={"resolution": (640, 360)})
    d.settle()
    x, y = d.point(RASTER, 0.3, 0.6)
    x, y = round(x), round(y)
    d.move_to((x, y))
    pixel = window.hovered[1]
    d.ctx.key_down(Key.mod_ctrl)
    for _ in range(6):
        d.ctx.mouse_wheel_y(1)
    d.frames(2)
    assert window.state.images.magnification == 8
    assert window.state.camera == d.start.camera
    apart = np.subtract(window.hovered[1], pixel)
    assert np.abs(apart).max() <= 1, f"{pixel} under the pointer moves by {apart}"
    assert d.steps == 1, "the resolution; the wheel is no step of undo"
    center = window.state.images.center
    d.drag((x, y), (x - 80, y - 24))
    d.ctx.key_up(Key.mod_ctrl)
    assert window.state.camera == d.start.camera
    moved = window.state.images.center
    assert abs((moved[0] - center[0]) * 640 * 8 - 80) < 1
    assert abs((moved[1] - center[1]) * 360 * 8 - 24) < 1
    # A drag without Ctrl turns the camera, also where the image is magnified.
    d.drag((x, y), (x + 30, y))
    assert window.state.camera != d.start.camera
    assert window.state.images.center == moved
    window.undo()
    d.press(ALT | Key._0)
    assert window.state.images.magnification is None
    d.press(ALT | Key.a)
    assert window.state.images.magnification == 1


def drive_magnified_pixels_are_squares_with_a_grid(d):
    images = {"resolution": (160, 90), "magnification": 8.0, "center": (0.4, 0.6), "grid": False}
    d.change(images=images)
    d.settle()
    plain = d.images()
    for name, image in zip((RASTER, RAY), plain, strict=True):
        expected = magnified(d, name, "color")
        difference = np.abs(without_overlays(image) - without_overlays(expected)).max(axis=2)
        assert (difference <= 1).all(), "nearest neighbour: nothing is blurred or shifted"
    d.press(ALT | Key.x)
    d.settle()
    for name, after in zip((RASTER, RAY), d.images(), strict=True):
        lines = np.abs(after - magnified(d, name, "color")).max(axis=2) > 4
        at, (height, width) = placement(d, name), lines.shape
        columns = (np.arange(width) + at.visible[0] - at.origin[0]) % 8 == 0
        rows = (np.arange(height) + at.visible[1] - at.origin[1]) % 8 == 0
        expected = columns[None, :] | rows[:, None]
        inner = without_overlays(np.dstack([lines, np.broadcast_to(expected, lines.shape)]))
        assert (inner[..., 0] <= inner[..., 1]).all(), "lines stand between pixels only"
        assert inner[..., 0].sum() > 0.9 * inner[..., 1].sum()
    d.change(images={"magnification": 4.0})
    d.settle()
    fine = d.images()
    d.press(ALT | Key.x)
    d.settle()
    assert (np.abs(fine[0] - d.images()[0]) <= 1).all(), "no lines between smaller pixels"


def drive_values_are_written_into_large_pixels(d):
    window = d.window
    d.change(images={"resolution": (64, 36), "magnification": 64.0})
    for number, channel in enumerate(("color", "depth", "normal", "id")):
        d.press(ALT | (Key._1 + number))
        d.settle()
        assert window.state.images.channel == channel
        raster = d.images()[0]
        cell = without_overlays(np.abs(raster - magnified(d, RASTER, channel)).max(axis=2)) > 60
        assert cell.mean() > 0.02, "there are no numbers in the pixels"
    # From 48 units a side on, each has its row and column too.
    large = raster
    d.change(one_based=False)
    d.settle()
    assert np.abs(without_overlays(d.images()[0] - large)).max() > 60
