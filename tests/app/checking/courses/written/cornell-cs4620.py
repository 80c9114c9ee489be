"""As students of CS4620 would write getRay, in Python."""

import numpy as np


def normalize(a):
    return a / np.linalg.norm(a)


def init_view(camera):
    basis_w = normalize(-np.array(camera.projNormal))
    basis_u = normalize(np.cross(camera.viewUp, basis_w))
    basis_v = np.cross(basis_w, basis_u)
    return basis_u, basis_v, basis_w


def right_perspective(camera, u, v):
    """perspective-camera"""
    basis_u, basis_v, basis_w = init_view(camera)
    x = -camera.viewWidth / 2 + camera.viewWidth * u
    y = -camera.viewHeight / 2 + camera.viewHeight * v
    return camera.viewPoint, x * basis_u + y * basis_v - camera.projDistance * basis_w


def right_corner_first(camera, u, v):
    """perspective-camera"""
    forward = np.array(camera.viewDir)
    side = normalize(np.cross(forward, camera.viewUp)) * camera.viewWidth
    above = normalize(np.cross(side, forward)) * camera.viewHeight
    corner = camera.viewPoint + camera.projDistance * forward - side / 2 - above / 2
    point = corner + u * side + v * above
    return {"origin": camera.viewPoint, "direction": normalize(point - camera.viewPoint)}


def right_parallel(camera, u, v):
    """parallel-camera"""
    basis_u, basis_v, _ = init_view(camera)
    x = camera.viewWidth / 2 * (2 * u - 1)
    y = camera.viewHeight / 2 * (2 * v - 1)
    return camera.viewPoint + x * basis_u + y * basis_v, camera.viewDir


def wrong_not_centred(camera, u, v):
    """perspective-camera: begins at its edge"""
    basis_u, basis_v, basis_w = init_view(camera)
    x, y = camera.viewWidth * u, camera.viewHeight * v
    return camera.viewPoint, x * basis_u + y * basis_v - camera.projDistance * basis_w


def wrong_parallel_as_perspective(camera, u, v):
    """parallel-camera: all directions are -w"""
    basis_u, basis_v, basis_w = init_view(camera)
    x, y = camera.viewWidth * (u - 0.5), camera.viewHeight * (v - 0.5)
    return camera.viewPoint, x * basis_u + y * basis_v - camera.projDistance * basis_w


def wrong_neither_size_nor_centre(camera, u, v):
    """perspective-camera: multiply by the viewport's size, and begin at its edge"""
    basis_u, basis_v, basis_w = init_view(camera)
    return camera.viewPoint, u * basis_u + v * basis_v - camera.projDistance * basis_w


def wrong_one_not_centred(camera, u, v):
    """perspective-camera: In the rows alone: The viewport begins at its edge"""
    basis_u, basis_v, basis_w = init_view(camera)
    x, y = camera.viewWidth * (u - 0.5), camera.viewHeight * v
    return camera.viewPoint, x * basis_u + y * basis_v - camera.projDistance * basis_w


def wrong_brackets_forgotten(camera, u, v):
    """parallel-camera: subtract 0.5 before you multiply"""
    basis_u, basis_v, _ = init_view(camera)
    x, y = camera.viewWidth * u - 0.5, camera.viewHeight * v - 0.5
    return camera.viewPoint + x * basis_u + y * basis_v, camera.viewDir
