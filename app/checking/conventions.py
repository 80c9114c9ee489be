"""The words of a task: the arguments that a function may have, and the fields of a camera.

Courses differ in their names and in how they count. Here a convention is data: an argument of a
function or a field of a camera is a word of this table, and its value follows from the camera, the
pixel and the image's size. docs/checking.md has the table for users.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera, Size, Vector

Floats = NDArray[np.float64]
Whole = NDArray[np.intp]
Named = tuple[tuple[str, str], ...]  # (name in the student's program, word)

DEFAULT_FIELDS = ("eye", "u", "v", "w", "distance", "left", "right", "bottom", "top", "projection")


@dataclass(frozen=True)
class Conventions:
    """The conventions of a course.

    arguments, camera: names and words.
    returns: the returned values, in order.
    base: the number of the first row, column and object.
    rows: the edge from which rows are counted; y01 and y11 start there too.
    axes: 1 if x points right in the image, y up and z back; -1 for the opposite direction.
    row_vectors: matrices multiply row vectors on their left.
    space: the space of the returned ray.
    unit: directions must be of length 1.
    any_origin: any point of the ray may be its origin.
    """

    arguments: Named = ()
    camera: Named = tuple((name, name) for name in DEFAULT_FIELDS)
    returns: tuple[str, ...] = ()
    base: int = 0
    rows: Literal["top", "bottom"] = "top"
    axes: tuple[int, int, int] = (1, 1, 1)
    row_vectors: bool = False
    space: Literal["world", "camera"] = "world"
    unit: bool = False
    any_origin: bool = False

    @property
    def words(self) -> frozenset[str]:
        """All words whose values are passed to the student."""
        given = {word for _, word in self.arguments}
        return frozenset(
            given | ({word for _, word in self.camera} if "camera" in given else set())
        )

    @property
    def needs_rigid(self) -> bool:
        """True if they can describe only an orthonormal camera with a symmetric viewport."""
        return any(word in CAMERA_WORDS and CAMERA_WORDS[word].rigid for word in self.words)

    @property
    def mirrored(self) -> bool:
        """True if the image's right, up and back become a left-handed frame. The cameras are then
        mirrored, so that their matrices are rotations in the course's world.
        """
        return math.prod(self.axes) < 0


@dataclass(frozen=True)
class Shot:
    """A camera and an image size, with the target and the up vector that an orthonormal camera
    follows from.
    """

    camera: Camera
    size: Size
    target: Vector
    up: Vector

    def frame(self, conventions: Conventions) -> Floats:
        """Return the axes of camera space as columns, (3, 3)."""
        return self.camera.basis * np.array(conventions.axes, float)


@dataclass(frozen=True)
class CameraWord:
    """A word for a value of the camera.

    meaning: for the list of words.
    rigid: only an orthonormal camera with a symmetric viewport has this value.
    """

    meaning: str
    value: Callable[[Shot, Conventions], Any]
    rigid: bool = False


@dataclass(frozen=True)
class PixelWord:
    """A word for a value of the pixel. value: a function of rows and columns, from 0 at the top
    left.
    """

    meaning: str
    value: Callable[[Whole, Whole, Size, Conventions], NDArray[Any]]


def rows_of(i: Whole, size: Size, conventions: Conventions) -> Whole:
    """Return the rows as the course counts them, but from 0."""
    return i if conventions.rows == "top" else size[1] - 1 - i


PIXEL_WORDS: Mapping[str, PixelWord] = {
    "i": PixelWord("the row", lambda i, j, size, c: rows_of(i, size, c) + c.base),
    "j": PixelWord("the column", lambda i, j, size, c: j + c.base),
    "row": PixelWord("the same as i", lambda i, j, size, c: rows_of(i, size, c) + c.base),
    "column": PixelWord("the same as j", lambda i, j, size, c: j + c.base),
    "x_pixel": PixelWord(
        "the pixel's centre in pixels from the left edge: 0.5 in the first column",
        lambda i, j, size, c: j + 0.5,
    ),
    "y_pixel": PixelWord(
        "the same from the edge where rows begin",
        lambda i, j, size, c: rows_of(i, size, c) + 0.5,
    ),
    "x01": PixelWord(
        "the pixel's centre, 0 at the left edge, 1 at the right",
        lambda i, j, size, c: (j + 0.5) / size[0],
    ),
    "y01": PixelWord(
        "the pixel's centre, 0 at the edge where rows begin, 1 at the other",
        lambda i, j, size, c: (rows_of(i, size, c) + 0.5) / size[1],
    ),
    "x11": PixelWord(
        "the pixel's centre, -1 at the left edge, 1 at the right",
        lambda i, j, size, c: 2 * (j + 0.5) / size[0] - 1,
    ),
    "y11": PixelWord(
        "the pixel's centre, -1 at the edge where rows begin, 1 at the other",
        lambda i, j, size, c: 2 * (rows_of(i, size, c) + 0.5) / size[1] - 1,
    ),
}

# Arguments that hold two numbers.
PAIRS = {
    "ij": ("i", "j"),
    "ji": ("j", "i"),
    "xy_pixel": ("x_pixel", "y_pixel"),
    "xy01": ("x01", "y01"),
    "xy11": ("x11", "y11"),
}


def _list(vector: Any) -> list[Any]:
    return np.asarray(vector, float).tolist()


def _point(shot: Shot, x: float, y: float) -> Floats:
    """Return a point of the viewport in world space. x, y: 0 to 1 from its bottom left corner."""
    camera = shot.camera
    left, right, bottom, top = camera.viewport
    on_plane = np.array([left + x * (right - left), bottom + y * (top - bottom), -camera.distance])
    return np.asarray(camera.eye) + camera.basis @ on_plane


def _edge(shot: Shot, x: float, y: float) -> list[float]:
    """Return x times the viewport's edge to the right plus y times its edge upwards."""
    return _list(_point(shot, x, y) - _point(shot, 0.0, 0.0))


