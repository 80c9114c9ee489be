"""As students of Scotty3D's courses would write its camera rays, in Python."""

import math

import numpy as np


def right_world(camera, screen_coord):
    """generate-ray"""
    height = 2 * math.tan(math.radians(camera.vert_fov) / 2)
    width = camera.aspect_ratio * height
    point = np.array([(screen_coord[0] - 0.5) * width, (screen_coord[1] - 0.5) * height, -1.0, 1.0])
    view = np.array(camera.iview)
    origin = view @ [0, 0, 0, 1]
    return origin[:3], (view @ point - origin)[:3]


def right_direction(camera, screen_coord):
    """generate-ray"""
    x, y = screen_coord
    half = math.tan(camera.vert_fov * math.pi / 360)
    local = [(2 * x - 1) * half * camera.aspect_ratio, (2 * y - 1) * half, -1, 0]
    direction = [sum(row[k] * local[k] for k in range(4)) for row in camera.iview][:3]
    return [row[3] for row in camera.iview][:3], direction


def right_sample(camera, px, py):
    """sample-ray"""
    h = 2 * math.tan(math.radians(camera.vertical_fov) / 2)
    w = camera.aspect_ratio * h
    x = (px + 0.5) / camera.film_width * w - w / 2
    y = (py + 0.5) / camera.film_height * h - h / 2
    return (0, 0, 0), (x, y, -1)


def right_sample_array(camera, px, py):
    """sample-ray"""
    half = np.tan(np.deg2rad(camera.vertical_fov / 2)) * np.array([camera.aspect_ratio, 1])
    film = np.array([camera.film_width, camera.film_height])
    xy = (2 * (np.array([px, py]) + 0.5) / film - 1) * half
    return np.zeros(3), np.append(xy, -1.0)


def wrong_aspect_of_the_angle(camera, screen_coord):
    """generate-ray: not the angle"""
    vertical = math.radians(camera.vert_fov)
    half_w = math.tan(vertical * camera.aspect_ratio / 2)
    half_h = math.tan(vertical / 2)
    x, y = screen_coord
    view = np.array(camera.iview)
    return view[:3, 3], view[:3, :3] @ [(2 * x - 1) * half_w, (2 * y - 1) * half_h, -1]


def wrong_sample_from_the_top(camera, px, py):
    """sample-ray: rows count upwards"""
    h = 2 * math.tan(math.radians(camera.vertical_fov) / 2)
    w = camera.aspect_ratio * h
    return (0, 0, 0), (
        (px + 0.5) / camera.film_width * w - w / 2,
        h / 2 - (py + 0.5) / camera.film_height * h,
        -1,
    )
