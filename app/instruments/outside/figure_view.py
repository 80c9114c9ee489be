"""The outside view as a figure in a file."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Literal

import moderngl
import numpy as np
from imgui_bundle import ImVec2

from lucida.app.images.renderers import look_of
from lucida.app.images.request import ImageRequest
from lucida.app.images.window_rasterizer import WindowRasterizer
from lucida.app.instruments.outside.figure import (
    WHITE,
    Depths,
    Figure,
    figure_parts,
    with_picture,
)
from lucida.app.instruments.outside.ground import SHIFTS
from lucida.app.instruments.outside.growing import grown_diagram
from lucida.app.instruments.outside.looking import nearest, scope_of, units_px
from lucida.app.instruments.outside.mouse import Area
from lucida.app.instruments.outside.paint import figure_color, ground_of
from lucida.app.instruments.outside.projected import project
from lucida.app.instruments.outside.screen import OutsideScreen, image_plane
from lucida.app.instruments.outside.svg import svg
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.ui.contrast import Rgb
from lucida.app.ui.host import Host
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.display import Bytes, to_srgb8
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError, describe

Ground = Literal["window", "white", "transparent"]
PLACE = "Figure"  # see Rasterizer.draw
ALONE = (1280, 960)  # of a figure while the outside view is hidden
GRID_PARTS = 16  # of a side of the image plane
FINE, LARGE_PX = 2, 1 << 21  # the image's pixels a side of each of the page's; of a larger page, 1


def _figure(view: OutsideView, host: Host, size: Size, page: Rgb) -> Figure:
    """Return the present outside view as a figure, with the live image if that is shown.

    page: the colour of its ground. Raises LucidaError, moderngl.Error.
    """
    both, state = host.renderers, host.state
    exposure_ev, options = state.images.exposure_ev, state.options.outside
    both.need_size(state.images)
    scope = scope_of(host, Area.of(size, ImVec2(0, 0)), view.extensions.points)
    camera, request = scope.shown, both.request(state)
    screen = OutsideScreen(camera, size, nearest(camera, scope), *units_px(scope.extent))
    content = replace(view.content(host, screen), grid_parts=GRID_PARTS)
    assert both.textures is not None
    assert request is not None
    plane, rasterizer = image_plane(content.camera, camera, size), both.textures.rasterizer
    texture = both.textures.whole_raster(request, look_of(state.images))
    if not options.image or texture is None:
        plane = None
    image, fine_t = _image(rasterizer, ImageRequest(state.scene, camera, size), exposure_ev)
    if plane is not None and texture is not None:
        pixels = np.frombuffer(texture.read(), np.uint8).reshape(*texture.size[::-1], 4)
        image = with_picture(image, fine_t, screen, plane, pixels[..., :3], options.image_opacity)
    t = _drawn(rasterizer, ImageRequest(state.scene, camera, size))[1]
    items = project([*grown_diagram(content), *view.extensions.lines], screen)
    parts = figure_parts(items, partial(figure_color, ground=page), screen, t, plane)
    return Figure(size, parts, screen.unit_px, page, image)


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


def _image(
    rasterizer: WindowRasterizer, request: ImageRequest, exposure_ev: float
) -> tuple[Bytes, Depths]:
    """Return the shaded scene with smooth edges, (height, width, 4), transparent where nothing is
    hit, and its ray parameters. Both are FINE times the request's size if that is not large.
    """
    width, height = request.size
    fine = FINE if width * height <= LARGE_PX else 1
    size = fine * width, fine * height
    color, covered = np.zeros((*size[::-1], 3), np.float32), np.zeros((*size[::-1], 1))
    for shift in SHIFTS:  # the last one is not shifted
        camera = request.camera.shifted(*shift, size)
        drawn, t = _drawn(rasterizer, replace(request, camera=camera, size=size))
        is_hit = np.isfinite(t)[..., None]
        color += np.where(is_hit, drawn, 0)
        covered += is_hit
    rgb = to_srgb8(color / np.maximum(covered, 1), exposure_ev)
    alpha = np.round(255 / len(SHIFTS) * covered).astype(np.uint8)
    return np.concatenate([rgb, alpha], axis=2), t


def export_figure(host: Host, ground: Ground) -> None:
    """Ask for a file, and write the present outside view into it as SVG."""
    view, state = host.view(OutsideView), host.state
    behind = ground_of(state.scene.background, state.images.exposure_ev)
    page: Rgb = behind if ground == "window" else WHITE
    try:
        figure = _figure(view, host, view.size_px or ALONE, page)
    except (LucidaError, moderngl.Error) as error:
        host.files.message = describe(error)
        return
    if ground == "transparent":
        figure = replace(figure, ground=None)
    name = state.scene.name
    title = f"{name}: the outside view" if name else "The outside view"

    def store(path: str) -> str:
        content = svg(figure, title).encode()
        with atomic_write(path) as file:
            file.write(content)
        return f"Saved {path}, {len(content)} bytes."

    kind = ("SVG files", ".svg")
    host.files.save_as_dialog("Export the figure as SVG", "figure.svg", kind, store)
