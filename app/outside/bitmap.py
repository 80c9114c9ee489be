"""A vector drawing as pixels: what a raster image of it keeps.

Owns the sampling: drawn SAMPLES times as fine in each direction, each pixel takes the mean (a box
filter). Pure; knows nothing of what is drawn.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from app.outside.svg import DASHES
from app.outside.vector import Arc, Area, Color, Drawing, Letters, Spot, VectorLine

if TYPE_CHECKING:
    from PIL import ImageDraw

SAMPLES = 4

Spots = list[tuple[float, float]]


def bitmap(drawing: Drawing, size: tuple[int, int]) -> NDArray[np.uint8]:
    """The drawing at (width, height) pixels: (height, width, 3), as shown. The drawing's own width
    over its height should be the same."""
    from PIL import Image, ImageDraw  # here: the window opens without

    scale = SAMPLES * size[0] / drawing.size[0]
    picture = Image.new("RGB", (SAMPLES * size[0], SAMPLES * size[1]), _ink(drawing.background)[:3])
    draw = ImageDraw.Draw(picture, "RGBA")
    for part in drawing.parts:
        if isinstance(part, VectorLine):
            lines = [part.points]
            if part.dashed:
                lines = dashes(part.points, [dash * drawing.unit for dash in DASHES])
            for points in lines:
                _line(draw, points, scale, part.width, _ink(part.color, part.opacity))
        elif isinstance(part, Arc):
            steps = max(2, math.ceil(64 * (part.end - part.start)))
            points = part.ellipse.at(np.linspace(part.start, part.end, steps))
            _line(draw, points, scale, part.width, _ink(part.color))
        elif isinstance(part, Area):
            draw.polygon(_spots(part.points, scale), fill=_ink(part.color, part.opacity))
        elif isinstance(part, Spot):
            x, y = (scale * value - 0.5 for value in part.center)
            r = max(scale * part.radius - 0.5, 0.0)
            draw.ellipse((x - r, y - r, x + r, y + r), fill=_ink(part.color, part.opacity))
        else:
            _letters(draw, part, scale, _ink(drawing.background))
    small = picture.resize(size, Image.Resampling.BOX)
    return np.asarray(small, np.uint8).copy()


def magnified(
    picture: NDArray[np.uint8],
    size: tuple[int, int],
    corner: tuple[float, float],
    extent: tuple[float, float],
) -> NDArray[np.uint8]:
    """A part of a picture at (width, height) pixels of a screen, each the nearest of its own.

    corner, extent: of the part, in parts of the picture's width and height.
    """
    rows, columns = (
        np.clip(
            ((corner[axis] + (np.arange(size[axis]) + 0.5) / size[axis] * extent[axis])
             * picture.shape[1 - axis]).astype(int),
            0,
            picture.shape[1 - axis] - 1,
        )
        for axis in (1, 0)
    )  # fmt: skip
    return picture[rows[:, None], columns]


def dashes(points: NDArray[np.float64], pattern: list[float]) -> list[NDArray[np.float64]]:
    """The drawn parts of a dashed line (n, 2). pattern: lengths, drawn and not drawn in turn."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    run = np.concatenate([[0.0], np.cumsum(steps)])
    period, drawn = sum(pattern), pattern[0]
    out = []
    for number in range(math.ceil(run[-1] / period)):
        start, end = number * period, min(number * period + drawn, float(run[-1]))
        inner = points[(run > start) & (run < end)]
        ends = [[np.interp(at, run, points[:, axis]) for axis in range(2)] for at in (start, end)]
        out.append(np.array([ends[0], *inner.tolist(), ends[1]]))
    return out


def _line(
    draw: ImageDraw.ImageDraw,
    points: NDArray[np.float64],
    scale: float,
    width: float,
    ink: tuple[int, int, int, int],
) -> None:
    draw.line(_spots(points, scale), fill=ink, width=max(1, round(width * scale)), joint="curve")


def _letters(
    draw: ImageDraw.ImageDraw, part: Letters, scale: float, rim: tuple[int, int, int, int]
) -> None:
    from PIL import ImageFont

    font = ImageFont.load_default(size=part.size * scale)
    bold = 0.04 * part.size * scale if part.strong else 0.0
    x, y = scale * part.center[0], scale * part.center[1]
    for width, ink in ((0.09 * part.size * scale + bold, rim), (bold, _ink(part.color))):
        draw.text((x, y), part.text, fill=ink, font=font, anchor="mm",
                  stroke_width=round(width), stroke_fill=ink)  # fmt: skip


def _spots(points: NDArray[np.float64], scale: float) -> Spots:
    # Pillow counts from the middle of the first pixel.
    return [(x, y) for x, y in (points * scale - 0.5).tolist()]


def _ink(color: Color, opacity: float = 1.0) -> tuple[int, int, int, int]:
    red, green, blue, alpha = (round(255 * min(max(v, 0.0), 1.0)) for v in (*color, opacity))
    return red, green, blue, alpha
