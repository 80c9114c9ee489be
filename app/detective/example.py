"""A camera's pose as another program would print it, as practice. Pure."""

from __future__ import annotations

import random

import numpy as np

from app.detective.readings import AXES, TURNS, Convention, Up, Way
from renderer.camera import Camera, Floats

DECIMALS = 7  # a basis of them is orthonormal enough to stay so
WAYS: tuple[Way, ...] = ("camera-to-world", "world-to-camera")
PROGRAMS = ("OpenGL", "OpenCV", "PyTorch3D")  # those with a right-handed camera


def drawn(seed: int) -> Convention:
    """Return a random convention; common ones more often."""
    chance = random.Random(seed)
    axes = chance.choices(PROGRAMS, (3, 3, 1))[0]
    return Convention(chance.choice(WAYS), chance.random() < 0.3, axes, chance.random() < 0.25)


def matrix_of(camera: Camera, convention: Convention, up: Up) -> Floats:
    """Return the camera's pose (4, 4) in a convention, as it is printed; the inverse of
    readings.py.
    """
    pose: Floats = np.eye(4)
    pose[:3, :3] = camera.basis
    pose[:3, 3] = camera.eye
    if convention.turned:
        pose[:3] = TURNS[up].T @ pose[:3]
    pose *= (*AXES[convention.axes], 1)
    if convention.way == "world-to-camera":
        pose = np.asarray(np.linalg.inv(pose), np.float64)
    return pose.T if convention.columns else pose


def printed_matrix(matrix: Floats) -> str:
    """Return a matrix as rows of numbers."""
    rows = [[f"{round(number, DECIMALS) + 0.0:.12g}" for number in row] for row in matrix.tolist()]
    wide = max(len(word) for row in rows for word in row)
    lines = ["[" + ", ".join(word.rjust(wide) for word in row) + "]" for row in rows]
    return "[" + ",\n ".join(lines) + "]\n"
