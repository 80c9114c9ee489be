"""The image laboratory: drawings that explain images, as large as its window."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui

from lucida.app.images.request import ImageRequest
from lucida.app.images.screen import available_px
from lucida.app.images.window_rasterizer import WindowRasterizer
from lucida.app.instruments.outside.figure import Figure
from lucida.app.instruments.outside.painting import Painter
from lucida.app.state.bounds import range_of
from lucida.app.state.options.laboratory import LaboratoryOptions
from lucida.app.ui import palettes, theme
from lucida.app.ui.areas import focused_steps, mouse_area
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.app.ui.messages import wrapped
from lucida.app.ui.rows import follow
from lucida.app.ui.theme import framebuffer_scale
from lucida.app.ui.uploads import Uploads
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.system.errors import LucidaError, describe
from lucida.renderer.system.memo import Memo

from .images import boxes, image_size
from .looks import look_of
from .page import Image, Page
from .pages import PAGES, drawn
from .sheet import Point, Sheet

LABORATORY = "Laboratory"
SMALLEST_PX = 60
NO_IMAGE = np.zeros((1, 1, 3), np.float32)
KEY_STEP = 0.02  # times the image's width and height


class LaboratoryView(Instrument):
    name = LABORATORY
    title = "Image laboratory"

    def __init__(self, views: Sequence[Instrument] = ()) -> None:
        self._uploads: Uploads | None = None
        self._image = Memo(_drawn_image)
        self._page = Memo(Page)
        self._figure = Memo(drawn)
        self.page: Page | None = None
        self.figure: Figure | None = None

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._uploads = Uploads(context)

    def end(self) -> None:
        if self._uploads is not None:
            self._uploads.release()

    def unseen(self, host: Host) -> None:
        self._image.forget()

    def draw(self, host: Host) -> None:
        assert self._uploads is not None
        self._uploads.begin_frame()
        options = toolbar(host) if host.has_tools else host.state.options.laboratory
        size = available_px()
        if min(size) < SMALLEST_PX:
            return
        scale, at = framebuffer_scale(), imgui.get_cursor_screen_pos()
        corner = at.x, at.y
        far = corner[0] + size[0] / scale, corner[1] + size[1] / scale
        try:
            color = self._color(host, options.page, size)
        except (LucidaError, moderngl.Error) as error:
            wrapped(describe(error), theme.ERROR)
            return
        reads = options.page == "function"
        place = self._read(host, size, color, corner, scale) if reads else options.point
        look, exposure_ev = look_of(theme.used().palette), host.state.images.exposure_ev
        self.page = self._page(size, look, options, color, exposure_ev, place)
        self.figure = self._figure(self.page)
        painter = Painter(imgui.get_window_draw_list(), host.fonts, self._uploads)
        painter.paint(self.figure, corner, 1 / scale, corner, far)

    def in_both_themes(self) -> tuple[Page, Page]:
        """Return the input of the last drawing, in a lecture hall's light and dark themes."""
        assert self.page is not None
        light, dark = (look_of(one) for one in (palettes.PRESENTED_LIGHT, palettes.PRESENTED_DARK))
        return replace(self.page, look=light), replace(self.page, look=dark)

    def _color(self, host: Host, page: str, size: Size) -> Image:
        """Return the image that a page shows, in linear light. Raises LucidaError."""
        if not PAGES[page].has_image:
            return NO_IMAGE
        textures, state = host.renderers.textures, host.state
        assert textures is not None
        asked = image_size(page, size, state.images.resolution)
        request = ImageRequest(state.scene, state.view.for_size(asked), asked)
        return self._image(textures.rasterizer, request)

    def _read(self, host: Host, size: Size, color: Image, corner: Point, scale: float) -> Point:
        """Return the point of the image that the mouse or the arrow keys read, as fractions."""
        extent, ((low, room),) = boxes("function", size, (color.shape[1], color.shape[0]))
        sheet = Sheet(size, look_of(theme.used().palette), extent)
        first, last = sheet.px(np.array([low, np.add(low, room)])) / scale + corner
        imgui.set_cursor_screen_pos(ImVec2(*first))
        mouse_area("image", ImVec2(*(last - first)))
        steps, place = focused_steps(), np.array(host.state.options.laboratory.point)
        if imgui.is_item_hovered():
            mouse = imgui.get_mouse_pos()
            place = np.clip(((mouse.x, mouse.y) - first) / (last - first), 0, 1)
        elif any(steps):
            place = np.clip(place + KEY_STEP * np.array(steps), 0, 1)
            host.edit(replace(host.options.laboratory, point=tuple(place.tolist())))
        return float(place[0]), float(place[1])


def toolbar(host: Host) -> LaboratoryOptions:
    """Draw the switches. Return the current options."""
    options = host.state.options.laboratory
    names = list(PAGES)
    room = imgui.get_content_region_avail().x
    imgui.set_next_item_width(min(13 * imgui.get_font_size(), room))
    titles = [kind.title for kind in PAGES.values()]
    moved, number = imgui.combo("##page", names.index(options.page), titles)
    changed = replace(options, page=names[number]) if moved else options  # type: ignore[arg-type]
    builds = PAGES[changed.page].builds
    if builds:
        progress = _slider("progress", changed.progress, (0.0, float(builds)), "%.1f")
        changed = replace(changed, progress=progress)
    if changed.page in ("kinds", "exposure"):
        limits = range_of(LaboratoryOptions, "after_ev")
        after_ev = _slider("exposure", changed.after_ev, limits, "%+.1f EV")
        changed = replace(changed, after_ev=after_ev)
    if changed != options:
        host.apply(host.state.with_options(changed))
    return changed


def _slider(label: str, value: float, limits: tuple[float, float], form: str) -> float:
    """Draw a slider in the same row if there is space. Return its value."""
    width, label_px = 8 * imgui.get_font_size(), imgui.calc_text_size(label).x
    follow(width + label_px)
    room = imgui.get_content_region_avail().x - imgui.get_style().item_inner_spacing.x - label_px
    imgui.set_next_item_width(max(imgui.get_font_size(), min(width, room)))
    return imgui.slider_float(label, value, *limits, form)[1]


def _drawn_image(rasterizer: WindowRasterizer, request: ImageRequest) -> Image:
    """Return the rasterizer's image in linear light: float32 (H, W, 3). Wait for the GPU."""
    texture = rasterizer.draw(request, LABORATORY).color
    width, height = request.size
    values = np.frombuffer(texture.read(), np.float32).reshape(height, width, 4)
    return np.ascontiguousarray(values[..., :3])
