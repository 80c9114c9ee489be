"""Where an image stands in its window, at which magnification, and what of it is to be seen.

Owns the mapping between the pixels of an image and those of the screen, and the arithmetic of
zooming and panning into it. Knows nothing of cameras, widgets or OpenGL. All lengths are
framebuffer pixels, with the origin in the upper left corner of the window's content.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from app.bounds import range_of
from app.options import ImageOptions

Size = tuple[int, int]  # (width, height)

LEAST, MOST = range_of(ImageOptions, "magnification")
# Where the wheel stops: whole numbers, so that all pixels are squares of one size.
STEPS = (
    *(1 / 64, 1 / 48, 1 / 32, 1 / 24, 1 / 16, 1 / 12, 1 / 8, 1 / 6, 1 / 4, 1 / 3, 1 / 2),
    *(1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0, 128.0),
)
NEARLY = 0.85  # as large: of the width, and of the height
WHOLE_FROM = 4.0  # a fitted image gives up a fifth of its size at most for pixels of one size


@dataclass(frozen=True)
class Placement:
    """An image of `size` pixels, drawn `extent` large at `origin` in a window of `pane`.

    origin may be negative, extent larger than pane. magnification: screen pixels a side of an
    image's pixel. whole: whether each pixel is a square of whole screen pixels.
    """

    size: Size
    pane: Size
    magnification: float
    origin: tuple[int, int]
    extent: Size

    @property
    def unit(self) -> tuple[float, float]:
        """Width and height of one pixel of the image."""
        return self.extent[0] / self.size[0], self.extent[1] / self.size[1]

    @property
    def whole(self) -> bool:
        return all(e % s == 0 for e, s in zip(self.extent, self.size, strict=True))

    @property
    def visible(self) -> tuple[int, int, int, int]:
        """Left, top, right, bottom of what is seen of the image."""
        (x, y), (width, height) = self.origin, self.extent
        left, top = max(x, 0), max(y, 0)
        right, bottom = min(x + width, self.pane[0]), min(y + height, self.pane[1])
        return left, top, max(right, left + 1), max(bottom, top + 1)

    @property
    def sees_all(self) -> bool:
        """Whether nothing of the image is outside the window."""
        return all(e <= p for e, p in zip(self.extent, self.pane, strict=True))

    @property
    def visible_parts(self) -> tuple[float, float, float, float]:
        """What is seen, in parts of the image's width and height: left, top, right, bottom."""
        left, top, right, bottom = self.visible
        (x, y), (width, height) = self.origin, self.extent
        return (left - x) / width, (top - y) / height, (right - x) / width, (bottom - y) / height

    @property
    def visible_pixels(self) -> tuple[int, int, int, int]:
        """First row, first column, and one past the last of each, of the pixels that are seen."""
        left, top, right, bottom = self.visible_parts
        width, height = self.size
        return (
            math.floor(top * height + 1e-6),
            math.floor(left * width + 1e-6),
            min(math.ceil(bottom * height - 1e-6), height),
            min(math.ceil(right * width - 1e-6), width),
        )

    def image_position(self, x: float, y: float) -> tuple[float, float]:
        """A place of the window as (row, column) of the image, where a pixel's centre has whole
        numbers; may lie outside."""
        return (
            (y - self.origin[1]) / self.unit[1] - 0.5,
            (x - self.origin[0]) / self.unit[0] - 0.5,
        )

    def pixel_at(self, x: float, y: float) -> tuple[int, int]:
        """The (row, column) that covers a place of the window; outside, the nearest."""
        row, column = self.image_position(x, y)
        width, height = self.size
        return (
            min(max(math.floor(row + 0.5), 0), height - 1),
            min(max(math.floor(column + 0.5), 0), width - 1),
        )

    def corner_of(self, row: float, column: float) -> tuple[float, float]:
        """The place of a pixel's upper left corner."""
        return (
            self.origin[0] + column * self.unit[0],
            self.origin[1] + row * self.unit[1],
        )

    def center_with(
        self, part: tuple[float, float], x: float, y: float, magnification: float
    ) -> tuple[float, float]:
        """What the middle of the window must show, so that at another magnification the part
        `part` of the image (of its width, height) stands at (x, y)."""
        return tuple(  # type: ignore[return-value]
            part[k] + (self.pane[k] / 2 - (x, y)[k]) / (self.size[k] * magnification)
            for k in (0, 1)
        )

    def part_at(self, x: float, y: float) -> tuple[float, float]:
        """A place of the window in parts of the image's width and height."""
        return (x - self.origin[0]) / self.extent[0], (y - self.origin[1]) / self.extent[1]


def fit_magnification(size: Size, pane: Size) -> float:
    """The largest at which all of the image is seen; a whole number from WHOLE_FROM on."""
    fit = min(p / s for p, s in zip(pane, size, strict=True))
    return float(math.floor(fit)) if fit >= WHOLE_FROM else max(fit, LEAST)


