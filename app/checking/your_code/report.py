"""The findings on a file, as one immutable value: a thread makes it, the view reads it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from lucida.app.checking.builtin import BUILTIN
from lucida.app.checking.calls import Failure
from lucida.app.checking.checked import TaskResult
from lucida.app.checking.mistakes.diagnosis import Diagnosis
from lucida.app.checking.tasks import CheckTask
from lucida.app.checking.your_code.model import CodeRays
from lucida.app.state.options.shared import Notation
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

ENDLESS = ("time", "memory", "ended")  # after these, a file is not run for another camera


@dataclass(frozen=True)
class CodeContent:
    """What is asked about.

    path: of the file.
    tasks: the file of tasks, "" for the built-in ones.
    notation: the window's.
    version: changes with the content of the file or of the tasks' file.
    """

    path: str
    tasks: str = ""
    notation: Notation = "book"
    version: int = 1

    def is_of_files(self, other: CodeContent) -> bool:
        """Return True if both are versions of the same files."""
        return (self.path, self.tasks) == (other.path, other.tasks)


@dataclass(frozen=True)
class CodeQuestion:
    """A question to a file.

    task: the name of the selected one.
    camera, size: for the canvas.
    """

    content: CodeContent
    task: str
    camera: Camera
    size: Size

    def differs_in_camera(self, other: CodeQuestion) -> bool:
        """Return True if it is the same as the other one, except for the camera."""
        return replace(self, camera=other.camera) == other


@dataclass(frozen=True, eq=False)
class CodeReport:
    """The findings on a file.

    tasks: those whose functions the file has.
    chosen: the selected one.
    rays: for the window's camera, None if the selected task makes none.
    results: of the tasks that have been tried, by name.
    diagnosis: the reason why the rays are wrong; None while unknown.
    failure: the reason why the file answers nothing at all.
    output: the text that it printed.
    seconds, at: the duration of the newest run, and its end in seconds since 1970.
    asked: all tasks.
    not_asked: the reason why there are no rays, if it is the camera.
    """

    question: CodeQuestion
    tasks: tuple[CheckTask, ...] = ()
    chosen: CheckTask | None = None
    rays: CodeRays | None = None
    results: Mapping[str, TaskResult] = field(default_factory=dict)
    diagnosis: Diagnosis | None = None
    failure: Failure | None = None
    output: str = ""
    seconds: float = 0.0
    at: float = 0.0
    asked: tuple[CheckTask, ...] = BUILTIN
    not_asked: str = ""

    @property
    def halted(self) -> bool:
        """True if the file should not run again by itself: it would only take as long again."""
        failure = self.failure
        if failure is None and self.rays is not None:
            failure = self.rays.result.failure
        return failure is not None and failure.kind in ENDLESS
