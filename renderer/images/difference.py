"""The difference of two images in one channel, as numbers and as false colours.

This module defines the difference in each channel, its colour map, and the causes' colours.
raster_and_ray.py finds the causes.

    color   display values (sRGB, 0 to 1, exposure 0) of the colour channel that differs most
    depth   the ray parameters' difference, relative to the ray image's; infinite if one misses
    normal  the component that differs most
    id      1 if the objects differ, else 0
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .display import encode_srgb
from .frame import Frame

Bytes = NDArray[np.uint8]
Floats32 = NDArray[np.float32]

FULL_SCALE = {"color": 1.0, "depth": 1.0, "normal": 2.0, "id": 1.0}  # at gain 1
LARGEST_GAIN = 1024.0
STEPS = 511  # colours of the map

UNEXPLAINED_COLOR = (255, 94, 0)
SHADING_COLOR = (238, 51, 119)
CAUSE_COLORS = {
    "edge": (86, 180, 233),
    "pattern": (170, 170, 0),
    "clip": (170, 68, 153),
    "lookup": (160, 220, 90),
}

# Lightness rises evenly from black to white, after matplotlib's inferno (Smith and van der Walt).
_ABSOLUTE = (
    (0, 0, 0),
    (31, 12, 72),
    (85, 15, 109),
    (136, 34, 106),
    (186, 54, 85),
    (227, 89, 51),
    (249, 140, 10),
    (249, 201, 50),
    (255, 255, 255),
)


def _colors(stops: tuple[tuple[int, int, int], ...]) -> Bytes:
    at = np.linspace(0, len(stops) - 1, STEPS)
    columns = [np.interp(at, range(len(stops)), column) for column in zip(*stops, strict=True)]
    return np.rint(np.stack(columns, axis=-1)).astype(np.uint8)


ABSOLUTE_COLORS = _colors(_ABSOLUTE)  # uint8 (STEPS, 3), sRGB: no difference to full scale


def difference(raster: Frame, ray: Frame, channel: str = "color") -> Floats32:
    """Return the difference in a channel, float32 (height, width); see the module.

    NaN if one image has NaN. Raises LucidaError if a frame lacks the channel.
    """
    first, second = raster.channel(channel), ray.channel(channel)
    if channel == "id":
        return (first != second).astype(np.float32)
    with np.errstate(invalid="ignore"):
        if channel == "depth":
            missed = np.isposinf(first) & np.isposinf(second)
            by = np.where(np.isposinf(second), np.float32(1), second)
            return np.where(missed, np.float32(0), np.abs((second - first) / by))
        if channel == "color":
            unusable = np.isnan(first) | np.isnan(second)
            shown = encode_srgb(second) - encode_srgb(first)
            shown[unusable] = np.nan
            return most(shown)
        return most(second - first)


def most(vectors: Floats32) -> Floats32:
    """Return the largest absolute component of each vector (..., 3)."""
    # Not vectors.max(axis=-1), which reduces three numbers at a time and takes ten times as long.
    x, y, z = (np.abs(vectors[..., axis]) for axis in range(3))
    return np.maximum(np.maximum(x, y), z)  # NaN if any is NaN


def false_color(values: Floats32, channel: str, gain: float = 1.0) -> Bytes:
    """Return differences as colours, uint8 (..., 3): the full scale is FULL_SCALE[channel] / gain.

    Values beyond it, and NaN, get the last colour.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        scaled = np.asarray(values, np.float32) * np.float32(gain / FULL_SCALE[channel])
    scaled = np.clip(np.where(np.isnan(scaled), np.float32(1), scaled), 0, 1)
    return ABSOLUTE_COLORS[(scaled * np.float32(STEPS - 1) + np.float32(0.5)).astype(np.intp)]
