"""The image of a camera with a lens: its passes, and the targets that they need.

A lens's image takes one or several passes over the scene (see renderer/lens_faces.py); each has the
two passes of the rasterizer, see() and shade().
"""

from __future__ import annotations

from typing import Protocol

import moderngl

from renderer.camera import Camera
from renderer.lens_faces import Faces, looked_up_faces
from renderer.raster.lens_targets import Lookup
from renderer.raster.scene_data import SceneData
from renderer.raster.setup import RasterView
from renderer.raster.targets import Targets


class Way(Protocol):
    """One pass over the scene. count: the number of these passes."""

    count: int

    def see(self) -> None:
        """Draw the nearest primitives."""

    def shade(self) -> None:
        """Draw hits and colours."""


class Pinhole:
    """No lens: one pass."""

    count = 1

    def __init__(self, targets: Targets, data: SceneData, camera: Camera) -> None:
        self._targets, self._data = targets, data
        data.set_view(RasterView(camera, targets.size))

    def see(self) -> None:
        self._targets.seen.use()
        self._data.see()

    def shade(self) -> None:
        self._targets.shaded.use()
        self._data.shade(self._targets.textures.primitive)


class LookedUp:
    """Each pixel looks up its primitive in a face, and is shaded from its own ray: one pass per
    face.
    """

    def __init__(
        self, targets: Targets, data: SceneData, camera: Camera, enlargement: int, number: int
    ) -> None:
        self._targets, self._data, self._number = targets, data, number
        self._faces: Faces = looked_up_faces(camera, targets.size, enlargement)
        self.count = max(1, len(self._faces.faces))
        if self._faces.faces:
            face = self._faces.faces[number]
            data.set_view(RasterView(face.camera, face.size, face))
        else:  # the lens sees nothing
            data.set_view(RasterView(camera.pinhole, targets.size))

    def see(self) -> None:
        targets, data = self._targets, self._data
        if not self._faces.faces:
            targets.seen.use()
            data.clear()
            return
        seen = targets.lens.face(self._faces.faces)
        seen.use()
        data.see()
        targets.seen.use()
        if self._number == 0:
            data.clear()
        data.look_up(_texture(seen, 0), self._lookup)

    def shade(self) -> None:
        self._targets.shaded.use()
        if self._faces.faces:
            self._data.shade(self._targets.textures.primitive, self._lookup)
        else:
            self._data.draw_background()

    @property
    def _lookup(self) -> Lookup:
        return self._targets.lens.lookup(self._faces.positions, self._number)


def way_of(camera: Camera, enlargement: int, number: int, data: SceneData, targets: Targets) -> Way:
    """Return pass `number` of drawing a camera's image."""
    if camera.lens is None:
        return Pinhole(targets, data, camera)
    return LookedUp(targets, data, camera, enlargement, number)


def _texture(framebuffer: moderngl.Framebuffer, number: int) -> moderngl.Texture:
    texture = framebuffer.color_attachments[number]
    assert isinstance(texture, moderngl.Texture)
    return texture
