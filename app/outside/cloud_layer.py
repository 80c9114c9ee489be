"""A cloud's picture in the outside view: drawn at once as far as a frame has time, refined after.

While the view moves, a device that is slow draws the first of the points, and lines a pixel wide;
when it is still, the rest, some in each frame. Owns the picture and what is still missing in it.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import moderngl
import numpy as np

from app.outside.cloud import Cloud
from app.outside.paint import CASING, line_color
from app.outside.screen import OutsideScreen
from app.widgets import theme
from renderer.raster.cloud import POINT, CloudLook, CloudPicture, CloudRenderer, Rgba
from renderer.raster.overlay import screen_from_world

FRAME_S = 0.006  # what it may take of a frame while the view moves
PART_S = 0.02  # and of one in which it is refined
STILL_S = 0.15  # without a change, before it is
FIRST = 20_000  # points in a first frame, while nothing has been measured
NEAREST = 1e-3  # of the cloud's reach: what is nearer to the eye that looks is not drawn
CASING_PX = 0.9  # beside a line, in widths of a line that teaches
POINT_PX, FEW = 2.0, 30_000  # a point's width; where there are few, half again
# What is assumed before it is measured, of a point, a thin line, a wide one.
GUESSED_S = {"points": FRAME_S / FIRST, "thin": 3e-7, "wide": 2e-6}


class _Pace:
    """Measures how long the device takes for each item of one kind.

    A time is read when the next measurement begins: reading it at once would wait for the device.
    """

    def __init__(self, context: moderngl.Context, each_s: float) -> None:
        self._timer = context.query(time=True)
        self._each_s = each_s
        self._timed = 0

    def many(self, budget_s: float) -> int:
        self._read()
        return max(int(budget_s / self._each_s), 1)

    @contextmanager
    def timed(self, count: int) -> Iterator[None]:
        self._read()
        with self._timer:
            yield
        self._timed = count

    def _read(self) -> None:
        if self._timed:
            each_s = max(self._timer.elapsed * 1e-9 / self._timed, 1e-10)
            # Something else may have had the device: what is slower counts half.
            slower = each_s > self._each_s
            self._each_s = (each_s + self._each_s) / 2 if slower else each_s
            self._timed = 0


class CloudLayer:
    """One for the view, in its context. number: another one whenever the picture is another."""

    def __init__(self, context: moderngl.Context) -> None:
        self._renderer = CloudRenderer(context)
        self._pace = {name: _Pace(context, each_s) for name, each_s in GUESSED_S.items()}
        self._cloud: Cloud | None = None
        self._key: Any = None
        self._picture: CloudPicture | None = None
        self._changed_s = 0.0
        self._points = self._parts = 0  # that are in the picture
        self.number = 0

    @property
    def settled(self) -> bool:
        """True if the picture is complete."""
        cloud = self._cloud
        if cloud is None or self._picture is None:
            return True
        return self._points == len(cloud.points) and self._parts == self._renderer.parts

    def forget(self) -> None:
        """Draw a new picture next time, because the view is hidden."""
        self._key = self._picture = None

    def picture(
        self, cloud: Cloud | None, screen: OutsideScreen, ground: theme.Rgb
    ) -> CloudPicture | None:
        """Return the picture as far as it is drawn. Each call draws more of it.

        ground: the picture under it. Raises LucidaError.
        """
        if cloud is not self._cloud:
            self._take(cloud)
        if cloud is None:
            return None
        ink = line_color(cloud.lines, ground)
        key = (cloud, screen.camera, screen.size, screen.unit_px, ink)
        if key != self._key:
            self._key, self._changed_s = key, time.monotonic()
            self._picture = self._begin(cloud, screen, ink)
        elif not self.settled and time.monotonic() - self._changed_s > STILL_S:
            self._refine(cloud)
        return self._picture

    def release(self) -> None:
        self._renderer.release()

    def _take(self, cloud: Cloud | None) -> None:
        """Upload a cloud. Unchanged points stay on the GPU: there may be millions."""
        self.forget()
        before, self._cloud = self._cloud, cloud
        if cloud is None:
            self._renderer.take_points(np.zeros(0, POINT))
            self._renderer.take_lines(np.zeros((0, 2, 3), np.float32))
            return
        self._renderer.take_lines((cloud.lines.segments - cloud.origin).astype(np.float32))
        if before is None or before.points is not cloud.points:
            points = np.zeros(len(cloud.points), POINT)
            points["place"], points["color"] = cloud.points, cloud.colors
            self._renderer.take_points(points)

    def _begin(self, cloud: Cloud, screen: OutsideScreen, ink: Rgba) -> CloudPicture:
        picture = self._renderer.begin(screen.size, _look(cloud, screen, ink))
        self._points = self._parts = 0
        self._add_points(cloud, FRAME_S / 2)  # before lines, whose edges are seen through
        lines = len(cloud.lines.segments)
        if lines <= self._pace["wide"].many(FRAME_S / 2):
            with self._pace["wide"].timed(lines):
                for part in range(self._renderer.parts):
                    self._renderer.add_lines(part)
            self._parts = self._renderer.parts
        else:
            thin = min(self._pace["thin"].many(FRAME_S / 2), lines)
            with self._pace["thin"].timed(thin):
                self._renderer.add_thin_lines(thin)
        return picture

    def _refine(self, cloud: Cloud) -> None:
        if self._points < len(cloud.points):
            self._add_points(cloud, PART_S)
            return
        count = len(cloud.lines.segments)
        with self._pace["wide"].timed(max(count // self._renderer.parts, 1)):
            self._renderer.add_lines(self._parts)
        self._parts += 1
        self.number += 1

    def _add_points(self, cloud: Cloud, budget_s: float) -> None:
        count = min(self._pace["points"].many(budget_s), len(cloud.points) - self._points)
        if count:
            with self._pace["points"].timed(count):
                self._renderer.add_points(self._points, count)
        self._points += count
        self.number += 1


def _look(cloud: Cloud, screen: OutsideScreen, ink: Rgba) -> CloudLook:
    matrix = screen_from_world(screen.camera, screen.size)
    matrix[:, 3] += matrix[:, :3] @ cloud.origin
    middle = cloud.middle - cloud.origin
    away = float(matrix[2, :3] @ middle + matrix[2, 3])
    reach = max(cloud.reach * float(np.linalg.norm(matrix[2, :3])), NEAREST * abs(away))
    near = max(away - 1.1 * reach, NEAREST * reach)
    unit_px = screen.unit_px
    point_px = POINT_PX * unit_px * (1.5 if len(cloud.points) < FEW else 1.0)
    return CloudLook(
        matrix, screen.camera.is_parallel, near, max(away + 1.1 * reach, 2 * near), ink, CASING,
        cloud.lines.width * unit_px, CASING_PX * unit_px, point_px,
    )  # fmt: skip
