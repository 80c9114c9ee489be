"""The passes over the scene for the image of a camera, with or without a lens.

A lens's image takes both passes of the rasterizer, see() and shade(), for each face (see
renderer/camera/lens_faces.py).
"""

from __future__ import annotations

import moderngl

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lens_faces import looked_up_faces

from .scene_data import SceneData
from .setup import RasterView
from .targets import Targets


def draw_passes(camera: Camera, enlargement: int, data: SceneData, targets: Targets) -> None:
    """Draw the nearest primitives, then hits and colours.

    With a lens, each pixel looks up its primitive in a face, and is shaded from its own ray.
    """
    primitive = targets.textures.primitive
    if camera.lens is None:
        data.set_view(RasterView(camera, targets.size))
        targets.seen.use()
        data.see()
        targets.shaded.use()
        data.shade(primitive)
        return
    faces = looked_up_faces(camera, targets.size, enlargement)
    if not faces.faces:  # the lens sees nothing
        data.set_view(RasterView(camera.pinhole, targets.size))
        targets.seen.use()
        data.clear()
        targets.shaded.use()
        data.draw_background()
    for number, face in enumerate(faces.faces):
        data.set_view(RasterView(face.camera, face.size, face))
        seen = targets.lens.face(faces.faces)
        seen.use()
        data.see()
        targets.seen.use()
        if number == 0:
            data.clear()
        texture, lookup = seen.color_attachments[0], targets.lens.lookup(faces.positions, number)
        assert isinstance(texture, moderngl.Texture)
        data.look_up(texture, lookup)
        targets.shaded.use()
        data.shade(primitive, lookup)