def _fov(shot: Shot, which: Callable[[float, float], float]) -> float:
    """Return the angle between two sides of the view in radians. which: selects from the half width
    and half height.
    """
    left, right, bottom, top = shot.camera.viewport
    half = which((right - left) / 2, (top - bottom) / 2)
    return 2 * math.atan2(half, shot.camera.distance)


def _matrix(shot: Shot, conventions: Conventions, inverse: bool) -> list[Any]:
    matrix = np.eye(4)
    matrix[:3, :3] = shot.frame(conventions)
    matrix[:3, 3] = shot.camera.eye
    if inverse:
        matrix[:] = np.linalg.inv(matrix)
    return (matrix.T if conventions.row_vectors else matrix).tolist()


def _rotation(shot: Shot, conventions: Conventions) -> list[Any]:
    frame = shot.frame(conventions)
    return (frame.T if conventions.row_vectors else frame).tolist()


def _top_left(shot: Shot, conventions: Conventions) -> Floats:
    width, height = shot.size
    return _point(shot, 0.5 / width, 1 - 0.5 / height)


def _fields(name: str, meaning: str, rigid: bool = False) -> dict[str, CameraWord]:
    return {name: CameraWord(meaning, lambda shot, c: _list(getattr(shot.camera, name)), rigid)}


def _angles() -> Iterator[tuple[str, CameraWord]]:
    """Yield all fields of view, in degrees and in radians."""
    kinds: dict[str, tuple[str, Callable[[float, float], float]]] = {
        "fov_x": ("from the left to the right edge", lambda x, y: x),
        "fov_y": ("from the bottom to the top edge", lambda x, y: y),
        "fov_long": ("of the image's longer side", max),
        "fov_short": ("of the image's shorter side", min),
    }
    for name, (what, which) in kinds.items():
        yield (
            name,
            CameraWord(
                f"angle of view {what}, in degrees",
                lambda shot, c, which=which: math.degrees(_fov(shot, which)),  # type: ignore[misc]
                True,
            ),
        )
        yield (
            f"{name}_rad",
            CameraWord(
                f"angle of view {what}, in radians",
                lambda shot, c, which=which: _fov(shot, which),  # type: ignore[misc]
                True,
            ),
        )


