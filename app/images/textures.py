"""Both images as textures that ImGui can show, in one look: channel, exposure, depths in one range.

Knows nothing of widgets and of how the images are made.
"""

from __future__ import annotations

import contextlib

import moderngl

from app.images.live_raster import LiveRaster, RasterImage
from app.images.placement import Placement
from app.images.progressive_ray import RayImage
from app.images.ray_texture import RayTexture
from app.images.request import ImageRequest
from app.images.shown import DepthBounds, Picture, ShownImage, whole
from app.images.window_rasterizer import FAILURES, WindowRasterizer
from renderer.memo import Memo
from renderer.raster import DepthRange, Look

PANE, WHOLE = "pane", "whole"


class ImageTextures:
    """In the window's context, which must be current in every call.

    smooth: see LiveRaster. rasterizer: the window's. raster: the raster image. raster_error,
    ray_error: why one of them is not shown.
    """

    def __init__(self, context: moderngl.Context, smooth: bool = True) -> None:
        self.rasterizer = WindowRasterizer(context)
        self.raster = LiveRaster(context, self.rasterizer, smooth)
        self._ray = RayTexture(context)
        self._shown_raster, self._shown_ray = ShownImage(context), ShownImage(context)
        self._in_raster: RasterImage | None = None  # what that shows
        self._range = DepthRange(context)
        self._depths: DepthBounds | None = None
        self._measured = Memo(_measured)
        self._frame = 0
        self._raster_frame = -1  # the last one that showed the raster image
        self.raster_error: Exception | None = None
        self.ray_error: Exception | None = None

    def retry(self) -> None:
        """Makes the rasterizer again, if that has failed, and puts the ray image on the GPU;
        drawing is tried in each frame."""
        self.rasterizer.retry()
        self._ray.retry()

    def begin_frame(self) -> None:
        """Once a frame, before anything else."""
        self._frame += 1
        self._shown_raster.begin_frame()
        self._shown_ray.begin_frame()
        self.raster.begin_frame()
        self._range.numbers()  # whether or not somebody will ask: then nothing is left to do

    def whole_raster(self, request: ImageRequest, look: Look) -> moderngl.Texture | None:
        """All of the raster image at its own size, otherwise as raster_in()."""
        picture = self.raster_in(whole(request.size), request, look, WHOLE)
        return picture.texture if picture is not None else None

    def raster_in(
        self,
        placement: Placement,
        request: ImageRequest,
        look: Look,
        name: str = PANE,
        under: bool = False,
        own_size: bool = False,
    ) -> Picture | None:
        """The raster image as it is seen in a window, drawn anew if it must be. name, under,
        own_size: see ShownImage.picture.

        None where that failed, see raster_error. Where OpenGL runs on the CPU, the image is coarse
        while things move, and full soon after.
        """
        try:
            image = self.raster.follow(request)
            self._raster_frame = self._frame
            if image is not self._in_raster:
                self._show_raster(image)
            if look.channel == "depth":
                self._measure(image, image.textures.surface)
            shown = self._shown_raster
            picture = shown.picture(name, look, placement, self._depths, under, own_size)
            self.raster_error = None
        except FAILURES as error:  # shown in the window, which goes on
            self.raster.forget()
            self._show_raster(None)
            self.raster_error = error
            return None
        return picture

    def raster_seen(self) -> RasterImage | None:
        """The raster image, where a view shows it: otherwise it may be of long ago."""
        return self.raster.image if self._raster_frame >= self._frame - 1 else None

    def take_ray(self, image: RayImage) -> None:
        """The traced image to show from now on."""
        self._ray.take(image)

    def ray_in(
        self,
        placement: Placement,
        request: ImageRequest,
        look: Look,
        name: str = PANE,
        under: bool = False,
        own_size: bool = False,
    ) -> Picture | None:
        """The last traced image as it is seen in a window. None as long as there is none that may
        stand in for the request's, and where putting it on the GPU failed, see ray_error."""
        ray = self._ray
        if ray.image is None or ray.gave_up:
            return None
        if not ray.image.request.may_stand_in_for(request):
            return None
        try:
            if ray.upload(look.channel):
                assert ray.uploaded is not None
                assert ray.texture is not None
                self._shown_ray.set_channels({ray.uploaded[1]: ray.texture})
            assert ray.uploaded is not None
            if not ray.uploaded[0].request.may_stand_in_for(request):
                return None  # the new image lacks the channel, and the old one is stale
            if look.channel == "depth" and self._raster_frame < self._frame - 1:
                self._measure(ray.uploaded, ray.texture)  # the raster image is not seen
            shown = self._shown_ray
            picture = shown.picture(name, look, placement, self._depths, under, own_size)
            self.ray_error = None
        except FAILURES as error:
            self._shown_ray.set_channels({})
            ray.failed()
            self.ray_error = error
            return None
        return picture

    def depths(self) -> tuple[float, float] | None:
        """The ray parameters shown white and darkest, of the frame before; None: nothing is hit."""
        return self._range.numbers()

    @property
    def unfinished(self) -> bool:
        """Whether the next frames have something to do: refine, try again, or read what the last
        one has measured."""
        is_seen = self._raster_frame >= self._frame - 1
        refines = is_seen and self.raster.unfinished
        return refines or self.raster.is_timed or self._ray.unfinished or self._range.unfinished

    def release(self) -> None:
        with contextlib.suppress(moderngl.Error):
            self.rasterizer.release()
            self._shown_raster.release()
            self._shown_ray.release()
            self._range.release()
            self._ray.release()

    def _show_raster(self, image: RasterImage | None) -> None:
        channels = {}
        if image is not None:
            drawn = image.textures
            channels = {
                "color": drawn.color,
                "depth": drawn.surface,
                "normal": drawn.surface,
                "id": drawn.object,
            }
        self._shown_raster.set_channels(channels)
        self._in_raster = image

    def _measure(self, image: object, texture: moderngl.Texture | None) -> None:
        if texture is not None:
            self._depths = self._measured(self._range, texture, image)


def _measured(depth_range: DepthRange, texture: moderngl.Texture, image: object) -> DepthBounds:
    """Measure a texture that holds an image."""
    return DepthBounds(depth_range.measure(texture))
