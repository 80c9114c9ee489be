"""Textures of pictures that are arrays, for ImGui."""

from __future__ import annotations

from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.raster.resources import check
from lucida.renderer.system.memo import same

ENLARGED_PX = 640  # the approximate width of a texture with enlarged pixels
KEPT_FRAMES = 3  # the window may still show a texture in the frame in which it was replaced


class Uploads:
    """Textures by name, in a context that must be current in every call."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._textures: dict[str, moderngl.Texture] = {}
        self._retired: list[tuple[int, moderngl.Texture]] = []
        self._frame = 0
        self._magnified: dict[str, tuple[Any, ...]] = {}  # the arguments of magnified()

    def put(self, name: str, picture: NDArray[np.uint8]) -> None:
        """Upload a picture, replacing the last one of that name.

        picture: (H, W, 3), or (H, W, 4) with opacity; sRGB, row 0 at the top. Raises LucidaError if
        there is no memory for it.
        """
        self.drop(name)
        height, width, components = picture.shape
        _ = self._gl.error  # clear OpenGL errors left by other code
        texture = self._gl.texture(
            (width, height), components, np.ascontiguousarray(picture).tobytes(), alignment=1
        )
        check(self._gl, f"a texture of {width}x{height}")
        texture.filter = moderngl.NEAREST, moderngl.NEAREST
        texture.repeat_x = texture.repeat_y = False
        self._textures[name] = texture

    def put_pixels(self, name: str, picture: NDArray[np.uint8]) -> None:
        """Same as put(), with enlarged pixels that appear as squares: ImGui smooths what it
        enlarges.
        """
        times = max(1, ENLARGED_PX // picture.shape[1])
        self.put(name, picture.repeat(times, axis=0).repeat(times, axis=1))

    def magnified(
        self,
        name: str,
        picture: NDArray[np.uint8],
        size: tuple[int, int],
        corner: tuple[float, float],
        extent: tuple[float, float],
    ) -> moderngl.Texture:
        """Return a texture of (width, height) with a part of a picture, by nearest neighbour.

        corner, extent: the part's, as fractions of the picture's width and height.
        """
        key = picture, size, corner, extent
        if name not in self._textures or not same(self._magnified.get(name), key):
            self.put(name, nearest(*key))
            self._magnified[name] = key
        return self._textures[name]

    def get(self, name: str) -> moderngl.Texture | None:
        return self._textures.get(name)

    def drop(self, name: str) -> None:
        texture = self._textures.pop(name, None)
        if texture is not None:
            self._retired.append((self._frame, texture))

    def begin_frame(self) -> None:
        """Release textures that no frame shows any more. Call once a frame."""
        self._frame += 1
        while self._retired and self._frame - self._retired[0][0] > KEPT_FRAMES:
            self._retired.pop(0)[1].release()

    def release(self) -> None:
        for name in list(self._textures):
            self.drop(name)
        for _, texture in self._retired:
            texture.release()
        self._retired.clear()


def nearest(
    picture: NDArray[np.uint8],
    size: tuple[int, int],
    corner: tuple[float, float],
    extent: tuple[float, float],
) -> NDArray[np.uint8]:
    """Return a part of a picture at (width, height) pixels. The arguments are those of
    Uploads.magnified().
    """
    rows, columns = (
        np.clip(
            (corner[axis] + (np.arange(size[axis]) + 0.5) / size[axis] * extent[axis])
            * picture.shape[1 - axis],
            0,
            picture.shape[1 - axis] - 1,
        ).astype(int)
        for axis in (1, 0)
    )
    return picture[rows[:, None], columns]
