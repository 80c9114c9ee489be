"""The image windows: pixels, sizes, layouts."""

from __future__ import annotations

import numpy as np
from imgui_bundle import hello_imgui
from window_driver import SIZE, Driver, Key

from app.pair.view import RASTER, RAY


def drive_pixels_can_be_large_and_are_marked(d: Driver) -> None:
    before = d.window.renderers.size
    d.ctx.menu_click("//##MainMenuBar/Image/Resolution/Window, pixels 8 x 8")
    d.ctx.key_press(int(Key.mod_alt) | int(Key.x))  # without the pixel grid
    d.settle()
    assert d.window.renderers.size == (before[0] // 8, before[1] // 8)
    raster, ray = d.images()
    assert raster.shape[:2] == (8 * d.window.renderers.size[1], 8 * d.window.renderers.size[0])
    blocks = raster.reshape(d.window.renderers.size[1], 8, d.window.renderers.size[0], 8, 3)
    assert (blocks == blocks[:, :1, :, :1]).all()  # nearest neighbour: no pixel is blurred
    x, y, *_ = d.rect(RASTER)
    d.ctx.mouse_teleport_to_pos((x + 8 * 20 + 4, y + 8 * 30 + 4))
    d.ctx.yield_(3)
    assert d.window._hovered == (RASTER, (30, 20))
    d.stay = True
    marked = d.images()[1]
    places = np.argwhere(np.abs(marked - ray).max(axis=2) > 8)
    assert places.min(axis=0).tolist() == [8 * 30 - 2, 8 * 20 - 2]
    assert places.max(axis=0).tolist() == [8 * 31 + 1, 8 * 21 + 1]


def drive_windows_can_be_hidden(d: Driver) -> None:
    both = d.window.renderers.size
    d.ctx.window_close(f"//###{RAY}")
    d.ctx.yield_(3)
    d.until(lambda: d.window.renderers.size[0] > both[0])
    d.ctx.menu_click("//##MainMenuBar/View/Views/###Ray")
    d.ctx.yield_(3)
    d.ctx.menu_click("//##MainMenuBar/View/Layout/Reset the layout")
    d.ctx.yield_(5)
    d.agreeing_images()
    assert abs(d.window.renderers.size[0] - both[0]) <= 2


def drive_the_window_is_resized(d: Driver) -> None:
    hello_imgui.change_window_size((1500, 640))
    d.ctx.yield_(5)
    d.agreeing_images()
    widths = [width for width, _ in d.window.renderers._panes_px.values()]
    assert abs(widths[0] - widths[1]) <= 2, "both images have half of the room"
    hello_imgui.change_window_size(SIZE)
    d.ctx.yield_(5)


def drive_a_tiny_window_is_survived(d: Driver) -> None:
    hello_imgui.change_window_size((300, 60))
    d.ctx.yield_(5)
    hello_imgui.change_window_size(SIZE)
    d.ctx.yield_(5)
    d.agreeing_images()
    widths = [width for width, _ in d.window.renderers._panes_px.values()]
    assert abs(widths[0] - widths[1]) <= 2, "both images have half of the room again"
