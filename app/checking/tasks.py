"""What is asked of a student: a task, and those that are built in.

A lecturer's own come from a file (task_file.py).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from app.checking.conventions import Conventions
from renderer.camera import Camera, Size, Vector
from renderer.shared_numbers import LUMINANCE

if TYPE_CHECKING:
    from renderer.scene.model import View

Feedback = Literal["nothing", "verdict", "first-wrong", "diagnosis"]
FEEDBACK: tuple[Feedback, ...] = ("nothing", "verdict", "first-wrong", "diagnosis")

# The cameras that are made up, from the simplest; see cases.py.
CAMERA_KINDS = ("canonical", "moved", "turned", "off-axis", "skewed")
RIGID_KINDS = ("canonical", "moved", "turned")
SEED = 20
MOST_CALLS = 500_000  # of one task: what memory and patience bear


@dataclass(frozen=True)
class CheckTask:
    """A function that is asked for, and how it is tried.

    kind: a name of kinds.KINDS. function: what it is called. part: the lecture's step to read.
    text: what is asked, for people. cameras: the kinds of cameras that are made up, count of them
    in all, from the seed; views: those that are tried beside them. size: of the image; None: a
    small one for each camera. vectorised: one call for all pixels of an image. weights: of to_gray;
    inclusive: whether the threshold itself is white; column_major, stride: of memory_offset.
    """

    name: str
    kind: str
    function: str
    part: str
    text: str
    points: float = 1.0
    conventions: Conventions = field(default_factory=Conventions)
    cameras: tuple[str, ...] = CAMERA_KINDS
    projections: tuple[str, ...] = ("perspective",)
    count: int = 10
    views: tuple[View, ...] = ()
    size: Size | None = None
    seed: int = SEED
    feedback: Feedback = "diagnosis"
    vectorised: bool = False
    weights: Vector = LUMINANCE
    inclusive: bool = True
    column_major: bool = False
    stride: int = 1


@dataclass(frozen=True, slots=True)
class CheckCase:
    """One call of a task's function. arguments: names and values, as it is called.

    right: the right answer in the kind's own form, and how far from it still is right
    (tolerance), as the kind defines them. values: by the task's words, what it follows from.
    Of a viewing ray or an image also camera and size; pixel: row and column from 0, from the top;
    target, up: what an orthonormal camera follows from, where the task tells them.
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
