"""The options of the image laboratory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from app.state.bounds import Range
from app.state.options import Part


@dataclass(frozen=True)
class LaboratoryOptions:
    """page: the aspect of an image that is shown. method: how a bitmap is made.

    after_ev: the exposure, in stops, of an image that has been stored. apart: the separation of the
    three projectors' pictures, as a fraction of the image's height. side_px: screen pixels per side
    of a magnified pixel. zoom: the magnification of raster image and vector drawing; zoom_center:
    the centre of the view, as a fraction of the picture's width and height. content: what
    projectors and displays show, the image or a test picture. display: the selected one. playing:
    run its cycle, which takes cycle_s seconds; phase: the moment, 0 to 1, and while it plays, where
    it began. order: how the array page lays an image into memory, row after row or column after
    column.
    """

    page: Literal[
        "heights", "kinds", "bitmaps", "exposure", "projectors", "displays", "array",
        "vector",
    ] = "kinds"  # fmt: skip
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
