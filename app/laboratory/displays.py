"""Displays over time: the tube, mirrors (DLP), liquid crystals (LCD), diodes (LED).

Computes what shines where and when. For each display, the mean over a cycle is the pixel's linear
colour. A cycle is one showing of the picture; a phase in 0..1 is a moment of it. Colours (H, W, 3)
are linear, 0..1. H and W are those of the visible part, which is scanned as if it were the whole
picture.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.laboratory.light import CHANNELS
from renderer.images.display import Bytes, to_srgb8

Floats = NDArray[np.float32]
Region = tuple[int, int, int, int]  # first row and column, rows and columns
Place = tuple[float, float, float, float, float]  # middle x, y; half the width, height; rounding

FADING = 0.1  # of a cycle, until a phosphor's light has fallen to 1/e; real ones are quicker
SHARES = 16  # steps of one colour's time, by hand
LEAST_SIDE_PX = 6  # of a magnified pixel: below, its parts cannot be told apart


@dataclass(frozen=True)
class DisplayKind:
    """light: maps (colour, phase) to the light of each element, 0..1 of its full brightness.
    time_share: the fraction of a cycle's light that an element of colour 1 sends; 1 is always fully
    on. places: of the red, green and blue elements in a pixel of side 1. unlit: the look of a dark
    element, sRGB. way: what makes the colours. gray: what makes less than white. framed: the result
    of at_work().
    """

    title: str
    way: str
    gray: str
    light: Callable[[Floats, float], Floats]
    time_share: float
    places: tuple[Place, Place, Place]
    unlit: int
    framed: str = ""

    def elements(self, side: int) -> Floats:
        """Return how much of each screen pixel the elements of each colour cover: (side,
        side, 3).
        """
        axis = (np.arange(side, dtype=np.float32) + np.float32(0.5)) / side
        x, y = np.meshgrid(axis, axis)
        covered = np.empty((side, side, 3), np.float32)
        for channel, (middle_x, middle_y, half_x, half_y, rounding) in enumerate(self.places):
            over_x = np.abs(x - middle_x) - (half_x - rounding)
            over_y = np.abs(y - middle_y) - (half_y - rounding)
            beyond = np.hypot(np.maximum(over_x, 0), np.maximum(over_y, 0))
            distance = beyond + np.minimum(np.maximum(over_x, over_y), 0) - rounding
            covered[..., channel] = np.clip(0.5 - distance * side, 0, 1)
        return covered

    def gain(self, side: int) -> Floats:
        """Return the brightness of each colour's elements relative to the picture's white: (3,).

        With it, the mean over a cycle and over a pixel's area is the pixel's colour.
        """
        area = self.elements(side).mean(axis=(0, 1))
        return np.asarray(1 / (area * self.time_share), np.float32)


def _fading(color: Floats, phase: float) -> Floats:
    """A beam meets one pixel after another, row by row; what it met fades."""
    rows, columns = color.shape[:2]
    met = np.arange(rows * columns).reshape(rows, columns, 1) / (rows * columns)
    return np.asarray(color * np.exp(-((phase - met) % 1.0) / FADING), np.float32)


def _mirrored(color: Floats, phase: float) -> Floats:
    """A third of the cycle for each colour; in it a mirror sends light for a share of the time."""
    third = min(int(3 * phase), 2)
    light = np.zeros_like(color)
    light[..., third] = color[..., third] > 3 * phase - third
    return light


def _held(color: Floats, phase: float) -> Floats:
    return color


def _switched(color: Floats, phase: float) -> Floats:
    """Fully on, for a share of the time."""
    return np.asarray(color > phase, np.float32)


def _stripes(width: float, height: float, rounding: float) -> tuple[Place, Place, Place]:
    red, green, blue = (
        ((2 * channel + 1) / 6, 0.5, width / 2, height / 2, rounding) for channel in range(3)
    )
    return red, green, blue


_DOT = 0.22, 0.22, 0.22
_MIRROR = 0.5, 0.5, 0.46, 0.46, 0.03

DISPLAYS: dict[str, DisplayKind] = {
    "tube": DisplayKind(
        "Tube",
        "three beams, line by line; dots fade",
        "a weaker beam",
        _fading,
        FADING * (1 - math.exp(-1 / FADING)),
        ((0.25, 0.27, *_DOT), (0.75, 0.27, *_DOT), (0.5, 0.73, *_DOT)),
        26,
        "the beams",
    ),
    "dlp": DisplayKind(
        "DLP",
        "one mirror a pixel, one colour after another",
        "the mirror turns away sooner",
        _mirrored,
        1 / 3,
        (_MIRROR, _MIRROR, _MIRROR),
        34,
    ),
    "lcd": DisplayKind(
        "LCD",
        "light behind filter stripes",
        "the stripe lets less through",
        _held,
        1.0,
        _stripes(0.29, 0.92, 0.02),
        22,
        "the row being set",
    ),
    "led": DisplayKind(
        "LED",
        "no light behind, stripes that shine",
        "the stripe goes out sooner",
        _switched,
        1.0,
        _stripes(0.22, 0.74, 0.09),
        26,
    ),
}


def shown(color: ArrayLike, exposure_ev: float = 0.0) -> Floats:
    """Return what a display can show of linear light: exposed, and clipped to 0..1."""
    with np.errstate(over="ignore", invalid="ignore"):
        exposed = np.asarray(color, np.float32) * np.float32(2.0**exposure_ev)
    return np.asarray(np.clip(np.nan_to_num(exposed, nan=0.0), 0, 1), np.float32)


def instant(display: DisplayKind, color: Floats, phase: float, side: int) -> Bytes:
    """Return the magnified display at a moment: uint8 (H side, W side, 3), sRGB.

    color: from shown(). Elements that send no light are just visible.
    """
    covered = display.elements(side)
    rows, columns = color.shape[:2]
    light = to_srgb8(display.light(color, phase)).astype(np.float32)
    tiles = light[:, None, :, None, :] * covered[None, :, None, :, :]
    dark = covered.max(axis=2, keepdims=True) * display.unlit
    tiles = np.maximum(tiles, dark[None, :, None, :, :])
    return (tiles + np.float32(0.5)).astype(np.uint8).reshape(rows * side, columns * side, 3)


def course(
    display: DisplayKind, color: Floats, place: tuple[int, int], moments: int = 240
) -> Floats:
    """A pixel's light over a cycle, 0..1 of full brightness: (moments, 3). place: row, column."""
    phases = (np.arange(moments) + 0.5) / moments
    return np.array([display.light(color, float(phase))[place] for phase in phases], np.float32)


