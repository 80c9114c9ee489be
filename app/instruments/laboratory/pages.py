"""The laboratory's pages: each a drawing of one aspect of images. Pure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from lucida.app.instruments.outside.figure import Figure

from . import images
from .array import array
from .devices import devices
from .dimension import dimension
from .displays import displays
from .light import projectors
from .page import Page
from .ruler import ruler
from .shapes import raster_and_vector
from .storage import storage


@dataclass(frozen=True)
class Kind:
    """A kind of page.

    builds: the largest progress that changes it. has_image: True if it shows the scene's image.
    """

    title: str
    draw: Callable[[Page], Figure]
    builds: int = 0
    has_image: bool = False


PAGES: dict[str, Kind] = {
    "function": Kind("Function", images.function, 1, True),
    "shapes": Kind("Pixels and shapes", raster_and_vector, 2),
    "projectors": Kind("Projectors", projectors, 2),
    "displays": Kind("Displays", displays, 3),
    "raster": Kind("Raster", images.raster, 0, True),
    "kinds": Kind("Kinds", images.kinds, 3, True),
    "exposure": Kind("Exposure", images.exposure, 0, True),
    "storage": Kind("Storage", storage, 3),
    "array": Kind("Array", array, 3),
    "devices": Kind("How images are made", devices, 3),
    "dimension": Kind("From 3D to 2D", dimension, 2),
    "ruler": Kind("From pixel to (u, v)", ruler, 4),
}


def drawn(page: Page) -> Figure:
    """Return a page's drawing."""
    return PAGES[page.options.page].draw(page)
