"""The tables of a lecture file as msgspec structures: names, types and defaults.

docs/lectures.md explains them. reading.py checks all further conditions on the values.
"""

from __future__ import annotations

from typing import Any, Literal

from msgspec import field

from lucida.renderer.files.schema import Numbers3, StrictTable

from .exercises import TOLERANCE, ChoiceExercise, VectorExercise

# What a step can show. A view of the window has the name with a capital.
VIEWS = (
    *("raster", "ray", "compare", "outside", "objects", "inspector", "probe", "stepper"),
    *("costs", "laboratory", "mistakes", "your-code", "poses"),
)
DEFAULT_VIEWS = ["raster"]


class StepTable(StrictTable):
    """[[steps]].

    notes: for the lecturer, in the notes window of an exported page.
    pixel: the marked pixel, row and column, counted as the lecture does.
    full: the picture fills the window, and the text lies over it.
    exercise: asked in the last build.
    """

    title: str
    part: str = ""
    text: str = ""
    notes: str = ""
    scene: str = ""
    camera: dict[str, Any] | str | None = None
    views: list[str] = field(default_factory=DEFAULT_VIEWS.copy)
    full: bool = False
    options: dict[str, Any] = field(default_factory=dict)
    pixel: tuple[int, int] | None = None
    exercise: dict[str, Any] | None = None
    builds: list[Any] = field(default_factory=list)


class OldStepTable(StepTable):
    """[[steps]] with fields of the format before builds, see old_format.py."""

    reveal: bool = False
    answer: str = ""
    links: dict[str, Any] = field(default_factory=dict)
    low: bool = False
    highlight: list[str] = field(default_factory=list)


class BuildTable(StrictTable):
    """[[steps.builds]]: the changes in a step. Fields left out stay as in the build before.

    text: added below the text so far. instead: takes the place of that text.
    camera, options: the fields that change.
    move_s: how long the window shows states between the last build and this one.
    loop: the movement repeats until the next key.
    """

    text: str = ""
    instead: str = ""
    scene: str = ""
    camera: dict[str, Any] | str | None = None
    views: list[str] | None = None
    options: dict[str, Any] = field(default_factory=dict)
    pixel: tuple[int, int] | None = None
    move_s: float = 0.5
    loop: bool = False


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

    object, hidden: their names in the step's scene.
    answer: a position of the object's middle that solves the exercise.
    at_most: the largest part of the hidden object's pixels that may still show it.
    """

    question: str
    object: str
    hidden: str
    answer: Numbers3
    at_most: float = 0.02


AnyExercise = RayTable | VectorExercise | ChoiceExercise | HideTable


class LectureFile(StrictTable, kw_only=True):
    """A lecture file. pixels_from: the number of the first row and column, in the file and in the
    window. scenes: scenes as scene files hold them, by name, for the steps below.
    """

    title: str
    author: str = ""
    pixels_from: Literal[0, 1] = 1
    scenes: dict[str, Any] = field(default_factory=dict)
    steps: list[Any]