def magnification_of(options: ImageOptions, size: Size, pane: Size) -> float:
    """What the options come to for an image in a window."""
    if options.magnification is not None:
        return options.magnification
    if options.resolution is None and all(
        s * options.pixel_size <= p for s, p in zip(size, pane, strict=True)
    ):
        return float(options.pixel_size)
    return fit_magnification(size, pane)


def common_pane(panes: Sequence[Size]) -> Size:
    """What the images' own size follows: the largest of their windows. Those that are nearly as
    large count too, so that all of these show their pixels one to one; in smaller ones the images
    are reduced."""
    width, height = max(panes, key=lambda pane: pane[0] * pane[1])
    near = [p for p in panes if p[0] >= NEARLY * width and p[1] >= NEARLY * height]
    return min(p[0] for p in near), min(p[1] for p in near)


def place(options: ImageOptions, size: Size, pane: Size) -> Placement:
    """Where an image of `size` stands in a window of `pane`. What does not fill the window stands
    in its middle; what is larger leaves nothing of it empty."""
    magnification = magnification_of(options, size, pane)
    origin, extent = [0, 0], [1, 1]
    for k in (0, 1):
        extent[k] = max(1, round(size[k] * magnification))
        if extent[k] <= pane[k]:
            origin[k] = (pane[k] - extent[k]) // 2
        else:
            wanted = round(pane[k] / 2 - options.center[k] * extent[k])
            origin[k] = min(max(wanted, pane[k] - extent[k]), 0)
    return Placement(size, pane, magnification, (origin[0], origin[1]), (extent[0], extent[1]))


def stepped(magnification: float, steps: float, fit: float) -> float | None:
    """The magnification some steps on (back: negative) in STEPS; None for back at the fit, below
    which nothing more is to be seen."""
    if steps < 0 and magnification < fit * 0.999:
        return magnification
    for _ in range(max(1, round(abs(steps)))):
        if steps > 0:
            magnification = _first(STEPS, magnification * 1.001, MOST)
        else:
            magnification = -_first([-s for s in reversed(STEPS)], -magnification * 0.999, -LEAST)
            if magnification <= fit * 1.001:
                return None
    return magnification


def step_from(placement: Placement, options: ImageOptions, steps: float) -> float | None:
    """stepped() from where an image is."""
    fitted = replace(options, magnification=None)
    fit = magnification_of(fitted, placement.size, placement.pane)
    return stepped(placement.magnification, steps, fit)


def _first(steps: Sequence[float], above: float, otherwise: float) -> float:
    return next((step for step in steps if step > above), otherwise)


def zoomed_at(
    placement: Placement,
    part: tuple[float, float],
    x: float,
    y: float,
    magnification: float | None,
) -> dict[str, object]:
    """The changes of the options that magnify, with the part `part` of the image at (x, y), as
    nearly as leaves nothing of the window empty. None: fit."""
    if magnification is None:
        return {"magnification": None, "center": (0.5, 0.5)}
    center = placement.center_with(part, x, y, magnification)
    return {"magnification": magnification, "center": clamped(center, placement, magnification)}


def panned(
    placement: Placement, part: tuple[float, float], x: float, y: float
) -> dict[str, object]:
    """The changes of the options that bring the part `part` of the image to (x, y)."""
    center = placement.center_with(part, x, y, placement.magnification)
    return {
        "magnification": placement.magnification,
        "center": clamped(center, placement, placement.magnification),
    }


def shown_pixel(placement: Placement, pixel: tuple[int, int]) -> dict[str, object]:
    """The changes of the options that bring a (row, column) into sight; none where it is."""
    top, left, bottom, right = placement.visible_pixels
    if top <= pixel[0] < bottom and left <= pixel[1] < right:
        return {}
    part = (pixel[1] + 0.5) / placement.size[0], (pixel[0] + 0.5) / placement.size[1]
    center = placement.part_at(placement.pane[0] / 2, placement.pane[1] / 2)
    kept = tuple(  # along an axis on which it is in sight, nothing moves
        center[k] if low <= pixel[1 - k] < high else part[k]
        for k, (low, high) in enumerate(((left, right), (top, bottom)))
    )
    return {"center": clamped((kept[0], kept[1]), placement, placement.magnification)}


def clamped(
    center: tuple[float, float], placement: Placement, magnification: float
) -> tuple[float, float]:
    """The nearest middle that leaves nothing of the window empty."""
    result = []
    for k in (0, 1):
        half = placement.pane[k] / (2 * placement.size[k] * magnification)
        result.append(0.5 if half >= 0.5 else min(max(center[k], half), 1 - half))
    return result[0], result[1]


def magnification_text(magnification: float) -> str:
    """`1:1`, `8x`, `1.37x`, `1/4`."""
    if magnification == 1:
        return "1:1"
    if round(1 / magnification) != 1 / magnification:
        return f"{magnification:.3g}x"
    return f"1/{round(1 / magnification)}"
