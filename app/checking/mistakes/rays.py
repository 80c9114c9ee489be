"""The lines for the viewing ray of a pixel in a task's words, and their mistakes.

If the task passes all values of the camera, and counts (i, j) from 0 with row 0 at the top, the
lines are the camera's contract:

    x = left + (j + 0.5) / width * (right - left)
    y = top - (i + 0.5) / height * (top - bottom)
    origin = eye
    direction = x*u + y*v - distance*w
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray

from lucida.app.checking.conventions import camera_words, pixel_words
from lucida.app.checking.tasks import CheckTask
from lucida.app.checking.words import PARTS
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.pixels import Indexing

from .catalogue import Part, part
from .program import Mistake, Program

Floats = NDArray[np.float64]

# The words that a task passes by default.
WORDS = frozenset(
    {"i", "j", "width", "height", "eye", "u", "v", "w", "distance"}
    | {"left", "right", "bottom", "top", "projection"}
)

PIXEL_NAMES = ("i", "j", "x_pixel", "y_pixel", "x01", "y01", "x11", "y11")
GRID = frozenset({"eye", "pixel00", "delta_u", "delta_v"})
EDGES = frozenset({"eye", "bottom_left", "horizontal", "vertical"})
SIZES = ("viewport_width", "viewport_height")
# The values of names in braces in the catalogue; see ray_values.toml.
VALUES = msgspec.toml.decode(Path(__file__).with_name("ray_values.toml").read_bytes())
UNITS, ANGLES = VALUES["units"], VALUES["angles"]

_VIEWPORT = {"left", "right", "bottom", "top"}
_MATRICES = {"camera_to_world", "world_to_camera"}
# The translation of a task's words into those of the lines.
_SAME: Mapping[str, Iterable[str]] = {**PARTS, "row": ["i"], "column": ["j"]}
_PIXELS = ({"i", "j"}, {"x_pixel", "y_pixel"}, {"x01", "y01"}, {"x11", "y11"})
_FRAMES = ({"eye", "u", "v", "w"}, {"eye", "target", "up"}, {"eye", "forward", "up"})


@dataclass(frozen=True)
class RayTask:
    """The conventions of a task that requires rays.

    words: the words that the task passes. A pixel has i, j; x_pixel, y_pixel, its centre in pixels;
    x01, y01; x11, y11. A camera has eye; u, v, w or target, up or camera_to_world or
    world_to_camera; left, right, bottom, top or fov_y, fov_x, in degrees or with _rad in radians,
    and aspect; or the words in SIZES, GRID or EDGES. With other words, the lines are those of the
    camera contract.
    indexing, from_top: the numbering of rows i and columns j; y01 and y11 start at the first row.
    axes: the axes of the matrices' camera space, as in Conventions.
    """

    projection: str = "perspective"
    indexing: Indexing = Indexing.ARRAY
    from_top: bool = True
    words: frozenset[str] = WORDS
    axes: tuple[int, int, int] = (1, 1, 1)


def ray_task(task: CheckTask) -> RayTask:
    """Return the conventions of a task in the words of the lines, or in the camera's own words if
    the lines lack them. The loops of an image always count from 0.
    """
    its = task.conventions
    words = {same for word in its.words for same in _SAME.get(word, {word})}
    pixel = next((pair for pair in _PIXELS if pair <= words), {"i", "j"})
    if {"rotation", "eye"} <= words:
        words = words - _MATRICES | {"eye", "u", "v", "w"}
    seen = words >= _VIEWPORT or words >= set(SIZES) or any(w.startswith("fov") for w in words)
    placed = bool(words & _MATRICES) or any(frame <= words for frame in _FRAMES)
    if not (has_corners(words) or (seen and placed)):
        words = set(WORDS)
    words = words - set().union(*_PIXELS) | pixel | {"width", "height"}
    base = 0 if task.kind == "render" else its.base
    return RayTask(task.projection, Indexing(base), its.rows == "top", frozenset(words), its.axes)


@functools.lru_cache(256)
def ray_program(task: RayTask) -> Program:
    """Return the correct lines, which compute origin and direction, and their mistakes."""
    words, is_parallel = task.words, task.projection == "parallel"
    has_angle = "left" not in words and any(word.startswith("fov_") for word in words)
    distance = "1" if has_angle and "distance" not in words else "distance"
    unit = (
        "pixels" if {"i", "j"} & words else next((u for u in UNITS if f"x{u}" in words), "pixels")
    )
    values = _pixel_values(task, unit) | {"distance": distance, "d": ""}
    facts = {task.projection, unit, f"from {task.indexing.value}"}
    if distance != "1":
        values["d"] = "distance*"
        facts.add("distance")
    facts |= {"top"} if task.from_top else set()
    facts |= {"edges"} if "left" in words else set()
    facts |= {"size"} if {"width", "height"} <= words else set()
    if has_corners(words) and not is_parallel:
        name = "grid" if words >= GRID else "corner"
        return _assembled([part(name, values, facts), part("ray_to_point")])
    matrix = "" if {"u", "v", "w"} & words else _matrix(words)
    parts = [] if matrix else _basis_part(words)
    parts += [] if "left" in words else _viewport_part(words)
    parts.append(part("pixels", values, facts))
    if matrix:
        values |= _matrix_values(matrix, is_parallel, distance, task.axes)
        facts |= {"x to the left"} if task.axes[0] < 0 else set()
        facts |= {"z back"} if task.axes[2] > 0 else set()
        facts |= {"from the world"} if matrix == "world_to_camera" else set()
    parts.append(part("matrix" if matrix else task.projection, values, facts))
    # In another camera space, its mistakes are reported first.
    return _assembled(parts, is_reversed=task.axes != (1, 1, 1))


def _assembled(parts: list[Part], is_reversed: bool = False) -> Program:
    lines = tuple(line for part, _ in parts for line in part)
    ordered = reversed(parts) if is_reversed else parts
    mistakes = [mistake for _, part in ordered for mistake in part]
    mistakes.sort(key=lambda mistake: not mistake.is_common)
    return Program(lines, tuple(mistakes), ("origin", "direction"))


def has_corners(words: Set[str]) -> bool:
    return words >= GRID or words >= EDGES


def _pixel_values(task: RayTask, unit: str) -> dict[str, str]:
    """Return the values for the pixel's position, as catalogue/pixels.toml lists them."""
    half, is_from_one = task.indexing.offset, task.indexing is Indexing.LECTURE
    i0, j0 = ("(i - 1)", "(j - 1)") if is_from_one else ("i", "j")
    across, down = UNITS.get(unit) or (f"(j {half}) / width", f"(i {half}) / height")
    values = {"half": half, "i0": i0, "j0": j0, "across": across, "down": down}
    rows = VALUES["rows"]["top" if task.from_top else "bottom"]
    return values | {name: text.format_map(values) for name, text in rows.items()}


