"""The numbers in magnified pixels, and the colours behind them.

The display transform of these few hundred pixels runs on the CPU; the window's shader computes the
same.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from lucida.app.state.options.shared import ImageOptions
from lucida.renderer.images.display import LUMINANCE, from_srgb, picture, to_srgb8
from lucida.renderer.images.frame import Frame, stored
from lucida.renderer.images.shared_numbers import FARTHEST_GRAY

Bytes = NDArray[np.uint8]
Depths = tuple[float, float] | None  # those shown white, and darkest

DARK = 0.179  # luminance at which black and white are equally legible. Source: WCAG 2, contrast


def shown_bytes(values: NDArray, options: ImageOptions, depths: Depths) -> Bytes:
    """Return a channel's values (see frame.py) as displayed: uint8 (height, width, 3)."""
    if stored(options.channel) == "depth":
        return np.repeat(_gray(values, depths)[..., None], 3, axis=2)
    if options.channel == "color":
        return color_bytes(values, options)
    frame = Frame(values.shape[1::-1], **{options.channel: values})  # type: ignore[arg-type]
    return picture(frame, options.channel)


def is_dark(shown: Bytes) -> NDArray[np.bool_]:
    """Return a mask (height, width) of pixels on which white is easier to read than black."""
    return from_srgb(shown) @ LUMINANCE < DARK


def value_lines(values: NDArray, options: ImageOptions) -> list[list[str]]:
    """Return the text in each pixel, by rows and columns, with its lines separated by newlines and
    all of one width.
    """
    channel = stored(options.channel)
    if channel == "depth":
        return [[_depth(t) for t in row] for row in values.tolist()]
    if channel == "id":
        return [[str(k) if k >= 0 else "-" for k in row] for row in values.tolist()]
    if channel == "color":
        numbers, form = color_bytes(values, options), "{:3d}"
    else:
        numbers, form = values, "{:+.2f}"
    return [["\n".join(map(form.format, pixel)) for pixel in row] for row in numbers.tolist()]


def line_count(options: ImageOptions) -> int:
    """Return the number of lines that value_lines() writes for a pixel."""
    return 3 if options.channel in ("color", "normal") else 1


def color_bytes(values: NDArray, options: ImageOptions) -> Bytes:
    """Return linear colours as displayed."""
    if options.transfer == "srgb":
        return to_srgb8(values, options.exposure_ev)
    exposed = np.nan_to_num(np.asarray(values, np.float32)) * np.float32(2.0**options.exposure_ev)
    return (np.clip(exposed, 0, 1) * 255 + 0.5).astype(np.uint8)


def _depth(t: float) -> str:
    if not math.isfinite(t):
        return "-"
    for limit, digits in ((9.995, 2), (99.95, 1), (999.5, 0)):
        if t < limit:
            return f"{t:.{digits}f}"
    return f"{t:.0e}"


def _gray(depth: NDArray, depths: Depths) -> Bytes:
    hit = np.isfinite(depth)
    near, far = depths or (0.0, 0.0)
    if far > near:
        behind = np.clip((np.where(hit, depth, near) - near) / (far - near), 0, 1)
    else:
        behind = np.zeros(depth.shape)
    return np.where(hit, np.rint((1 - (1 - FARTHEST_GRAY) * behind) * 255), 0).astype(np.uint8)
