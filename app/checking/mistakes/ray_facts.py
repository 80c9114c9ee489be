"""The correct parts of wrong rays, reported when no mistake fits."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.checking.mistakes.candidates import LOOSE
from app.checking.mistakes.ray_trial import RayCase, RayTrial, images
from app.checking.mistakes.rays import RayTask

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

TOLD = 3  # facts at most; more would hide the helpful one


@dataclass(frozen=True, eq=False)
class Rays:
    """Rays to describe. given: (N, 2, 3). wrong: flags (N,). is_camera: True if they belong to a
    camera.
    """

    cases: Sequence[RayCase]
    given: Floats
    wrong: Flags
    task: RayTask
    any_origin: bool
    is_camera: bool


def facts(rays: Rays) -> list[str]:
    """Return a few sentences, the most helpful first."""
    told = [*_not_numbers(rays)] or [*_parts(rays), *_where(rays), *_same(rays)]
    return told[:TOLD] or [*_shape(rays)]


def _not_numbers(rays: Rays) -> Iterator[str]:
    broken = len(rays.cases) - np.count_nonzero(np.isfinite(rays.given).all(axis=(1, 2)))
    if broken:
        yield f"{broken} of {len(rays.cases)} rays have NaN or inf: look for a division by 0."
    short = int(np.count_nonzero(np.linalg.norm(rays.given[:, 1], axis=1) == 0))
    if short:
        are = "is" if short == 1 else "are"
        yield f"{short} of {len(rays.cases)} directions {are} zero."


def _parts(rays: Rays) -> Iterator[str]:
    """Compare origins and directions separately."""
    trial = RayTrial(rays.cases, rays.given, rays.task, "any", rays.any_origin)
    everything = np.arange(trial.count)
    right, given = trial.right, rays.given

    def is_right(origins: Floats, directions: Floats) -> Flags:
        return trial.apart(np.stack([origins, directions], axis=1), right, everything) <= LOOSE

    origins = is_right(given[:, 0], right[:, 1])
    directions = is_right(right[:, 0], given[:, 1])
    backwards = is_right(right[:, 0], -given[:, 1])
    if (backwards & ~directions).any() and (backwards | directions).all():
        yield "Your directions point backwards: t > 0 must lead into the scene."
    elif origins.all() and directions.all():
        yield "Your rays are correct, only the lengths of their directions are not."
    elif origins.all() and not directions.any():
        yield "Your origins are correct, your directions are not."
    elif directions.all() and not origins.any():
        yield "Your directions are correct, your origins are not."
    if not directions.all() and origins.all():
        yield from _axes(rays)


def _axes(rays: Rays) -> Iterator[str]:
    """Find which part of wrong directions in perspective is wrong: the one along u or the one along
    v.
    """
    if any(case.camera.is_parallel for case in rays.cases):
        return
    bases = np.array([case.camera.basis for case in rays.cases])
    directions = np.array([case.camera.ray(*case.pixel, case.size)[1] for case in rays.cases])
    both = np.stack([rays.given[:, 1], directions], axis=-1)
    with np.errstate(all="ignore"):
        found = np.linalg.solve(bases, both)
        points, asked = np.moveaxis(found[:, :2] / -found[:, 2:], -1, 0)
        right = np.abs(points - asked) <= 64 * LOOSE * (1 + np.abs(asked))
    along_u, along_v = right.all(axis=0)
    if along_v and not along_u:
        yield "The directions' part along v is correct, that along u is not: look at the column j."
    elif along_u and not along_v:
        yield "The directions' part along u is correct, that along v is not: look at the row i."


def _is_orthonormal(case: RayCase) -> bool:
    basis = case.camera.basis
    return bool(np.allclose(basis.T @ basis, np.eye(3), atol=1e-9))


def _is_symmetric(case: RayCase) -> bool:
    left, right, bottom, top = case.camera.viewport
    return abs(left + right) + abs(bottom + top) <= 1e-9 * (right - left + top - bottom)


def _has_square_pixels(case: RayCase) -> bool:
    left, right, bottom, top = case.camera.viewport
    return abs((right - left) / case.size[0] * case.size[1] / (top - bottom) - 1) <= 1e-9


PLACES: tuple[tuple[str, Callable[[RayCase], bool]], ...] = (
    ("in parallel projection", lambda case: case.camera.is_parallel),
    ("in perspective", lambda case: not case.camera.is_parallel),
    ("where the basis is that of the world",
     lambda case: bool(np.allclose(case.camera.basis, np.eye(3), atol=1e-9))),
    ("where the basis is orthonormal", _is_orthonormal),
    ("where the eye is at the world's origin", lambda case: not np.any(case.camera.eye)),
    ("where the viewport is symmetric", _is_symmetric),
    ("where `distance` = 1", lambda case: case.camera.distance == 1.0),
    ("in square images", lambda case: case.size[0] == case.size[1]),
    ("where pixels are square", _has_square_pixels),
)  # fmt: skip

# Of first row, first column, last row, last column: those that are wrong.
EDGES = (
    ("the last row", [2]),
    ("the last column", [3]),
    ("the first row", [0]),
    ("the first column", [1]),
    ("the last row or column", [2, 3]),
    ("the first row or column", [0, 1]),
)


def _where(rays: Rays) -> Iterator[str]:
    """Describe where the rays are wrong: by a property of exactly the images whose rays are all
    correct, and by the edges on which all wrong pixels are.
    """
    spans = list(images(rays.cases))
    right = [not rays.wrong[first:last].any() for first, last in spans]
    if any(right):
        firsts = [rays.cases[first] for first, _ in spans]
        found = [place for place, is_there in PLACES if [is_there(one) for one in firsts] == right]
        if len(found) == 1:
            yield f"Your rays are correct {found[0]}, and wrong elsewhere."
        elif found:
            yield f"Of the cameras tried, your rays are correct only {' and '.join(found)}."
    pixels = np.array([case.pixel for case in rays.cases])
    last = np.array([case.size[::-1] for case in rays.cases]) - 1
    at = np.column_stack([pixels == 0, pixels == last])
    for name, edges in EDGES:
        if at[rays.wrong][:, edges].any(axis=1).all():
            if not rays.wrong.all():
                yield f"Only rays of {name} are wrong."
            return


def kept(rays: Rays) -> str:
    """Return a sentence if the rays of all cameras are those of the first camera; "" otherwise."""
    first = rays.cases[0].camera
    trial = RayTrial(rays.cases, rays.given, rays.task, "any", rays.any_origin)
    made = []
    for case in rays.cases:
        seen = replace(first, viewport=case.camera.viewport, distance=case.camera.distance)
        seen = replace(seen, projection=case.camera.projection)
        whole, pose = (camera.ray(*case.pixel, case.size) for camera in (first, seen))
        made.append((whole, pose))
    apart = trial.apart(rays.given, np.moveaxis(np.array(made), 1, 0), np.arange(trial.count))
    for what, errors in zip(("it", "its eye and basis"), apart, strict=True):
        if errors.max() <= LOOSE:
            return (
                "Your rays are correct for the first camera that your function was given, also "
                f"where it is given another one: does it keep {what} from one call to the next?"
            )
    return ""


def _same(rays: Rays) -> Iterator[str]:
    """Detect rays that do not depend on i or j."""
    found = []
    for first, last in images(rays.cases):
        i, j = np.array([case.pixel for case in rays.cases[first:last]]).T
        given = rays.given[first:last].reshape(-1, 6)
        if np.ptp(i) and np.ptp(j):
            found.append([_constant(given, group) for group in (0 * i, j, i)])
    if found:
        told = (
            "All your rays of an image are the same: they do not depend on i and j.",
            "Your rays are the same in all rows: they do not depend on i.",
            "Your rays are the same in all columns: they do not depend on j.",
        )
        yield from [text for text, are in zip(told, np.all(found, axis=0), strict=True) if are][:1]


def _constant(given: Floats, group: NDArray[np.intp]) -> bool:
    return all(bool(np.ptp(given[group == value], axis=0).max() == 0) for value in set(group))


def _shape(rays: Rays) -> Iterator[str]:
    """Report that the rays belong to no camera, if nothing else is known."""
    if not rays.is_camera and max(last - first for first, last in images(rays.cases)) >= 9:
        yield (
            "Your rays are not those of a camera: from one pixel to the next, they do not take "
            "equal steps on one image plane."
        )
