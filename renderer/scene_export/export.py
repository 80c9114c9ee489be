"""Export of a scene to a file for other programs, selected by the file's ending, and written
atomically.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from renderer.atomic import atomic_write, check_writable
from renderer.camera import Camera, Size
from renderer.camera_formats import pbrt
from renderer.camera_formats.distortion import check_held
from renderer.errors import LucidaError
from renderer.scene.cancelling import check_cancelled
from renderer.scene.model import Scene
from renderer.scene.reading import path_of
from renderer.scene_export import gltf_scene, mitsuba_scene, pbrt_scene
from renderer.scene_export.what import Exported, ExportSubject

WRITERS: dict[str, Callable[[ExportSubject], Exported]] = {
    ".xml": mitsuba_scene.write,
    ".pbrt": pbrt_scene.write,
    ".glb": gltf_scene.write,
}
ENDINGS = tuple(WRITERS)
ONE_OF_THEM = f"give one of {' '.join(ENDINGS)}"


def check_export_path(
    path: str | Path, endings: Sequence[str] = ENDINGS, remedy: str = ONE_OF_THEM
) -> Path:
    """Return the path. Raises LucidaError if it cannot be written, or has another ending."""
    target = path_of(path, "output")
    if target.suffix.lower() not in endings:
        ending = target.suffix
        problem = f"ends in {ending!r}" if ending else "has no ending"
        raise LucidaError("", problem, remedy, str(path))
    check_writable(target)
    return target


def export_scene(path: str | Path, scene: Scene, camera: Camera, size: Size) -> tuple[str, ...]:
    """Write a scene for Mitsuba 3 (.xml), pbrt-v4 (.pbrt) or as glTF (.glb), seen by a camera in an
    image of `size`, (width, height).

    Returns what could not be carried over, one line each. Meshes of .xml and .pbrt are PLY files in
    a folder next to it, which are written first. Raises LucidaError if the target cannot hold the
    camera, or a file cannot be written; then nothing is written. Stops if the work is cancelled
    (renderer/scene/cancelling.py).
    """
    target = check_export_path(path)
    stem = target.stem.encode("utf-8", "replace").decode()  # the files contain it
    ending = target.suffix.lower()
    check_held(camera, size, pbrt.LENSES if ending == ".pbrt" else (), ending)
    written = WRITERS[ending](ExportSubject(scene, camera, size, stem))
    with _undone_on_failure() as made:
        for name, content in written.beside.items():
            check_cancelled()
            file = target.parent / name
            _make_folder(file.parent, made)
            is_new = not file.exists()
            with atomic_write(file) as stream:
                stream.write(content())
            if is_new:
                made.append(file)
        check_cancelled()
        with atomic_write(target) as stream:
            stream.write(written.main)
    return written.left_out


def _make_folder(folder: Path, made: list[Path]) -> None:
    if folder.is_dir():
        return
    try:
        folder.mkdir()
    except OSError as error:
        problem = f"cannot be made: {(error.strerror or str(error)).lower()}"
        raise LucidaError("", problem, "write elsewhere", str(folder)) from None
    made.append(folder)


@contextlib.contextmanager
def _undone_on_failure() -> Iterator[list[Path]]:
    """Yield a list for the paths created inside. They are deleted again if the block raises an
    exception.
    """
    made: list[Path] = []
    try:
        yield made
    except BaseException:
        for path in reversed(made):
            with contextlib.suppress(OSError):
                path.rmdir() if path.is_dir() else path.unlink()
        raise
