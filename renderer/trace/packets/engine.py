"""A scene prepared for packets: flat arrays and trees, and the packet kernel run on them.

Same interface as engine.py's Engine, many times faster.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.lenses import Lens
from renderer.scene.flat import FlatScene, flatten
from renderer.scene.model import Scene
from renderer.scene.positions import lights_from, near_point
from renderer.trace.arguments.image import Image, Rows, new_image
from renderer.trace.arguments.view import KernelView
from renderer.trace.bvh.instances import Instances
from renderer.trace.compile.stage import StagedCode, new_room
from renderer.trace.packets.cells import cells_of
from renderer.trace.packets.effects import effects_of
from renderer.trace.packets.kernel import trace_packets
from renderer.trace.packets.lens_table import NO_FRAMES, LensTable, lens_table
from renderer.trace.packets.view import PacketView, packet_view
from renderer.trace.packets.write import writing_stage
from renderer.trace.rays.query import any_hits, closest_hits
from renderer.trace.scalar.kernel import shade_rays
from renderer.trace.threads.thread_pool import Control, Team, cancel, new_control

Points = NDArray[np.floating]  # float32 or float64
Directions = NDArray[np.float32]
_ONE_TEXEL = np.zeros(1, np.int32)
_ONE_TEXEL.setflags(write=False)
_ONE_METAL = np.zeros((1, 2, 4), np.int32)
_ONE_METAL.setflags(write=False)
_ONE_PIXEL = Rows((1, 1), 0, 1)
KERNELS = "walk", "write"  # each compiled on its own; trees have others
_LENS_CAMERA = Camera(lens=Lens("equidistant"))
_compiled: set[tuple[tuple[str, ...], bool]] = (
    set()
)  # in this process; the types are always the same


class PacketEngine:
    """Traces images of one scene by a team of threads. Raises LucidaError (see flatten).

    shadows, mirror_depth: see effects.py. kernels: those of KERNELS that are compiled at once; with
    "-lens", for cameras with a lens; "write" with "-textures" or "-metals" after that, for scenes
    with these; or "lens", for tables of lenses.
    """

    def __init__(
        self,
        scene: Scene,
        team: Team,
        shadows: bool = False,
        mirror_depth: int = 0,
        kernels: tuple[str, ...] = KERNELS,
    ) -> None:
        self._effects = shadows, mirror_depth
        self._team = team
        self._scene = scene
        self._flat = flatten(scene)
        self._cells = cells_of(self._flat)
        self.instances = Instances(scene, self._flat, team)
        self._compile(kernels)

    def _compile(self, kernels: tuple[str, ...]) -> None:
        """Compile kernels, or load them from the cache, by tracing a cancelled image."""
        what = kernels, any(self._effects)
        if what in _compiled:
            return
        image, over = new_image((1, 1), ()), new_control()
        cancel(over)
        for name in kernels:
            if name == "lens":
                lens_table(_LENS_CAMERA, _ONE_PIXEL, over)
                continue
            lens = NO_FRAMES if "-lens" in name else None
            of_image, near = self._seen_from(Camera.canonical(), _ONE_PIXEL, lens)
            if name.startswith("walk"):
                self._walk(of_image, StagedCode(0, new_room()), image, over)
            elif name.endswith("-textures"):
                self._writing(of_image, near._replace(texels=_ONE_TEXEL), image)
            elif name.endswith("-metals"):
                metal = near._replace(texels=_ONE_TEXEL, textures=_ONE_METAL)
                self._writing(of_image, metal, image)
            else:
                self._writing(of_image, near, image)
        _compiled.add(what)

    def set_scene(self, scene: Scene) -> None:
        """Follow a changed scene; unchanged meshes (the same arrays) keep their trees."""
        flat = flatten(scene, (self._scene, self._flat))
        # All at once: flatten() must find the scene with its own arrays if this fails.
        self._scene, self._flat, self._cells = scene, flat, cells_of(flat)
        self.instances.update(scene, self._flat)

    def closest_hits(
        self, origins: Points, directions: Directions, t_min: float, t_max: float
    ) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
        """Return (t, primitive) of many rays; see rays/query.py."""
        return closest_hits(self.instances, self._team, origins, directions, t_min, t_max)

    def any_hits(
        self, origins: Points, directions: Directions, t_min: float, t_max: float
    ) -> NDArray[np.bool_]:
        """Return whether each of many rays hits anything: see rays/query.py."""
        return any_hits(self.instances, self._team, origins, directions, t_min, t_max)

    def shaded(
        self, origins: Points, directions: Directions, t_min: float, t_max: float
    ) -> NDArray[np.float32]:
        """Return the light (n, 3) along many rays, without shadows and mirrors."""
        largest = [np.abs(part).max(axis=1, keepdims=True) for part in (origins, directions)]
        is_good = np.isfinite(largest[0] + largest[1])
        directions = np.where(is_good, directions, np.float32(0))  # hits nothing
        t, primitives = self.closest_hits(origins, directions, t_min, t_max)
        light, origins = np.empty((len(t), 3), np.float32), origins.view()
        # Read-only: for writable arrays, the kernel would be compiled again.
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
        of_image, near = self._seen_from(camera, rows, lens)
        self._walk(of_image, self._writing(of_image, near, image), image, control)

    def _seen_from(
        self, camera: Camera, rows: Rows, lens: LensTable | None
    ) -> tuple[PacketView, FlatScene]:
        """Return the camera, and the scene with its lights relative to near_point."""
        view, point = KernelView.of(camera), near_point(self._flat, camera.eye)
        near = self._flat._replace(lights=lights_from(self._flat, point))
        return packet_view(view, rows, self.instances, point, self._cells, lens), near

    def _writing(self, of_image: PacketView, near: FlatScene, image: Image) -> StagedCode:
        effects = effects_of(*self._effects, self._flat.bounds)
        return writing_stage(of_image, self.instances.world, near, effects, image)

    def _walk(
        self, of_image: PacketView, writing: StagedCode, image: Image, control: Control
    ) -> None:
        self._team.run(
            trace_packets,
            of_image,
            self.instances.world,
            writing,
            image.finished,
            self.instances.stack_size,
            control,
            size=image.finished.size,
        )
