"""Export of a scene and its camera to a file for other programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.cameras.distortion import check_held
from lucida.renderer.files.reading import path_of
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.atomic import atomic_write, check_writable
from lucida.renderer.system.cancelling import check_cancelled
from lucida.renderer.system.errors import LucidaError

from .gltf_scene import glb_of

ENDINGS = (".glb",)


def check_export_path(path: str | Path, endings: Sequence[str] = ENDINGS) -> Path:
    """Return the path. Raises LucidaError if it cannot be written, or has another ending."""
    target = path_of(path, "output")
    if target.suffix.lower() not in endings:
        ending = target.suffix
        problem = f"ends in {ending!r}" if ending else "has no ending"
        raise LucidaError("", problem, f"give {endings[0]}", str(path))
    check_writable(target)
    return target


def export_scene(path: str | Path, scene: Scene, camera: Camera, size: Size) -> tuple[str, ...]:
    """Write a scene as glTF (.glb), seen by a camera in an image of `size`, (width, height).

    Returns a line for each thing that glTF cannot hold. Raises LucidaError if glTF cannot hold the
    camera, or the file cannot be written. The export stops if it is cancelled
    (renderer/system/cancelling.py).
    """
    target = check_export_path(path)
    check_held(camera, (), "glTF")
    data, left_out = glb_of(scene, camera, size)
    check_cancelled()
    with atomic_write(target) as file:
        file.write(data)
    return left_out
