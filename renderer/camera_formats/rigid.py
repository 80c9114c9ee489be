"""A camera as most formats hold it: a rotation and an eye, all lengths in its viewport.

Owns the refusal of what is more than that. Knows nothing of formats.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import listed
from renderer.camera_formats.given import Options
from renderer.camera_formats.posed import PosedCamera
from renderer.errors import LucidaError

SKEWED = 1e-6  # a cosine between two axes that are at right angles up to rounding


def for_size(posed: PosedCamera, options: Options) -> Camera:
    """The camera for the image's size, where one is known."""
    size = options.size or posed.size
    return posed.camera.fitted(size) if posed.fit and size is not None else posed.camera


def image_size(posed: PosedCamera, options: Options, format: str) -> Size:
    """The size of the image, for a format that must say it. Raises LucidaError."""
    size = options.size or posed.size
    if size is None:
        raise LucidaError("size", f"is not known, and {format} must say it", "give --size WxH")
    return size


def rigid(camera: Camera, format: str) -> Camera:
    """The same picture by unit vectors at right angles, right-handed: the lengths of u, v and w go
    into the viewport, the distance and the clip planes; a parallel camera's eye to the viewport's
    middle. Raises LucidaError where there is none."""
    vectors = {"u": np.asarray(camera.u), "v": np.asarray(camera.v), "w": np.asarray(camera.w)}
    a, b, c = lengths = [float(np.linalg.norm(vector)) for vector in vectors.values()]
    unit = {
        name: vector / length
        for (name, vector), length in zip(vectors.items(), lengths, strict=True)
    }
    for first, second in (("u", "v"), ("u", "w"), ("v", "w")):
        if abs(unit[first] @ unit[second]) > SKEWED:
            raise LucidaError(
                second,
                f"{listed(vectors[second])} is not at right angles to {first} = "
                f"{listed(vectors[first])}, as {format}'s cameras are",
                "give an orthonormal basis, or write a view or pbrt",
            )
    if camera.determinant < 0:
        raise LucidaError(
            "u",
            f"{listed(vectors['u'])} makes the basis left-handed, a mirrored picture, which "
            f"{format}'s cameras have not",
            "give -u, or write a view or pbrt",
        )
    left, right, bottom, top = camera.viewport
    straight = replace(
        camera,
        u=tuple(unit["u"].tolist()),
        v=tuple(unit["v"].tolist()),
        w=tuple(unit["w"].tolist()),
        distance=camera.distance * c,
        viewport=(left * a, right * a, bottom * b, top * b),
        near=None if camera.near is None else camera.near * c,
        far=None if camera.far is None else camera.far * c,
    ).orthonormalized()
    return centred(straight) if camera.is_parallel else straight


def centred(camera: Camera) -> Camera:
    """A parallel camera with the eye in its viewport's middle: the same rays."""
    left, right, bottom, top = camera.viewport
    x, y = (left + right) / 2, (bottom + top) / 2
    eye = np.asarray(camera.eye) + x * np.asarray(camera.u) + y * np.asarray(camera.v)
    viewport = left - x, right - x, bottom - y, top - y
    return replace(camera, eye=tuple(eye.tolist()), viewport=viewport)
