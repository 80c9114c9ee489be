"""The rasterizer: object order on the GPU, through OpenGL 3.3.

    for each object: for each pixel that it covers: keep the nearest hit's primitive
    for each pixel: from its primitive to the exact hit, normal and colour

A Rasterizer owns a context, a scene on the GPU, and targets.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from typing import Any

import moderngl

from lucida.renderer.camera.camera import Camera, check_camera
from lucida.renderer.camera.pixels import ENLARGEMENT, ENLARGEMENTS
from lucida.renderer.images.frame import Frame, check_channels, check_size
from lucida.renderer.images.samples import Progress, check_samples, supersampled
from lucida.renderer.scene.flat import same_places
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

from .contexts import check_process, is_inherited, open_platform
from .lens_passes import draw_passes
from .prepared import Prepared, prepare
from .programs import Programs
from .resources import Owner, check
from .scene_data import SceneData
from .screen_pass import plain_state
from .targets import Region, Targets, Textures

DEFAULT_CHANNELS = ("color", "depth", "normal", "id")


class Rasterizer:
    """A rasterizer that draws one scene from any camera.

    backend: "egl", "osmesa" or "auto". context: a window's, used instead; it must be current
    whenever a method is called. Otherwise each method makes its own context current, and then
    restores the previous one. platform: the backend, and OpenGL's renderer and version. Not
    thread-safe. Raises LucidaError if there is no OpenGL 3.3, or the scene does not fit.
    """

    def __init__(
        self, scene: Scene, backend: str = "auto", context: moderngl.Context | None = None
    ) -> None:
        prepared = prepare(scene)
        self._known = scene, prepared
        self._platform = open_platform(backend, context)
        self._owner = Owner()
        self._data: SceneData | None = None
        self._targets: dict[str, Targets] = {}  # by place
        self._released = False
        try:
            with self.current() as gl:
                self._programs = self._owner.own(Programs(gl))
                self._data = SceneData(gl, self._programs, prepared)
                renderer, version = gl.info["GL_RENDERER"], gl.info["GL_VERSION"]
        except BaseException:
            self.release()
            raise
        self.platform = f"{self._platform.name}: {renderer}, OpenGL {version}"

    def __enter__(self) -> Rasterizer:
        return self

    def __exit__(self, *_: object) -> None:
        self.release()

    def current(self) -> AbstractContextManager[moderngl.Context]:
        """Return a context manager inside which the rasterizer's context is current, to use its
        textures.
        """
        if self._released:
            raise RuntimeError("this Rasterizer was released")
        check_process()
        return self._platform.current()

    def set_scene(self, scene: Scene, prepared: Prepared | None = None) -> None:
        """Draw another scene from now on. If that fails, the old one stays.

        Mesh arrays that both scenes share are not uploaded again, unless other objects were added
        or removed. prepared: the result of prepare(), perhaps from another thread, since a large
        scene takes seconds.
        """
        prepared = prepared or prepare(scene, self._known)
        with self.current() as gl:
            old = self._data
            same = same_places(scene, self._known[0])
            if old is None or not old.follows(prepared, same):
                self._data = SceneData(gl, self._programs, prepared)
                if old is not None:
                    old.release()
            self._known = scene, prepared

    def draw(
        self,
        camera: Camera,
        size: tuple[int, int],
        place: str = "",
        enlargement: int = ENLARGEMENT,
    ) -> Textures:
        """Draw the image on the GPU, without reading it back. size: (width, height). enlargement:
        texels of a lens's faces per pixel, along a side.

        The next draw() to the same place overwrites the textures, and replaces them if the size
        differs. Different cameras can use different places, all with one scene. Leaves the
        framebuffer binding unchanged, and depth test, culling and blending off.
        """
        with self._passes():
            return self._draw(camera, check_size(size), place, enlargement).textures

    def render(
        self,
        camera: Camera,
        size: tuple[int, int],
        channels: Iterable[str] = DEFAULT_CHANNELS,
        samples: int = 1,
        progress: Progress | None = None,
        enlargement: int = ENLARGEMENT,
    ) -> Frame:
        """Return the image as arrays.

        size: (width, height). samples: per pixel, a square number; only for colour. progress is
        called with fractions up to 1. enlargement: of a lens's faces, 1, 2 or 4. Raises
        LucidaError.
        """
        check_camera(camera)
        size, channels, samples = check_size(size), check_channels(channels), check_samples(samples)
        if enlargement not in ENLARGEMENTS:
            raise LucidaError("enlargement", f"{enlargement!r} is not 1, 2 or 4", "give e.g. 2")
        draw = partial(self._frame, enlargement)
        return supersampled(draw, camera, size, channels, samples, progress)

    def read(
        self,
        channels: Iterable[str] = DEFAULT_CHANNELS,
        region: Region | None = None,
        place: str = "",
    ) -> dict[str, Any]:
        """Return channels of the image that draw() drew last, or of a part of it, as arrays by name
        (see Frame). Waits until it is drawn.

        region: first row and column, one past the last of each. place: as in draw(), which must
        have been called. Raises LucidaError.
        """
        channels = check_channels(channels)
        with self.current() as gl:
            targets = self._targets[place]
            _ = gl.error  # clear errors left by other code
            arrays: dict[str, Any] = targets.read(channels, region)
            check(gl, f"reading an image of {targets.size[0]}x{targets.size[1]}")
        return arrays

    def release(self) -> None:
        """Release everything. Safe to call twice, and in a forked process."""
        if self._released or is_inherited():
            self._released = True
            return
        with self.current():
            for part in (*self._targets.values(), self._data, self._owner):
                if part is not None:
                    part.release()
        self._targets, self._data, self._released = {}, None, True
        self._platform.release()

    def _frame(
        self,
        enlargement: int,
        camera: Camera,
        size: tuple[int, int],
        channels: tuple[str, ...],
        progress: Progress | None,
    ) -> Frame:
        start = time.perf_counter()
        with self.current() as gl:
            with self._passes():
                targets = self._draw(camera, size, "", enlargement)
            arrays: dict[str, Any] = targets.read(channels)
            check(gl, f"an image of {size[0]}x{size[1]}")
        if progress is not None:
            progress(1.0)
        return Frame(size=size, time_s=time.perf_counter() - start, **arrays)

    @contextmanager
    def _passes(self) -> Iterator[None]:
        """Set up and tear down the OpenGL state for either pass."""
        with self.current() as gl, plain_state(gl, 16):
            try:
                yield
            finally:
                gl.front_face, gl.cull_face, gl.depth_func = "ccw", "back", "<="

    def _draw(self, camera: Camera, size: tuple[int, int], place: str, enlargement: int) -> Targets:
        """Run both passes, for all faces, within _passes()."""
        gl, data = self._platform.context, self._data
        assert data is not None  # current() has checked that
        targets = self._targets_of(gl, size, place)
        data.bind()
        draw_passes(camera, enlargement, data, targets)
        return targets

    def _targets_of(self, gl: moderngl.Context, size: tuple[int, int], place: str) -> Targets:
        targets = self._targets.get(place)
        if targets is None or targets.size != size:
            if targets is not None:
                del self._targets[place]
                targets.release()
            self._targets[place] = targets = Targets(gl, size)
        return targets
