"""The outside view as a figure in a file.

A Sketch is made on the window's thread, its figure and the file on another.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Literal

import moderngl
import numpy as np
from imgui_bundle import ImVec2
from numpy.typing import NDArray

from lucida.app.images.renderers import look_of
from lucida.app.images.request import ImageRequest
from lucida.app.images.window_rasterizer import WindowRasterizer
from lucida.app.instruments.outside.camera_diagram import Content
from lucida.app.instruments.outside.diagram import Item, Role
from lucida.app.instruments.outside.figure import (
    WHITE,
    Color,
    Depths,
    Figure,
    PlaneImage,
    figure_parts,
    with_picture,
)
from lucida.app.instruments.outside.ground import SHIFTS
from lucida.app.instruments.outside.growing import grown_diagram
from lucida.app.instruments.outside.looking import nearest, scope_of, units_px
from lucida.app.instruments.outside.paint import figure_color, ground_of
from lucida.app.instruments.outside.projected import project
from lucida.app.instruments.outside.screen import OutsideScreen, image_plane
from lucida.app.instruments.outside.svg import svg
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.ui.contrast import Rgb
from lucida.app.ui.host import Host
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.display import to_srgb8
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError, describe

if TYPE_CHECKING:
    from lucida.app.ui.host import Host

Ground = Literal["window", "white", "transparent"]
PLACE = "Figure"  # see Rasterizer.draw
ALONE = (1280, 960)  # of a figure while the outside view is hidden
GRID_PARTS = 16  # of a side of the image plane
FINE, LARGE_PX = 2, 1 << 21  # the image's pixels a side of each of the page's; of a larger page, 1


@dataclass(frozen=True, eq=False)
class Sketch:
    """The inputs of a figure.

    t: (height, width), of the scene at the page's pixels. color: of a role and a tint. picture, on
    the image plane, and image: as in Figure; None for neither.
    """

    scene: Scene
    screen: OutsideScreen
    content: Content
    extra: tuple[Item, ...]
    t: Depths
    color: Callable[[Role, float], Color]
    ground: Color | None
    picture: PlaneImage | None = None
    image: NDArray[np.uint8] | None = None

    def figure(self) -> Figure:
        """Return the figure."""
        screen = self.screen
        items = [*grown_diagram(self.content), *self.extra]
        plane = None if self.picture is None else self.picture.plane
        parts = figure_parts(project(items, screen), self.color, screen, self.t, plane)
        return Figure(screen.size, parts, screen.unit_px, self.ground, self.image)


def _sketch(view: OutsideView, host: Host, size: Size, ground: Rgb) -> Sketch:
    """Return the present inputs of a figure, without the scene's image.

    ground: the colour that the lines must contrast with. Raises LucidaError, moderngl.Error.
    """
    both, state = host.renderers, host.state
    both.need_size(state.images)
    scale = framebuffer_scale()
    extent = ImVec2(size[0] / scale, size[1] / scale)
    scope = scope_of(host, size, ImVec2(0, 0), extent, view.extensions.points)
    assert both.textures is not None
    screen = OutsideScreen(scope.shown, size, nearest(scope.shown, scope), *units_px(extent))
    content = replace(view.content(host, screen), grid_parts=GRID_PARTS)
    t = _drawn(both.textures.rasterizer, ImageRequest(state.scene, scope.shown, size))[1]
    color = partial(figure_color, ground=ground)
    return Sketch(state.scene, screen, content, view.extra, t, color, ground)


def _drawn(rasterizer: WindowRasterizer, request: ImageRequest) -> tuple[Depths, Depths]:
    """Return the colours (height, width, 3) in linear light, and the ray parameters (height,
    width). Waits for the GPU.
    """
    textures, (width, height) = rasterizer.draw(request, PLACE), request.size
    color, surface = (
        np.frombuffer(texture.read(), np.float32).reshape(height, width, 4)
        for texture in (textures.color, textures.surface)
    )
    return color[..., :3].copy(), surface[..., 3].copy()


def _with_image(sketch: Sketch, host: Host) -> Sketch:
    """Return the sketch with the shaded scene, and the live image if that is shown."""
    both, screen, state = host.renderers, sketch.screen, host.state
    assert both.textures is not None
    request = both.request(state)
    assert request is not None
    size, is_parallel = screen.size, screen.camera.is_parallel
    fine = FINE if size[0] * size[1] <= LARGE_PX else 1
    width, height = fine * size[0], fine * size[1]
    color, covered = np.zeros((height, width, 3), np.float32), np.zeros((height, width, 1))
    for shift in SHIFTS:  # smooth edges; the last one is not shifted
        camera = screen.camera.shifted(*shift, (width, height))
        seen = ImageRequest(state.scene, camera, (width, height))
        drawn, t = _drawn(both.textures.rasterizer, seen)
        is_hit = np.isfinite(t)[..., None]
        color += np.where(is_hit, drawn, 0)
        covered += is_hit
    _drawn(both.textures.rasterizer, replace(seen, size=(1, 1)))  # frees the large textures
    rgb = to_srgb8(color / np.maximum(covered, 1), state.images.exposure_ev)
    alpha = np.round(255 / len(SHIFTS) * covered).astype(np.uint8)
    image, picture = np.concatenate([rgb, alpha], axis=2), None
    plane = image_plane(sketch.content.camera, screen.camera, size)
    texture = both.textures.whole_raster(request, look_of(state.images))
    if sketch.content.options.image and plane is not None and texture is not None:
        pixels = np.frombuffer(texture.read(), np.uint8).reshape(*texture.size[::-1], 4)
        opacity = sketch.content.options.image_opacity
        picture = PlaneImage(pixels[..., :3], plane, opacity)
        image = with_picture(image, t, picture, size, is_parallel)
    return replace(sketch, image=image, picture=picture)


def export_figure(host: Host, ground: Ground) -> None:
    """Ask for a file, and write the present outside view into it as SVG."""
    view, state = host.view(OutsideView), host.state
    behind = ground_of(state.scene.background, state.images.exposure_ev)
    page: Rgb = behind if ground == "window" else WHITE
    try:
        sketch = _sketch(view, host, view.size_px or ALONE, page)
        sketch = _with_image(sketch, host)
    except (LucidaError, moderngl.Error) as error:
        host.files.message = describe(error)
        return
    if ground == "transparent":
        sketch = replace(sketch, ground=None)
    name = sketch.scene.name
    title = f"{name}: the outside view" if name else "The outside view"

    def store(path: str) -> str:
        content = svg(sketch.figure(), title).encode()
        with atomic_write(path) as file:
            file.write(content)
        return f"Saved {path}, {len(content)} bytes."

    kind = ("SVG files", ".svg")
    host.files.save_as_dialog("Export the figure as SVG", "figure.svg", kind, store)
