"""Sets of cameras to look at, and files of them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from format_cameras import colmap_model, transforms_json
from numpy.typing import NDArray

from lucida.app.instruments.poses.model import PoseSet, pose_set
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import CameraSet, PosedCamera

SIZE = (80, 60)


def ring(count: int, names: str = "images/{:03}.png") -> list[PosedCamera]:
    """Cameras that look at the middle from a ring about it."""
    posed = []
    for k in range(count):
        angle = 2 * np.pi * k / count
        eye = (3 * np.cos(angle), 1.0, 3 * np.sin(angle))
        camera = Camera.look_at(eye, (0, 0.5, 0), fov_y_deg=40.0, aspect=4 / 3)
        name = names.format(k)
        posed.append(PosedCamera(camera, SIZE, name, name))
    return posed


def a_set(
    count: int = 5, path: str = "/data/transforms.json", points: NDArray[np.float64] | None = None
) -> PoseSet:
    return pose_set(Path(path), CameraSet("nerf", tuple(ring(count)), ("told",), points))


def transforms(path: Path, count: int = 5) -> Path:
    """A data set's file, whose frames name images/000.png and so on beside it."""
    table = json.loads(transforms_json(ring(count)))
    for k, frame in enumerate(table["frames"]):
        frame["file_path"] = f"./images/{k:03}.png"
    path.write_text(json.dumps(table))
    return path


def colmap(folder: Path, count: int = 5, points: int = 50) -> Path:
    """A model in a folder, with points in a box of side 1."""
    colmap_model(folder, ring(count, "{:03}.png"))
    places = np.random.default_rng(1).uniform(-0.5, 0.5, (points, 3))
    lines = [f"{k} {x} {y} {z} 200 100 50 0.1 1 2\n" for k, (x, y, z) in enumerate(places)]
    (folder / "points3D.txt").write_text("".join(lines))
    return folder
