"""The place of a photograph in the images, and the note on it. Pure.

A photograph fills the camera's own viewport: its left edge is the viewport's left, its upper edge
the top. If a view is fitted to the window, its images show more than the viewport, and the
photograph is a part of them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.photograph.options import PhotographOptions
from app.photograph.reading import Size
from app.state.app_state import AppState
from app.storage.paths import restored, stored
from renderer.camera import Camera
from renderer.errors import one_line

Parts = tuple[float, float, float, float]  # left, top, right, bottom: of an image's width, height
WHOLE: Parts = (0.0, 0.0, 1.0, 1.0)
STRETCHED = 0.005  # reported from here on


def path_of(state: AppState) -> Path | None:
    """Return the path of the open photograph."""
    file = restored(state.of(PhotographOptions).file)
    return Path(file) if file else None


def with_photograph(state: AppState, path: str | None, **changes: Any) -> AppState:
    """Return the state with a photograph open; None closes it."""
    return state.with_options(photograph={"file": stored(path or ""), **changes})


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


def pixels_of(parts: Parts, size: Size) -> Size:
    """Return the number of pixels of an image of (width, height) that a photograph covers: at least
    one, and no more than the image has.
    """
    left, top, right, bottom = parts
    wide, high = round((right - left) * size[0]), round((bottom - top) * size[1])
    return min(max(wide, 1), size[0]), min(max(high, 1), size[1])


def note(name: str, own: Size, seen: Size) -> str:
    """Return a note if a photograph does not keep its proportions; "" if it does, to a pixel."""
    across, down = own[0] * seen[1], own[1] * seen[0]
    near = max(own[0], own[1]) + STRETCHED * max(across, down)  # a pixel is rounding
    if abs(across - down) <= near:
        return ""
    size = f"{own[0]} x {own[1]}"
    return f"{one_line(name)}, {size}, is stretched to the viewport's {seen[0]} x {seen[1]}"
