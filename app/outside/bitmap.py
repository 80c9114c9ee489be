"""A vector drawing as pixels: what a raster image of it keeps.

It is drawn SAMPLES times as fine in each direction, and each pixel takes the mean (a box filter).
Pure.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from app.outside.diagram import runs
from app.outside.vector import Arc, Color, Drawing, Letters, dashes

SAMPLES = 4


def bitmap(drawing: Drawing, size: tuple[int, int]) -> NDArray[np.uint8]:
    """Return the drawing at (width, height) pixels: (height, width, 3), as displayed. The drawing
    should have the same aspect ratio.
    """
    from PIL import Image, ImageDraw, ImageFont  # here: the window opens without

    scale = SAMPLES * size[0] / drawing.size[0]
    ground = _ink(drawing.background)
    picture = Image.new("RGB", (SAMPLES * size[0], SAMPLES * size[1]), ground[:3])
    draw = ImageDraw.Draw(picture, "RGBA")
    for part in drawing.parts:
        form, ink = part.form, _ink(part.color, part.opacity)
        if isinstance(form, Letters):
            em = form.size * scale
            bold = 0.04 * em if form.strong else 0.0
            x, y = form.center
            text = "".join(piece for piece, _ in runs(form.text, form.strong))
            for width, color in ((0.09 * em + bold, ground), (bold, ink)):
                draw.text((scale * x, scale * y), text, fill=color, anchor="mm",
                          font=ImageFont.load_default(size=em),
                          stroke_width=round(width), stroke_fill=color)  # fmt: skip
            continue
        if isinstance(form, Arc) and not part.width:
            x, y = (scale * value - 0.5 for value in form.ellipse.center)
            r = max(scale * form.ellipse.radii[0] - 0.5, 0.0)
            draw.ellipse((x - r, y - r, x + r, y + r), fill=ink)
            continue
        if isinstance(form, Arc):
            steps = max(2, math.ceil(64 * (form.end - form.start)))
            form = form.ellipse.at(np.linspace(form.start, form.end, steps))
        for points in dashes(form, drawing.unit) if part.dashed else [form]:
            # Pillow counts from the middle of the first pixel.
            spots = [(x, y) for x, y in (points * scale - 0.5).tolist()]
            if part.width:
                draw.line(spots, fill=ink, width=max(1, round(part.width * scale)), joint="curve")
            else:
                draw.polygon(spots, fill=ink)
    return np.asarray(picture.resize(size, Image.Resampling.BOX), np.uint8).copy()


def magnified(
    picture: NDArray[np.uint8],
    size: tuple[int, int],
    corner: tuple[float, float],
    extent: tuple[float, float],
) -> NDArray[np.uint8]:
    """Return a part of a picture at (width, height) pixels of a screen, by nearest neighbour.

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


def _ink(color: Color, opacity: float = 1.0) -> tuple[int, int, int, int]:
    red, green, blue, alpha = (round(255 * min(max(v, 0.0), 1.0)) for v in (*color, opacity))
    return red, green, blue, alpha
