"""As students of CS184 would write generate_ray, in Python."""

from math import radians, tan

import numpy as np


def unit(a):
    return a / np.linalg.norm(a)


def right_from_the_corner(camera, x, y):
    """generate-ray"""
    bottom_left = np.array([-tan(radians(camera.hFov) * 0.5), -tan(radians(camera.vFov) * 0.5), -1])
    top_right = np.array([tan(radians(camera.hFov) * 0.5), tan(radians(camera.vFov) * 0.5), -1])
    point = bottom_left + np.array([x, y, 0]) * (top_right - bottom_left)
    return camera.pos, unit(np.array(camera.c2w) @ point)


def right_from_the_middle(camera, x, y):
    """generate-ray"""
    h, v = camera.hFov * np.pi / 180, camera.vFov * np.pi / 180
    c = [2 * np.tan(h / 2) * (x - 0.5), 2 * np.tan(v / 2) * (y - 0.5), -1.0]
    direction = [sum(row[k] * c[k] for k in range(3)) for row in camera.c2w]
    length = sum(d * d for d in direction) ** 0.5
    return list(camera.pos), [d / length for d in direction]


def wrong_degrees(camera, x, y):
    """generate-ray: The tangent takes radians"""
    point = [tan(camera.hFov / 2) * (2 * x - 1), tan(camera.vFov / 2) * (2 * y - 1), -1]
    return camera.pos, unit(np.array(camera.c2w) @ point)


def wrong_not_unit(camera, x, y):
    """generate-ray: length"""
    h, v = radians(camera.hFov), radians(camera.vFov)
    return camera.pos, np.array(camera.c2w) @ [
        tan(h / 2) * (2 * x - 1),
        tan(v / 2) * (2 * y - 1),
        -1,
    ]


def wrong_half_of_the_tangent(camera, x, y):
    """generate-ray: The tangent of half the angle is meant"""
    h, v = radians(camera.hFov), radians(camera.vFov)
    point = [tan(h) * (x - 0.5), tan(v) * (y - 0.5), -1]
    return camera.pos, unit(np.array(camera.c2w) @ point)
