"""The tables of a task file, as msgspec structures; docs/checking.md explains them.

Owns the fields' names, types and defaults. What the values must fulfil beyond that is checked by
task_file.py.
"""

from __future__ import annotations

from typing import Any, Literal

from msgspec import field

from renderer.scene.schema import Numbers3, StrictTable

FeedbackName = Literal["nothing", "verdict", "first-wrong", "diagnosis"]


class AxesTable(StrictTable):
    """axes = { x, y, z }: where camera space's axes point, seen in the image."""

    x: Literal["right", "left"] = "right"
    y: Literal["up", "down"] = "up"
    z: Literal["back", "forward"] = "back"


class ConventionsTable(StrictTable):
    """[conventions], of all tasks of the file; each task may say otherwise. None: the contract's.

    camera: the fields of the camera object, name = "word". pixels_from: see Conventions.base.
    """

    pixels_from: Literal[0, 1] | None = None
    rows: Literal["top", "bottom"] | None = None
    axes: AxesTable | None = None
    vectors: Literal["column", "row"] | None = None
    space: Literal["world", "camera"] | None = None
    unit: bool | None = None
    origin: Literal["exact", "on-ray"] | None = None
    camera: dict[str, str] | None = None


class TaskTable(ConventionsTable, kw_only=True):
    """[[tasks]]. arguments: words, or name = "word"; returns: words. cases: how many are made up.

    views: cameras as tables, files, or built-in scenes' names. Of to-gray: weights; of to-bitmap:
    at_threshold, what is made of a gray that is the threshold; of memory-offset: order,
    stride: bytes per pixel, 1 where pixels are counted.
    """

    kind: str
    name: str = ""
    function: str = ""
    text: str = ""
    part: str = ""
    points: float = 1.0
    arguments: list[str] | dict[str, str] | None = None
    returns: list[str] | None = None
    vectorised: bool = False
    projection: Literal["perspective", "parallel", "both"] | None = None
    cameras: list[str] | None = None
    views: list[dict[str, Any] | str] = field(default_factory=list)
    size: tuple[int, int] | None = None
    cases: int | None = None
    seed: int | None = None
    feedback: FeedbackName | None = None
    weights: Numbers3 | None = None
    at_threshold: Literal[0, 1] | None = None
    order: Literal["row-major", "column-major"] | None = None
    stride: int | None = None


class TaskFile(StrictTable, kw_only=True):
    """A task file. seconds, memory_mb: limits, unless the command line gives them. network: the
    student's program may connect to other machines."""

    title: str = ""
    seed: int | None = None
    feedback: FeedbackName = "diagnosis"
    seconds: float | None = None
    memory_mb: int | None = None
    network: bool = False
    conventions: ConventionsTable = field(default_factory=ConventionsTable)
    tasks: list[Any]