def steps(name: str, rows: int, columns: int) -> int:
    """Into how many steps by hand a cycle is cut: one pixel of a tube, one row of an LCD."""
    return {"tube": rows * columns, "dlp": 3 * SHARES, "lcd": rows}.get(name, SHARES)


def stepped(name: str, phase: float, rows: int, columns: int, by: int = 1) -> float:
    """The phase some steps on, or back; the cycle begins anew at its end."""
    count = steps(name, rows, columns)
    number = math.floor(phase * count + 1e-6)
    if by < 0 and phase * count - number > 1e-6:
        number += 1
    return ((number + by) % count) / count


def at_work(name: str, phase: float, rows: int, columns: int) -> Region | None:
    """Return what is addressed at a moment: the pixel that the beams meet, or the row that gets its
    numbers. None if all pixels are addressed at once.
    """
    number = int(phase * steps(name, rows, columns) + 1e-6)
    if name == "tube":
        return number // columns % rows, number % columns, 1, 1
    return (number % rows, 0, 1, columns) if name == "lcd" else None


def moment(name: str, phase: float) -> str:
    """A moment's name: of a DLP display, which colour's turn it is."""
    if name == "dlp":
        return f"{CHANNELS[min(int(3 * phase), 2)]}'s third of the cycle"
    return "this moment"
