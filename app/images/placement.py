"""The place of an image in its window: its position, its magnification and its visible part.

Maps between the pixels of an image and those of the screen, and computes zooming, panning and the
margin for rulers that number magnified pixels. This module knows no camera, widget or OpenGL. All
lengths are framebuffer pixels, with the origin in the upper left corner of the window's content.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from lucida.app.state.bounds import range_of
from lucida.app.state.options.shared import ImageOptions
from lucida.renderer.camera.image_plane import Size

LEAST, MOST = range_of(ImageOptions, "magnification")
# Where the wheel stops: whole numbers, so that all pixels are squares of one size.
STEPS = (
    *(LEAST, 1 / 48, 1 / 32, 1 / 24, 1 / 16, 1 / 12, 1 / 8, 1 / 6, 1 / 4, 1 / 3, 1 / 2),
    *(1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0, MOST),
)
NEARLY = 0.85  # part of the width, and of the height, that counts as equal
WHOLE_FROM = 4.0  # a fitted image loses at most a fifth of its size to equal pixels
RULED_FROM = 8.0  # from this magnification on there are lines between pixels, and rulers
LEAST_RULED = 4  # a window must be this many rulers wide and high to have any


@dataclass(frozen=True)
class Placement:
    """An image of `size` pixels, drawn `extent` large at `origin` in a window of `pane`.

    origin may be negative, extent larger than pane. magnification: screen pixels a side of an
    image's pixel. rulers: (width, height) of the ruler at the image's left and of the one above it,
    if the magnification has them; (0, 0) for no rulers. whole: each pixel is a square of whole
    screen pixels.
    """

    size: Size
    pane: Size
    magnification: float
    origin: tuple[int, int]
    extent: Size
    rulers: Size = (0, 0)

    @cached_property
    def margin(self) -> Size:
        """The width of the rulers on the left and above."""
        return margin_at(self.magnification, self.rulers)

    @property
    def unit(self) -> tuple[float, float]:
        """Width and height of one pixel of the image."""
        return self.extent[0] / self.size[0], self.extent[1] / self.size[1]

    @property
    def whole(self) -> bool:
        return all(e % s == 0 for e, s in zip(self.extent, self.size, strict=True))

    @cached_property
    def visible(self) -> tuple[int, int, int, int]:
        """Left, top, right, bottom of the visible part of the image."""
        (x, y), (width, height) = self.origin, self.extent
        left, top = max(x, self.margin[0]), max(y, self.margin[1])
        right, bottom = min(x + width, self.pane[0]), min(y + height, self.pane[1])
        return left, top, max(right, left + 1), max(bottom, top + 1)

    @property
    def visible_parts(self) -> tuple[float, float, float, float]:
        """The visible part, as fractions of the image's width and height: left, top, right,
        bottom.
        """
        left, top, right, bottom = self.visible
        (x, y), (width, height) = self.origin, self.extent
        return (left - x) / width, (top - y) / height, (right - x) / width, (bottom - y) / height

    @property
    def visible_pixels(self) -> tuple[int, int, int, int]:
        """First row, first column, and one past the last of each, of the visible pixels."""
        left, top, right, bottom = self.visible_parts
        width, height = self.size
        return (
            math.floor(top * height + 1e-6),
            math.floor(left * width + 1e-6),
            min(math.ceil(bottom * height - 1e-6), height),
            min(math.ceil(right * width - 1e-6), width),
        )

    def image_position(self, x: float, y: float) -> tuple[float, float]:
        """Return a place of the window as (row, column) of the image, with integers at the pixels'
        centres; it may be outside.
        """
        return (
            (y - self.origin[1]) / self.unit[1] - 0.5,
            (x - self.origin[0]) / self.unit[0] - 0.5,
        )

    def pixel_at(self, x: float, y: float) -> tuple[int, int]:
        """Return the (row, column) that covers a place of the window; outside, the nearest one."""
        row, column = self.image_position(x, y)
        width, height = self.size
        return (
            min(max(math.floor(row + 0.5), 0), height - 1),
            min(max(math.floor(column + 0.5), 0), width - 1),
        )

    def corner_of(self, row: float, column: float) -> tuple[float, float]:
        """Return the place of a pixel's upper left corner."""
        return (
            self.origin[0] + column * self.unit[0],
            self.origin[1] + row * self.unit[1],
        )

    def center_with(
        self, part: tuple[float, float], x: float, y: float, magnification: float
    ) -> tuple[float, float]:
        """Return the centre for another magnification that keeps `part` of the image at (x, y).

        part, centre: fractions of the image's width and height.
        """
        middle = self.middle_at(magnification)
        return tuple(  # type: ignore[return-value]
            part[k] + (middle[k] - (x, y)[k]) / (self.size[k] * magnification) for k in (0, 1)
        )

    def middle_at(self, magnification: float) -> tuple[float, float]:
        """Return the middle of the space for the image, the window without the rulers."""
        margin = margin_at(magnification, self.rulers)
        return (self.pane[0] + margin[0]) / 2, (self.pane[1] + margin[1]) / 2

    def part_at(self, x: float, y: float) -> tuple[float, float]:
        """Return a place of the window as fractions of the image's width and height."""
        return (x - self.origin[0]) / self.extent[0], (y - self.origin[1]) / self.extent[1]


def fit_magnification(size: Size, pane: Size) -> float:
    """Return the largest magnification at which all of the image is visible; an integer from
    WHOLE_FROM on.
    """
    fit = min(p / s for p, s in zip(pane, size, strict=True))
    return float(math.floor(fit)) if fit >= WHOLE_FROM else max(fit, LEAST)


