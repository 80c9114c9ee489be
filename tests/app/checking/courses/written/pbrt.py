"""As readers of pbrt would write the perspective camera's GenerateRay, in Python."""

import math

import numpy as np


def unit(a):
    return np.asarray(a, float) / np.linalg.norm(a)


def screen_window(camera):
    aspect = camera.resolution[0] / camera.resolution[1]
    return (aspect, 1.0) if aspect > 1 else (1.0, 1 / aspect)


def right_by_matrices(camera, p_film):
    """generate-ray"""
    xres, yres = camera.resolution
    sx, sy = screen_window(camera)
    ndc_from_screen = np.array([[0.5 / sx, 0, 0.5], [0, -0.5 / sy, 0.5], [0, 0, 1]])
    screen = np.linalg.inv(np.diag([xres, yres, 1]) @ ndc_from_screen) @ [*p_film, 1]
    scale = math.tan(math.radians(camera.fov) / 2)
    direction = np.array(camera.world_from_camera)[:3, :3] @ [*(scale * screen[:2]), 1]
    return np.array(camera.world_from_camera)[:3, 3], unit(direction)


def right_by_hand(camera, p_film):
    """generate-ray"""
    half = math.tan(camera.fov * math.pi / 360)
    shorter = min(camera.resolution)
    x = (2 * p_film[0] - camera.resolution[0]) / shorter * half
    y = (camera.resolution[1] - 2 * p_film[1]) / shorter * half
    length = math.sqrt(x * x + y * y + 1)
    rows = camera.world_from_camera[:3]
    return [r[3] for r in rows], [(r[0] * x + r[1] * y + r[2]) / length for r in rows]


def wrong_z_backwards(camera, p_film):
    """generate-ray: z points forwards"""
    half = math.tan(math.radians(camera.fov) / 2)
    sx, sy = screen_window(camera)
    x = (2 * p_film[0] / camera.resolution[0] - 1) * sx * half
    y = (1 - 2 * p_film[1] / camera.resolution[1]) * sy * half
    m = np.array(camera.world_from_camera)
    return m[:3, 3], unit(m[:3, :3] @ [x, y, -1])


def wrong_vertical_fov(camera, p_film):
    """generate-ray: shorter side"""
    half = math.tan(math.radians(camera.fov) / 2)
    aspect = camera.resolution[0] / camera.resolution[1]
    x = (2 * p_film[0] / camera.resolution[0] - 1) * aspect * half
    y = (1 - 2 * p_film[1] / camera.resolution[1]) * half
    m = np.array(camera.world_from_camera)
    return m[:3, 3], unit(m[:3, :3] @ [x, y, 1])