CAMERA_WORDS: Mapping[str, CameraWord] = {
    **_fields("eye", "the camera's position"),
    **_fields("u", "the basis: right in the image"),
    **_fields("v", "the basis: up in the image"),
    **_fields("w", "the basis: back, from what is seen to the eye"),
    "distance": CameraWord(
        "from the eye to the viewport, along -w", lambda shot, c: shot.camera.distance
    ),
    "left": CameraWord("the viewport's left edge, along u", lambda s, c: s.camera.viewport[0]),
    "right": CameraWord("its right edge", lambda s, c: s.camera.viewport[1]),
    "bottom": CameraWord("its bottom edge, along v", lambda s, c: s.camera.viewport[2]),
    "top": CameraWord("its top edge", lambda s, c: s.camera.viewport[3]),
    "viewport": CameraWord(
        "the four in one: left, right, bottom, top", lambda s, c: _list(s.camera.viewport)
    ),
    "viewport_width": CameraWord(
        "right - left", lambda s, c: s.camera.viewport[1] - s.camera.viewport[0]
    ),
    "viewport_height": CameraWord(
        "top - bottom", lambda s, c: s.camera.viewport[3] - s.camera.viewport[2]
    ),
    "projection": CameraWord('"perspective" or "parallel"', lambda s, c: s.camera.projection),
    "width": CameraWord("the number of columns", lambda s, c: s.size[0]),
    "height": CameraWord("the number of rows", lambda s, c: s.size[1]),
    "size": CameraWord("both: [width, height]", lambda s, c: list(s.size)),
    "aspect": CameraWord("width / height", lambda s, c: s.size[0] / s.size[1]),
    "target": CameraWord("a point that is looked at", lambda s, c: _list(s.target), True),
    "up": CameraWord(
        "a vector that is upwards in the image; not of length 1, nor at right angles to the view",
        lambda s, c: _list(s.up),
        True,
    ),
    "forward": CameraWord(
        "where the camera looks, of length 1", lambda s, c: _list(-np.asarray(s.camera.w)), True
    ),
    **dict(_angles()),
    "camera_to_world": CameraWord(
        "4 x 4, from camera space (its axes as declared) to the world",
        lambda s, c: _matrix(s, c, inverse=False),
    ),
    "world_to_camera": CameraWord(
        "its inverse, the view matrix", lambda s, c: _matrix(s, c, inverse=True)
    ),
    "rotation": CameraWord("3 x 3, camera_to_world without the position", _rotation),
    "pixel00": CameraWord(
        "the centre of the top left pixel on the viewport, a point of the world",
        lambda s, c: _list(_top_left(s, c)),
    ),
    "delta_u": CameraWord(
        "from one pixel's centre on the viewport to the next one's to its right",
        lambda s, c: _edge(s, 1 / s.size[0], 0.0),
    ),
    "delta_v": CameraWord(
        "the same to the next one below", lambda s, c: _edge(s, 0.0, -1 / s.size[1])
    ),
    "top_left": CameraWord(
        "the viewport's corner, a point of the world", lambda s, c: _list(_point(s, 0.0, 1.0))
    ),
    "bottom_left": CameraWord(
        "the viewport's corner, a point of the world", lambda s, c: _list(_point(s, 0.0, 0.0))
    ),
    "horizontal": CameraWord(
        "the viewport's bottom edge, from left to right", lambda s, c: _edge(s, 1.0, 0.0)
    ),
    "vertical": CameraWord(
        "the viewport's left edge, from bottom to top", lambda s, c: _edge(s, 0.0, 1.0)
    ),
}

CAMERA = "camera"  # the word for an object with the declared fields


def camera_object(shot: Shot, conventions: Conventions) -> dict[str, Any]:
    """Return the camera as it is passed to the student."""
    return {name: CAMERA_WORDS[word].value(shot, conventions) for name, word in conventions.camera}


def argument_lists(
    shot: Shot, conventions: Conventions, i: Whole, j: Whole
) -> dict[str, list[Any]]:
    """Return the value of each argument's word for each pixel. i, j: int (N,), from 0."""
    lists: dict[str, list[Any]] = {}
    for _, word in conventions.arguments:
        if word in PIXEL_WORDS:
            lists[word] = PIXEL_WORDS[word].value(i, j, shot.size, conventions).tolist()
        elif word in PAIRS:
            pair = [PIXEL_WORDS[part].value(i, j, shot.size, conventions) for part in PAIRS[word]]
            lists[word] = np.column_stack(pair).tolist()
        else:
            value = (
                camera_object(shot, conventions)
                if word == CAMERA
                else CAMERA_WORDS[word].value(shot, conventions)
            )
            lists[word] = [value] * len(i)
    return lists


def vectorised_arguments(
    shot: Shot, conventions: Conventions, i: Whole, j: Whole
) -> tuple[tuple[str, Any], ...]:
    """Return the arguments of a single call for all pixels. Arguments that depend on the pixel are
    lists.
    """
    of_pixels = {*PIXEL_WORDS, *PAIRS}
    lists = argument_lists(shot, conventions, i, j)
    return tuple(
        (name, lists[word] if word in of_pixels else lists[word][0])
        for name, word in conventions.arguments
    )
