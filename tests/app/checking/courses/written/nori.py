"""As students with Nori would write the perspective camera's sampleRay, in Python."""

import math

import numpy as np


def unit(a):
    return np.asarray(a, float) / np.linalg.norm(a)


def right_by_cotangent(camera, sample_position):
    """sample-ray"""
    width, height = camera.output_size
    aspect = width / height
    cot = 1 / math.tan(math.radians(camera.fov) / 2)
    x = (1 - 2 * sample_position[0] / width) / cot
    y = (1 - 2 * sample_position[1] / height) / (aspect * cot)
    m = np.array(camera.camera_to_world)
    return m[:3, 3], m[:3, :3] @ unit([x, y, 1])


def right_plain(camera, sample_position):
    """sample-ray"""
    width, height = camera.output_size
    half = math.tan(camera.fov / 2 * math.pi / 180)
    x = half * (width - 2 * sample_position[0]) / width
    y = half * (height - 2 * sample_position[1]) / width
    length = (x * x + y * y + 1) ** 0.5
    rows = camera.camera_to_world[:3]
    return {
        "origin": [row[3] for row in rows],
        "direction": [(row[0] * x + row[1] * y + row[2]) / length for row in rows],
    }


def wrong_x_to_the_right(camera, sample_position):
    """sample-ray: x points to the left"""
    width, height = camera.output_size
    half = math.tan(math.radians(camera.fov) / 2)
    x = half * (2 * sample_position[0] - width) / width
    y = half * (height - 2 * sample_position[1]) / width
    m = np.array(camera.camera_to_world)
    return m[:3, 3], m[:3, :3] @ unit([x, y, 1])


def wrong_no_aspect(camera, sample_position):
    """sample-ray: aspect ratio"""
    width, height = camera.output_size
    half = math.tan(math.radians(camera.fov) / 2)
    x, y = half * (1 - 2 * sample_position[0] / width), half * (1 - 2 * sample_position[1] / height)
    m = np.array(camera.camera_to_world)
    return m[:3, 3], m[:3, :3] @ unit([x, y, 1])
