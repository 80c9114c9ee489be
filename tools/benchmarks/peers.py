"""Other ray tracers behind one interface, each used in the fastest way that its Python offers.

Owns how each is called. Knows nothing of timing. All trace float32 triangles, and make the rays of
a camera image themselves: in NumPy, or in a compiled kernel where they have one.
"""

from __future__ import annotations

import os
from importlib import metadata
from typing import Any, NamedTuple

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from tools.benchmarks.cameras import rays
from tools.benchmarks.meshes import Faces, Vertices


class Hits(NamedTuple):
    """t: float32 (n,), inf where nothing is hit. primitive: int32 (n,), -1 there.
    normal: float32 (n, 3), unit, on either side."""

    t: np.ndarray
    primitive: np.ndarray
    normal: np.ndarray


class Peer:
    """One ray tracer and one mesh.

    trace answers in the tracer's own form, complete in memory; read turns that into arrays, and is
    not timed.
    """

    name: str  # in tables
    package: str = ""  # the distribution that it comes in

    @classmethod
    def version(cls) -> str:
        return metadata.version(cls.package)

    def __init__(self, threads: int | None = None) -> None:
        """threads: how many trace together; None: as many as there are processors.

        Raises ImportError, or what else a broken installation raises.
        """

    def prepare(self, vertices: Vertices, faces: Faces) -> None:
        """Takes the mesh and builds whatever the first ray needs. Called once."""

    def trace(self, camera: Camera, size: Size) -> Any:
        """Ray parameter, primitive and normal of each pixel."""

    def read(self, answer: Any) -> Hits:
        """Convert the result of trace."""

    def close(self) -> None:
        """Frees threads, if the tracer has its own."""


class Mitsuba(Peer):
    """Mitsuba 3, variant llvm_ad_rgb: rays made in its JIT kernel, traced by Embree in packets."""

    name = "Mitsuba 3 (llvm)"
    package = "mitsuba"

    def __init__(self, threads: int | None = None) -> None:
        import drjit
        import mitsuba

        mitsuba.set_variant("llvm_ad_rgb")
        self._mi, self._dr, self._threads = mitsuba, drjit, threads or processors()
        drjit.eval(drjit.arange(mitsuba.UInt32, 8) + 1)  # fails here where there is no LLVM

    def prepare(self, vertices: Vertices, faces: Faces) -> None:
        self._use_threads()
        mesh = self._mi.Mesh("mesh", len(vertices), len(faces))
        parameters = self._mi.traverse(mesh)
        parameters["vertex_positions"] = vertices.ravel()
        parameters["faces"] = faces.ravel().astype(np.uint32)
        parameters.update()
        self._scene = self._mi.load_dict({"type": "scene", "mesh": mesh})
        self._intersect(self._vector((0, 0, 0)), self._vector((1, 1, 1)))

    def trace(self, camera: Camera, size: Size) -> Any:
        mi, dr = self._mi, self._dr
        width, height = size
        left, right, bottom, top = camera.viewport
        self._use_threads()
        with dr.suspend_grad():
            index = dr.arange(mi.UInt32, width * height)
            row = index // width
            column = index - row * width
            x = self._number(left) + self._number((right - left) / width) * (column + 0.5)
            y = self._number(top) - self._number((top - bottom) / height) * (row + 0.5)
            across = x * self._vector(camera.u) + y * self._vector(camera.v)
            if camera.is_parallel:
                # + 0: the direction must have as many lanes as the origin.
                origin = self._vector(camera.eye) + across
                direction = 0 * across - self._vector(camera.w)
            else:
                origin = self._vector(camera.eye) + 0 * across
                direction = across - self._vector([camera.distance * w for w in camera.w])
            return self._intersect(origin, direction)

    def read(self, answer: Any) -> Hits:
        t, primitive, normal = (np.array(part) for part in answer)
        none = ~np.isfinite(t)
        return Hits(t, np.where(none, -1, primitive.astype(np.int64)).astype(np.int32), normal.T)

    def _intersect(self, origin: Any, direction: Any) -> Any:
        ray = self._mi.Ray3f(self._mi.Point3f(origin), direction)
        hit = self._scene.ray_intersect_preliminary(ray, coherent=True)
        normal = hit.compute_surface_interaction(ray, self._mi.RayFlags.Minimal).n
        self._dr.eval(hit.t, hit.prim_index, normal)
        self._dr.sync_thread()
        return hit.t, hit.prim_index, normal

    def _use_threads(self) -> None:
        # The number is the process's, not the scene's.
        if self._dr.thread_count() != self._threads:
            self._dr.set_thread_count(self._threads)

    def _number(self, value: float) -> Any:
        # Opaque: as a literal it would be part of the kernel, and each camera would compile one.
        return self._dr.opaque(self._mi.Float, float(value))

    def _vector(self, values: Any) -> Any:
        return self._mi.Vector3f(*(self._number(value) for value in values))


class Open3D(Peer):
    """open3d.t.geometry.RaycastingScene: Embree, the rays in one float32 (n, 6) array."""

    name = "Open3D"
    package = "open3d"

    def __init__(self, threads: int | None = None) -> None:
        import open3d

        self._open3d, self._threads = open3d, threads or 0

    def prepare(self, vertices: Vertices, faces: Faces) -> None:
        tensor = self._open3d.core.Tensor
        self._scene = self._open3d.t.geometry.RaycastingScene(nthreads=self._threads)
        self._scene.add_triangles(tensor(vertices), tensor(faces.astype(np.uint32)))
        self._scene.cast_rays(tensor(np.zeros((1, 6), np.float32)))

    def trace(self, camera: Camera, size: Size) -> Any:
        both = np.concatenate(rays(camera, size), axis=1)
        tensor = self._open3d.core.Tensor.from_numpy(both)
        return self._scene.cast_rays(tensor, nthreads=self._threads)

    def read(self, answer: Any) -> Hits:
        primitive = answer["primitive_ids"].numpy().astype(np.int32)  # 2**32 - 1 becomes -1
        return Hits(answer["t_hit"].numpy(), primitive, answer["primitive_normals"].numpy())


def processors() -> int:
    """Return the number of processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
