"""A photograph over an image, read on a thread and blended by ImGui. It costs nothing if unused."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import ImVec2, ImVec4, imgui
from numpy.typing import NDArray

from lucida.app.images.screen import Screen
from lucida.app.ui import theme
from lucida.app.ui.background import Background
from lucida.app.ui.host import Host
from lucida.app.ui.uploads import Uploads
from lucida.renderer.system.errors import describe

from .model import covered, letterboxed, path_of, pixels_of
from .reading import DecodedPhotograph, Size, decoded

Asked = tuple[Path, Size]  # the file, and the number of pixels that the photograph covers


class PhotographLayer:
    """The photograph over one view's image. The images, and the values read from them, are
    unchanged.

    uploads: the view's textures.
    """

    def __init__(self, uploads: Uploads) -> None:
        self._uploads = uploads
        self._work: Background[tuple[Asked, DecodedPhotograph]] = Background("lucida-photograph")
        self._asked: Asked | None = None
        self._path: Path | None = None
        self._photograph: DecodedPhotograph | None = None  # the photograph read last

    @property
    def busy(self) -> bool:
        """True while a photograph that the view still needs is being read."""
        return self._asked is not None and self._work.busy

    def draw(self, host: Host, screen: Screen) -> None:
        """Draw the photograph over the visible part of the image, if one is open and visible."""
        self._uploads.begin_frame()
        options, path = host.options.photograph, path_of(host.state)
        if path is None:
            self._asked = self._path = self._photograph = None
            return
        view, camera, place = host.state.view, host.renderers.camera(host.state), screen.placement
        parts = covered(view.camera, camera)
        width, height = map(min, place.size, place.extent)
        self._read(host, (path, pixels_of(parts, (width, height))))
        if self._photograph is None or self._path != path or not options.shown:
            return
        # Use the shape of the camera's own image, because its pixels may not be square.
        shape = view.own_size or pixels_of(parts, place.size)
        left, top, right, bottom = letterboxed(parts, shape, self._photograph.size)
        self._show(self._photograph.pixels, (left, top, right, bottom), screen, options.opacity)

    def close(self) -> None:
        self._work.close()

    def _read(self, host: Host, asked: Asked) -> None:
        """Request a photograph, unless it was requested last, and take the result."""
        outcome = self._work.poll()
        if outcome is not None and outcome.error is not None:
            host.files.say(describe(outcome.error))
        elif outcome is not None and outcome.value is not None:
            (self._path, _), self._photograph = outcome.value
        if asked != self._asked:
            self._asked = asked
            self._work.submit(lambda: (asked, decoded(*asked)))

    def _show(
        self,
        pixels: NDArray,
        parts: tuple[float, float, float, float],
        screen: Screen,
        opacity: float,
    ) -> None:
        """Draw the pixels over a part of the image: left, top, right, bottom, as fractions."""
        place = screen.placement
        low, far, corner, extent = [0, 0], [0, 0], [0.0, 0.0], [0.0, 0.0]
        for axis in (0, 1):
            start = place.origin[axis] + parts[axis] * place.extent[axis]
            length = (parts[axis + 2] - parts[axis]) * place.extent[axis]
            low[axis] = max(round(start), place.visible[axis])
            far[axis] = min(round(start + length), place.visible[axis + 2])
            corner[axis] = (low[axis] - start) / length
            extent[axis] = (far[axis] - low[axis]) / length
        if low[0] >= far[0] or low[1] >= far[1]:
            return
        size = far[0] - low[0], far[1] - low[1]
        texture = self._uploads.magnified(
            "photograph", pixels, size, (corner[0], corner[1]), (extent[0], extent[1])
        )
        imgui.get_window_draw_list().add_image(
            imgui.ImTextureRef(texture.glo),
            screen.corner + ImVec2(*low) / screen.scale,
            screen.corner + ImVec2(*far) / screen.scale,
            col=theme.u32(ImVec4(1, 1, 1, opacity)),
        )
