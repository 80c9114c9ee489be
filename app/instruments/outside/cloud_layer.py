"""A cloud's picture in the outside view, redrawn when the cloud or the view changes."""

from __future__ import annotations

from typing import Any

import moderngl
import numpy as np

from lucida.app.ui.contrast import Rgb
from lucida.renderer.raster.cloud import POINT, CloudLook, CloudPicture, CloudRenderer, Rgba

from .cloud import Cloud
from .paint import line_color
from .screen import OutsideScreen

NEAREST = 1e-3  # times the cloud's reach: points nearer to the outside camera are not drawn
CASING_PX = 0.9  # a casing's width on each side of a line, in widths of the line
POINT_PX, FEW = 2.0, 30_000  # a point's width; 1.5 times that for fewer points


class CloudLayer:
    """A renderer of one view's cloud, in the view's OpenGL context."""

    def __init__(self, context: moderngl.Context) -> None:
        self._renderer = CloudRenderer(context)
        self._cloud: Cloud | None = None
        self._key: Any = None
        self._picture: CloudPicture | None = None

    def picture(
        self, cloud: Cloud | None, screen: OutsideScreen, ground: Rgb
    ) -> CloudPicture | None:
        """Return the picture, or None without a cloud.

        ground: the colour under it. Raises LucidaError.
        """
        if cloud is not self._cloud:
            self._take(cloud)
        if cloud is None:
            return None
        ink = line_color(cloud.lines, ground)
        key = (cloud, screen.camera, screen.size, screen.unit_px, ink)
        if key != self._key:
            self._picture = self._renderer.draw(screen.size, _look(cloud, screen, ink))
            self._key = key
        return self._picture

    def release(self) -> None:
        self._renderer.release()

    def _take(self, cloud: Cloud | None) -> None:
        """Upload a cloud, or none."""
        self._cloud, self._key = cloud, None
        lines, points = np.zeros((0, 2, 3), np.float32), np.zeros(0, POINT)
        if cloud is not None:
            lines = (cloud.lines.segments - cloud.origin).astype(np.float32)
            points = np.zeros(len(cloud.points), POINT)
            points["place"], points["color"] = cloud.points, cloud.colors
        self._renderer.take_points(points)
        self._renderer.take_lines(lines)


def _look(cloud: Cloud, screen: OutsideScreen, ink: Rgba) -> CloudLook:
    matrix = screen.camera.image_from_world(screen.size)
    matrix[:, 3] += matrix[:, :3] @ cloud.origin
    middle = cloud.middle - cloud.origin
    away = float(matrix[2, :3] @ middle + matrix[2, 3])
    reach = max(cloud.reach * float(np.linalg.norm(matrix[2, :3])), NEAREST * abs(away))
    near = max(away - 1.1 * reach, NEAREST * reach)
    unit_px = screen.unit_px
    point_px = POINT_PX * unit_px * (1.5 if len(cloud.points) < FEW else 1.0)
    return CloudLook(
        matrix, screen.camera.is_parallel, near, max(away + 1.1 * reach, 2 * near), ink,
        cloud.lines.width * unit_px, CASING_PX * unit_px, point_px,
    )  # fmt: skip
