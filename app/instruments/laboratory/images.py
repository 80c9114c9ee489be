"""The scene's image on the laboratory's sheets: read at a point, in pixels, stored and exposed."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from lucida.app.instruments.outside.figure import Figure
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.display import Bytes, encode_srgb, to_srgb8

from .kinds import COLOR, FLOAT, KINDS, Kind
from .page import Page, is_wide
from .sheet import BLACK, LIGHTS, YELLOW, Point, Sheet, circle, reached, rectangle
from .stored import kept

# The shape of images: width and height. Two side by side are square.
SHAPE, SQUARE = (3, 2), (1, 1)
MOST_PX = 1 << 20  # per image; in a larger rectangle its pixels are squares
NUMBERED = 12  # frames of at most this many pixels a side have numbers on them
# Wavelengths in nm: the ends of the spectrum; the middle and the width of red, green and blue.
FIRST_NM, LAST_NM = 400.0, 700.0
PEAKS = ((610.0, 42.0), (540.0, 38.0), (458.0, 30.0))

Box = tuple[Point, Point]  # corner and extent


def boxes(page: str, size: Size, shape: Size) -> tuple[Point, tuple[Box, ...]]:
    """Return the extent of a page's sheet, and the place of each image of a shape on it."""
    wide = is_wide(size)
    if page == "function":
        extent, room = ((34.0, 25.0), (34.0, 16.5)) if size[0] > 1.4 * size[1] else (
            (26.0, 25.6), (26.0, 17.4))  # fmt: skip
        rooms: tuple[Box, ...] = (((0.0, 0.0), room),)
    elif page == "exposure":
        extent = (36.0, 24.0) if wide else (24.0, 38.6)
        step = (18.2, 0.0) if wide else (0.0, 19.6)
        room = (17.8, 20.4) if wide else (24.0, 14.8)
        rooms = ((0.0, 0.0), room), (step, room)
    else:
        extent = (32.0, 25.0) if wide else (24.0, 28.0)
        margin = 2.0 if page == "raster" else 0.0
        room = extent[0] - 2 * margin, extent[1] - 4.2 - margin
        rooms = (((margin, margin), room),)
    return extent, tuple(_inside(corner, room, shape) for corner, room in rooms)


def _inside(corner: Point, room: Point, shape: Size) -> Box:
    """Return the largest rectangle of a shape in the middle of an area."""
    unit = min(room[0] / shape[0], room[1] / shape[1])
    extent = unit * shape[0], unit * shape[1]
    return (corner[0] + (room[0] - extent[0]) / 2, corner[1] + (room[1] - extent[1]) / 2), extent


