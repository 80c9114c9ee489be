"""The options of both images: names of channels, resolutions and magnifications, and state changes
for menus and keys.
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import get_args

from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Channel
from lucida.renderer.images.frame import check_size
from lucida.renderer.system.errors import LucidaError

CHANNELS: dict[Channel, tuple[str, str]] = {
    "color": ("Colour", "the shaded colour of each pixel"),
    "depth": ("Depth", "the ray parameter t of the hit: the nearest is white"),
    "normal": ("Normal", "the surface's normal n, world space: (n + 1) / 2 as red, green, blue"),
    "id": ("Object", "the visible object, in a colour of its own"),
    "z": ("Distance z", "the hit's distance z along -w, in units of w: the nearest is white"),
}
_SIZE = re.compile(r"\s*(\d{1,6})\s*[x*,; \N{MULTIPLICATION SIGN}]\s*(\d{1,6})\s*", re.IGNORECASE)

assert set(CHANNELS) == set(get_args(Channel))


def size_text(size: tuple[int, int]) -> str:
    """Return `1280 x 720`."""
    return f"{size[0]} x {size[1]}"


def parsed_size(text: str) -> tuple[int, int]:
    """Return a typed resolution, (width, height). Raises LucidaError."""
    match = _SIZE.fullmatch(text)
    if match is None:
        raise LucidaError("resolution", f"{text!r} is not a size", "type e.g. 1280 x 720")
    return check_size((int(match.group(1)), int(match.group(2))))


def with_resolution(state: AppState, resolution: tuple[int, int] | None) -> AppState:
    """Make both images this large and entirely visible; None fits them to the window."""
    images = replace(state.images, resolution=resolution, magnification=None, center=(0.5, 0.5))
    return state.with_options(images)


def with_magnification(state: AppState, magnification: float | None) -> AppState:
    """Magnify about the centre; None shows the whole image."""
    center = (0.5, 0.5) if magnification is None else state.images.center
    return state.with_options(replace(state.images, magnification=magnification, center=center))
