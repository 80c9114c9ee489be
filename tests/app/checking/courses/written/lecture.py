"""The lecture's formulas, typed in as they stand: i, j count from 1."""

import numpy as np


def right_as_written(i, j, width, height, camera):
    """viewing-ray"""
    x = camera.left + (j - 0.5) / width * (camera.right - camera.left)
    y = camera.top - (i - 0.5) / height * (camera.top - camera.bottom)
    u, v, w = np.array(camera.u), np.array(camera.v), np.array(camera.w)
    return camera.eye, x * u + y * v - camera.distance * w


def right_from_zero_first(i, j, width, height, camera):
    """viewing-ray"""
    i, j = i - 1, j - 1
    x = (camera.right - camera.left) * (2 * j + 1) / (2 * width) + camera.left
    y = camera.bottom + (camera.top - camera.bottom) * (2 * (height - i) - 1) / (2 * height)
    direction = [
        x * camera.u[k] + y * camera.v[k] - camera.distance * camera.w[k] for k in range(3)
    ]
    return {"origin": list(camera.eye), "direction": direction}


def right_parallel(i, j, width, height, camera):
    """viewing-ray-parallel"""
    basis = np.column_stack([camera.u, camera.v, camera.w])
    x = camera.left + (j - 0.5) * (camera.right - camera.left) / width
    y = camera.top - (i - 0.5) * (camera.top - camera.bottom) / height
    return camera.eye + basis @ [x, y, 0], -basis[:, 2]


def wrong_from_zero(i, j, width, height, camera):
    """viewing-ray: the half pixel, do not add it"""
    x = camera.left + (j + 0.5) / width * (camera.right - camera.left)
    y = camera.top - (i + 0.5) / height * (camera.top - camera.bottom)
    u, v, w = np.array(camera.u), np.array(camera.v), np.array(camera.w)
    return camera.eye, x * u + y * v - camera.distance * w


def wrong_parallel_from_the_eye(i, j, width, height, camera):
    """viewing-ray-parallel: the pixel moves the origin"""
    return camera.eye, tuple(-number for number in camera.w)
