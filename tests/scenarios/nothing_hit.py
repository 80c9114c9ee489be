"""An image that shows nothing says so: over both images, in the status line, as the comparison."""

from __future__ import annotations

from dataclasses import replace

from window_driver import RASTER, RAY, Driver

from app.window.status import is_good_news, told

WHY = "everything is behind the eye"


def drive_an_empty_image_says_why(d: Driver) -> None:
    window = d.window
    x, y, z = window.state.camera.w
    eye = tuple(100.0 * part for part in window.state.camera.eye)
    away = replace(window.state.camera, w=(-x, -y, -z), eye=eye)
    window.change(window.state.with_camera(away))
    d.settle()
    assert window.renderers.nothing_hit(window.state) == WHY
    verdict = window.renderers.verdict(window.state)
    assert told(verdict, None) == f"nothing is hit: {WHY}"
    assert is_good_news(verdict, None, effects=False) is None
    for image in d.images():  # a box with text in the middle of a plain background
        height, width = image.shape[:2]
        middle = image[2 * height // 5 : 3 * height // 5, width // 3 : 2 * width // 3]
        assert middle.std(axis=(0, 1)).min() > 8
        assert image[: height // 4, width // 4 : width // 2].std(axis=(0, 1)).max() == 0
    window.undo()
    d.settle()
    assert window.renderers.nothing_hit(window.state) == ""
    assert {RASTER, RAY} <= set(window.shell.stage.rects)
