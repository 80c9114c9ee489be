"""A rendered image: the channels that both renderers produce, in one format."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.checks import number
from lucida.renderer.system.errors import LucidaError

CHANNELS = ("color", "depth", "normal", "id", "primitive")
DISPLAY = "lucida.renderer.notebook.display"  # it is in a higher layer, so import it by name
LARGEST_SIDE = 16384
LARGEST_PIXELS = 1 << 26


@dataclass(frozen=True, eq=False)
class Frame:
    """Channels of one image, row 0 at the top; None for a channel that was not requested.

    color: float32 (height, width, 3), linear light.
    depth: float32 (height, width), the ray parameter, inf if nothing is hit.
    normal: float32 (height, width, 3), world space, unit, facing the viewer, 0 if nothing is hit.
    id: int32 (height, width), the object's index in the scene, -1 if nothing is hit.
    primitive: int32 (height, width), the triangle's or sphere's number in the flat scene, -1 if
    nothing is hit.
    time_s: the rendering time.
    complete: False if rendering was cancelled; unfinished pixels are then misses.
    """

    size: tuple[int, int]
    color: NDArray[np.float32] | None = None
    depth: NDArray[np.float32] | None = None
    normal: NDArray[np.float32] | None = None
    id: NDArray[np.int32] | None = None
    primitive: NDArray[np.int32] | None = None
    time_s: float = 0.0
    complete: bool = True

    def __repr__(self) -> str:
        names = ", ".join(name for name in CHANNELS if getattr(self, name) is not None)
        state = f"{1000 * self.time_s:.3g} ms" if self.complete else "cancelled"
        return f"Frame({self.size[0]}x{self.size[1]}: {names or 'no channels'}; {state})"

    def _repr_png_(self) -> bytes | None:
        png: bytes | None = import_module(DISPLAY).frame_png(self)
        return png

    def show(self, channel: str = "color") -> Any:
        """Return a channel that a notebook displays with the range of its values and its shape.

        Raises LucidaError if it was not rendered.
        """
        self.channel(channel)
        return import_module(DISPLAY).Shown(self, channel)

    def channel(self, name: str) -> NDArray:
        """Return a channel's array. Raises LucidaError if it was not rendered."""
        array = getattr(self, check_channels(name)[0])
        if array is None:
            raise LucidaError("channel", f"{name!r} was not rendered", "ask the renderer for it")
        return array

    def part(self, rows_and_columns: tuple[slice, slice]) -> Frame:
        """Return a frame of some of the pixels; its channels are views of this frame's."""
        channels: dict[str, Any] = {
            name: array[rows_and_columns]
            for name in CHANNELS
            if (array := getattr(self, name)) is not None
        }
        height, width = next(iter(channels.values())).shape[:2] if channels else (0, 0)
        return Frame((width, height), **channels, time_s=self.time_s, complete=self.complete)


def stored(channel: str) -> str:
    """Return the frame's channel that holds a visible one; z replaces the depth."""
    return "depth" if channel == "z" else channel


def check_channels(channels: Iterable[str]) -> tuple[str, ...]:
    """Return the channels as a tuple. Raises LucidaError for an unknown name."""
    channels = (channels,) if isinstance(channels, str) else tuple(channels)
    for name in channels:
        if name not in CHANNELS:
            raise LucidaError(
                "channel", f"{name!r} is unknown", f"give one of {', '.join(CHANNELS)}"
            )
    return channels


def check_size(size: Iterable[int], rows: tuple[int, int] | None = None) -> tuple[int, int]:
    """Return (width, height) as ints. Raises LucidaError for an impossible image size.

    rows: the first, and one past the last, if an image is drawn in parts; only they must stay
    within LARGEST_PIXELS.
    """
    try:
        sides = [number("size", side) for side in size]
        width, height = map(int, sides)
        if [width, height] != sides:
            raise ValueError
    except (TypeError, ValueError):  # LucidaError is a ValueError
        problem = f"{size!r} is not two whole numbers"
        raise LucidaError("size", problem, "give e.g. (1280, 720)") from None
    if min(width, height) < 1:
        raise LucidaError("size", f"{width}x{height} has no pixels", "give at least 1x1")
    if rows is not None and not 0 <= rows[0] < rows[1] <= height:
        raise LucidaError("rows", f"{rows!r} are not in 0 to {height}", "give e.g. (0, 32)")
    count = height if rows is None else rows[1] - rows[0]
    is_long = max(width, height) > LARGEST_SIDE
    if is_long or width * count > LARGEST_PIXELS:
        pixels = "" if is_long and rows else f" and {LARGEST_PIXELS} pixels"
        remedy = f"stay within {LARGEST_SIDE} a side{pixels}"
        raise LucidaError("size", f"{width}x{height} is too large", remedy)
    return width, height
