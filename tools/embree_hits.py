"""Record what Embree sees in three scenes, for tests/parity/test_embree.py.

    python -m tools.embree_hits        needs `pip install embreex`

The rays are written out here, from the camera's numbers alone.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene import shapes
from lucida.renderer.scene.model import Mesh

RECORDED = Path(__file__).parents[1] / "tests" / "parity" / "embree.npz"
SIZE = (64, 48)
FARTHEST = 1e30  # Embree's distance of no hit is larger


def soup() -> Mesh:
    """Return 400 triangles without order, of very different sizes, many of which intersect."""
    random = np.random.default_rng(42)
    middles = random.uniform(-1, 1, (400, 1, 3))
    corners = middles + random.normal(size=(400, 3, 3)) * 10 ** random.uniform(-2, 0, (400, 1, 1))
    return Mesh(corners.reshape(-1, 3), np.arange(1200).reshape(-1, 3))


def waves() -> Mesh:
    """Return a surface of 3042 triangles whose neighbours share their vertices."""
    x, z = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-2, 2, 40)] * 2))
    k = (np.arange(39)[:, None] * 40 + np.arange(39)).ravel()
    faces = [np.stack(part, 1) for part in ((k, k + 40, k + 1), (k + 1, k + 40, k + 41))]
    height = 0.3 * np.sin(3 * x) * np.cos(4 * z)
    return Mesh(np.stack([x, height, z], 1), np.concatenate(faces))


SKEWED = Camera(
    eye=(0.3, 0.4, 4), u=(1, 0.2, 0.1), v=(-0.1, 0.8, 0), w=(0.1, 0.1, 1.2),
    viewport=(-0.7, 0.5, -0.4, 0.5), distance=1.3,
)  # fmt: skip
SCENES: dict[str, tuple[Mesh, Camera]] = {
    "torus": (
        shapes.torus(),
        Camera.look_at((0.9, 1.1, 1.4), (0, 0, 0), fov_y_deg=50, aspect=4 / 3),
    ),
    "soup": (soup(), SKEWED),
    "waves": (
        waves(),
        replace(
            Camera.look_at((2, 3, 4), (0, 0, 0), projection="parallel"),
            viewport=(-2, 2, -1.5, 1.5),
        ),
    ),
}


def rays(camera: Camera) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return the origins and directions of all pixels' rays: (pixels, 3) each."""
    (width, height), (left, right, bottom, top) = SIZE, camera.viewport
    a = left + (np.arange(width) + 0.5) * (right - left) / width
    b = top - (np.arange(height) + 0.5) * (top - bottom) / height
    across = a[None, :, None] * np.array(camera.u) + b[:, None, None] * np.array(camera.v)
    eye, w = np.array(camera.eye), np.array(camera.w)
    if camera.projection == "parallel":
        origins, directions = eye + across, np.broadcast_to(-w, across.shape)
    else:
        directions = across - camera.distance * w
        origins = np.broadcast_to(eye, across.shape)
    return origins.reshape(-1, 3).astype(np.float32), directions.reshape(-1, 3).astype(np.float32)


def main() -> None:
    """Trace the scenes with Embree, and save primitives (-1 for none) and ray parameters."""
    from embreex import mesh_construction, rtcore_scene

    recorded = {}
    for name, (mesh, camera) in SCENES.items():
        scene = rtcore_scene.EmbreeScene()
        mesh_construction.TriangleMesh(scene, np.asarray(mesh.vertices, np.float32)[mesh.faces])
        hits = scene.run(*rays(camera), output=1)
        shape = SIZE[1], SIZE[0]
        recorded[f"{name}-primitive"] = hits["primID"].astype(np.int16).reshape(shape)
        depth = np.where(hits["tfar"] > FARTHEST, np.inf, hits["tfar"])
        recorded[f"{name}-depth"] = depth.astype(np.float32).reshape(shape)
    np.savez_compressed(RECORDED, **recorded)


if __name__ == "__main__":
    main()
