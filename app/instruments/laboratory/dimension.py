"""The camera conundrum: the points along one line become one pixel."""

from __future__ import annotations

import numpy as np

from lucida.app.instruments.outside.figure import Figure
from lucida.renderer.camera.checks import Floats

from .page import Page
from .sheet import Sheet, between, mixed, reached

COLUMNS, ROWS = 4, 3
# On the sheet: the corner of pixel (1, 1), and the steps to the next column and the next row.
FRAME, ACROSS, DOWN = np.array((5.6, 4.6)), np.array((1.35, 0.85)), np.array((0.0, 3.1))
PIXEL = (1, 2)  # row and column from 0
EYE = np.array((1.2, 14.6))
ALONG = (1.7, 2.15, 2.65, 3.2)  # the points, in multiples of the distance from the eye to the pixel
AXES = {"x": (4.6, 1.5), "y": (0.0, -4.6), "z": (-3.4, 2.7)}
ORIGIN = (20.5, 15.6)


def dimension(page: Page) -> Figure:
    """Draw points of the world. Build 1 adds an image, build 2 slides the points into a pixel."""
    sheet, look = page.sheet((29, 20)), page.look
    flat, lost = (reached(page.progress, build) for build in (1, 2))
    drawn, slid = min(1.0, 2 * lost), max(0.0, 2 * lost - 1)  # the line, then the points
    image, axes = sheet.part(opacity=flat), sheet.part(ORIGIN, 1 - 0.75 * lost)
    for name, way in AXES.items():
        axes.arrow((0.0, 0.0), way, look.dim)
        axes.word(name, 1.17 * np.array(way), 1.3, look.dim)
    sheet.word("3D", (23.5, 1.4), 1.8, strong=True)
    image.word("2D", (8.3, 1.4), 1.8, strong=True)
    middle = _cell(*PIXEL).mean(axis=0)
    far = EYE + (ALONG[-1] + 0.3) * drawn * (middle - EYE)
    sheet.line([EYE, far], look.ray, 0.14, min(1.0, 10 * drawn))
    for cell in np.ndindex(ROWS, COLUMNS):
        image.fill(_cell(*cell), mixed(look.fill, look.ground, 0.6), 0.85)
        image.outline(_cell(*cell), width=0.1)
    sheet.fill(_cell(*PIXEL), look.u, slid)
    image.disc(EYE, 0.35, look.text)
    sheet.word("eye", EYE + np.array((0.0, 1.5)), 1.3, opacity=drawn)
    _points(sheet, middle, slid)
    return sheet.figure()


def _cell(row: int, column: int) -> Floats:
    """Return the corners of a pixel."""
    corner = FRAME + column * ACROSS + row * DOWN
    return np.array([corner, corner + ACROSS, corner + ACROSS + DOWN, corner + DOWN])


def _points(sheet: Sheet, pixel: Floats, slid: float) -> None:
    """Draw the points, the farthest first; they leave pale traces where they were."""
    colors = sheet.look.u, sheet.look.v, sheet.look.w, sheet.look.mark
    for along, color in reversed(list(zip(ALONG, colors, strict=True))):
        start = EYE + along * (pixel - EYE)
        sheet.disc(start, 0.65, color, 0.3)
        if slid < 1:
            sheet.disc(between(slid, (start, pixel)), 0.65 - 0.2 * slid, color)
