"""The place of a photograph in the images. Pure.

A photograph of the viewport's shape fills the camera's own viewport: its left edge is the
viewport's left edge, and its upper edge the viewport's top. A photograph of another shape has bars
on two sides. If a view is fitted to the window, its images show more than the viewport, and the
photograph covers a part of them.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from lucida.app.state.app_state import AppState
from lucida.app.state.paths import restored, stored
from lucida.renderer.camera.camera import Camera

from .reading import Size

Parts = tuple[float, float, float, float]  # left, top, right, bottom: of an image's width, height
WHOLE: Parts = (0.0, 0.0, 1.0, 1.0)
SAME_SHAPE = 0.005  # relative difference of two shapes that are the same


def path_of(state: AppState) -> Path | None:
    """Return the path of the open photograph."""
    file = restored(state.options.photograph.file)
    return Path(file) if file else None


def with_photograph(state: AppState, path: str | None, **changes: Any) -> AppState:
    """Return the state with a photograph open; None closes it."""
    file = stored(path or "")
    return state.with_options(replace(state.options.photograph, file=file, **changes))


def closed(state: AppState) -> AppState:
    return with_photograph(state, None, follows=False)


def covered(camera: Camera, drawn: Camera) -> Parts:
    """Return the part of an image that a camera's viewport covers.

    The image is drawn by another camera, which differs in its viewport only.
    """
    if camera.viewport == drawn.viewport:
        return WHOLE
    left, right, bottom, top = camera.viewport
    l, r, b, t = drawn.viewport  # noqa: E741
    width, height = r - l, t - b
    return (left - l) / width, (t - top) / height, (right - l) / width, (t - bottom) / height


def letterboxed(parts: Parts, shape: Size, own: Size) -> Parts:
    """Return the part of the viewport that a photograph fills without being stretched.

    This is all of it if the shapes agree; otherwise there are bars on two sides.

    parts: the viewport's part of the image. shape: (width, height) of the viewport. own: of the
    photograph; (0, 0) if unknown.
    """
    if not min(own):
        return parts
    width, height = shape
    ratio = own[0] * height / (own[1] * width)
    if abs(ratio - 1) <= SAME_SHAPE + 1 / min(*own, *shape):  # a pixel's difference is rounding
        return parts
    across, down = min(1.0, ratio), min(1.0, 1 / ratio)
    x, y = (parts[0] + parts[2]) / 2, (parts[1] + parts[3]) / 2
    wide, high = across * (parts[2] - parts[0]) / 2, down * (parts[3] - parts[1]) / 2
    return x - wide, y - high, x + wide, y + high


def pixels_of(parts: Parts, size: Size) -> Size:
    """Return the number of pixels of an image of (width, height) that a photograph covers: at least
    one, and no more than the image has.
    """
    left, top, right, bottom = parts
    wide, high = round((right - left) * size[0]), round((bottom - top) * size[1])
    return min(max(wide, 1), size[0]), min(max(high, 1), size[1])
