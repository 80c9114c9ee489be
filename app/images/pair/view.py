"""The raster and the ray image, side by side and linked, as two instances of one class."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import ClassVar

import moderngl
from imgui_bundle import imgui

from lucida.app.images.photograph.actions import PHOTOGRAPH
from lucida.app.images.photograph.layer import PhotographLayer
from lucida.app.images.screen import Screen
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.uploads import Uploads
from lucida.renderer.system.memo import Memo

from .actions import IMAGE, MOUSE
from .footprint import draw_footprint, footprint
from .image_view import ImageView, Linked
from .pane import Pane
from .straight_lines import draw_grid
from .vanishing import draw_parallels

RASTER, RAY = "Raster", "Ray"


class PairView(ImageView):
    """One of the two images, with its drawings and the open photograph, if any."""

    is_ray: ClassVar[bool]

    def __init__(self, linked: Linked) -> None:
        super().__init__(linked)
        self._footprint = Memo(footprint)
        self._uploads: Uploads | None = None
        self.photograph: PhotographLayer | None = None

    @property
    def settled(self) -> bool:
        return self.photograph is None or not self.photograph.busy

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._uploads = Uploads(context)
        self.photograph = PhotographLayer(self._uploads)

    def end(self) -> None:
        if self.photograph is not None and self._uploads is not None:
            self.photograph.close()
            self._uploads.release()

    def _on_pixels(self, host: Host, screen: Screen) -> None:
        if self.photograph is not None:
            self.photograph.draw(host, screen)

    def _over_image(self, host: Host, screen: Screen) -> None:
        options, state = host.state.options.pair, host.state
        draw, both = imgui.get_window_draw_list(), host.renderers
        camera = both.camera(state)
        if options.straight_lines and not camera.is_parallel:
            draw_grid(draw, screen, camera, both.size)
        if options.vanishing and camera.lens is None:
            draw_parallels(draw, screen, camera, both.size, options)
        if options.footprint and state.marked is not None:
            self._draw_footprint(host, screen, state.marked)

    def _draw_footprint(self, host: Host, screen: Screen, pixel: Pixel) -> None:
        both, state = host.renderers, host.state
        request = both.request(state)
        if request is None or both.textures is None or not _contains(request.size, pixel):
            return
        if self.is_ray and both.shown_ray(state) is None:
            return
        samples = state.images.samples if self.is_ray else 1
        square = self._footprint(both.textures.rasterizer, request, pixel, samples)
        draw_footprint(screen, pixel, square)


def _contains(size: tuple[int, int], pixel: Pixel) -> bool:
    return pixel[0] < size[1] and pixel[1] < size[0]


class RasterView(PairView):
    name = RASTER
    title = "Raster  object order"
    actions = (*PHOTOGRAPH, *IMAGE)
    mouse = MOUSE
    is_ray = False

    def __init__(self, views: Sequence[Instrument]) -> None:
        super().__init__(Linked())

    def draw(self, host: Host) -> None:
        both = host.renderers
        self._pane(host, Pane(partial(both.picture, False), both.raster_values, both.raster_error))


class RayView(PairView):
    name = RAY
    title = "Ray  image order"
    is_ray = True

    def __init__(self, views: Sequence[Instrument]) -> None:
        super().__init__(view_of(views, RasterView).linked)

    def draw(self, host: Host) -> None:
        both = host.renderers
        pane = Pane(partial(both.picture, True), both.ray_values, both.ray_error, both.preparing())
        self._pane(host, pane)
        both.trace(host.state)