def margin_at(magnification: float, rulers: Size) -> Size:
    """Return the margin for rulers of a (width, height), on the left and above."""
    return rulers if magnification >= RULED_FROM else (0, 0)


def beside(pane: Size, margin: Size) -> Size:
    """Return the (width, height) of a window without its margin."""
    return pane[0] - margin[0], pane[1] - margin[1]


def rulers_in(pane: Size, rulers: Size) -> Size:
    """Return the rulers of a window: none if it is too small for them."""
    has_room = all(p >= LEAST_RULED * r for p, r in zip(pane, rulers, strict=True))
    return rulers if has_room else (0, 0)


def magnification_of(options: ImageOptions, size: Size, pane: Size, rulers: Size) -> float:
    """Return an image's magnification in a window under the options.

    An image that would have rulers in the whole window is fitted next to them. It has none if it is
    then too small.
    """
    if options.magnification is not None:
        return options.magnification
    magnification = _unruled(options, size, pane)
    if magnification >= RULED_FROM:
        return _unruled(options, size, beside(pane, rulers))
    return magnification


def _unruled(options: ImageOptions, size: Size, pane: Size) -> float:
    is_own = options.resolution is None and size[0] <= pane[0] and size[1] <= pane[1]
    return 1.0 if is_own else fit_magnification(size, pane)


def common_pane(panes: Sequence[Size]) -> Size:
    """Return the pane that the images' own size follows: the largest of their windows.

    Windows that are nearly as large count, too, so that they all show pixels one to one. Smaller
    windows reduce the images.
    """
    width, height = max(panes, key=lambda pane: pane[0] * pane[1])
    near = [p for p in panes if p[0] >= NEARLY * width and p[1] >= NEARLY * height]
    return min(p[0] for p in near), min(p[1] for p in near)


def place(options: ImageOptions, size: Size, pane: Size, rulers: Size = (0, 0)) -> Placement:
    """Place an image of `size` in a window of `pane`, next to rulers of a (width, height) if shown.

    An image smaller than the space for it is centred; a larger one fills it.
    """
    rulers = rulers_in(pane, rulers) if options.grid else (0, 0)
    magnification = magnification_of(options, size, pane, rulers)
    margin = margin_at(magnification, rulers)
    origin, extent = [0, 0], [1, 1]
    for k in (0, 1):
        room = pane[k] - margin[k]
        extent[k] = max(1, round(size[k] * magnification))
        if extent[k] <= room:
            origin[k] = margin[k] + (room - extent[k]) // 2
        else:
            wanted = round(room / 2 - options.center[k] * extent[k])
            origin[k] = margin[k] + min(max(wanted, room - extent[k]), 0)
    return Placement(
        size, pane, magnification, (origin[0], origin[1]), (extent[0], extent[1]), rulers
    )


def stepped(magnification: float, steps: float, fit: float) -> float | None:
    """Return the magnification some steps further in STEPS; negative steps go back.

    Return None for a step back to the fit, because smaller ones show no more.
    """
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
    """Return stepped() from an image's present magnification."""
    fitted = replace(options, magnification=None)
    fit = magnification_of(fitted, placement.size, placement.pane, placement.rulers)
    return stepped(placement.magnification, steps, fit)


def _first(steps: Sequence[float], above: float, otherwise: float) -> float:
    return next((step for step in steps if step > above), otherwise)


def zoomed_at(
    images: ImageOptions,
    placement: Placement,
    part: tuple[float, float],
    x: float,
    y: float,
    magnification: float | None,
) -> ImageOptions:
    """Return the options magnified, with `part` of the image at (x, y), or as close to it as
    possible without leaving a part of the window empty. magnification: None for fit.
    """
    if magnification is None:
        return replace(images, magnification=None, center=(0.5, 0.5))
    center = clamped(placement.center_with(part, x, y, magnification), placement, magnification)
    return replace(images, magnification=magnification, center=center)


def panned(
    images: ImageOptions, placement: Placement, part: tuple[float, float], x: float, y: float
) -> ImageOptions:
    """Return the options that bring `part` of the image to (x, y)."""
    return zoomed_at(images, placement, part, x, y, placement.magnification)


def shown_pixel(images: ImageOptions, placement: Placement, pixel: tuple[int, int]) -> ImageOptions:
    """Return the options that bring a (row, column) into view; the same if it is visible."""
    top, left, bottom, right = placement.visible_pixels
    if top <= pixel[0] < bottom and left <= pixel[1] < right:
        return images
    part = (pixel[1] + 0.5) / placement.size[0], (pixel[0] + 0.5) / placement.size[1]
    center = placement.part_at(*placement.middle_at(placement.magnification))
    kept = tuple(  # nothing moves along an axis on which the pixel is visible
        center[k] if low <= pixel[1 - k] < high else part[k]
        for k, (low, high) in enumerate(((left, right), (top, bottom)))
    )
    center = clamped((kept[0], kept[1]), placement, placement.magnification)
    return replace(images, center=center)


def clamped(
    center: tuple[float, float], placement: Placement, magnification: float
) -> tuple[float, float]:
    """Return the nearest centre that leaves no part of the image's space empty."""
    room = beside(placement.pane, margin_at(magnification, placement.rulers))
    result = []
    for k in (0, 1):
        half = room[k] / (2 * placement.size[k] * magnification)
        result.append(0.5 if half >= 0.5 else min(max(center[k], half), 1 - half))
    return result[0], result[1]


def magnification_text(magnification: float) -> str:
    """Return `1:1`, `8x`, `1.37x`, `1/4`."""
    if magnification == 1:
        return "1:1"
    if round(1 / magnification) != 1 / magnification:
        return f"{magnification:.3g}x"
    return f"1/{round(1 / magnification)}"
