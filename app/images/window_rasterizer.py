"""The rasterizer in the window's context, and its scene.

It is created when it first draws. A driver that rejects its shaders therefore causes a drawing
error, and the window still shows the ray image.
"""

from __future__ import annotations

import moderngl

from lucida.renderer.raster import Prepared, Rasterizer
from lucida.renderer.raster.targets import Textures
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

from .request import ImageRequest

# Drawing errors, which are shown to the user and do not end the program.
FAILURES = (LucidaError, moderngl.Error, MemoryError)


class WindowRasterizer:
    """The rasterizer, in a context that must be current in every call."""

    def __init__(self, context: moderngl.Context) -> None:
        self._gl = context
        self._made: Rasterizer | None = None
        self._not_made: Exception | None = None
        self._scene: Scene | None = None
        self._prepared: list[tuple[Scene, Prepared]] = []

    def of(self, scene: Scene) -> Rasterizer:
        """Return the rasterizer, with this scene. If creating it has failed, raise the same error
        until retry(): compiling takes many frames.
        """
        if self._not_made is not None:
            raise self._not_made
        if self._made is None:
            try:
                self._made = Rasterizer(Scene(()), context=self._gl)
            except FAILURES as error:
                self._not_made = error
                raise
        if scene is not self._scene:
            known = next((known for of, known in self._prepared if of is scene), None)
            self._made.set_scene(scene, known)
            self._scene = scene
        return self._made

    def draw(self, request: ImageRequest, place: str) -> Textures:
        """Draw an image in addition to the one of both renderers.

        place: see Rasterizer.draw. Raises LucidaError.
        """
        rasterizer = self.of(request.scene)
        return rasterizer.draw(request.camera, request.size, place, request.enlargement)

    def prepare(self, scene: Scene, prepared: Prepared) -> None:
        """Keep the last prepared scene and the one before it (for undo): preparing takes long."""
        self._prepared = [*self._prepared, (scene, prepared)][-2:]

    def retry(self) -> None:
        """Create the rasterizer again if that has failed."""
        self._not_made = None

    def release(self) -> None:
        if self._made is not None:
            self._made.release()
