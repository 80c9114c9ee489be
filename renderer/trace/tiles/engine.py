"""A scene prepared for packets: flat arrays and trees, and the packet kernel that runs on them.

The interface is that of ReferenceEngine; the engine is many times faster.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Scene
from lucida.renderer.scene.positions import lights_from, near_point
from lucida.renderer.trace.arguments.image import Image, Rows, new_image
from lucida.renderer.trace.arguments.view import KernelView
from lucida.renderer.trace.bvh.instances import Instances, World
from lucida.renderer.trace.compile.stage import StagedCode, new_room
from lucida.renderer.trace.rays.query import Vectors, closest_hits
from lucida.renderer.trace.reference.kernel import shade_rays
from lucida.renderer.trace.threads.thread_pool import Control, Team, cancelled_control

from .cells import cells_of
from .effects import Effects, effects_of
from .kernel import trace_packets
from .lens_table import NO_FRAMES, LensTable, lens_table
from .surface import SceneArrays, scene_arrays
from .texture import NO_TEXTURES, PacketTextures
from .variants import Variant, variant_of
from .view import PacketView, packet_view
from .write import writing_stage

_ONE_TEXEL = np.zeros(1, np.int32)
_ONE_TEXEL.setflags(write=False)
_ONE_PIXEL = Rows((1, 1), 0, 1)
_LENS_CAMERA = Camera(lens=Lens("equidistant"))


class _Seen(NamedTuple):
    """The arguments of kernels for one image. effects, and the textures in world and scene, are
    None in kernels for plain images.
    """

    view: PacketView
    world: World
    scene: SceneArrays
    effects: Effects | None


class PacketEngine:
    """An engine that traces images of one scene in packets. Raises LucidaError (see flatten).

    shadows, mirror_depth: see effects.py.
    """

    def __init__(
        self, scene: Scene, team: Team, shadows: bool = False, mirror_depth: int = 0
    ) -> None:
        self._effects = shadows, mirror_depth
        self._team = team
        self._scene = scene
        self._flat = flatten(scene)
        self._cells = cells_of(self._flat)
        self.instances = Instances(scene, self._flat, team)

    # Tracing a cancelled image compiles kernels, or loads them from the cache.

    def compile_lens(self) -> None:
        """Compile the kernels of a lens's table."""
        lens_table(_LENS_CAMERA, _ONE_PIXEL, cancelled_control())

    def compile_walk(self, variant: Variant) -> None:
        """Compile the kernel that finds closest hits."""
        nothing = StagedCode(0, new_room())
        self._walk(
            self._one_pixel(variant), nothing, np.zeros((1, 1), np.uint8), cancelled_control()
        )

    def compile_write(self, variant: Variant) -> None:
        """Compile the stage that shades hits."""
        writing_stage(*self._one_pixel(variant), new_image((1, 1), ()))

    def _one_pixel(self, variant: Variant) -> _Seen:
        lens = NO_FRAMES if variant is Variant.LENS else None
        return self._seen(Camera.canonical(), _ONE_PIXEL, variant, lens)

    def set_scene(self, scene: Scene) -> None:
        """Prepare another scene; unchanged meshes (the same arrays) keep their trees."""
        flat = flatten(scene, (self._scene, self._flat))
        # Assign all at once, because flatten() must find the scene with its own arrays after an
        # error.
        self._scene, self._flat, self._cells = scene, flat, cells_of(flat)
        self.instances.update(scene, self._flat)

    def closest_hits(
        self, origins: Vectors, directions: Vectors, t_min: float, t_max: float
    ) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
        """Return (t, primitive) of many rays; see rays/query.py."""
        return closest_hits(self.instances, self._team, origins, directions, t_min, t_max)

    def shaded(
        self, origins: Vectors, directions: Vectors, t_min: float, t_max: float
    ) -> NDArray[np.float32]:
        """Return the light (n, 3) along many rays, without shadows and mirrors."""
        largest = [np.abs(part).max(axis=1, keepdims=True) for part in (origins, directions)]
        with np.errstate(over="ignore"):
            is_good = np.isfinite(largest[0] + largest[1])
        directions = np.where(is_good, directions, np.float32(0))  # hits nothing
        t, primitives = self.closest_hits(origins, directions, t_min, t_max)
        light, origins = np.empty((len(t), 3), np.float32), np.ascontiguousarray(origins).view()
        # Make the arrays read-only, because the kernel would be compiled again for writable ones.
        origins.flags.writeable = directions.flags.writeable = False
        shade_rays(self._flat, origins, directions, t, primitives, light)
        return light

    def trace(
        self, camera: Camera, image: Image, control: Control, rows: Rows | None = None
    ) -> None:
        """Fill the image; return early if cancelled. Unfinished blocks stay unmarked.

        rows: those of a larger image that `image` holds; None if it is the whole one.
        """
        rows = rows or Rows((image.width, image.height), 0, image.height)
        lens = None if camera.lens is None else lens_table(camera, rows, control)
        if camera.lens is not None and lens is None:
            return  # cancelled
        variant = variant_of(self._scene, camera, any(self._effects))
        seen = self._seen(camera, rows, variant, lens)
        self._walk(seen, writing_stage(*seen, image), image.finished, control)

    def _seen(self, camera: Camera, rows: Rows, variant: Variant, lens: LensTable | None) -> _Seen:
        flat, world = self._flat, self.instances.world
        point = near_point(flat, camera.eye)
        view = packet_view(KernelView.of(camera), rows, self.instances, point, self._cells, lens)
        near = flat._replace(lights=lights_from(flat, point))
        if variant is Variant.PLAIN:
            world = world._replace(uv=None, textures=None, texels=None)
            return _Seen(view, world, scene_arrays(near, NO_TEXTURES), None)
        texels = flat.texels if len(flat.texels) else _ONE_TEXEL
        textures = PacketTextures(flat.uv, flat.textures, texels)
        effects = effects_of(*self._effects, flat.bounds)
        return _Seen(view, world, scene_arrays(near, textures), effects)

    def _walk(
        self, seen: _Seen, writing: StagedCode, finished: NDArray[np.uint8], control: Control
    ) -> None:
        self._team.run(
            trace_packets, seen.view, seen.world, writing, finished, self.instances.stack_size,
            control, size=finished.size,
        )  # fmt: skip
