"""As students of 6.837 would write generateRay, in Python."""

import numpy as np


def normalized(a):
    return np.asarray(a, float) / np.linalg.norm(a)


def right_at_distance(camera, point):
    """generate-ray"""
    direction = normalized(camera.direction)
    horizontal = normalized(np.cross(direction, camera.up))
    up = np.cross(horizontal, direction)
    distance = 1.0 / np.tan(camera.angle / 2)
    ray = distance * direction + point[0] * horizontal + point[1] * up
    return camera.center, normalized(ray)


def right_scaled(camera, point):
    """generate-ray"""
    w = normalized(camera.direction)
    u = normalized(np.cross(w, camera.up))
    v = normalized(np.cross(u, w))
    x, y = np.tan(camera.angle / 2) * np.array(point)
    return {"origin": camera.center, "direction": (w + x * u + y * v).astype(np.float32)}


def wrong_whole_angle(camera, point):
    """generate-ray: tangent of half of it"""
    w = normalized(camera.direction)
    u = normalized(np.cross(w, camera.up))
    v = normalized(np.cross(u, w))
    d = 1 / np.tan(camera.angle)
    return camera.center, d * w + point[0] * u + point[1] * v


def wrong_tangent_for_distance(camera, point):
    """generate-ray: the edge is distance times the tangent"""
    w = normalized(camera.direction)
    u = normalized(np.cross(w, camera.up))
    v = normalized(np.cross(u, w))
    d = np.tan(camera.angle / 2)
    return camera.center, d * w + point[0] * u + point[1] * v
