"""Answers to viewing-ray-parallel."""

import numpy as np


def _uv(i, j, width, height, camera):
    x = camera.left + (j + 0.5) / width * (camera.right - camera.left)
    y = camera.top - (i + 0.5) / height * (camera.top - camera.bottom)
    return x, y


def right_scalars(i, j, width, height, camera):
    x, y = _uv(i, j, width, height, camera)
    origin = [e + x * a + y * b for e, a, b in zip(camera.eye, camera.u, camera.v)]
    return origin, [-part for part in camera.w]


def right_arrays(i, j, width, height, camera):
    x, y = _uv(i, j, width, height, camera)
    return camera.eye + x * np.array(camera.u) + y * np.array(camera.v), -np.array(camera.w)


def right_unit(i, j, width, height, camera):
    origin, direction = right_arrays(i, j, width, height, camera)
    return tuple(origin), tuple(direction / np.linalg.norm(direction))


def wrong_at_the_eye(i, j, width, height, camera):
    return camera.eye, -np.array(camera.w)


def wrong_perspective(i, j, width, height, camera):
    x, y = _uv(i, j, width, height, camera)
    d = x * np.array(camera.u) + y * np.array(camera.v) - camera.distance * np.array(camera.w)
    return camera.eye, d


def unusable_none(i, j, width, height, camera):
    return None
