"""The display transform, and pictures of a frame's channels: sRGB, exposure and false colours.

The window's shader (shaders/) computes the same display transform with the same constants
(renderer/images/shared_numbers.py).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.renderer.system.errors import LucidaError

from . import shared_numbers
from .frame import Frame
from .shared_numbers import (
    FARTHEST_GRAY,
    SRGB_GAMMA,
    SRGB_LINEAR,
    SRGB_LINEAR_SHOWN,
    SRGB_SCALE,
    SRGB_SHIFT,
    SRGB_SLOPE,
)

Bytes = NDArray[np.uint8]
Floats32 = NDArray[np.float32]

EXPOSURE_LIMIT_EV = 32.0
LUMINANCE = np.array(shared_numbers.LUMINANCE, np.float32)
ID_PALETTE = np.array(shared_numbers.ID_PALETTE, np.uint8)
_BLOCK = 1 << 20  # numbers converted at a time, to bound the temporary memory


def to_srgb8(color: ArrayLike, exposure_ev: float = 0.0) -> Bytes:
    """Return a colour after the display transform: uint8, in the shape of `color` (linear light).

    The colour is multiplied by 2^exposure_ev, clamped to 0..1, encoded with the sRGB curve, and
    rounded to 8 bits. NaN becomes 0. Raises LucidaError if the exposure is not a usable number.
    """
    gain = _gain(exposure_ev)
    linear = np.asarray(color, np.float32)
    result = np.empty(linear.shape, np.uint8)
    flat, out = linear.reshape(-1), result.reshape(-1)
    for start in range(0, flat.size, _BLOCK):
        block = slice(start, start + _BLOCK)
        with np.errstate(over="ignore"):  # overflow becomes white
            exposed = flat[block] * gain
        out[block] = encode_srgb(exposed) * np.float32(255) + np.float32(0.5)
    return result


def encode_srgb(linear: ArrayLike) -> Floats32:
    """Return linear light encoded with the sRGB curve, float32; input and output are clamped to
    0..1, and NaN becomes 0.

    Source: IEC 61966-2-1.
    """
    values = np.asarray(linear, np.float32)
    values = np.clip(np.where(np.isnan(values), np.float32(0), values), 0, 1)
    power = values ** np.float32(1 / SRGB_GAMMA)
    curve = np.float32(SRGB_SCALE) * power - np.float32(SRGB_SHIFT)
    return np.where(values <= np.float32(SRGB_LINEAR), np.float32(SRGB_SLOPE) * values, curve)


def from_srgb(values: ArrayLike) -> Floats32:
    """Return sRGB values, uint8 or floats in 0..1, decoded to linear light, float32.

    Source: IEC 61966-2-1.
    """
    array = np.asarray(values)
    shown = array.astype(np.float32)
    if array.dtype == np.uint8:
        shown /= np.float32(255)
    shown = np.clip(np.where(np.isnan(shown), np.float32(0), shown), 0, 1)
    curve = ((shown + np.float32(SRGB_SHIFT)) / np.float32(SRGB_SCALE)) ** np.float32(SRGB_GAMMA)
    return np.where(shown <= np.float32(SRGB_LINEAR_SHOWN), shown / np.float32(SRGB_SLOPE), curve)


def luminance(color: ArrayLike) -> Floats32:
    """Return the Rec. 709 luminance of linear colours (..., 3): float32 (...)."""
    return np.asarray(color, np.float32) @ LUMINANCE


def picture(frame: Frame, channel: str = "color", exposure_ev: float = 0.0) -> Bytes:
    """Return a channel as colours to look at: uint8 (height, width, 3), sRGB.

    color: the display transform. depth: gray, linear in the ray parameter, the nearest hit white,
    misses black. normal: 0.5 + 0.5 n as red, green, blue; misses black. id, primitive: a repeating
    palette of 14 colours that colour-blind viewers can distinguish; misses black.
    Raises LucidaError if the frame lacks the channel.
    """
    data = frame.channel(channel)
    if channel == "color":
        return to_srgb8(data, exposure_ev)
    if channel == "depth":
        return np.repeat(depth_gray(data)[..., None], 3, axis=2)
    if channel == "normal":
        hit = (data != 0).any(axis=-1, keepdims=True)
        shown = np.clip(np.nan_to_num(data) * np.float32(0.5) + np.float32(0.5), 0, 1)
        return (np.where(hit, shown, 0) * 255 + 0.5).astype(np.uint8)
    colors = ID_PALETTE[np.maximum(data, 0) % len(ID_PALETTE)]
    return np.where((data >= 0)[..., None], colors, np.uint8(0))


def gray_picture(frame: Frame, channel: str = "color", exposure_ev: float = 0.0) -> Bytes:
    """Return a channel in gray: uint8 (height, width), sRGB.

    color: the luminance of the exposed linear light, encoded. depth: as in picture().
    Other channels: the luminance of picture().
    """
    data = frame.channel(channel)
    if channel == "color":
        return to_srgb8(luminance(data), exposure_ev)
    if channel == "depth":
        return depth_gray(data)
    return gray_of(picture(frame, channel))


def gray_of(shown: Bytes) -> Bytes:
    """Return the gray of an sRGB picture (height, width, 3): its encoded linear luminance."""
    linear_of_byte = from_srgb(np.arange(256, dtype=np.uint8))
    return to_srgb8(luminance(linear_of_byte[shown]))


def depth_gray(depth: Floats32) -> Bytes:
    """Return ray parameters (height, width) as gray: the nearest hit 255, the farthest 51, misses
    0.
    """
    hit = np.isfinite(depth)
    if not hit.any():
        return np.zeros(depth.shape, np.uint8)
    nearest, farthest = (float(value) for value in (depth[hit].min(), depth[hit].max()))
    span = farthest - nearest
    behind = (np.where(hit, depth, nearest) - nearest) / span if span > 0 else np.zeros(depth.shape)
    gray = 1 - (1 - FARTHEST_GRAY) * behind
    return np.where(hit, np.rint(gray * 255), 0).astype(np.uint8)


def _gain(exposure_ev: float) -> np.float32:
    if not (math.isfinite(exposure_ev) and abs(exposure_ev) <= EXPOSURE_LIMIT_EV):
        limit = f"{EXPOSURE_LIMIT_EV:g}"
        raise LucidaError(
            "exposure", f"{exposure_ev:g} is not usable", f"give -{limit} to {limit} EV"
        )
    return np.float32(2.0**exposure_ev)
