"""The outside view as a vector drawing: for its export as SVG and for the image laboratory.

Owns the way from the window to a Sketch, in the window's thread; the drawing is made in another.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

import moderngl
import numpy as np
from imgui_bundle import ImVec2
from numpy.typing import NDArray

from app.host.view import Host
from app.images.progressive_ray import LiveTrace
from app.images.renderers import look_of
from app.images.request import ImageRequest
from app.images.window_rasterizer import WindowRasterizer
from app.outside import svg
from app.outside.camera_diagram import Content
from app.outside.extent import end_parameter
from app.outside.looking import nearest, scope_of, units_px
from app.outside.options import OutsideOptions
from app.outside.paint import vector_paint
from app.outside.sketch import GRID_PARTS, Sketch
from app.outside.view import OutsideView
from app.widgets import theme
from app.widgets.theme import framebuffer_scale
from renderer.errors import LucidaError, describe
from renderer.memo import Memo

if TYPE_CHECKING:
    from app.host.action import Window

Size = tuple[int, int]
PLACE = "Vector"  # see Rasterizer.draw
ALONE = (1280, 960)  # of a drawing while the outside view is not to be seen


class Sketcher:
    """Sketches of one page size; the same one again as long as nothing has changed."""

    def __init__(self) -> None:
        self._sketch = Memo(_sketch)

    def follow(
        self,
        view: OutsideView,
        host: Host,
        size: Size,
        units: tuple[float, float] | None = None,
        live: bool = False,
        shape: Size | None = None,
    ) -> Sketch:
        """Return the present inputs of a drawing.

        units: the width of a line and the size of symbols; the view's own if not given.
        live: with the live image, if that is shown. shape: of a page; what fits on such a
        page fits on this one.
        Raises LucidaError, moderngl.Error.
        """
        both, state = host.renderers, host.state
        both.need_size(state.images)
        scale = framebuffer_scale()
        extent = ImVec2(size[0] / scale, size[1] / scale)
        scope = scope_of(host, size, ImVec2(0, 0), extent, view.framing, view.extensions.points)
        looking = scope.camera.fitted(shape).fitted(size) if shape else scope.shown
        camera, image_size = both.camera(state), both.size
        options = replace(state.of(OutsideOptions), camera=None)
        marked, hits = view.rays(host, camera, image_size)
        unit, symbol = units or units_px(extent)
        assert both.textures is not None
        content = Content(
            camera, image_size, options, end_parameter(camera, host.focus.framed), tuple(hits),
            marked, GRID_PARTS, state.options.notation,
        )  # fmt: skip
        sketch = self._sketch(
            both.textures.rasterizer, both.live, theme.used(), state.scene, looking, size,
            nearest(looking, scope), unit, symbol, content, view.extra,
        )  # fmt: skip
        return replace(sketch, picture=self._picture(host)) if live and options.image else sketch

    def _picture(self, host: Host) -> NDArray[np.uint8] | None:
        """Return the raster image for the image plane. Waits for the GPU."""
        both, state = host.renderers, host.state
        request = both.request(state)
        assert both.textures is not None
        assert request is not None
        texture = both.textures.whole_raster(request, look_of(state.images))
        if texture is None:
            return None
        width, height = texture.size
        rgba = np.frombuffer(texture.read(), np.uint8).reshape(height, width, 4)
        return rgba[:, :, :3].copy()


def _sketch(
    rasterizer: WindowRasterizer, live: LiveTrace, look: theme.WindowLook, *inputs: Any
) -> Sketch:
    """Return a Sketch of its first inputs, with the colours of the look in use."""
    scene, looking, size = inputs[:3]
    surface = rasterizer.draw(ImageRequest(scene, looking, size), PLACE).surface
    values = np.frombuffer(surface.read(), np.float32).reshape(size[1], size[0], 4)
    t, tracer = values[..., 3].copy(), live.tracer_of(scene)
    fields = (*inputs, t, vector_paint(), None, tracer)
    return Sketch(*fields)


def export_diagram(window: Window, live: bool = True) -> None:
    """Run export_svg() for the window's outside view."""
    view = window.view(OutsideView)
    export_svg(view, cast(Host, window), live)  # the window is both


def export_svg(view: OutsideView, host: Host, live: bool) -> None:
    """Ask for a place, and write the present diagram; the view's own page if that is visible.

    live: with the live image, if that is shown; otherwise nothing in it has pixels.
    """
    try:
        sketch = Sketcher().follow(view, host, view.size_px or ALONE, live=live)
    except (LucidaError, moderngl.Error) as error:
        host.files.message = describe(error)
        return
    name = sketch.scene.name

    def store(path: str) -> str:
        made = sketch.draw()
        count = svg.write(path, made, f"{name}: the outside view" if name else "The outside view")
        return " ".join([f"Saved {path}, {count} bytes.", *made.notes[1:]])

    host.files.save_as_dialog(
        "Export the diagram as SVG", "diagram.svg", ("SVG files", svg.ENDING), store
    )
