"""What sources hold that a user opens, drops or names: scenes, views, lectures, sets of cameras,
read and prepared.

Nothing here waits for a window: it runs in the threads that load.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from app.checking.task_file import load_tasks
from app.lecture.model import Lecture
from app.lecture.reading import is_lecture, load_lecture
from app.poses.model import PoseSet
from app.poses.reading import is_cameras, open_cameras
from app.storage.code_files import found_code, is_code, is_tasks
from renderer.camera_formats import PosedCamera
from renderer.errors import LucidaError, describe
from renderer.raster import Prepared, prepare
from renderer.scene import BUILTIN_SCENES, Scene, View, load_scene, load_view
from renderer.scene.cancelling import check_cancelled
from renderer.scene.models import read_by
from renderer.scene.outside import OutsideError, kept_inside
from renderer.scene.subprocess_reader import ModelReader

SNIFFED_BYTES = 1 << 20


@dataclass(frozen=True)
class Opened:
    """What sources held: a scene, a view, or both. sources: of those that could be read.

    problems: one line for each of the others. lecture: and its file. prepared: the scene for the
    rasterizer, so that no frame has to do it; None where that cannot be, which drawing tells.
    is_first: it takes the place of what the window has begun with, without a step of undo.
    replaces: the scene of which this is a newer version; None for another one. agreed: the files
    outside of its folder that a scene which came by itself may read; None where the user named it.
    code: the absolute path of a Python file, which is there. poses: a set of cameras. tasks: the
    path of a course's tasks, which can be read.
    """

    sources: tuple[str, ...] = ()
    scene: Scene | None = None
    view: View | None = None
    problems: tuple[str, ...] = ()
    lecture: tuple[Lecture, Path] | None = None
    prepared: Prepared | None = None
    is_first: bool = False
    replaces: Scene | None = None
    agreed: frozenset[Path] | None = None
    code: str = ""
    poses: PoseSet | None = None
    tasks: str = ""


def open_sources(
    sources: Sequence[str], dropped: bool = False, agreed: frozenset[Path] = frozenset()
) -> Opened:
    """Loads the first scene and the first view among sources; and the first lecture, the first
    Python file, the first set of cameras, the first file of tasks. A file with one camera is a
    view, whatever its format.

    dropped: scenes must not name files outside of their folder but those that are agreed to;
    lectures never. Raises LucidaError where there is but one and it cannot be read, OutsideError
    in any case.
    """
    scene, view, lecture, code, poses, tasks = None, None, None, "", None, ""
    good, problems = [], []
    for source in sources:
        try:
            if source not in BUILTIN_SCENES and is_code(source):
                code = code or found_code(source)
            elif source not in BUILTIN_SCENES and is_tasks(source):
                tasks = tasks or open_tasks(source).tasks
            elif source not in BUILTIN_SCENES and _is_view(Path(source)):
                view = view or load_view(source)
            elif source not in BUILTIN_SCENES and is_lecture(source):
                lecture = lecture or (load_lecture(source, agreed), Path(source).absolute())
            elif source not in BUILTIN_SCENES and is_cameras(source):
                found = open_cameras(source)
                if isinstance(found, PosedCamera):
                    view = view or View(found.camera, fit=True)
                else:
                    poses = poses or found
            elif scene is None:
                scene = _load_scene(source, agreed if dropped else None)
            else:
                continue  # one scene at a time
            good.append(source)
        except LucidaError as error:
            if len(sources) == 1 or isinstance(error, OutsideError):
                raise
            problems.append(describe(error))
    given = agreed if dropped else None
    prepared = _prepared(scene)
    return Opened(
        tuple(good), scene, view, tuple(problems), lecture, prepared, agreed=given, code=code,
        poses=poses, tasks=tasks,
    )  # fmt: skip


def _load_scene(source: str, agreed: frozenset[Path] | None) -> Scene:
    with kept_inside(Path(source), agreed):
        return load_scene(source)


def reread(source: str, scene: Scene, agreed: frozenset[Path] | None) -> Opened:
    """A newer version of a scene, whose files have changed. agreed: as in Opened."""
    with read_by(ModelReader().read):
        newer = _load_scene(source, agreed)
    return Opened(scene=newer, prepared=_prepared(newer), replaces=scene, agreed=agreed)


def opened_scene(source: str, scene: Scene, view: View) -> Opened:
    """What a source held, seen by a view."""
    return Opened((source,), scene, view, prepared=_prepared(scene))


def _prepared(scene: Scene | None) -> Prepared | None:
    if scene is not None:
        check_cancelled()
        with contextlib.suppress(LucidaError):
            return prepare(scene)
    return None


def open_lecture(source: str, agreed: frozenset[Path] = frozenset()) -> Opened:
    """Loads a file as a lecture, whatever it looks like. agreed: files outside of its folder that
    it may read. Raises LucidaError."""
    return Opened((source,), lecture=(load_lecture(source, agreed), Path(source).absolute()))


def open_tasks(source: str) -> Opened:
    """Reads a file as a course's tasks. Raises LucidaError."""
    load_tasks(source)
    return Opened((source,), tasks=str(Path(source).absolute()))


def _is_view(path: Path) -> bool:
    if path.suffix.lower() != ".toml":
        return False
    try:
        with path.open("rb") as file:
            text = file.read(SNIFFED_BYTES)
    except OSError:
        return False
    return b"[camera]" in text and b"objects" not in text and not is_lecture(path)
