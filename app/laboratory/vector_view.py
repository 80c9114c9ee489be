"""The laboratory's page "Raster and vector": one diagram in both ways, under one magnification.

Owns the two panes, what the mouse does in them, and the thread that makes both. The diagram is the
outside view's; the raster image has the same pixels at every magnification.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from app.host.view import Host
from app.laboratory.diagram import bitmap, magnified, outlines
from app.laboratory.options import LaboratoryOptions
from app.outside.figure import Figure
from app.outside.figure_view import Sketch, Sketcher
from app.outside.painting import Magnified, paint
from app.outside.svg import svg
from app.outside.view import OutsideView
from app.state.bounds import range_of
from app.widgets import theme
from app.widgets.areas import focused_steps, mouse_area
from app.widgets.background import Background
from app.widgets.lettering import fitting_words, lettering
from app.widgets.theme import framebuffer_scale
from app.widgets.uploads import Uploads
from renderer.camera import Size
from renderer.errors import describe
from renderer.memo import Memo
from renderer.scene.model import Scene
from renderer.scene.reading import size_text
from renderer.scene_editing.documents import are_versions

PAGE_PX = 640  # the width of the drawing
PIXEL_PX = 4  # of the drawing, a side of its raster image's pixel
LOWEST, HIGHEST = 0.75, 1.2  # the drawing's height, in parts of its width: as high as has room
SHAPE = (4, 3)  # the lowest one's: what is seen then is seen in all
UNITS = (1.6, 1.5)  # of lines and of symbols, in the drawing's pixels
WHEEL_STEP = 1.25
STEP = 0.02  # of an arrow key, in parts of what is seen
NAME = "vector"  # of the raster image's texture


@dataclass(frozen=True, eq=False)
class Both:
    """The diagram in both ways, of a scene. svg_bytes: of the file."""

    scene: Scene
    figure: Figure
    picture: NDArray[np.uint8]
    svg_bytes: int


@dataclass(frozen=True)
class PageRect:
    """The place of the page on the screen when all of it is visible."""

    low: ImVec2
    high: ImVec2


class VectorPage:
    """outside: whose diagram it is."""

    def __init__(self, outside: OutsideView) -> None:
        self._outside = outside
        self._sketcher = Sketcher()
        self._work: Background[Both] | None = None
        self._asked = False
        self._put = Memo(_put)
        self.error: Exception | None = None
        self.made: Both | None = None

    @property
    def settled(self) -> bool:
        busy = self._work is not None and self._work.busy
        return not busy and self._outside.settled and self._asked

    def begin(self, host: Host) -> None:
        self._work = Background("lucida-vector", host.animate)

    def end(self) -> None:
        if self._work is not None:
            self._work.close()

    def draw(self, host: Host, options: LaboratoryOptions, uploads: Uploads) -> None:
        """Into the rest of the window. Raises LucidaError, moderngl.Error."""
        room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        panes, page = panes_in(*room, imgui.get_font_size())
        self._follow(host, page)
        if self.error is not None:
            imgui.text_colored(theme.ERROR, describe(self.error))
            return
        if self.made is None:
            return
        if not are_versions(self.made.scene, host.state.scene) or self.made.figure.size != page:
            return  # stale
        changed = options
        for number, pane in enumerate(panes):
            changed = self._mouse(f"pane {number}", pane, changed)
        zoom, corner = changed.zoom, _corner(changed)
        draw = imgui.get_window_draw_list()
        texture = self._pixels(panes[0], zoom, corner, uploads)
        if texture is not None:
            draw.add_image(imgui.ImTextureRef(texture.glo), panes[0].low, panes[0].high)
        low, high = panes[1].low, panes[1].high
        width, height = self.made.figure.size
        scale = (high.x - low.x) * zoom / width
        origin = low.x - corner[0] * width * scale, low.y - corner[1] * height * scale
        view = Magnified(origin, scale)
        paint(draw, self.made.figure, view, low, high, host.fonts)
        for pane in panes:
            draw.add_rect(pane.low, pane.high, theme.u32(theme.LINE))
        self._captions(host, panes)
        if changed != options:
            host.apply(host.state.with_options(laboratory=changed), "vector pane")

    def _follow(self, host: Host, page: Size) -> None:
        assert self._work is not None
        color = theme.BACKGROUND
        ground = color.x, color.y, color.z
        sketch = self._sketcher.follow(self._outside, host, page, ground, UNITS, SHAPE)
        self._work.ask(_both, sketch)
        self._asked = True
        outcome = self._work.poll()
        if outcome is not None:
            self.error = outcome.error
        if outcome is not None and outcome.value is not None:
            self.made = outcome.value

    def _pixels(
        self, pane: PageRect, zoom: float, corner: tuple[float, float], uploads: Uploads
    ) -> moderngl.Texture | None:
        """Draw the visible part of the raster image, screen pixel by screen pixel: ImGui would
        smooth it.
        """
        assert self.made is not None
        scale = framebuffer_scale()
        size = round((pane.high.x - pane.low.x) * scale), round((pane.high.y - pane.low.y) * scale)
        self._put(uploads, self.made.picture, size, zoom, corner)
        return uploads.get(NAME)

    def _mouse(self, name: str, pane: PageRect, options: LaboratoryOptions) -> LaboratoryOptions:
        """A drag moves, the wheel magnifies about the pointer."""
        extent = ImVec2(pane.high.x - pane.low.x, pane.high.y - pane.low.y)
        imgui.set_cursor_screen_pos(pane.low)
        mouse_area(name, extent)
        imgui.set_item_key_owner(imgui.Key.mouse_wheel_y)
        io = imgui.get_io()
        center = options.zoom_center
        right, down = focused_steps()
        if right or down:
            step = STEP / options.zoom
            moved = center[0] + right * step, center[1] + down * step
            options = replace(options, zoom_center=_held(moved, options.zoom))
        if imgui.is_item_active() and (io.mouse_delta.x or io.mouse_delta.y):
            x = center[0] - io.mouse_delta.x / extent.x / options.zoom
            y = center[1] - io.mouse_delta.y / extent.y / options.zoom
            options = replace(options, zoom_center=_held((x, y), options.zoom))
        if imgui.is_item_hovered() and io.mouse_wheel:
            least, most = range_of(LaboratoryOptions, "zoom")
            zoom = min(max(options.zoom * WHEEL_STEP**io.mouse_wheel, least), most)
            mouse = (
                (io.mouse_pos.x - pane.low.x) / extent.x - 0.5,
                (io.mouse_pos.y - pane.low.y) / extent.y - 0.5,
            )
            step = 1 / options.zoom - 1 / zoom
            moved = center[0] + mouse[0] * step, center[1] + mouse[1] * step
            options = replace(options, zoom=zoom, zoom_center=_held(moved, zoom))
        return options

    def _captions(self, host: Host, panes: tuple[PageRect, PageRect]) -> None:
        assert self.made is not None
        em = imgui.get_font_size()
        draw = imgui.get_window_draw_list()
        picture = self.made.picture
        texts = (
            (
                "Raster image",
                f"{picture.shape[1]} x {picture.shape[0]} pixels, {size_text(picture.nbytes)}",
            ),
            (
                "Vector drawing",
                f"{len(self.made.figure.parts)} shapes, {size_text(self.made.svg_bytes)} as SVG",
            ),
        )
        for pane, (title, caption) in zip(panes, texts, strict=True):
            top = pane.low.y - 2.5 * em
            with lettering(host.fonts.bold):
                draw.add_text(ImVec2(pane.low.x, top), theme.u32(theme.TEXT), title)
            below = ImVec2(pane.low.x, top + 1.15 * em)
            draw.add_text(
                below, theme.u32(theme.DIM), fitting_words(caption, pane.high.x - pane.low.x)
            )


def _both(sketch: Sketch) -> Both:
    figure = sketch.figure(outlines(sketch.scene, sketch.screen.camera))
    width, height = figure.size
    picture = bitmap(figure, (width // PIXEL_PX, height // PIXEL_PX))
    return Both(sketch.scene, figure, picture, len(svg(figure).encode()))


def panes_in(corner: ImVec2, avail: ImVec2, em: float) -> tuple[tuple[PageRect, PageRect], Size]:
    """Two side by side or one below the other, under their headings, and the size of the drawing
    in them: as much of the room as two of its proportions take. em: the size of type."""
    gap, heading = 0.6 * em, 2.5 * em
    beside = max(1.0, (avail.x - gap) / 2), avail.y - heading
    below = max(1.0, avail.x), (avail.y - gap) / 2 - heading
    parts = [min(max(height / width, LOWEST), HIGHEST) for width, height in (beside, below)]
    widths = [
        min(width, height / part)
        for (width, height), part in zip((beside, below), parts, strict=True)
    ]
    best = max((0, 1), key=lambda way: widths[way] ** 2 * parts[way])
    rows = round(PAGE_PX * parts[best] / PIXEL_PX)
    page = PAGE_PX, rows * PIXEL_PX
    width = np.floor(max(widths[best], 0.02 * PAGE_PX))
    height = np.floor(width * page[1] / page[0])
    step = (beside[0] + gap, 0.0) if best == 0 else (0.0, height + heading + gap)

    def pane(number: int) -> PageRect:
        x = float(np.floor(corner.x + number * step[0]))
        y = float(np.floor(corner.y + heading + number * step[1]))
        return PageRect(ImVec2(x, y), ImVec2(x + width, y + height))

    return (pane(0), pane(1)), page


def _held(center: tuple[float, float], zoom: float) -> tuple[float, float]:
    """Return the nearest view that shows nothing outside the page."""
    half = 0.5 / zoom
    x, y = (min(max(part, half), 1 - half) for part in center)
    return x, y


def _corner(options: LaboratoryOptions) -> tuple[float, float]:
    """The upper left corner of what is seen, in parts of the page."""
    x, y = _held(options.zoom_center, options.zoom)
    return x - 0.5 / options.zoom, y - 0.5 / options.zoom


def _put(
    uploads: Uploads,
    picture: NDArray[np.uint8],
    size: Size,
    zoom: float,
    corner: tuple[float, float],
) -> None:
    uploads.put(NAME, magnified(picture, size, corner, (1 / zoom, 1 / zoom)))
