"""The outside view as a figure."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from imgui_bundle import ImVec2

from lucida.app.images.renderers import look_of
from lucida.app.images.request import ImageRequest
from lucida.app.images.window_rasterizer import WindowRasterizer
from lucida.app.ui.contrast import Rgb
from lucida.app.ui.host import Host
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.display import Bytes, to_srgb8

from .figure import Depths, Figure, figure_parts, with_picture
from .ground import SHIFTS
from .growing import grown_diagram
from .looking import nearest, scope_of
from .mouse import Area
from .paint import figure_color
from .projected import project
from .screen import OutsideScreen, image_plane
from .view import OutsideView

PLACE = "Figure"  # see Rasterizer.draw
GRID_PARTS = 16  # per side of the image plane
FINE, LARGE_PX = 2, 1 << 21  # image pixels per side of a page pixel; 1 for larger pages


def outside_figure(host: Host, size: Size, scale: float, page: Rgb) -> Figure:
    """Return the current outside view as a figure, with the live image if that is shown.

    scale: the scale of lines and letters. page: the colour of its ground. Raises LucidaError,
    moderngl.Error.
    """
    view, both, state = host.view(OutsideView), host.renderers, host.state
    exposure_ev, options = state.images.exposure_ev, state.options.outside
    both.need_size(state.images)
    area = Area(size, ImVec2(0, 0), ImVec2(size[0] / scale, size[1] / scale))
    scope = scope_of(host, area, view.extensions.points)
    camera, request = scope.shown, both.request(state)
    screen = OutsideScreen(camera, size, nearest(camera, scope), scale, scale)
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
    fine = image.shape[0] // size[1]
    t = fine_t[fine // 2 :: fine, fine // 2 :: fine]
    items = project([*grown_diagram(content), *view.extensions.lines], screen)
    parts = figure_parts(items, partial(figure_color, ground=page), screen, t, plane)
    return Figure(size, parts, screen.unit_px, page, image)


def _drawn(rasterizer: WindowRasterizer, request: ImageRequest) -> tuple[Depths, Depths]:
    """Return the colours (height, width, 3) in linear light, and the ray parameters (height,
    width). Wait for the GPU.
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
