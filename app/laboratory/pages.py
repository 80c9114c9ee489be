"""The laboratory's pages: what each shows of an image, as pictures of the very size of the screen.

Pure: arrays in, pictures and words out; meant for a thread. Knows nothing of windows and texts'
sizes. Screen sizes are (width, height) in framebuffer pixels.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.laboratory import displays, light
from app.laboratory.bitmaps import TITLES
from app.laboratory.heights import height_field
from app.laboratory.kinds import BITMAP, COLOR, FLOAT, GRAY, KINDS
from app.laboratory.options import LaboratoryOptions
from app.laboratory.stored import clipped, levels, shown, store
from app.state.options import Pixel
from renderer.camera import Size
from renderer.images.display import Bytes, to_srgb8
from renderer.scene.reading import size_text

Image = NDArray[np.float32]

DOT_PX = 2  # a side of a bitmap's pixel, so that a class sees it
SMALLEST_CELL = 8


@dataclass(frozen=True, eq=False)
class Panel:
    """A picture with a heading. region: first row and column, rows and columns of the pixels that
    another panel magnifies. magnification: screen pixels a side of an image's pixel; 0: not a
    plain picture of the image. first: the image's pixel, row and column, at its corner. at_work:
    pixels that a display addresses, as in region."""

    title: str
    caption: str
    picture: Bytes
    magnification: int = 0
    first: Pixel = (0, 0)
    region: displays.Region | None = None
    at_work: displays.Region | None = None


@dataclass(frozen=True)
class PagePlan:
    """The layout of a page.

    columns, rows: of cells. cell: the size of one. image: the size that the image should have.
    magnification: screen pixels per side of an image's pixel. is_fixed: the user has chosen the
    image's size.
    """

    columns: int
    rows: int
    cell: Size
    image: Size
    magnification: int
    is_fixed: bool = False


def plan(
    page: str,
    room: Size,
    heading_px: int,
    gap_px: int,
    resolution: Size | None,
    apart: float = 0.0,
    is_short: bool = False,
) -> PagePlan:
    """The division of a page's room. heading_px: of the text over each picture. resolution: the
    image's, where it is fixed. apart: of projectors, see LaboratoryOptions.
    is_short: the parts of the array stand side by side in a page that is not wide, too."""
    wide = room[0] > 1.15 * room[1]
    columns, rows = {
        "kinds": (3, 2) if wide else (2, 3),
        "bitmaps": (2, 2),
        "projectors": (1, 1),
        "heights": (1, 1),
        "array": (2, 2)
        if wide or is_short
        else (1, 4),  # the image, the cells, the program, the memory
    }.get(page, (2, 1) if wide else (1, 2))
    cell = (
        max(SMALLEST_CELL, (room[0] - (columns - 1) * gap_px) // columns),
        max(SMALLEST_CELL, (room[1] - (rows - 1) * gap_px) // rows - heading_px),
    )
    free = cell
    if page == "projectors":  # together they fill it
        height = int(cell[1] / (1 + 1.5 * apart))
        free = max(SMALLEST_CELL, cell[0] - int(1.74 * apart * height)), height
    if resolution is not None:
        fitting = max(1, min(free[0] // resolution[0], free[1] // resolution[1]))
        return PagePlan(columns, rows, cell, resolution, fitting, True)
    dot = DOT_PX if page == "bitmaps" and min(cell) > 200 else 1
    return PagePlan(columns, rows, cell, (free[0] // dot, free[1] // dot), dot)


@dataclass(frozen=True, eq=False)
class PageInput:
    """The input of a page's pictures.

    color: the image, (H, W, 3), linear.
    taken_ev: its exposure.
    pixel: the one to look at, 0-based.
    """

    color: Image
    plan: PagePlan
    options: LaboratoryOptions
    taken_ev: float
    pixel: Pixel

    @property
    def is_test(self) -> bool:
        """True if the page shows a test picture, which has an exposure of its own."""
        return self.options.content == "test"

    @property
    def shown_ev(self) -> float:
        return 0.0 if self.is_test else self.taken_ev


Panels = tuple[Panel, ...]


def panels(
    page: str,
    color: Image,
    plan: PagePlan,
    options: LaboratoryOptions,
    taken_ev: float,
    pixel: Pixel,
) -> Panels:
    """Return the pictures of a page. The arguments are those of PageInput."""
    return PAGES[page](PageInput(color, plan, options, taken_ev, pixel))


def _heights(page: PageInput) -> Panels:
    field = height_field(page.color, page.plan.cell, page.taken_ev)
    caption = "as high as the image is bright, in linear light; row 1 is at the back"
    return (Panel("The image as a height field", caption, field),)


def _kinds(page: PageInput) -> Panels:
    found = []
    for kind in KINDS:
        kept = store(page.color, kind, page.taken_ev, page.options.method)
        bits = "1 bit" if kind.bits == 1 else f"{kind.bits} bits"
        caption = f"{bits} per pixel, {size_text(kept.storage_bytes)}"
        found.append(_whole(kind.title, caption, shown(kept, page.options.after_ev), page.plan))
    return tuple(found)


def _bitmaps(page: PageInput) -> Panels:
    gray = store(page.color, GRAY, page.taken_ev)
    found = [_whole("Grayscale", "8 bits per pixel", shown(gray), page.plan)]
    for method, title in TITLES.items():
        kept = store(page.color, BITMAP, page.taken_ev, method)
        white = f"{100 * float(kept.array.mean()):.1f} % white"
        found.append(_whole(title, white, shown(kept), page.plan))
    return tuple(found)


def _exposure(page: PageInput) -> Panels:
    lost = 100 * float(clipped(page.color, page.taken_ev).mean())
    found = []
    for kind in (COLOR, FLOAT):
        picture = shown(store(page.color, kind, page.taken_ev), page.options.after_ev)
        count = levels(picture)
        caption = f"{count} of 256 levels; {lost:.1f} % of the pixels are clipped"
        if kind.is_float:  # which has no such steps: the screen has
            caption = f"without steps; nothing is clipped; seen in {count} levels"
        found.append(_whole(f"{kind.title}, {kind.bits} bits", caption, picture, page.plan))
    return tuple(found)


def _projectors(page: PageInput) -> Panels:
    height, width = page.color.shape[:2]
    distance = page.options.apart * height
    color = light.disc(height, width) if page.is_test else page.color
    wall = light.projected(color, light.triangle(distance), page.shown_ev)
    caption = f"{'apart' if distance else 'aligned'}; where pictures overlap, their light adds"
    return (_whole("Three projectors: red, green, blue", caption, wall, page.plan),)


def _displays(page: PageInput) -> Panels:
    name, phase = page.options.display, page.options.phase % 1.0
    display = displays.DISPLAYS[name]
    part, first, side, place = display_part(page)
    at_work = displays.at_work(name, phase, *part.shape[:2])
    if at_work is not None:
        at_work = (at_work[0] + first[0], at_work[1] + first[1], *at_work[2:])
    marked = (place[0] + first[0], place[1] + first[1], 1, 1)
    title = f"{display.title}: {displays.moment(name, phase)}"
    way = f"{display.way}; framed: {display.framed}" if display.framed else display.way
    now = displays.instant(display, part, phase, side)
    mean = light.magnified(to_srgb8(part), side)
    told = "the mean over a cycle; and over each pixel"
    return (
        Panel(title, way, now, side, first, marked, at_work),
        Panel("What the eye sees", told, mean, side, first, marked),
    )


def display_part(page: PageInput) -> tuple[Image, Pixel, int, Pixel]:
    """Return the visible part of a display.

    Returns the colours that it shows, (rows, columns, 3), linear, 0..1; the image's pixel at its
    corner; screen pixels per side of a pixel; and the place of `pixel` in it.
    """
    part, (first, left), side = _magnified_part(page, displays.LEAST_SIDE_PX)
    part = displays.shown(part, page.shown_ev)
    rows, columns = part.shape[:2]
    place = min(page.pixel[0] - first, rows - 1), min(page.pixel[1] - left, columns - 1)
    return part, (first, left), side, place


def _magnified_part(page: PageInput, least: int) -> tuple[Image, Pixel, int]:
    """Return the pixels around one that have room, or as many of a test picture; the first of
    them, row and column; and the screen pixels per side of a pixel, `least` or more.
    """
    plan = page.plan
    side = max(least, plan.cell[0] // len(light.BARS) if page.is_test else page.options.side_px)
    rows, columns = max(1, plan.cell[1] // side), max(1, plan.cell[0] // side)
    if page.is_test:
        return light.bars(rows, columns), (0, 0), side
    first, left, part = light.window(page.color, *page.pixel, rows, columns)
    return np.ascontiguousarray(part), (first, left), side


def _array(page: PageInput) -> Panels:
    height, width = page.color.shape[:2]
    caption = f"{height} rows of {width} pixels, {size_text(page.color.nbytes)}"
    return (_whole("canvas", caption, to_srgb8(page.color, page.taken_ev), page.plan),)


def _whole(
    title: str,
    caption: str,
    picture: Bytes,
    plan: PagePlan,
    region: displays.Region | None = None,
) -> Panel:
    """A picture magnified for its cell; of one that is too large, the middle."""
    most = plan.cell[1] // plan.magnification, plan.cell[0] // plan.magnification
    height, width = picture.shape[:2]
    first, left, part = light.window(picture, height // 2, width // 2, *most)
    large = light.magnified(part, plan.magnification)
    return Panel(title, caption, large, plan.magnification, (first, left), region)


PAGES: dict[str, Callable[[PageInput], Panels]] = {
    "heights": _heights,
    "kinds": _kinds,
    "bitmaps": _bitmaps,
    "exposure": _exposure,
    "projectors": _projectors,
    "displays": _displays,
    "array": _array,
}
PAGE_TITLES = {
    "heights": "Heights",
    "kinds": "Kinds",
    "bitmaps": "One bit",
    "exposure": "Exposure",
    "projectors": "Projectors",
    "displays": "Displays",
    "array": "Array",
    "vector": "Vector",  # drawn by a view of its own
}
