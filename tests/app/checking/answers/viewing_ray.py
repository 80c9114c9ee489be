"""Answers to viewing-ray as students write them: right_, wrong_, unusable_."""

import numpy as np


def right_scalars(i, j, width, height, camera):
    x = camera.left + (j + 0.5) / width * (camera.right - camera.left)
    y = camera.top - (i + 0.5) / height * (camera.top - camera.bottom)
    direction = []
    for k in range(3):
        direction.append(x * camera.u[k] + y * camera.v[k] - camera.distance * camera.w[k])
    return camera.eye, direction


def right_arrays(row, column, w, h, cam):
    s = np.array([(column + 0.5) / w, (row + 0.5) / h])
    uv = np.array([cam.left, cam.top]) + s * np.array([cam.right - cam.left, cam.bottom - cam.top])
    basis = np.column_stack([cam.u, cam.v, cam.w])
    return np.array(cam.eye), basis @ np.array([*uv, -cam.distance])


class Ray:
    def __init__(self, origin, direction):
        self.origin = origin
        self.direction = direction


def right_class(i, j, width, height, camera):
    origin, direction = right_arrays(i, j, width, height, camera)
    return Ray(origin, 7.5 * direction)


def _made(i, j, width, height, camera, x=None, y=None, distance=None, swap=False):
    c = camera
    x = c.left + (j + 0.5) / width * (c.right - c.left) if x is None else x
    y = c.top - (i + 0.5) / height * (c.top - c.bottom) if y is None else y
    d = c.distance if distance is None else distance
    return c.eye, x * np.array(c.u) + y * np.array(c.v) - d * np.array(c.w)


def wrong_steps(i, j, width, height, camera):
    x = camera.left + j / (width - 1) * (camera.right - camera.left)
    return _made(i, j, width, height, camera, x=x)


def wrong_origin_on_the_viewport(i, j, width, height, camera):
    origin, direction = _made(i, j, width, height, camera)
    return origin + direction, direction


def unusable_none(i, j, width, height, camera):
    pass
