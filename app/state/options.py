"""What the user has chosen beside scene and camera: small immutable values, kept in AppState.

Owns their fields, defaults and bounds (bounds.py): panels, sessions and lectures take these from
the fields. Knows nothing of windows, widgets or renderers.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Literal

from app.state.bounds import Accepted, AtMost, OneOf, Range
from renderer.camera import Camera
from renderer.difference import LARGEST_GAIN
from renderer.frame import LARGEST_SIDE, check_size
from renderer.pixels import Indexing
from renderer.scene.model import View

Index = Annotated[int, Range(0, LARGEST_SIDE - 1)]
Pixel = tuple[Index, Index]  # (row, column), 0-based, row 0 at the top
Part = Annotated[float, Range(0, 1)]  # of a width or height
Coordinate = Annotated[float, Range(-1e6, 1e6)]
Rays = Annotated[int, Range(0, 64)]  # rows, or columns, of viewing rays
Step = Annotated[int, Range(0, 1_000_000)]  # of a run of the loop stepper

PIXEL_SIZES = (1, 2, 4, 8, 16, 32)
RESOLUTIONS = (
    *((16, 9), (64, 36), (160, 90), (320, 180), (640, 360), (1280, 720), (1920, 1080)),
    *((3840, 2160), (4096, 2160), (4, 3), (16, 16), (64, 64), (256, 256), (512, 512)),
)
MAGNIFICATIONS = (1, 2, 4, 8, 16, 32, 64)

Channel = Literal["color", "depth", "normal", "id"]
Component = Literal["rgb", "red", "green", "blue"]
Transfer = Literal["srgb", "linear"]
Language = Literal["python", "julia", "c"]
CompareMode = Literal["absolute", "signed", "wipe", "flip"]


@dataclass(frozen=True)
class ImageOptions:
    """How both images are drawn and shown.

    exposure_ev: the display's brightness, in stops. transfer: how light becomes a display value.
    component: all of a colour, or one of its channels. resolution: (width, height) of both
    images, None for what fits the window at pixel_size screen pixels a side of an image's pixel.
    magnification: screen pixels a side of an image's pixel where the user has zoomed into the
    pixels, None to fit the whole image into its window; center: what is in the middle then, in
    parts of the image's width and height. tinted: a single component in its own colour, else gray.
    grid: lines between pixels, and their numbers, where those are large enough. values: how the
    numbers of a colour are written.
    """

    channel: Channel = "color"
    component: Component = "rgb"
    transfer: Transfer = "srgb"
    exposure_ev: Annotated[float, Range(-8, 8)] = 0.0
    pixel_size: Annotated[int, OneOf(PIXEL_SIZES)] = 1
    resolution: Annotated[tuple[int, int], Accepted(check_size)] | None = None
    magnification: Annotated[float, Range(1 / 64, 128)] | None = None
    center: tuple[Part, Part] = (0.5, 0.5)
    tinted: bool = False
    grid: bool = True
    values: Literal["bytes", "floats"] = "bytes"


@dataclass(frozen=True)
class CompareOptions:
    """The compare view. gain: what the difference is multiplied with before it gets a colour.

    divider: the wipe's, in parts of the image's width: the raster image left of it. flipped: flip
    shows the ray image. causes: differing pixels are marked in the colours of their causes.
    """

    mode: CompareMode = "wipe"
    gain: Annotated[float, Range(1, LARGEST_GAIN)] = 1.0
    divider: Part = 0.5
    flipped: bool = False
    causes: bool = False


@dataclass(frozen=True)
class OutsideOptions:
    """The outside view. camera: the free camera that looks at the scene and the other camera;
    None: one that sees both. bundle: rows and columns of the bundle of viewing rays; (0, 0): none.
    gizmo: what the handles in the view do to the camera. target: a point to draw as **a**, and up
    as an arrow at the eye: what a lecture makes a basis from; None: neither. parameters: the points
    of the marked pixel's ray at t = 0 and 1.
    """

    camera: Camera | None = None
    volume: bool = True
    image: bool = True
    basis: bool = True
    grid: bool = True
    ray: bool = True
    bundle: tuple[Rays, Rays] = (0, 0)
    gizmo: Literal["none", "move", "turn"] = "none"
    target: tuple[Coordinate, Coordinate, Coordinate] | None = None
    up: tuple[Coordinate, Coordinate, Coordinate] = (0.0, 1.0, 0.0)
    parameters: bool = False


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


@dataclass(frozen=True)
class ProbeOptions:
    """The pixel probe. pins: pixels that are kept at hand. rays: which viewing rays the outside
    view shows beside the marked pixel's: none, or those of its row or column."""

    pins: Annotated[tuple[Pixel, ...], AtMost(256)] = ()
    rays: Literal["pixel", "row", "column"] = "pixel"


