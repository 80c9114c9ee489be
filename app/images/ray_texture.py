"""The newest ray image, on the GPU."""

from __future__ import annotations

import moderngl

from app.images.progressive_ray import RayImage
from renderer.raster import upload

ATTEMPTS = 3  # at putting an image on the GPU, one a frame


class RayTexture:
    """In a context that must be current in every call.

    image: the one to show; None before the first. uploaded: the image and the channel that are on
    the GPU, in `texture`.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._failures = 0
        self.image: RayImage | None = None
        self.texture: moderngl.Texture | None = None
        self.uploaded: tuple[RayImage, str] | None = None

    def take(self, image: RayImage) -> None:
        """The image to show from now on."""
        self.image, self._failures = image, 0

    @property
    def gave_up(self) -> bool:
        """True if it has failed so often that it is not tried again, until retry()."""
        return self._failures >= ATTEMPTS

    @property
    def unfinished(self) -> bool:
        """True if the next frame tries again."""
        return 0 < self._failures < ATTEMPTS

    def retry(self) -> None:
        self._failures = 0

    def failed(self) -> None:
        """Discard what is on the GPU."""
        self._failures += 1
        self.uploaded = None

    def upload(self, channel: str) -> bool:
        """Puts the image's channel there, whether or not that changes anything: only what is
        shown, since a channel of a large image is 100 MB."""
        image = self.image
        assert image is not None
        if getattr(image.frame, channel) is None:  # coarse, and begun before the channel was
            if self.uploaded is not None:  # chosen: the last image stays a moment longer
                return False
            channel = "color"
        if self.uploaded == (image, channel):
            return False
        texture, self.texture = self.texture, None
        self.texture = upload(self._gl, image.shown(channel), texture)
        self.uploaded = image, channel
        return True

    def release(self) -> None:
        if self.texture is not None:
            self.texture.release()
