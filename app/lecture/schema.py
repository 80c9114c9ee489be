"""The tables of a lecture file as msgspec structures: names, types and defaults.

docs/lectures.md explains them. reading.py checks all further conditions on the values.
"""

from __future__ import annotations

from typing import Any, Literal

from msgspec import field

from app.instruments import ROOMS
from app.lecture.exercises import TOLERANCE, ChoiceExercise, VectorExercise
from app.state.options import Notation
from renderer.scene.schema import Numbers3, StrictTable

# What a step can show. A view of the window has the name with a capital.
VIEWS = tuple(name for room in ROOMS for name in room.views)
PANEL = "camera"  # may stand beside them

# What a step can point out: fields of the camera's panel, and views.
HIGHLIGHTS = (
    "projection",
    "eye",
    "u",
    "v",
    "w",
    "distance",
    "viewport",
    "lens",
    "clip",
    "keep_orthonormal",
    *VIEWS,
)


class StepTable(StrictTable):
    """[[steps]].

    answer: to the last question of the text, uncovered last.
    low: the second view is a small one below the text.
    links: options that a click on a link in the text shows, by its name.
    notes: for the lecturer, in the notes window of an exported page.
    reveal: the items of the text's lists are uncovered one by one.
    pixel: the marked pixel, row and column, counted as the lecture does.
    """

    title: str
    part: str = ""
    text: str = ""
    answer: str = ""
    notes: str = ""
    reveal: bool = False
    scene: str = ""
    camera: dict[str, Any] | str | None = None
    views: list[str] = field(default_factory=lambda: ["raster"])
    low: bool = False
    options: dict[str, Any] = field(default_factory=dict)
    links: dict[str, dict[str, Any]] = field(default_factory=dict)
    pixel: tuple[int, int] | None = None
    highlight: list[str] = field(default_factory=list)
    exercise: dict[str, Any] | None = None


class RayTable(StrictTable, tag_field="kind", tag="ray"):
    """[steps.exercise] kind = "ray": the ray of a pixel of the step's camera, or of `camera`.

    pixel: row and column, counted as the lecture does. size: width and height of the image.
    """

    question: str
    pixel: tuple[int, int]
    size: tuple[int, int]
    camera: dict[str, Any] | None = None
    scaled: bool = True
    tolerance: float = TOLERANCE


class HideTable(StrictTable, tag_field="kind", tag="hide"):
    """[steps.exercise] kind = "hide": put one object where it hides another one from the camera.

    object, hidden: their names in the step's scene. answer: where the object's middle may go.
    at_most: the part of the hidden one's pixels that may still show it.
    """

    question: str
    object: str
    hidden: str
    answer: Numbers3
    at_most: float = 0.02


AnyExercise = RayTable | VectorExercise | ChoiceExercise | HideTable


class LectureFile(StrictTable, kw_only=True):
    """A lecture file. pixels_from: what its first row and column are called, in the file and in the
    window. notation: the window's during its steps; None for the one that the user has chosen.
    scenes: scenes as scene files hold them, by name, for the steps below.
    """

    title: str
    author: str = ""
    pixels_from: Literal[0, 1] = 1
    notation: Notation | None = None
    scenes: dict[str, Any] = field(default_factory=dict)
    steps: list[Any]
