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


def right_float32(i, j, width, height, camera):
    x, y = np.float32(_uv(i, j, width, height, camera))
    eye, u, v, w = np.float32([camera.eye, camera.u, camera.v, camera.w])
    return eye + x * u + y * v, -w


def right_unit(i, j, width, height, camera):
    origin, direction = right_arrays(i, j, width, height, camera)
    return tuple(origin), tuple(direction / np.linalg.norm(direction))


def right_branching(i, j, width, height, camera):
    if camera.projection != "parallel":
        raise ValueError
    origin, direction = right_arrays(i, j, width, height, camera)
    return {"direction": direction * camera.distance, "origin": origin}


def wrong_at_the_eye(i, j, width, height, camera):
    return camera.eye, -np.array(camera.w)


def wrong_perspective(i, j, width, height, camera):
    x, y = _uv(i, j, width, height, camera)
    d = x * np.array(camera.u) + y * np.array(camera.v) - camera.distance * np.array(camera.w)
    return camera.eye, d


def wrong_both(i, j, width, height, camera):
    return right_arrays(i, j, width, height, camera)[0], wrong_perspective(
        i, j, width, height, camera
    )[1]


def unusable_none(i, j, width, height, camera):
    return None
