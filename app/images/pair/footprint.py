"""The enlarged square of one pixel: the camera's view of it, and the samples taken there."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from lucida.app.images.request import ImageRequest
from lucida.app.images.screen import Screen
from lucida.app.images.window_rasterizer import WindowRasterizer
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.display import to_srgb8
from lucida.renderer.images.samples import offsets

CELLS = 32  # a side of the enlarged square
AROUND = 0.25  # width of the visible neighbourhood, in pixels
PART = 0.46  # of the image's height, for the inset
DRAWN = "footprint"

Colors = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class Footprint:
    """A pixel's square, in sRGB.

    fine: with a margin, (CELLS, CELLS, 3). samples: (k, k, 3), those in the cells of a k x k grid.
    mean: their mean in linear light.
    """

    fine: Colors
    samples: Colors
    mean: Colors


def square(camera: Camera, size: tuple[int, int], pixel: Pixel, margin: float = 0.0) -> Camera:
    """Return the camera that sees only one pixel of an image, with a margin in pixels."""
    left, right, bottom, top = camera.viewport
    wide, high = (right - left) / size[0], (top - bottom) / size[1]
    x, y = left + pixel[1] * wide, top - pixel[0] * high
    ends = (x - margin * wide, x + (1 + margin) * wide)
    return replace(camera, viewport=(*ends, y - (1 + margin) * high, y + margin * high))


def footprint(
    rasterizer: WindowRasterizer, request: ImageRequest, pixel: Pixel, samples: int
) -> Footprint:
    """Draw the square of a pixel."""
    side = math.isqrt(samples)
    fine = _drawn(rasterizer, request, square(request.camera, request.size, pixel, AROUND), CELLS)
    taken = _drawn(rasterizer, request, square(request.camera, request.size, pixel), side)
    return Footprint(to_srgb8(fine), to_srgb8(taken), to_srgb8(taken.mean(axis=(0, 1))))


def _drawn(
    rasterizer: WindowRasterizer, request: ImageRequest, camera: Camera, side: int
) -> NDArray[np.float32]:
    part = ImageRequest(request.scene, camera, (side, side))
    texture = rasterizer.draw(part, DRAWN).color
    return np.frombuffer(texture.read(), np.float32).reshape(side, side, 4)[..., :3]


def draw_footprint(screen: Screen, pixel: Pixel, seen: Footprint) -> None:
    """Draw the inset in the image's corner, and lines to it from the pixel."""
    draw, em = imgui.get_window_draw_list(), imgui.get_font_size()
    low, far = screen.visible
    side, count = min(PART * (far.y - low.y), 0.4 * (far.x - low.x)), len(seen.samples)
    pixel_at = screen.point(pixel[0] + 0.5, pixel[1] + 0.5)
    is_right = pixel_at.x > (low.x + far.x) / 2
    corner = ImVec2(low.x + em if is_right else far.x - side - 6 * em, low.y + em)
    end = corner + ImVec2(side, side)
    mark, text_color = theme.u32(theme.MARK), theme.u32(theme.TEXT)
    draw.push_clip_rect(low, far, True)
    for x in (corner.x, end.x):
        draw.add_line(pixel_at, ImVec2(x, end.y), theme.u32(theme.MARK, 0.8), theme.line_px(1.5))
    cell = side / CELLS
    for i, row in enumerate(seen.fine):
        for j, color in enumerate(row):
            at = corner + ImVec2(j, i) * cell
            draw.add_rect_filled(at, at + ImVec2(cell + 0.5, cell + 0.5), _ink(color))
    whole = side / (1 + 2 * AROUND)
    inner = corner + ImVec2(AROUND, AROUND) * whole
    draw.add_rect(corner, end, text_color, 0.0, theme.line_px(1.5))
    draw.add_rect(inner, inner + ImVec2(whole, whole), mark, 0.0, theme.line_px(2.5))
    radius = max(2.0, min(theme.px(7), 0.24 * whole / count))
    for (down, right), color in zip(offsets(count**2), seen.samples.reshape(-1, 3), strict=True):
        at = inner + ImVec2(right + 0.5, down + 0.5) * whole
        draw.add_circle_filled(at, radius + theme.px(2), theme.u32(theme.rgb("#000000")))
        draw.add_circle_filled(at, radius + theme.px(1), mark)
        draw.add_circle_filled(at, radius, _ink(color))
    swatch, below = ImVec2(end.x, corner.y), max(side, 4.4 * em)
    draw.add_rect_filled(swatch, swatch + ImVec2(5 * em, below), theme.u32(theme.PANEL, 0.92))
    text = "1 sample" if count == 1 else f"mean of {count**2}"
    shift = ImVec2((5 * em - imgui.calc_text_size(text).x) / 2, 0.4 * em)
    draw.add_text(swatch + shift, text_color, text)
    box = swatch + ImVec2(1.2, 2) * em, swatch + ImVec2(3.8 * em, below - 0.6 * em)
    draw.add_rect_filled(*box, _ink(seen.mean))
    draw.add_rect(*box, mark, 0.0, theme.line_px(2))
    draw.pop_clip_rect()


def _ink(color: Colors) -> int:
    red, green, blue = (int(value) for value in color)
    return 0xFF000000 | blue << 16 | green << 8 | red
