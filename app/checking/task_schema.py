"""The tables of a task file as msgspec structures, with names, types and defaults.

docs/checking.md explains them. task_file.py checks the conditions that involve several fields.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, field

from lucida.app.ui.explaining.symbols import Notation
from lucida.renderer.files.schema import StrictTable

from .tasks import Feedback

Seed = Annotated[int, Meta(ge=0)]
Side = Annotated[int, Meta(ge=1, le=512)]  # of a task's images


class AxesTable(StrictTable):
    """axes = { x, y, z }: the directions of camera space's axes, as seen in the image."""

    x: Literal["right", "left"] = "right"
    y: Literal["up", "down"] = "up"
    z: Literal["back", "forward"] = "back"

    @property
    def signs(self) -> tuple[int, int, int]:
        """The signs of x, y, z: 1 for right, up and back, -1 for the opposite direction."""
        return (
            1 if self.x == "right" else -1,
            1 if self.y == "up" else -1,
            1 if self.z == "back" else -1,
        )


class ConventionsTable(StrictTable):
    """[conventions], for all tasks of the file. Each task may override a field. None means the
    contract's value.

    camera: the fields of the camera object, name = "word".
    pixels_from: see Conventions.base.
    """

    pixels_from: Literal[0, 1] | None = None
    rows: Literal["top", "bottom"] | None = None
    axes: AxesTable | None = None
    space: Literal["world", "camera"] | None = None
    unit: bool | None = None
    camera: dict[str, str] | None = None


class TaskTable(ConventionsTable, kw_only=True):
    """A table of [[tasks]].

    arguments: words, or name = "word".
    returns: words.
    cases: the number of generated cases.
    """

    kind: str
    name: str = ""
    function: str = ""
    text: str = ""
    part: str = ""
    points: Annotated[float, Meta(ge=0, le=1e6)] = 1.0
    arguments: list[str] | dict[str, str] | None = None
    returns: Annotated[list[str], Meta(min_length=1)] | None = None
    projection: Literal["perspective", "parallel"] | None = None
    cameras: Annotated[list[str], Meta(min_length=1)] | None = None
    size: tuple[Side, Side] | None = None
    cases: Annotated[int, Meta(ge=1, le=1000)] | None = None
    seed: Seed | None = None
    feedback: Feedback | None = None


class TaskFile(StrictTable, kw_only=True):
    """A task file.

    seconds, memory_mb: limits, unless the command line sets them.
    notation: the symbols of the diagnosis and of arguments that have the names of their words.
    network: True if the student's program may connect to other machines; not enforced.
    """

    title: str = ""
    seed: Seed | None = None
    feedback: Feedback = "diagnosis"
    seconds: Annotated[float, Meta(gt=0, le=3600)] | None = None
    memory_mb: Annotated[int, Meta(ge=64, le=1 << 20)] | None = None
    network: bool | None = None
    notation: Notation = "book"
    conventions: ConventionsTable = field(default_factory=ConventionsTable)
    tasks: Annotated[list[dict[str, Any]], Meta(min_length=1, max_length=100)]
