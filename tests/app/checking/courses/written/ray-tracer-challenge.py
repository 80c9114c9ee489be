"""As readers of The Ray Tracer Challenge would write ray_for_pixel, in Python."""

import math

import numpy as np


def measured(camera):
    half_view = math.tan(camera.field_of_view / 2)
    aspect = camera.hsize / camera.vsize
    if aspect >= 1:
        half_width, half_height = half_view, half_view / aspect
    else:
        half_width, half_height = half_view * aspect, half_view
    return half_width, half_height, half_width * 2 / camera.hsize


def normalize(a):
    return a / np.linalg.norm(a)


def right_points(camera, px, py):
    """ray-for-pixel"""
    half_width, half_height, pixel_size = measured(camera)
    world_x = half_width - (px + 0.5) * pixel_size
    world_y = half_height - (py + 0.5) * pixel_size
    inverse = np.linalg.inv(camera.transform)
    pixel = inverse @ [world_x, world_y, -1, 1]
    origin = inverse @ [0, 0, 0, 1]
    return origin, normalize(pixel - origin)


def right_solved(camera, px, py):
    """ray-for-pixel"""
    half_width, half_height, pixel_size = measured(camera)
    local = [half_width - (px + 0.5) * pixel_size, half_height - (py + 0.5) * pixel_size, -1]
    turn = np.array(camera.transform)[:3, :3]
    origin = -turn.T @ np.array(camera.transform)[:3, 3]
    return {
        "origin": origin.tolist(),
        "direction": normalize(np.linalg.solve(turn, local)).tolist(),
    }


def wrong_x_to_the_right(camera, px, py):
    """ray-for-pixel: x points to the left"""
    half_width, half_height, pixel_size = measured(camera)
    world_x = (px + 0.5) * pixel_size - half_width
    world_y = half_height - (py + 0.5) * pixel_size
    inverse = np.linalg.inv(camera.transform)
    origin = inverse @ [0, 0, 0, 1]
    return origin, normalize(inverse @ [world_x, world_y, -1, 1] - origin)


def wrong_not_inverted(camera, px, py):
    """ray-for-pixel: from the world to the camera"""
    half_width, half_height, pixel_size = measured(camera)
    world_x = half_width - (px + 0.5) * pixel_size
    world_y = half_height - (py + 0.5) * pixel_size
    matrix = np.array(camera.transform)
    origin = matrix @ [0, 0, 0, 1]
    return origin, normalize(matrix @ [world_x, world_y, -1, 1] - origin)
