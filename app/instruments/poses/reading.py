"""Read files of cameras: recognise them by name, read and prepare them on a thread."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from lucida.app.cameras.taken import TakenCamera, is_fitted, told_of
from lucida.app.ui.background import Background
from lucida.renderer.files.cameras.given import Given, given
from lucida.renderer.scene.model import View
from lucida.renderer.system.cancelling import check_cancelled
from lucida.renderer.system.errors import LucidaError, describe, one_line

from .model import PoseSet, load_poses, pose_set

# The endings of files that hold no scene.
CAMERA_ENDINGS = (".json", ".yml", ".yaml", ".txt", ".bin", ".xml", ".ini")
_LARGEST_LOOKED_AT = 1 << 20  # bytes of a script, or of a model's table: without meshes it is small


@dataclass(frozen=True)
class _Read:
    path: str
    poses: PoseSet | None
    problem: str = ""


class PosesReader:
    """A reader of sets on a thread. problems: one line per path."""

    def __init__(self) -> None:
        self._work: Background[_Read] = Background("lucida-poses")
        self._latest: PoseSet | None = None
        self.problems: dict[str, str] = {}
        self._asked = ""

    @property
    def busy(self) -> bool:
        return bool(self._asked)

    def give(self, poses: PoseSet) -> None:
        """Keep a set that was read elsewhere, just now."""
        self._keep(str(poses.path), poses)

    def of(self, path: str) -> PoseSet | None:
        """Return the set of a path; None without a path, while it is read, and if that failed."""
        outcome = self._work.poll()
        if outcome is not None:
            read = outcome.value
            if read is None or read.path == self._asked:  # otherwise another set is wanted by now
                self._asked = ""
            if read is not None:
                self._keep(read.path, read.poses, read.problem)
            elif outcome.error is not None:
                self.problems[path] = describe(outcome.error)
        if not path:
            self._asked = ""
            return None
        if self._latest is not None and str(self._latest.path) == path:
            return self._latest
        if self._asked != path and path not in self.problems:
            self._asked = path
            self._work.submit(lambda: _read(path))
        return None

    def close(self) -> None:
        self._work.close()

    def _keep(self, path: str, poses: PoseSet | None, problem: str = "") -> None:
        if poses is None:
            self.problems[path] = problem
            return
        self.problems.pop(path, None)
        self._latest = poses


def is_cameras(source: str) -> bool:
    """Return True if a source is a file or folder of cameras, not a scene.

    A glTF file is examined: it is a file of cameras if it has no mesh.
    """
    path = Path(source)
    try:
        if source.lower().endswith(CAMERA_ENDINGS) or path.is_dir():
            return True
        is_small_gltf = path.suffix.lower() == ".gltf" and path.stat().st_size <= _LARGEST_LOOKED_AT
        return is_small_gltf and _has_no_mesh(given(path))
    except (OSError, ValueError):  # LucidaError is a ValueError: there is no such file
        return False


def _has_no_mesh(model: Given) -> bool:
    tree = model.json
    return isinstance(tree, dict) and bool(tree.get("cameras")) and not tree.get("meshes")


def open_cameras(source: str) -> PoseSet | TakenCamera:
    """Return a set of cameras, or its only camera. Raises LucidaError."""
    path = Path(source).absolute()
    found = load_poses(path)
    check_cancelled()
    if len(found.cameras) == 1 and (found.points is None or not len(found.points)):
        posed = found.cameras[0]
        said = f"The camera is {path.name}'s: {told_of(found)}."
        view = View(posed.camera, is_fitted(posed), (posed.camera, posed.size))
        return TakenCamera(view, one_line(said), posed)
    return pose_set(path, found)


def _read(path: str) -> _Read:
    try:
        return _Read(path, pose_set(Path(path), load_poses(Path(path))))
    except LucidaError as error:
        return _Read(path, None, describe(error))
