"""The image of a camera with a lens: its passes, and the targets that they need.

A lens's image takes one or several passes over the scene (see renderer/lens_faces.py); each has the
two passes of the rasterizer, see() and shade(). Drawing() in rasterizer.py selects the way.
"""

from __future__ import annotations

from typing import Protocol

import moderngl

from renderer.camera import Camera
from renderer.lens_drawing import LensDrawing
from renderer.lens_faces import Faces, looked_up_faces, resampled_face
from renderer.raster.lens_targets import Lookup
from renderer.raster.moved import check_pieces, moved_spheres, moved_triangles, t_span
from renderer.raster.scene_data import SceneData
from renderer.raster.setup import RasterView
from renderer.raster.targets import Targets


class Way(Protocol):
    """One pass over the scene of a way to draw an image. count: of these passes."""

    count: int

    def see(self, first: int, count: int | None) -> bool:
        """Draw the nearest primitives, a part of the triangles; return True after the last part."""

    def shade(self, rows: tuple[int, int]) -> None:
        """Draw hits and colours of some rows."""


class Pinhole:
    """No lens: one pass."""

    count = 1

    def __init__(self, targets: Targets, data: SceneData, camera: Camera) -> None:
        self._targets, self._data = targets, data
        data.set_view(RasterView(camera, targets.size))

    def see(self, first: int, count: int | None) -> bool:
        self._targets.seen.use()
        return self._data.see(first, count)

    def shade(self, rows: tuple[int, int]) -> None:
        self._targets.shade_rows(rows)
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

    def see(self, first: int, count: int | None) -> bool:
        targets, data = self._targets, self._data
        if not self._faces.faces:
            targets.seen.use()
            data.clear()
            return True
        seen = targets.lens.face(self._faces.faces)
        seen.use()
        done = data.see(first, count)
        if done:
            targets.seen.use()
            if self._number == 0:
                data.clear()
            data.look_up(_texture(seen, 0), self._lookup)
        return done

    def shade(self, rows: tuple[int, int]) -> None:
        self._targets.shade_rows(rows)
        if self._faces.faces:
            self._data.shade(self._targets.textures.primitive, self._lookup)
        else:
            self._data.draw_background()

    @property
    def _lookup(self) -> Lookup:
        return self._targets.lens.lookup(self._faces.positions, self._number)


class Resampled:
    """The finished image of the pinhole, warped. inner: the pinhole's targets."""

    count = 1

    def __init__(self, targets: Targets, inner: Targets, data: SceneData, camera: Camera) -> None:
        self._targets, self._inner, self._data = targets, inner, data
        self._camera = camera
        self._pinhole = Pinhole(inner, data, camera.pinhole)

    def see(self, first: int, count: int | None) -> bool:
        return self._pinhole.see(first, count)

    def shade(self, rows: tuple[int, int]) -> None:
        self._pinhole.shade(rows)
        if rows[1] < self._targets.size[1]:
            return
        targets, data, size = self._targets, self._data, self._targets.size
        (face,), positions = resampled_face(self._camera, size)
        data.set_view(RasterView(face.camera, size, face))
        lookup = targets.lens.lookup(positions, 0)
        targets.seen.use()
        data.clear()
        data.look_up(self._inner.textures.primitive, lookup)
        targets.shade_rows((0, size[1]))
        data.draw_background()
        data.resample(self._inner.textures, lookup)


class MovedVertices:
    """Each vertex is moved to where the lens shows it; triangles stay straight."""

    count = 1

    def __init__(self, targets: Targets, data: SceneData, camera: Camera, splitting: int) -> None:
        check_pieces(data.flat, splitting)
        self._targets, self._data, self._camera = targets, data, camera
        self._splitting = splitting
        data.set_view(RasterView(camera.pinhole, targets.size, None, t_span(data.flat, camera)))

    def see(self, first: int, count: int | None) -> bool:
        data, flat = self._data, self._data.flat
        given = self._camera, self._targets.size, self._splitting
        if first == 0:
            self._targets.seen.use()
            data.clear()
        self._places.use()
        each, last = 4**self._splitting, len(flat.faces)
        if count is not None:  # of pieces
            last = min(-(-(first + count) // each), last)
        for moved in moved_triangles(flat, *given, first // each, last):
            data.see_moved(moved)
        if last < len(flat.faces):
            return False
        for moved in moved_spheres(flat, *given):
            data.see_moved(moved)
        return True

    def shade(self, rows: tuple[int, int]) -> None:
        self._targets.shade_rows(rows)
        self._data.shade(self._targets.textures.primitive, places=_texture(self._places, 1))

    @property
    def _places(self) -> moderngl.Framebuffer:
        targets = self._targets
        return targets.lens.places(targets.textures.primitive, targets.depth)


def way_of(
    camera: Camera,
    drawing: LensDrawing,
    number: int,
    data: SceneData,
    targets: Targets,
    pinhole: Targets | None,
) -> Way:
    """Return pass `number` of drawing a camera's image. pinhole: further targets, needed for a
    resampled image.
    """
    if camera.lens is None:
        return Pinhole(targets, data, camera)
    if drawing.method == "lookup":
        return LookedUp(targets, data, camera, drawing.enlargement, number)
    if drawing.method == "vertices":
        return MovedVertices(targets, data, camera, drawing.splitting)
    assert pinhole is not None
    return Resampled(targets, pinhole, data, camera)


def _texture(framebuffer: moderngl.Framebuffer, number: int) -> moderngl.Texture:
    texture = framebuffer.color_attachments[number]
    assert isinstance(texture, moderngl.Texture)
    return texture
