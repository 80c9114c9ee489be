"""The classic wrong lines of a camera: what each gives for a pixel, and what to tell its author.

Pure. Knows nothing of exercises or windows. In the lecture's notation: i, j from 1, and

    x = left + (j - 0.5) / W (right - left),  y = top - (i - 0.5) / H (top - bottom)

or from 0, and + 0.5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from renderer.camera import Camera, Ray
from renderer.pixels import Indexing


@dataclass(frozen=True, eq=False)
class Mistake:
    """name: what was done. ray: what it gives. hint: what to tell."""

    name: str
    ray: Ray
    hint: str


def mistakes(
    camera: Camera,
    i: int,
    j: int,
    size: tuple[int, int],
    indexing: Indexing = Indexing.LECTURE,
) -> Iterator[Mistake]:
    """What the wrong lines give for pixel (i, j), 0-based, of an image of (width, height).
    indexing: how whoever makes them counts.

    Those whose ray happens to be the right one are not left out: compare with that one first.
    """
    width, height = size
    yield Mistake(
        "rows count upwards",
        _ray(camera, *_point(camera, height - 1 - i, j, size)),
        "Rows count downwards, v points up: v needs its minus sign.",
    )
    yield Mistake(
        "columns count leftwards",
        _ray(camera, *_point(camera, i, width - 1 - j, size)),
        "Columns count to the right, as u does: u has no minus sign.",
    )
    yield Mistake(
        "the corner, not the centre",
        _ray(camera, *_point(camera, i - 0.5, j - 0.5, size)),
        "That ray goes through the pixel's corner. Its centre is half a pixel further.",
    )
    from_one = indexing is Indexing.LECTURE
    yield Mistake(
        "no half pixel" if from_one else "a whole pixel",
        _ray(camera, *_point(camera, i + 0.5, j + 0.5, size)),
        "i and j count from 1: the centre is at j - 0.5, not at j."
        if from_one
        else "i and j count from 0: the centre is at j + 0.5, not at j + 1.",
    )
    off = 1 if from_one else -1
    yield Mistake(
        "half a pixel too far",
        _ray(camera, *_point(camera, i + off, j + off, size)),
        "i and j count from 1: subtract the half pixel, do not add it."
        if from_one
        else "i and j count from 0: add the half pixel, do not subtract it.",
    )
    yield Mistake(
        "row and column exchanged",
        _ray(camera, *_point(camera, j, i, size)),
        "(i, j) is row, column: the column j gives u, the row i gives v.",
    )
    if width != height:
        yield Mistake(
            "width and height exchanged",
            _ray(camera, *_point(camera, i, j, (height, width))),
            "The column is divided by the width W, the row by the height H.",
        )
    x, y = _point(camera, i, j, size)
    yield Mistake(
        "u and v exchanged",
        _ray(camera, y, x),
        "u and v are exchanged: u, from the column j, comes first.",
    )
    yield from _basis_mistakes(camera, x, y)
    yield from _projection_mistakes(camera, x, y)


def _basis_mistakes(camera: Camera, x: float, y: float) -> Iterator[Mistake]:
    right = _ray(camera, x, y)
    eye, w = np.asarray(camera.eye), np.asarray(camera.w)
    if camera.is_parallel:
        yield Mistake(
            "along +w", Ray(right.origin, w), "w points backwards: the camera looks along -w."
        )
        yield Mistake(
            "no eye",
            Ray(right.origin - eye, right.direction),
            "That origin forgets the eye: origin = e + u u + v v.",
        )
        yield Mistake(
            "the camera's coordinates",
            Ray(np.array([x, y, 0.0]), np.array([0.0, 0.0, -1.0])),
            "Those are the camera's coordinates: multiply the basis vectors by them.",
        )
        return
    behind = right.direction + 2 * camera.distance * w
    yield Mistake(
        "along +w", Ray(right.origin, behind), "w points backwards: the direction has -d w."
    )
    yield Mistake(
        "a point, not a direction",
        Ray(right.origin, right.direction + eye),
        "That is the point on the image plane. The direction leads to it from the eye: subtract e.",
    )
    yield Mistake(
        "no distance",
        _ray(replace(camera, distance=1.0), x, y),
        f"The image plane is at distance d = {camera.distance:g}: the direction has -d w.",
    )
    yield Mistake(
        "the camera's coordinates",
        Ray(right.origin, np.array([x, y, -camera.distance])),
        "Those are the camera's coordinates u, v, -d: multiply the basis vectors by them.",
    )


def _projection_mistakes(camera: Camera, x: float, y: float) -> Iterator[Mistake]:
    if camera.is_parallel:
        yield Mistake(
            "as in perspective",
            _ray(replace(camera, projection="perspective"), x, y),
            "That is the perspective ray. In parallel projection all directions are -w, and the "
            "origin depends on the pixel.",
        )
    else:
        yield Mistake(
            "as in parallel projection",
            _ray(replace(camera, projection="parallel"), x, y),
            "That is the parallel ray. In perspective all rays start at the eye, and the "
            "direction depends on the pixel.",
        )


def _point(camera: Camera, i: float, j: float, size: tuple[int, int]) -> tuple[float, float]:
    x, y = camera.image_point(i, j, size)
    return float(x), float(y)


def _ray(camera: Camera, x: float, y: float) -> Ray:
    eye, u, v, w = (np.asarray(vector) for vector in (camera.eye, camera.u, camera.v, camera.w))
    if camera.is_parallel:
        return Ray(eye + x * u + y * v, -w)
    return Ray(eye, x * u + y * v - camera.distance * w)
