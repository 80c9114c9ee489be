"""The words of a task: the arguments that a function may have, and the fields of a camera.

Courses differ in their names and their numbering. Here a convention is data: an argument of a
function or a field of a camera is a word of this table, and its value follows from the camera, the
pixel and the image's size. docs/checking.md has the table for users.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size

from .words import GROUPS, PARTS

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
    space: the space of the returned ray.
    unit: True if directions must be of length 1.
    """

    arguments: Named = ()
    camera: Named = tuple((name, name) for name in DEFAULT_FIELDS)
    returns: tuple[str, ...] = ()
    base: int = 0
    rows: Literal["top", "bottom"] = "top"
    axes: tuple[int, int, int] = (1, 1, 1)
    space: Literal["world", "camera"] = "world"
    unit: bool = False

    @property
    def words(self) -> frozenset[str]:
        """All words whose values are passed to the student."""
        given = {word for _, word in self.arguments}
        return frozenset(
            given | ({word for _, word in self.camera} if "camera" in given else set())
        )

    @property
    def needs_rigid(self) -> bool:
        """True if the words require an orthonormal camera with a symmetric viewport."""
        return not RIGID_WORDS.isdisjoint(self.words)

    def explained(self, meaning: str) -> str:
        """Fill in a word's meaning: `first` is the number of the first row and column, and `near`
        is the edge from which rows are counted.
        """
        signs = zip(("right", "up", "back"), ("left", "down", "forward"), self.axes, strict=True)
        axes = (
            f"{name} {a if sign > 0 else b}"
            for name, (a, b, sign) in zip("xyz", signs, strict=True)
        )
        far = "bottom" if self.rows == "top" else "top"
        return meaning.format(first=self.base, near=self.rows, far=far, axes=", ".join(axes))

    @property
    def mirrored(self) -> bool:
        """True if the image's right, up and back become a left-handed frame. The cameras are then
        mirrored, so that their matrices are rotations in the course's world.
        """
        return math.prod(self.axes) < 0


@dataclass(frozen=True)
class Shot:
    """A camera and an image size, with the target and the up vector that determine an orthonormal
    camera.
    """

    camera: Camera
    size: Size
    target: Vector
    up: Vector


PIXEL_WORDS, CAMERA_WORDS = GROUPS["pixel"], GROUPS["camera"]

# Arguments that hold two numbers.
PAIRS = {word: tuple(PARTS[word]) for word in GROUPS["pairs"]}

# Only an orthonormal camera with a symmetric viewport has these values.
RIGID_WORDS = {"target", "up", "forward"}
RIGID_WORDS |= {word for word in CAMERA_WORDS if word.startswith("fov_")}

CAMERA = "camera"  # the word for an object with the declared fields


@lru_cache(256)  # all pixels of an image share them
def camera_words(camera: Camera, size: Size, axes: tuple[int, int, int]) -> Mapping[str, Any]:
    """Return the values of words that are numbers, vectors (3,) or 4 x 4 matrices."""
    width, height = size
    left, right, bottom, top = camera.viewport
    wide, high = right - left, top - bottom
    to_world = np.eye(4)
    to_world[:3, :3] = camera.basis * np.array(axes, float)
    to_world[:3, 3] = camera.eye
    corner = np.asarray(camera.eye) + camera.basis @ (left, bottom, -camera.distance)
    across, upwards = camera.basis @ (wide, 0.0, 0.0), camera.basis @ (0.0, high, 0.0)
    sides = {"x": wide, "y": high, "long": max(wide, high), "short": min(wide, high)}
    angles = {f"fov_{k}_rad": 2 * math.atan2(s / 2, camera.distance) for k, s in sides.items()}
    return {
        **{name: np.asarray(getattr(camera, name)) for name in ("eye", "u", "v", "w")},
        "distance": camera.distance,
        **dict(zip(("left", "right", "bottom", "top"), camera.viewport, strict=True)),
        "viewport_width": wide,
        "viewport_height": high,
        "width": width,
        "height": height,
        "aspect": width / height,
        **angles,
        **{name.removesuffix("_rad"): math.degrees(angle) for name, angle in angles.items()},
        "forward": -np.asarray(camera.w),
        "camera_to_world": to_world,
        "world_to_camera": np.linalg.inv(to_world),
        "pixel00": corner + 0.5 / width * across + (1 - 0.5 / height) * upwards,
        "delta_u": across / width,
        "delta_v": -upwards / height,
        "bottom_left": corner,
        "horizontal": across,
        "vertical": upwards,
    }


def pixel_words(i: Whole, j: Whole, size: Size, base: int, from_top: bool) -> dict[str, Any]:
    """Return the values of the pixel words. i, j: from 0, row 0 at the top."""
    width, height = size
    row = i if from_top else height - 1 - i
    x, y = j + 0.5, row + 0.5
    words = {"i": row + base, "j": j + base, "x_pixel": x, "y_pixel": y}
    words |= {"x01": x / width, "y01": y / height}
    return words | {"x11": 2 * x / width - 1, "y11": 2 * y / height - 1}


def camera_values(shot: Shot, conventions: Conventions) -> dict[str, Any]:
    """Return the value of each camera word, and of CAMERA, as JSON values."""
    camera = shot.camera
    words = dict(camera_words(camera, shot.size, conventions.axes))
    words["rotation"] = words["camera_to_world"][:3, :3]
    words["top_left"] = words["bottom_left"] + words["vertical"]
    words |= {"target": shot.target, "up": shot.up, "viewport": camera.viewport}
    words |= {"projection": camera.projection, "size": shot.size}
    values = {name: np.asarray(value).tolist() for name, value in words.items()}
    values[CAMERA] = {name: values[word] for name, word in conventions.camera}
    return values


def argument_lists(
    shot: Shot, conventions: Conventions, i: Whole, j: Whole
) -> dict[str, list[Any]]:
    """Return the value of each argument's word for each pixel. i, j: int (N,), from 0."""
    pixels = pixel_words(i, j, shot.size, conventions.base, conventions.rows == "top")
    pixels |= {"row": pixels["i"], "column": pixels["j"]}
    pixels |= {pair: np.column_stack([pixels[part] for part in PAIRS[pair]]) for pair in PAIRS}
    values = camera_values(shot, conventions)
    return {
        word: pixels[word].tolist() if word in pixels else [values[word]] * len(i)
        for _, word in conventions.arguments
    }
