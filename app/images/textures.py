"""Both images as textures for ImGui, with the same look: channel, exposure and depth range."""

from __future__ import annotations

import contextlib

import moderngl

from lucida.renderer.raster import DepthRange, Look, upload
from lucida.renderer.system.memo import Memo

from .live_raster import Choice, LiveRaster, RasterImage
from .placement import Placement
from .progressive_ray import RayImage
from .request import ImageRequest
from .shown import DepthBounds, Picture, Pictures, Source, whole
from .window_rasterizer import FAILURES, WindowRasterizer

PANE, WHOLE = "pane", "whole"
ATTEMPTS = 3  # to upload a ray image, one per frame


class ImageTextures:
    """The images in the window's context, which must be current in every call.

    choice: see LiveRaster. rasterizer: the window's. raster: the raster image. raster_error,
    ray_error: the reason that an image is missing.
    """

    def __init__(
        self, context: moderngl.Context, choice: Choice = lambda request: (request, 1)
    ) -> None:
        self._gl, self._choice = context, choice
        self.rasterizer = WindowRasterizer(context)
        self.raster = LiveRaster(context, self.rasterizer, choice)
        self._pictures = Pictures(context)
        self._ray: RayImage | None = None
        self._uploaded: tuple[RayImage, str] | None = None  # image and channel in _ray_texture
        self._ray_texture: moderngl.Texture | None = None
        self._upload_count = 0
        self._z_image: RasterImage | None = None
        self._z_texture: moderngl.Texture | None = None  # of that image
        self._ray_failures = 0
        self._range = DepthRange(context)
        self._depths: DepthBounds | None = None
        self._measured = Memo(_measured)
        self._frame = 0
        self._raster_frame = -1  # the last frame that showed the raster image
        self.raster_error: Exception | None = None
        self.ray_error: Exception | None = None

    def retry(self) -> None:
        """Create the rasterizer and upload the ray image again after a failure. Drawing is retried
        in each frame.
        """
        self.rasterizer.retry()
        self._ray_failures = 0

    def begin_frame(self) -> None:
        """Begin a frame. Call this once a frame, before anything else."""
        self._frame += 1
        self._pictures.begin_frame()
        self.raster.begin_frame()
        self._range.numbers()  # read them even if they are not needed, so that no work is left

    def whole_raster(self, request: ImageRequest, look: Look) -> moderngl.Texture | None:
        """Return the whole raster image, row 0 at the top; otherwise like raster_in()."""
        picture = self.raster_in(whole(request.size), request, look, WHOLE)
        return picture.texture if picture is not None else None

    def raster_in(
        self,
        placement: Placement,
        request: ImageRequest,
        look: Look,
        name: str = PANE,
    ) -> Picture | None:
        """Return the visible part of the raster image in a window, drawn again if necessary; None
        if that failed, see raster_error.

        name: see Pictures.picture.
        """
        try:
            image = self.raster.follow(request)
            self._raster_frame = self._frame
            source = image.texture(look.channel), image
            if _shows_z(request, look):
                source = self._z_source(image), image
            if look.channel == "depth":
                self._measure(source)
            picture = self._pictures.picture(name, look, placement, source, self._depths)
            self.raster_error = None
            return picture
        except FAILURES as error:  # the window shows it, and continues
            self.raster.forget()
            self.raster_error = error
            return None

    @property
    def sees_raster(self) -> bool:
        """True if a view shows the raster image; otherwise it may be out of date."""
        return self._raster_frame >= self._frame - 1

    def take_ray(self, image: RayImage) -> None:
        """Show this ray image from now on."""
        self._ray, self._ray_failures = image, 0

    def ray_in(
        self,
        placement: Placement,
        request: ImageRequest,
        look: Look,
        name: str = PANE,
    ) -> Picture | None:
        """Return the visible part of the last ray image in a window; None if its camera differs
        from the raster image's, or if uploading it failed, see ray_error.
        """
        image = self._ray
        if image is None or self._ray_failures >= ATTEMPTS:
            return None
        if not image.is_beside(self._choice(request)[0]):
            return None
        try:
            source = self._upload(image, "z" if _shows_z(request, look) else look.channel)
            if look.channel == "depth" and not self.sees_raster:
                self._measure(source)
            picture = self._pictures.picture(f"{name} ray", look, placement, source, self._depths)
            self.ray_error = None
            return picture
        except FAILURES as error:
            self._uploaded, self._ray_failures, self.ray_error = None, self._ray_failures + 1, error
            return None

    def depths(self) -> tuple[float, float] | None:
        """Return the ray parameters shown white and darkest in the last frame; None if nothing was
        hit.
        """
        return self._range.numbers()

    @property
    def unfinished(self) -> bool:
        """True if the next frames will refine an image, retry, or read a measurement."""
        refines = self.sees_raster and self.raster.unfinished
        tries_again = 0 < self._ray_failures < ATTEMPTS
        return refines or self.raster.is_timed or tries_again or self._range.unfinished

    def release(self) -> None:
        self.raster.lens_tables.close()
        with contextlib.suppress(moderngl.Error):
            for part in (self.rasterizer, self._pictures, self._range):
                part.release()
            for texture in (self._ray_texture, self._z_texture):
                if texture is not None:
                    texture.release()

    def _upload(self, image: RayImage, channel: str) -> Source:
        """Upload one channel unless it is already uploaded; a large image's takes 100 MB."""
        if self._uploaded != (image, channel) or self._ray_texture is None:
            texture, self._ray_texture = self._ray_texture, None  # upload() releases it if it fails
            self._ray_texture = upload(self._gl, image.shown(channel), texture)
            self._uploaded, self._upload_count = (image, channel), self._upload_count + 1
        return self._ray_texture, self._upload_count  # not the image, which would stay alive

    def _z_source(self, image: RasterImage) -> moderngl.Texture:
        """Return the raster image's distances z, uploaded if necessary."""
        if self._z_image is not image or self._z_texture is None:
            z = self.raster.z(image)
            texture, self._z_texture = self._z_texture, None  # upload() releases it if it fails
            self._z_texture, self._z_image = upload(self._gl, z, texture), image
        return self._z_texture

    def _measure(self, source: Source) -> None:
        self._depths = self._measured(self._range, source)


def _shows_z(request: ImageRequest, look: Look) -> bool:
    return request.channel == "z" and look.channel == "depth"


def _measured(depth_range: DepthRange, source: Source) -> DepthBounds:
    return DepthBounds(depth_range.measure(source[0]))
