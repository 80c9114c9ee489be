"""Reading files of cameras: recognise them by name, read and prepare them on a thread, reload them
when they are saved.

The last sets are cached, so that undo finds them at once.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from pathlib import Path

from lucida.app.cameras.taken import TakenCamera, is_fitted, told_of
from lucida.app.instruments.poses.model import PoseSet, load_poses, pose_set
from lucida.app.ui.background import Background
from lucida.app.ui.watching import FilesWatch
from lucida.renderer.files.cameras.given import Given, given
from lucida.renderer.scene.model import View
from lucida.renderer.system.cancelling import check_cancelled
from lucida.renderer.system.errors import LucidaError, describe, one_line
from lucida.renderer.system.file_dependencies import Noted, noting

KEPT = 2
# Of files that hold no scene.
CAMERA_ENDINGS = (".json", ".yml", ".yaml", ".txt", ".bin", ".xml", ".ini")
_LARGEST_LOOKED_AT = 1 << 20  # bytes of a script, or of a model's table: without meshes it is small


@dataclass(frozen=True)
class _Read:
    path: str
    files: Noted
    poses: PoseSet | None
    problem: str = ""


class PosesReader:
    """Reads sets on a thread. problems: by path, one line each."""

    def __init__(self) -> None:
        self._work: Background[_Read] = Background("lucida-poses")
        self._sets: dict[str, PoseSet] = {}
        self.problems: dict[str, str] = {}
        self._asked = ""
        self._files: dict[str, Noted] = {}
        self._watched, self._watch = "", FilesWatch({})

    @property
    def waiting(self) -> bool:
        """True if a file has just changed: ask again soon."""
        return self._watch.waiting

    @property
    def busy(self) -> bool:
        return bool(self._asked)

    def give(self, poses: PoseSet) -> None:
        """Keep a set that was read elsewhere, just now."""
        self._keep(str(poses.path), poses, poses.files)

    def of(self, path: str) -> PoseSet | None:
        """Return the set of a path; None for no path, while it is first read, and if that failed. A
        set stays while a newer version of it is read."""
        outcome = self._work.poll()
        if outcome is not None:
            read = outcome.value
            if read is None or read.path == self._asked:  # otherwise another one is wanted by now
                self._asked = ""
            if read is not None:
                self._keep(read.path, read.poses, read.files, read.problem)
            elif outcome.error is not None:
                self.problems[path] = describe(outcome.error)
        if not path:
            self._asked = ""
            return None
        found = self._sets.get(path)
        is_read = found is not None or path in self.problems
        if self._asked != path and (not is_read or self._is_changed(path)):
            self._asked = path
            self._work.submit(lambda: _read(path))
        return found

    def close(self) -> None:
        self._work.close()

    def _is_changed(self, path: str) -> bool:
        if path != self._watched:
            self._watched, self._watch = path, FilesWatch(self._files.get(path, {}))
        return self._watch.changed(time.monotonic())

    def _keep(self, path: str, poses: PoseSet | None, files: Noted, problem: str = "") -> None:
        self._files[path], self._watched = files, ""
        if poses is None:
            self.problems[path] = problem
            return
        self.problems.pop(path, None)
        self._sets.pop(path, None)
        self._sets[path] = poses
        while len(self._sets) > KEPT:
            self._sets.pop(next(iter(self._sets)))


def is_cameras(source: str) -> bool:
    """Return True if a name is that of a file or folder of cameras, never of a scene.

    A glTF file is examined: it is one of cameras if it has no mesh.
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
    """Return a set of cameras, or the only one. Raise LucidaError."""
    path = Path(source).absolute()
    with noting() as files:
        found = load_poses(path)
    check_cancelled()
    if len(found.cameras) == 1 and (found.points is None or not len(found.points)):
        posed = found.cameras[0]
        said = f"The camera is {path.name}'s: {told_of(found)}."
        view = View(posed.camera, is_fitted(posed), (posed.camera, posed.size))
        return TakenCamera(view, one_line(said), posed)
    return replace(pose_set(path, found), files=files)


def _read(path: str) -> _Read:
    with noting() as files:
        try:
            return _Read(path, files, pose_set(Path(path), load_poses(Path(path))))
        except LucidaError as error:
            return _Read(path, files, None, describe(error))
