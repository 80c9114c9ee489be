"""The options that all instruments share, apart from scene and camera.

They are small immutable values with bounds (bounds.py), which panels, sessions and lectures read
from the fields. Each instrument's own options are in a module next to this one; Options has all.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Annotated, Literal

from lucida.app.state.bounds import Accepted, AtMost, OneOf, OptionPart, Range
from lucida.renderer.camera.intrinsics import PixelOrigin
from lucida.renderer.camera.pixels import ENLARGEMENT, ENLARGEMENTS, Indexing
from lucida.renderer.images.frame import LARGEST_SIDE, check_size
from lucida.renderer.scene.model import View

Index = Annotated[int, Range(0, LARGEST_SIDE - 1)]
Pixel = tuple[Index, Index]  # (row, column), 0-based, row 0 at the top
Part = Annotated[float, Range(0, 1)]  # of a width or height

RESOLUTIONS = (
    *((16, 9), (64, 36), (160, 90), (320, 180), (640, 360), (1280, 720), (1920, 1080)),
    *((3840, 2160), (4096, 2160), (4, 3), (16, 16), (64, 64), (256, 256), (512, 512)),
)
SAMPLES = (1, 4, 16, 64)  # rays per pixel
MOST_BOOKMARKS = 9  # a key for each
MAGNIFICATIONS = (1, 2, 4, 8, 16, 32, 64)

# Fields of ImageOptions that change the display of an image, not the image itself.
DISPLAY = (
    *("channel", "transfer", "exposure_ev", "magnification", "center"),
    *("grid", "dissolved"),
)

Channel = Literal["color", "depth", "normal", "id", "z"]
Transfer = Literal["srgb", "linear"]
Language = Literal["python", "julia"]


@dataclass(frozen=True)
class ImageOptions(OptionPart):
    """The options of both images.

    exposure_ev: the display's brightness, in stops. transfer: the conversion of light to display
    values. resolution: (width, height) of both images; None for as many pixels as the window has.
    magnification: screen pixels per side of an image's pixel if the user has zoomed into the
    pixels; None to fit the whole image into its window. center: the centre of a zoomed view, as a
    fraction of the image's width and height. grid: draw lines between pixels, and the pixels'
    numbers if there is space.
    samples: rays per pixel for the ray image's colour, once the image is complete. dissolved: the
    progress of both images' dissolution into flat squares, of which finally 32 are in a row.
    lens_enlargement: texels per side of a pixel in the pinhole images in which the raster image of
    a lens is looked up.
    """

    channel: Channel = "color"
    transfer: Transfer = "srgb"
    exposure_ev: Annotated[float, Range(-8, 8)] = 0.0
    resolution: Annotated[tuple[int, int], Accepted(check_size)] | None = None
    magnification: Annotated[float, Range(1 / 64, 128)] | None = None
    center: tuple[Part, Part] = (0.5, 0.5)
    grid: bool = True
    samples: Annotated[int, OneOf(SAMPLES)] = 1
    dissolved: Part = 0.0
    lens_enlargement: Annotated[int, OneOf(ENLARGEMENTS)] = ENLARGEMENT

    def displayed_as(self, other: ImageOptions) -> ImageOptions:
        """Return these options with the display of others."""
        return replace(self, **{name: getattr(other, name) for name in DISPLAY})


Theme = Literal["dark", "light"]


@dataclass(frozen=True)
class Preferences(OptionPart):
    """The window's appearance. reduced_motion: the camera jumps without a transition."""

    theme: Theme = "dark"
    presentation: bool = False
    font_scale: Annotated[float, Range(0.75, 3)] = 1.0
    reduced_motion: bool = False


@dataclass(frozen=True)
class Bookmark:
    """A saved view. number: its key."""

    number: Annotated[int, Range(1, MOST_BOOKMARKS)]
    view: View


@dataclass(frozen=True)
class SharedOptions:
    """The options that belong to no single instrument.

    marked: the pixel that the user has marked, in every view; None for none. marked_size: (width,
    height) of the image that it was set in, so that it keeps its ray in an image of another size;
    None until an image of its size is shown.

    shadows, mirrors: effects that only image order has. one_based: pixels are counted from 1, as in
    the lecture, or from 0, as in arrays. language: the language of displayed programs.
    pixel_origin: the points at which K's pixel coordinates are whole numbers: pixels' centres or
    corners. bookmarks: the saved views in the order of their numbers.
    """

    images: ImageOptions = field(default_factory=ImageOptions)
    preferences: Preferences = field(default_factory=Preferences)
    marked: Pixel | None = None
    marked_size: Annotated[tuple[int, int], Accepted(check_size)] | None = None
    shadows: bool = False
    mirrors: bool = False
    one_based: bool = True
    language: Language = "python"
    pixel_origin: PixelOrigin = "center"
    bookmarks: Annotated[tuple[Bookmark, ...], AtMost(MOST_BOOKMARKS)] = ()

    @property
    def indexing(self) -> Indexing:
        """The numbering of rows and columns that the user reads and types."""
        return Indexing(int(self.one_based))
