"""Read and prepare what a user opens, drops or names: scenes, views, lectures, sets of cameras.

Nothing here waits for a window: it runs on the threads that load.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from app.cameras.taken import TakenCamera
from app.checking.task_file import load_tasks
from app.images.photograph.reading import found_photograph, is_photograph
from app.instruments.poses.model import PoseSet
from app.instruments.poses.reading import is_cameras, open_cameras
from app.lecture.model import Lecture
from app.lecture.reading import is_lecture, load_lecture
from app.window.code_files import found_code, is_code, is_tasks
from renderer.files import SCENE_NAMES, load_scene, load_view
from renderer.files.models.models import read_by
from renderer.files.models.subprocess_reader import ModelReader
from renderer.files.outside import OutsideError, kept_inside
from renderer.files.reading import first_bytes
from renderer.raster import Prepared, prepare
from renderer.scene import Scene, View
from renderer.system.cancelling import check_cancelled
from renderer.system.errors import LucidaError, describe

SNIFFED_BYTES = 1 << 20


@dataclass(frozen=True)
class Opened:
    """The contents of the sources: a scene, a view, or both. sources: those that could be read.

    problems: one line for each of the others. lecture: and its file. prepared: the scene for the
    rasterizer, so that no frame has to prepare it; None if that fails, which drawing reports.
    is_first: replaces what the window began with, without an undo step. replaces: the scene of
    which this is a newer version; None for another one. agreed: the files outside its folder that a
    scene which came by itself may read; None if the user named it. code: the absolute path of an
    existing Python file. poses: a set of cameras. tasks: the path of a course's tasks, which can be
    read. photograph: the absolute path of one, which can be read. taken: the camera of another
    format, which becomes the view. adds: add a model
    to the open scene.
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
    photograph: str = ""
    taken: TakenCamera | None = None
    adds: bool = False


def open_sources(
    sources: Sequence[str], dropped: bool = False, agreed: frozenset[Path] = frozenset()
) -> Opened:
    """Load the first scene and the first view among sources; and the first lecture, the first
    Python file, the first set of cameras, the first file of tasks and the first photograph. A file
    with one camera is a view, whatever its format.

    dropped: scenes must not name files outside of their folder but those that are agreed to;
    lectures never. Raises LucidaError where there is but one and it cannot be read, OutsideError
    in any case.
    """
    found: dict[str, Any] = {}  # Opened's fields
    good: list[str] = []
    problems: list[str] = []
    for source in sources:
        if "scene" in found and _kind(source) == "scene":
            continue  # one scene at a time
        try:
            found = _held(source, dropped, agreed) | found
            good.append(source)
        except LucidaError as error:
            if len(sources) == 1 or isinstance(error, OutsideError):
                raise
            problems.append(describe(error))
    taken = found.get("taken")
    if taken is not None:
        found.setdefault("view", taken.view)
    found |= {"prepared": _prepared(found.get("scene")), "agreed": agreed if dropped else None}
    return Opened(tuple(good), problems=tuple(problems), **found)


def _kind(source: str) -> str:
    """Return what a source looks like, by its name and its first lines."""
    if source in SCENE_NAMES:
        return "scene"
    kinds = {
        "tasks": is_tasks,
        "photograph": is_photograph,
        "view": _is_view,
        "lecture": is_lecture,
        "cameras": is_cameras,
        "code": is_code,
    }
    return next((kind for kind, is_it in kinds.items() if is_it(source)), "scene")


def _held(source: str, dropped: bool, agreed: frozenset[Path]) -> dict[str, Any]:
    """Return the contents of a source, as a field of Opened. Raises LucidaError."""
    kind = _kind(source)
    if kind == "tasks":
        return {"tasks": open_tasks(source).tasks}
    if kind == "photograph":
        return {"photograph": found_photograph(source)}
    if kind == "view":
        return {"view": load_view(source)}
    if kind == "lecture":
        return {"lecture": (load_lecture(source, agreed), Path(source).absolute())}
    if kind == "cameras":
        cameras = open_cameras(source)
        return {"poses" if isinstance(cameras, PoseSet) else "taken": cameras}
    if kind == "code":
        return {"code": found_code(source)}
    return {"scene": _load_scene(source, agreed if dropped else None)}


def _load_scene(source: str, agreed: frozenset[Path] | None) -> Scene:
    with kept_inside(Path(source), agreed):
        return load_scene(source)


def reread(source: str, scene: Scene, agreed: frozenset[Path] | None) -> Opened:
    """A newer version of a scene, whose files have changed. agreed: as in Opened."""
    with read_by(ModelReader().read):
        newer = _load_scene(source, agreed)
    return Opened(scene=newer, prepared=_prepared(newer), replaces=scene, agreed=agreed)


def opened_scene(source: str, scene: Scene, view: View) -> Opened:
    """Return a source's scene, seen by a view."""
    return Opened((source,), scene, view, prepared=_prepared(scene))


def _prepared(scene: Scene | None) -> Prepared | None:
    if scene is not None:
        check_cancelled()
        with contextlib.suppress(LucidaError):
            return prepare(scene)
    return None


def open_to_add(source: str, agreed: frozenset[Path] = frozenset()) -> Opened:
    """Read a model to add to the open scene. Raises LucidaError."""
    return replace(open_sources([source], True, agreed), adds=True)


def open_lecture(source: str, agreed: frozenset[Path] = frozenset()) -> Opened:
    """Loads a file as a lecture, whatever it looks like. agreed: files outside of its folder that
    it may read. Raises LucidaError."""
    return Opened((source,), lecture=(load_lecture(source, agreed), Path(source).absolute()))


def open_tasks(source: str) -> Opened:
    """Reads a file as a course's tasks. Raises LucidaError."""
    load_tasks(source)
    return Opened((source,), tasks=str(Path(source).absolute()))


def _is_view(source: str) -> bool:
    path = Path(source)
    if path.suffix.lower() != ".toml":
        return False
    try:
        text = first_bytes(path, SNIFFED_BYTES)
    except (OSError, ValueError):
        return False
    return b"[camera]" in text and b"objects" not in text and not is_lecture(path)
