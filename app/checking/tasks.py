"""Tasks for students, their cases, and the calls to a student's code that answer them.

Values of calls are JSON values. A camera, an object or a scene is a dict: Python code receives it
as an object with attributes, any other program as plain JSON.

A lecturer's own tasks come from a file (task_file.py).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

from lucida.app.ui.explaining.symbols import Notation
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size

from .conventions import Conventions

Kind = Literal["missing", "exception", "time", "memory", "ended", "answer"]


@dataclass(frozen=True)
class Limits:
    """Limits of a run of the student's code.

    seconds: the time of all calls together, from the program's start.
    memory_mb: the memory of each process, on Linux.
    output: the number of printed characters that are kept.
    """

    seconds: float = 20.0
    memory_mb: int = 1024
    output: int = 20_000


@dataclass(frozen=True)
class Call:
    """One call.

    function: its name.
    arguments: names, for messages, and values, in their order.
    notation: the notation of the names in messages.
    """

    function: str
    arguments: tuple[tuple[str, Any], ...]
    notation: Notation = "code"


@dataclass(frozen=True)
class Failure:
    """The reason for a missing answer, in one line with the remedy.

    traceback: the student's own lines.
    call: the number of the call in the run; None if no call caused it.
    """

    kind: Kind
    text: str
    traceback: tuple[str, ...] = ()
    call: int | None = None


@dataclass(frozen=True)
class Run:
    """The results of a run.

    values: the JSON value or the Failure of each call; fewer than the calls if the run ended
    early.
    output: the printed text, shortened in the middle.
    failure: the reason why the run ended early, or None.
    """

    values: tuple[Any, ...]
    output: str = ""
    failure: Failure | None = None


Feedback = Literal["nothing", "verdict", "first-wrong", "diagnosis"]

# Kinds of generated cameras, from the simplest; see cases.py.
CAMERA_KINDS = ("canonical", "moved", "turned", "off-axis", "skewed")
WITH_CAMERAS = ("viewing-ray", "render")  # kinds of tasks
RIGID_KINDS = ("canonical", "moved", "turned")
SEED = 20
MOST_CALLS = 500_000  # per task, limited by memory and patience


@dataclass(frozen=True)
class CheckTask:
    """A required function, and the parameters of its check.

    kind: a name of kinds.KINDS.
    function: the name of the function.
    part: the lecture's step to read.
    text: the description of the task for students.
    cameras: the kinds of generated cameras. count: their total number. seed: generates them.
    size: the image's size; None for a small random one for each camera.
    notation: the notation of the function's arguments, the text and the diagnosis.
    """

    name: str
    kind: str
    function: str
    part: str
    text: str
    points: float = 1.0
    conventions: Conventions = field(default_factory=Conventions)
    cameras: tuple[str, ...] = CAMERA_KINDS
    projection: Literal["perspective", "parallel"] = "perspective"
    count: int = 10
    size: Size | None = None
    seed: int = SEED
    feedback: Feedback = "diagnosis"
    notation: Notation = "book"


@dataclass(frozen=True, slots=True)
class CheckCase:
    """One call of a task's function.

    arguments: names and values, in the order of the call.
    right, tolerance: the correct answer as an array, and the largest difference from it
    that is still correct, as the kind defines it.
    values: the values that determine it, by the task's words.
    camera, size: the camera and the image size of a viewing ray or an image.
    pixel: row and column from 0, from the top.
    target, up: the vectors that determine an orthonormal camera, if the task passes them.
    """

    arguments: tuple[tuple[str, Any], ...]
    right: Any
    tolerance: Any
    values: dict[str, Any] = field(default_factory=dict)
    camera: Camera | None = None
    size: Size | None = None
    pixel: tuple[int, int] | None = None
    target: Vector | None = None
    up: Vector | None = None
