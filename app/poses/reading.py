"""Files of cameras on their way into memory: known by their names, read and prepared in a thread,
given up when asked.

Owns the thread, and the last sets, so that undo finds them at once.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from app.poses.model import PoseSet, load_poses, pose_set
from app.widgets.background import Background
from renderer.camera_formats import PosedCamera
from renderer.camera_formats.formats import check_distortion
from renderer.camera_formats.given import Options
from renderer.errors import LucidaError, describe
from renderer.scene.cancelling import check_cancelled

KEPT = 2
CAMERA_ENDINGS = (".json", ".yml", ".yaml", ".txt", ".bin")  # of files that hold no scene


@dataclass(frozen=True)
class _Read:
    path: str
    poses: PoseSet | None
    problem: str = ""


class PosesReader:
    """wake: called from the thread when a set is there. problems: by path, one line each."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._work: Background[_Read] = Background("lucida-poses", wake)
        self._sets: dict[str, PoseSet] = {}
        self.problems: dict[str, str] = {}
        self._asked = ""
        self._began_s = 0.0

    @property
    def busy(self) -> bool:
        return bool(self._asked)

    @property
    def time_s(self) -> float:
        """For how long it has been reading."""
        return time.monotonic() - self._began_s if self._asked else 0.0

    def give(self, poses: PoseSet) -> None:
        """One that somebody else has read, just now."""
        self._keep(str(poses.path), poses)

    def of(self, path: str) -> PoseSet | None:
        """The set of a path; None while it is being read, and where that failed."""
        outcome = self._work.poll()
        if outcome is not None:
            read = outcome.value
            self._asked = ""
            if read is not None and read.poses is not None:
                self._keep(read.path, read.poses)
            elif read is not None:
                self.problems[read.path] = read.problem
            elif outcome.error is not None:
                self.problems[path] = describe(outcome.error)
        found = self._sets.get(path)
        if found is None and self._asked != path and path not in self.problems:
            self._asked, self._began_s = path, time.monotonic()
            self._work.submit(lambda: _read(path))
        return found

    def cancel(self) -> None:
        """Nobody waits any more; what is being read ends when it has been read."""
        if self._asked:
            self.problems[self._asked] = f"Reading {self._asked} was cancelled."
            self._asked = ""
            self._work.close(0.0)
            self._work = Background("lucida-poses", self._wake)

    def close(self) -> None:
        self._work.close()

    def _keep(self, path: str, poses: PoseSet) -> None:
        self.problems.pop(path, None)
        self._sets.pop(path, None)
        self._sets[path] = poses
        while len(self._sets) > KEPT:
            self._sets.pop(next(iter(self._sets)))


def is_cameras(source: str) -> bool:
    """Whether a name is that of a file of cameras, or of a folder, never of a scene."""
    try:
        return source.lower().endswith(CAMERA_ENDINGS) or Path(source).is_dir()
    except (OSError, ValueError):
        return False


def open_cameras(source: str, ignore_distortion: bool = False) -> PoseSet | PosedCamera:
    """A set of cameras; or the one, where there is but one, whose lens is refused: a set tells its
    lenses, and a view has no place for that. Raises LucidaError."""
    path = Path(source).absolute()
    found = load_poses(path)
    check_cancelled()
    if len(found.cameras) == 1 and found.points is None:
        try:
            check_distortion(found.cameras, Options(ignore_distortion=ignore_distortion))
        except LucidaError as error:
            raise error.in_file(source) from None
        return found.cameras[0]
    return pose_set(path, found)


def _read(path: str) -> _Read:
    try:
        return _Read(path, pose_set(Path(path), load_poses(Path(path))))
    except LucidaError as error:
        return _Read(path, None, describe(error))
