"""As readers of Ray Tracing in One Weekend would write get_ray, in Python."""

import math

import numpy as np


def unit_vector(a):
    return a / np.linalg.norm(a)


def right_get_ray(i, j, camera):
    """get-ray"""
    center = np.array(camera.center)
    pixel_center = (
        np.array(camera.pixel00_loc)
        + i * np.array(camera.pixel_delta_u)
        + j * np.array(camera.pixel_delta_v)
    )
    return center, pixel_center - center


def right_get_ray_plain(i, j, camera):
    """get-ray"""
    direction = []
    for k in range(3):
        point = camera.pixel00_loc[k] + i * camera.pixel_delta_u[k] + j * camera.pixel_delta_v[k]
        direction.append(point - camera.center[k])
    return camera.center, direction


def right_positionable(i, j, camera):
    """get-ray-positionable"""
    center = np.array(camera.lookfrom)
    viewport_height = 2 * math.tan(math.radians(camera.vfov) / 2) * camera.focus_dist
    viewport_width = viewport_height * camera.image_width / camera.image_height
    w = unit_vector(center - camera.lookat)
    u = unit_vector(np.cross(camera.vup, w))
    v = np.cross(w, u)
    viewport_u, viewport_v = viewport_width * u, viewport_height * -v
    delta_u, delta_v = viewport_u / camera.image_width, viewport_v / camera.image_height
    upper_left = center - camera.focus_dist * w - viewport_u / 2 - viewport_v / 2
    pixel00_loc = upper_left + 0.5 * (delta_u + delta_v)
    return center, pixel00_loc + i * delta_u + j * delta_v - center


def right_st(s, t, camera):
    """get-ray-st"""
    o, c, h, v = map(
        np.array, (camera.origin, camera.lower_left_corner, camera.horizontal, camera.vertical)
    )
    return o, c + s * h + t * v - o


def wrong_row_first(i, j, camera):
    """get-ray: exchanged"""
    point = (
        np.array(camera.pixel00_loc)
        + j * np.array(camera.pixel_delta_u)
        + i * np.array(camera.pixel_delta_v)
    )
    return camera.center, point - camera.center


def wrong_no_focus_dist(i, j, camera):
    """get-ray-positionable: focus_dist"""
    center = np.array(camera.lookfrom)
    viewport_height = 2 * math.tan(math.radians(camera.vfov) / 2)
    viewport_width = viewport_height * camera.image_width / camera.image_height
    w = unit_vector(center - camera.lookat)
    u = unit_vector(np.cross(camera.vup, w))
    v = np.cross(w, u)
    delta_u = viewport_width * u / camera.image_width
    delta_v = viewport_height * -v / camera.image_height
    upper_left = center - camera.focus_dist * w - viewport_width * u / 2 + viewport_height * v / 2
    return center, upper_left + (i + 0.5) * delta_u + (j + 0.5) * delta_v - center


def wrong_st_from_the_top(s, t, camera):
    """get-ray-st: y needs no minus sign"""
    o, c, h, v = map(
        np.array, (camera.origin, camera.lower_left_corner, camera.horizontal, camera.vertical)
    )
    return o, c + s * h + (1 - t) * v - o