def image_size(page: str, size: Size, resolution: Size | None) -> Size:
    """Return the size of the image that a page of `size` pixels shows. resolution: a fixed size."""
    if resolution is not None and page == "raster":
        return resolution
    shape = SQUARE if page == "exposure" and is_wide(size) else SHAPE
    extent, ((_, (width, _)), *_) = boxes(page, size, shape)
    wide = int(min(size[0] / extent[0], size[1] / extent[1]) * width)
    wide = max(3, min(wide, math.isqrt(MOST_PX * shape[0] // shape[1])))
    return wide, max(2, wide * shape[1] // shape[0])


def function(page: Page) -> Figure:
    """Draw an image, and the light at a place of it: a spectrum, and with build 1 three numbers."""
    extent, ((corner, (width, height)),) = boxes("function", page.size, _shape(page))
    sheet, look = page.sheet(extent), page.look
    rows, columns = page.color.shape[:2]
    row, column = int(page.place[1] * rows), int(page.place[0] * columns)
    light = page.color[min(row, rows - 1), min(column, columns - 1)]
    exposed = np.clip(light * np.float32(2.0**page.taken_ev), 0, 1)
    sheet.picture(to_srgb8(page.color, page.taken_ev), corner, (width, height))
    at = corner[0] + page.place[0] * width, corner[1] + page.place[1] * height
    for ink, wide in ((BLACK, 0.34), (YELLOW, 0.16)):
        sheet.outline(circle(at, 0.6), ink, wide)
    top, left = corner[1] + height + 1.2, corner[0] + 0.2
    three = reached(page.progress, 1)
    room = (0.6 * width, extent[1] - top - 2.4)
    _spectrum(sheet, exposed, (left, top), room)
    sheet.word("schematic", (left + room[0] / 2, top + room[1] + 1.5), 1.2, look.dim)
    for name, x, align in ((f"{FIRST_NM:.0f} nm", left, 0.0),
                           (f"{LAST_NM:.0f} nm", left + room[0], 1.0)):  # fmt: skip
        sheet.word(name, (x, top + room[1] + 1.5), 1.2, look.dim, align=align)
    x = left + room[0] + 1.6
    bar = corner[0] + width - x - 4.4
    for channel, (name, value) in enumerate(zip("rgb", exposed.tolist(), strict=True)):
        y = top + (channel + 0.5) * room[1] / 3
        sheet.word(name, (x, y), 1.3, opacity=three, strong=True)
        sheet.fill(rectangle((x + 1.2, y - 0.6), (bar * value, 1.2)), LIGHTS[channel], three)
        sheet.word(f"{value:.2f}", (corner[0] + width, y), 1.2, opacity=three, align=1.0)
    return sheet.figure()


def _spectrum(sheet: Sheet, light: NDArray[np.float32], at: Point, room: Point) -> None:
    """Draw a smooth spectrum that looks like a colour: one of the many that do."""
    (left, top), count = at, 60
    floor = top + room[1]
    nm = np.linspace(FIRST_NM, LAST_NM, count + 1)
    heights = room[1] * np.minimum(spectrum(light, nm), 1.0)
    xs = left + room[0] * (nm - FIRST_NM) / (LAST_NM - FIRST_NM)
    colors = encode_srgb(cone_light(nm))
    for k in range(count):
        red, green, blue = colors[k].tolist()
        points = [(xs[k], floor), (xs[k], floor - heights[k]),
                  (xs[k + 1], floor - heights[k + 1]), (xs[k + 1], floor)]  # fmt: skip
        sheet.fill(points, (red, green, blue))
    sheet.line(np.stack([xs, floor - heights], axis=1), width=0.14)
    sheet.line([(left, floor), (left + room[0], floor)], sheet.look.dim)


def cone_light(nm: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the approximate colours of wavelengths: linear red, green and blue (n, 3)."""
    bumps = [np.exp(-(((nm - middle) / width) ** 2)) for middle, width in PEAKS]
    return np.stack(bumps, axis=1) + 0.02


def spectrum(light: NDArray[np.float32], nm: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the energy at wavelengths of a made-up spectrum for a colour."""
    found: NDArray[np.float64] = (cone_light(nm) - 0.02) @ np.asarray(light, float)
    return found


def raster(page: Page) -> Figure:
    """Draw the pixels of an image as squares, with their count; numbered if they are few."""
    rows, columns = page.color.shape[:2]
    extent, ((corner, (width, height)),) = boxes("raster", page.size, (columns, rows))
    sheet, look = page.sheet(extent), page.look
    sheet.picture(to_srgb8(page.color, page.taken_ev), corner, (width, height))
    unit = width / columns
    if max(rows, columns) <= NUMBERED:
        for number in range(rows + 1):
            y = corner[1] + unit * number
            sheet.line([(corner[0], y), (corner[0] + width, y)], look.dim, 0.05)
        for number in range(columns + 1):
            x = corner[0] + unit * number
            sheet.line([(x, corner[1]), (x, corner[1] + height)], look.dim, 0.05)
    for number in _numbered(columns):
        sheet.word(str(number + 1), (corner[0] + unit * (number + 0.5), corner[1] - 0.9), 1.25)
    for number in _numbered(rows):
        at = corner[0] - 0.4, corner[1] + unit * (number + 0.5)
        sheet.word(str(number + 1), at, 1.25, align=1.0)
    middle = extent[0] / 2
    sheet.word(f"{columns} x {rows} pixels", (middle, extent[1] - 2.9), 1.4, strong=True)
    text = f"3 numbers each: {3 * rows * columns:,} numbers"
    sheet.word(text, (middle, extent[1] - 1.0), 1.25)
    return sheet.figure()


def _numbered(count: int) -> range:
    """Return the rows or columns whose numbers are on a frame: all, or the first and the last."""
    return range(count) if count <= NUMBERED else range(0, count, count - 1)


def kinds(page: Page) -> Figure:
    """Draw the image as each kind stores it, one more with each build."""
    progress = min(page.progress, len(KINDS) - 1)
    first = int(progress)
    picture, part = _kept(page, KINDS[first]), progress - first
    kind = KINDS[round(progress)]
    if part:
        other = _kept(page, KINDS[first + 1])
        picture = np.round((1 - part) * picture + part * other).astype(np.uint8)
    extent, ((corner, room),) = boxes("kinds", page.size, _shape(page))
    sheet = page.sheet(extent)
    sheet.picture(picture, corner, room)
    _caption(sheet, kind, corner, room)
    return sheet.figure()


def exposure(page: Page) -> Figure:
    """Draw the image, stored as bytes and as floats and exposed afterwards."""
    extent, places = boxes("exposure", page.size, _shape(page))
    sheet = page.sheet(extent)
    for kind, (corner, room) in zip((COLOR, FLOAT), places, strict=True):
        sheet.picture(_kept(page, kind), corner, room)
        _caption(sheet, kind, corner, room)
    return sheet.figure()


def _caption(sheet: Sheet, kind: Kind, corner: Point, room: Point) -> None:
    y = corner[1] + room[1] + 1.4
    middle = corner[0] + room[0] / 2
    sheet.word(kind.title, (middle, y), 1.5, strong=True)
    sheet.word(kind.each, (middle, y + 1.8), 1.5, sheet.look.dim)


def _kept(page: Page, kind: Kind) -> Bytes:
    return kept(page.color, kind, page.taken_ev, page.options.after_ev)


def _shape(page: Page) -> Size:
    return page.color.shape[1], page.color.shape[0]