def _matrix(words: Set[str]) -> str:
    return next((word for word in ("camera_to_world", "world_to_camera") if word in words), "")


def _matrix_values(
    matrix: str, is_parallel: bool, distance: str, axes: tuple[int, int, int]
) -> dict[str, str]:
    inverse = f"inverse({matrix})"
    to_world, other = (matrix, inverse) if matrix == "camera_to_world" else (inverse, matrix)
    x, y = ("" if axis > 0 else "-" for axis in axes[:2])
    ahead, back = ("-", "") if axes[2] > 0 else ("", "-")
    at, at_right, to, to_right = f"{x}x, {y}y, 0", f"x, {y}y, 0", "0, 0, ", "0, 0, "
    length = "1"
    if not is_parallel:
        at, at_right, to, to_right = "0, 0, 0", "0, 0, 0", f"{x}x, {y}y, ", f"x, {y}y, "
        length = distance
    return {
        "title": "Parallel: the pixel moves the origin" if is_parallel else "Any camera",
        "to_world": to_world, "other": other, "at": at, "at_right": at_right,
        "to": f"{to}{ahead}{length}", "to_right": f"{to_right}{ahead}{length}",
        "forwards": f"{to}{back}{length}",
    }  # fmt: skip


def _basis_part(words: Set[str]) -> list[Part]:
    """Return the basis from a target or a direction, unless the task passes it."""
    if "up" not in words or {"u", "v", "w"} & words:
        return []
    if "target" in words:
        return [part("basis", {"back": "eye - target"}, {"target"})]
    return [part("basis", {"back": "-forward"})] if "forward" in words else []


def _viewport_part(words: frozenset[str]) -> list[Part]:
    """Return the viewport from one or two angles, or from its size."""
    aspect = "aspect" if "aspect" in words else "width / height"
    values = {
        "scale": "distance * " if "distance" in words else "",
        "ratio": aspect,
        "aspect": f"({aspect})" if " " in aspect else aspect,
    }
    given = {
        axis: word
        for axis in ANGLES
        for word in (f"fov_{axis}", f"fov_{axis}_rad")
        if word in words
    }
    if {"x", "y"} <= given.keys():
        edges = {f"edge_{axis}": given[axis] for axis in "xy"}
        return [part("two_angles", values, angles=edges)]
    axis = next(iter(given), "")
    if words.issuperset(SIZES) and "side" not in ANGLES.get(axis, {}):
        return [part("sizes")]
    if not axis:
        return []
    word = given[axis]
    values |= ANGLES[axis] | {"angle": word if word.endswith("_rad") else f"radians({word})"}
    return [part("side" if "side" in values else "fov", values, angles={"edge": word})]


def ray_values(
    camera: Camera, i: ArrayLike, j: ArrayLike, size: Size, task: RayTask | None = None
) -> dict[str, Any]:
    """Return the values that the lines use: all words but target and up.

    i, j: pixels, 0-based, row 0 at the top.
    size: the image's (width, height).
    """
    task = task or RayTask(camera.projection)
    row, column = (np.asarray(value)[..., None] for value in np.broadcast_arrays(i, j))
    pixel = pixel_words(row, column, size, task.indexing.value, task.from_top)
    return {**pixel, **camera_words(camera, size, task.axes)}


def run_rays(
    program: Program, known: Mapping[str, Any], mistakes: tuple[Mistake, ...] = ()
) -> tuple[Floats, Floats]:
    """Return origins and directions, (..., 3) for each pixel in `known`."""
    origin, direction = program.run(known, mistakes)
    pixels = (np.shape(known[name]) for name in PIXEL_NAMES if name in known)
    shape = np.broadcast_shapes(*pixels, np.shape(origin), np.shape(direction))
    return np.broadcast_to(origin, shape), np.broadcast_to(direction, shape)


def camera_rays(
    camera: Camera,
    size: Size,
    mistakes: tuple[Mistake, ...] = (),
    indexing: Indexing = Indexing.ARRAY,
) -> tuple[Floats, Floats]:
    """Return the rays of a whole image with these mistakes, (height, width, 3) each. The lines are
    those of `ray_program` for the camera's projection.
    """
    task = RayTask(camera.projection, indexing)
    i, j = np.arange(size[1])[:, None], np.arange(size[0])
    return run_rays(ray_program(task), ray_values(camera, i, j, size, task), mistakes)
