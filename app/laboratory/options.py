"""What the image laboratory shows, and how."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import Range
from app.state.options import Part


@dataclass(frozen=True)
class LaboratoryOptions:
    """The image laboratory. page: what of an image it shows. method: how a bitmap is made.

    after_ev: the exposure, in stops, of an image that has been stored. apart: how far the three
    projectors' pictures are moved apart, in parts of the image's height. side_px: screen pixels a
    side of a magnified pixel. zoom: the magnification of raster image and vector drawing;
    zoom_center: what is in the middle, in parts of the picture's width and height. content: what
    projectors and displays show, the image or a test picture. display: which one. playing: its
    cycle, which takes cycle_s seconds, goes on by itself; phase: where it stands, 0 to 1, and while
    it plays, where it began. order: how the array page lays an image into memory, row after row or
    column after column.
    """

    page: Literal[
        "kinds", "bitmaps", "exposure", "projectors", "displays", "subpixels", "array", "vector"
    ] = "kinds"
    method: Literal["threshold", "ordered", "floyd-steinberg"] = "floyd-steinberg"
    after_ev: Annotated[float, Range(-6, 6)] = 0.0
    apart: Annotated[float, Range(0, 0.4)] = 0.0
    side_px: Annotated[int, Range(3, 300)] = 36
    zoom: Annotated[float, Range(1, 32)] = 1.0
    zoom_center: tuple[Part, Part] = (0.5, 0.5)
    content: Literal["image", "test"] = "image"
    display: Literal["tube", "dlp", "lcd", "led"] = "tube"
    playing: bool = False
    phase: Part = 0.0
    cycle_s: Annotated[float, Range(1, 60)] = 8.0
    order: Literal["row", "column"] = "row"


OPTIONS = LaboratoryOptions
