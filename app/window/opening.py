"""Read and prepare what a user opens, drops or names: scenes, views, lectures, sets of cameras.

This module does not wait for a window: it runs on the threads that load.
"""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, TypeVar

from lucida.app.images.photograph.reading import found_photograph
from lucida.app.instruments.poses.model import PoseSet
from lucida.app.instruments.poses.reading import open_cameras
from lucida.app.lecture.model import Lecture
from lucida.app.lecture.reading import load_lecture
from lucida.renderer.files import load_scene, load_view
from lucida.renderer.files.outside import OutsideError, kept_inside
from lucida.renderer.raster import Prepared, prepare
from lucida.renderer.scene import Scene, View
from lucida.renderer.system.cancelling import check_cancelled
from lucida.renderer.system.errors import LucidaError, describe

from .kinds import found_code, kind_of

T = TypeVar("T")
Use = Literal["open", "newer", "add"]


@dataclass(frozen=True)
class OpenedScene:
    """A scene, or a model as one.

    prepared: its data for the rasterizer, so that no frame has to prepare it; None if that fails,
    which drawing reports. agreed: the files outside its folder that the scene may read if the user
    did not name it; None if the user did.
    use: "open" replaces the present scene; "newer" replaces it if it is still a version of
    `replaces`; "add" adds the model to it.
    """

    scene: Scene
    prepared: Prepared | None = None
    agreed: frozenset[Path] | None = None
    use: Use = "open"
    replaces: Scene | None = None

    @property
    def notes(self) -> tuple[str, ...]:
        return self.scene.notes


@dataclass(frozen=True)
class OpenedView:
    """A view. said: a message on how a camera of another format was read."""

    view: View
    said: str = ""


@dataclass(frozen=True)
class OpenedLecture:
    """A lecture, and its file."""

    lecture: Lecture
    path: Path

    @property
    def notes(self) -> tuple[str, ...]:
        return self.lecture.summary


@dataclass(frozen=True)
class OpenedPoses:
    """A set of cameras."""

    poses: PoseSet


@dataclass(frozen=True)
class OpenedCode:
    """The absolute path of an existing Python file."""

    path: str


@dataclass(frozen=True)
class OpenedPhotograph:
    """The absolute path of a photograph, which can be read."""

    path: str


Thing = OpenedScene | OpenedView | OpenedLecture | OpenedPoses | OpenedCode | OpenedPhotograph


@dataclass(frozen=True)
class Opened:
    """The contents of sources, at most one thing of each kind.

    sources: those that could be read. problems: one line for each of the others.
    """

    things: tuple[Thing, ...] = ()
    sources: tuple[str, ...] = ()
    problems: tuple[str, ...] = ()

    def find(self, kind: type[T]) -> T | None:
        """Return the thing of a kind; None if there is none."""
        return next((thing for thing in self.things if isinstance(thing, kind)), None)


def open_sources(
    sources: Sequence[str],
    dropped: bool = False,
    agreed: frozenset[Path] = frozenset(),
    use: Use = "open",
) -> Opened:
    """Load the first thing of each kind among sources. A file with one camera is a view, in any
    format.

    dropped: scenes must not name files outside their folder, except for `agreed`; lectures must
    never do so. Raises LucidaError if there is only one source and it cannot be read, and
    OutsideError for any number of sources.
    """
    found: dict[type, Thing] = {}
    good: list[str] = []
    problems: list[str] = []
    for source in sources:
        try:
            thing = _read(source, agreed)
            if thing is None and OpenedScene in found:
                continue  # one scene at a time
            thing = thing or _open_scene(source, agreed if dropped else None, use)
        except LucidaError as error:
            if len(sources) == 1 or isinstance(error, OutsideError):
                raise
            problems.append(describe(error))
        else:
            found.setdefault(type(thing), thing)
            good.append(source)
    return Opened(tuple(found.values()), tuple(good), tuple(problems))


def _read(source: str, agreed: frozenset[Path]) -> Thing | None:
    """Read a source of any kind; None for scenes and models."""
    match kind_of(source):
        case "tasks":
            remedy = f"lucida check rays.py --tasks {source}"
            raise LucidaError("", "holds tasks for students' code", remedy, source)
        case "photograph":
            return OpenedPhotograph(found_photograph(source))
        case "view":
            return OpenedView(load_view(source))
        case "lecture":
            return OpenedLecture(load_lecture(source, agreed), Path(source).absolute())
        case "cameras":
            return _open_cameras(source)
        case "code":
            return OpenedCode(found_code(source))
    return None


def _open_scene(source: str, agreed: frozenset[Path] | None, use: Use = "open") -> OpenedScene:
    with kept_inside(Path(source), agreed):
        scene = load_scene(source)
    return OpenedScene(scene, _prepared(scene), agreed, use)


def _open_cameras(source: str) -> OpenedPoses | OpenedView:
    cameras = open_cameras(source)
    if isinstance(cameras, PoseSet):
        return OpenedPoses(cameras)
    return OpenedView(cameras.view, cameras.said)


def reread(source: str, scene: Scene, agreed: frozenset[Path] | None) -> Opened:
    """Return a newer version of a scene whose files have changed. agreed: as in OpenedScene."""
    newer = _open_scene(source, agreed, "newer")
    return Opened((replace(newer, replaces=scene),))


def _prepared(scene: Scene) -> Prepared | None:
    check_cancelled()
    with contextlib.suppress(LucidaError):
        return prepare(scene)
    return None
