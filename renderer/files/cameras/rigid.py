"""Rigid cameras, for formats that pose a camera by a rotation and a position.

Determines which part of u, v and w such a pose can hold, and moves the rest into the viewport.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, listed
from lucida.renderer.system.errors import LucidaError

STRAIGHT = 1e-6  # smaller cosines are float32 rounding, and count as right angles
UNSEEN_PX = 0.01  # a change that moves no point of the image by more is rounding
ANY_SIZE = (4096, 4096)  # assumed for an image of unknown size
ROUNDED = 1e-4  # error of a rotation's numbers with four digits, or in float32
REMEDY = "make it orthonormal (Keep orthonormal, --up, orthonormalized()), or save a view file"


def rigid(camera: Camera, target: str) -> Camera:
    """Return the camera with the same rays whose u, v and w are orthonormal.

    A rotation that a file has rounded becomes the nearest rotation, and the viewport stays
    unchanged, so that images with one calibration keep sharing it. Otherwise the lengths of u and v
    move into the viewport. In perspective, so does the tilt of w; the image plane is then
    off-centre. near and far are measured along the new w. A parallel camera's eye moves to the
    viewport's centre.

    target: the name of the format, for errors. Raises LucidaError for a
    left-handed basis, for u and v that are not at right angles, and for an oblique parallel camera.
    A lens measures in u, v and w: with one, they must be orthogonal and equally long.
    """
    u, v, w = (np.asarray(vector) for vector in (camera.u, camera.v, camera.w))
    if camera.determinant < 0:
        problem = f"{listed(u)} is left-handed with v and w; {target} cannot mirror"
        raise LucidaError("u", problem, "negate u, which mirrors the picture")
    if np.abs(camera.basis.T @ camera.basis - np.eye(3)).max() <= ROUNDED:
        turn, _, back = np.linalg.svd(camera.basis)
        u, v, w = (turn @ back).T
        turned = replace(camera, u=tuple(u.tolist()), v=tuple(v.tolist()), w=tuple(w.tolist()))
        return centred(turned) if camera.is_parallel else turned
    width, height = float(np.linalg.norm(u)), float(np.linalg.norm(v))
    u, v = u / width, v / height
    back = np.cross(u, v)
    lean_x, lean_y, length = (float(w @ axis) for axis in (u, v, back))
    off = [float(u @ v)]
    if camera.is_parallel or camera.lens is not None:
        off += [lean_x / length, lean_y / length]
    if camera.lens is not None:
        off += [width / length - 1, height / length - 1]
    if max(map(abs, off)) > STRAIGHT:
        even = " and of equal length, as behind a lens" * (camera.lens is not None)
        problem = f"{listed(w)} is not at right angles to the others{even}, as {target} requires"
        raise LucidaError("w", problem, REMEDY)
    left, right, bottom, top = camera.viewport
    x, y = lean_x * camera.distance, lean_y * camera.distance
    if camera.is_parallel:
        x = y = 0.0
    straight = replace(
        camera,
        u=tuple(u.tolist()),
        v=tuple(v.tolist()),
        w=tuple(back.tolist()),
        distance=camera.distance * length,
        viewport=(left * width - x, right * width - x, bottom * height - y, top * height - y),
        near=None if camera.near is None else camera.near * length,
        far=None if camera.far is None else camera.far * length,
    )
    return centred(straight) if camera.is_parallel else straight


def centred(camera: Camera) -> Camera:
    """Return a parallel camera with the eye in its viewport's centre, and the same rays."""
    left, right, bottom, top = camera.viewport
    x, y = (left + right) / 2, (bottom + top) / 2
    eye = np.asarray(camera.eye) + x * np.asarray(camera.u) + y * np.asarray(camera.v)
    viewport = left - x, right - x, bottom - y, top - y
    return replace(camera, eye=tuple(eye.tolist()), viewport=viewport)


def pose_of(camera: Camera) -> Floats:
    """Return the matrix (4, 4) with the columns u, v, w and eye."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = camera.basis, camera.eye
    return pose
