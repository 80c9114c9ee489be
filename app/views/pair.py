"""The raster and the ray image, side by side and linked: one class, made twice.

Owns what both share: the drag under way, what the wheel zooms at, the size of their windows.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.files import describe
from app.panels.images import Grab, Pane, Zoom, available_px, image_pane
from app.state import AppState
from app.views.base import Host, View
from renderer.camera import Camera

RASTER, RAY = "Raster", "Ray"
WHEEL_PAUSE_S = 0.5  # turns of the wheel closer together are one step of undo


@dataclass
class Linked:
    """What the two images share."""

    grab: Grab | None = None
    zoom: Zoom | None = None
    wheel_number: int = 0
    wheel_s: float = 0.0


class ImageView(View):
    """One of the two images."""

    padding = ImVec2(1, 1)
    flags = int(
        imgui.WindowFlags_.no_scrollbar
        | imgui.WindowFlags_.no_scroll_with_mouse
        | imgui.WindowFlags_.no_background
    )

    def __init__(self, linked: Linked) -> None:
        self._linked = linked

    def unseen(self, host: Host) -> None:
        host.renderers.forget_pane(self.name)

    def cancel(self) -> None:
        self._linked.grab = None

    def flown(self, host: Host) -> Camera | None:
        return host.state.camera

    def with_flown(self, state: AppState, camera: Camera) -> AppState:
        return state.with_camera(camera)

    def object_under(self, host: Host) -> int | None:
        if host.hovered is None or host.hovered[0] != self.name:
            return None
        row, column = host.hovered[1]
        frame = host.renderers.agreement.frame_of(host.renderers.request(host.state))
        if frame is None or row >= frame.size[1] or column >= frame.size[0]:
            return None
        number = int(frame.channel("id")[row, column])
        return number if number >= 0 else None

    def _pane(
        self,
        host: Host,
        texture: Callable[[AppState], int | None],
        error: Exception | None,
        note: str = "",
        progress: float = 1.0,
    ) -> None:
        both, shared, state = host.renderers, self._linked, host.state
        both.fit_pane(self.name, available_px(), state.images.pixel_size)
        marked = None
        if host.hovered is not None and (
            host.hovered[0] != self.name or state.images.pixel_size > 4
        ):
            marked = host.hovered[1]
        pane = Pane(
            name=self.name,
            texture=texture,
            shown=both.camera(state),
            size=both.size,
            center=host.focus.center,
            reach=host.focus.reach,
            depth_at=lambda pixel: both.depth_at(state, pixel),
            note=describe(error) if error else note,
            is_error=error is not None,
            progress=progress,
            marked=marked,
        )
        result = image_pane(pane, state, shared.grab, shared.zoom)
        shared.grab, shared.zoom = result.grab, result.zoom or shared.zoom
        if result.hovered is not None:
            host.hover(self.name, result.hovered)
        host.apply(result.state, self._wheel() if result.zoom is not None else None)

    def _wheel(self) -> tuple[str, int]:
        """The gesture that a turn of the wheel belongs to."""
        shared, now_s = self._linked, time.monotonic()
        shared.wheel_number += now_s - shared.wheel_s > WHEEL_PAUSE_S
        shared.wheel_s = now_s
        return ("wheel", shared.wheel_number)


class RasterView(ImageView):
    name = RASTER
    title = "Raster  object order"

    def draw(self, host: Host) -> None:
        self._pane(host, host.renderers.raster_texture, host.renderers.raster_error)


class RayView(ImageView):
    name = RAY
    title = "Ray  image order"

    def draw(self, host: Host) -> None:
        both, image = host.renderers, host.renderers.ray_image
        refining = image is not None and image.factor > 1
        progress = both.live.progress if refining else 1.0
        self._pane(host, both.ray_texture, both.ray_error, both.preparing(), progress)
        both.trace(host.state)