@dataclass(frozen=True)
class StepperOptions:
    """The loop stepper. canvas: (width, height). order: which algorithms are shown. form: how
    object order is done: triangle by triangle, as graphics cards do it, or each object by its rays;
    a scene without triangles always by rays.

    steps: where the run in object order stands, and the one in image order; those that a run does
    not have are its last. speed: steps a second while it plays.
    """

    canvas: tuple[Annotated[int, Range(1, 64)], Annotated[int, Range(1, 48)]] = (16, 12)
    order: Literal["both", "object", "image"] = "both"
    form: Literal["triangles", "rays"] = "triangles"
    steps: tuple[Step, Step] = (0, 0)
    speed: Annotated[float, Range(1, 20_000)] = 8.0


@dataclass(frozen=True)
class CostOptions:
    """The cost plot. against: what the times are plotted against. triangles, pixels: of the image
    that is measured; the one that they are plotted against grows."""

    against: Literal["frames", "triangles", "pixels"] = "frames"
    triangles: Annotated[int, Range(18, 1_000_000)] = 10_000
    pixels: Annotated[int, Range(64, 1 << 22)] = 76_800


@dataclass(frozen=True)
class Preferences:
    """How the window looks. reduced_motion: the camera jumps, without a passage."""

    theme: Literal["dark", "light"] = "dark"
    presentation: bool = False
    font_scale: Annotated[float, Range(0.75, 3)] = 1.0
    reduced_motion: bool = False


@dataclass(frozen=True)
class Bookmark:
    """A view to come back to. number: its key."""

    number: Annotated[int, Range(1, 9)]
    name: str
    view: View


@dataclass(frozen=True)
class Options:
    """All of them. marked: the pixel that the user has chosen, in every view; None: none.
    highlight: what a lecture points out: fields of the camera's panel, and views, in small letters.

    shadows, mirrors: what only image order has. one_based: pixels are counted from 1, as in the
    lecture, or from 0, as in arrays. language: of the programs that are shown.
    presets_in_perspective: those of the camera's that can be, are. bookmarks: in the order of
    their numbers.
    """

    images: ImageOptions = field(default_factory=ImageOptions)
    compare: CompareOptions = field(default_factory=CompareOptions)
    outside: OutsideOptions = field(default_factory=OutsideOptions)
    laboratory: LaboratoryOptions = field(default_factory=LaboratoryOptions)
    probe: ProbeOptions = field(default_factory=ProbeOptions)
    stepper: StepperOptions = field(default_factory=StepperOptions)
    costs: CostOptions = field(default_factory=CostOptions)
    preferences: Preferences = field(default_factory=Preferences)
    marked: Pixel | None = None
    highlight: Annotated[tuple[str, ...], AtMost(256)] = ()
    shadows: bool = False
    mirrors: bool = False
    one_based: bool = True
    language: Language = "python"
    presets_in_perspective: bool = False
    bookmarks: Annotated[tuple[Bookmark, ...], AtMost(9)] = ()

    @property
    def indexing(self) -> Indexing:
        """How every pixel's row and column are counted that is shown or typed."""
        return Indexing(int(self.one_based))
