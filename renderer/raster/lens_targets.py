"""The textures that the image of a camera with a lens needs next to its targets."""

from __future__ import annotations

from typing import NamedTuple

import moderngl
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.lens_faces import Face

from .resources import Owner, new_texture


class Lookup(NamedTuple):
    """A face that pixels look up. positions: texture of Faces.positions. number: the face's."""

    positions: moderngl.Texture
    number: int


class LensTargets:
    """The textures of a lens's images, in a context that must be current."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._known: NDArray[np.float32] | None = None
        self._positions: moderngl.Texture | None = None
        self._face: tuple[Size, Owner, moderngl.Framebuffer] | None = None

    def lookup(self, positions: NDArray[np.float32], number: int) -> Lookup:
        if self._positions is None or self._known is not positions:
            height, width = positions.shape[:2]
            if self._positions is None:
                self._positions = new_texture(self._context, (width, height), 3, np.float32)
            self._positions.write(positions)
            self._known = positions
        return Lookup(self._positions, number)

    def face(self, faces: tuple[Face, ...]) -> moderngl.Framebuffer:
        """Return a framebuffer for the primitives of any of the faces."""
        size = max(face.size[0] for face in faces), max(face.size[1] for face in faces)
        if self._face is None or self._face[0] != size:
            if self._face is not None:
                self._face[1].release()
            self._face = None
            owner = Owner()
            texture = owner.own(new_texture(self._context, size, 1, np.int32))
            depth = owner.own(self._context.depth_renderbuffer(size))
            self._face = size, owner, owner.own(self._context.framebuffer([texture], depth))
        return self._face[2]

    def release(self) -> None:
        for part in (self._positions, self._face and self._face[1]):
            if part is not None:
                part.release()
