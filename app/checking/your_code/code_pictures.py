"""The pictures of an answer on the screen: the given one and the correct one.

This module runs the thread that makes them, and keeps their textures and the clicked pixel.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import NDArray

from lucida.app.images.ray_pictures import RayPainter, RayPictures
from lucida.app.instruments.outside.paint import role_color
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.host import Host
from lucida.app.ui.messages import wrapped
from lucida.app.ui.picture_grid import GridPicture, picture_grid
from lucida.app.ui.uploads import Uploads
from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.display import to_srgb8
from lucida.renderer.system.errors import LucidaError, describe
from lucida.renderer.system.memo import Memo

from .model import CodeRays, CodeReport, canvas_pixel

Bytes = NDArray[np.uint8]
PICTURES = ("given", "right")


@dataclass(frozen=True, eq=False)
class CodePictures:
    """Pictures of an answer: uint8 (H, W, 3), sRGB. Missing pixels are black."""

    given: Bytes
    right: Bytes

    @property
    def size(self) -> tuple[int, int]:
        height, width = self.right.shape[:2]
        return width, height


class PicturesShown:
    """The pictures of a report. Call follow() once a frame. pictures: those on screen, or None."""

    def __init__(self, host: Host, context: moderngl.Context) -> None:
        self._painter: RayPictures[CodePictures] = RayPictures("lucida-your-pictures", host.animate)
        self._uploads = Uploads(context)
        self._upload = Memo(_upload)
        self.pictures: CodePictures | None = None

    @property
    def busy(self) -> bool:
        return self._painter.busy

    @property
    def expected(self) -> bool:
        """True if there are pictures or will be, so that their space is reserved."""
        return bool(self.pictures or self._painter.busy or self._painter.error)

    def begin_frame(self) -> None:
        self._uploads.begin_frame()

    def forget(self) -> None:
        """Show nothing, and drop pictures in progress."""
        self._painter.forget()
        self.pictures = None

    def close(self) -> None:
        self._painter.close()
        self._uploads.release()

    def follow(self, host: Host, report: CodeReport) -> None:
        """Update the pictures for the report. The previous ones of the same scene stay until the
        new ones are ready.
        """
        rays, state = report.rays, host.state
        if rays is None or not rays.came.any():
            self.forget()
        else:
            key, live = (rays, state.images.exposure_ev), host.renderers.live
            make = partial(_painted, rays=rays, exposure_ev=state.images.exposure_ev)
            self.pictures = self._painter.follow(key, state.scene, live, make)
        self._upload(self._uploads, self.pictures)

    def draw(self, host: Host, report: CodeReport, room: ImVec2, marked: Pixel | None) -> None:
        """Draw the pictures, or the reason why there are none. A click marks a pixel in all views.

        marked: see marked_pixel().
        """
        pictures, rays = self.pictures, report.rays
        if pictures is None:
            error = self._painter.error
            imgui.begin_child("waiting", room)
            text = describe(error) if error is not None else host.renderers.preparing()
            wrapped(text, theme.ERROR if error is not None else theme.DIM)
            imgui.end_child()
            return
        is_of_rays = rays is not None and pictures.size == rays.size  # not of earlier rays
        pixel, color = marked if is_of_rays else None, role_color("other")
        given, right = map(self._uploads.get, PICTURES)
        grid = [
            GridPicture("given", "yours", given, frame=color, pixel=pixel),
            GridPicture("right", "correct", right, pixel=pixel),
        ]
        try:
            clicked = picture_grid(grid, pictures.size, room, host.fonts)
        except LucidaError as error:
            imgui.text_colored(theme.ERROR, describe(error))
            return
        if clicked is not None and rays is not None and is_of_rays:
            again = host.state.marked is not None and clicked == marked
            found = canvas_pixel(clicked, rays.camera, rays.size, *_images(host))
            options = replace(host.state.options, marked=None if again else found)
            host.change(host.state.with_options(options))


def marked_pixel(host: Host, report: CodeReport) -> Pixel | None:
    """Return the marked pixel, in the pictures; without a mark, the first wrong one."""
    rays, marked = report.rays, host.state.marked
    if rays is None:
        return None
    if marked is not None:
        return canvas_pixel(marked, *_images(host), rays.camera, rays.size)
    wrong = np.argwhere(rays.wrong)
    return (int(wrong[0, 0]), int(wrong[0, 1])) if len(wrong) else None


def _images(host: Host) -> tuple[Camera, tuple[int, int]]:
    return host.renderers.camera(host.state), host.renderers.size


def _painted(painter: RayPainter, rays: CodeRays, exposure_ev: float) -> CodePictures:
    given, right = (
        painter.picture(one[..., 0, :], one[..., 1, :], rays.camera.t_range)
        for one in (rays.given, rays.right)
    )
    given = np.where(rays.came[..., None], given, 0)
    return CodePictures(to_srgb8(given, exposure_ev), to_srgb8(right, exposure_ev))


def _upload(uploads: Uploads, pictures: CodePictures | None) -> None:
    if pictures is not None:
        for name in PICTURES:
            uploads.put_pixels(name, getattr(pictures, name))
