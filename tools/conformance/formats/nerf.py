"""NeRF: its own formula, and nerfstudio's lenses, written here, since no library is common to all.

A pixel's ray, as in run_nerf_helpers.py's get_rays() and nerfstudio, with integers at the corners:
direction ((x - cx) / fx, -(y - cy) / fy, -1), rotated by transform_matrix, from its last column.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from lucida.renderer.camera.checks import Floats
from tests.support.format_cameras import transforms_json
from tools.conformance.cameras import (
    POINTS,
    any_pose,
    any_size,
    lens_cases,
    only,
    pixels,
    read,
)
from tools.conformance.measured import Checked, Job, Measured, measured

KINDS = ("simple radial", "radial", "opencv", "plumb bob", "simple fisheye", "fisheye")


def check(job: Job) -> Checked:
    return Checked("NeRF's `get_rays()`, written in the check", (_theirs(job), _lenses(job)))


def _theirs(job: Job) -> Measured:
    """Read files in the forms of the synthetic scenes, of instant-ngp and of nerfstudio."""
    random, errors = job.random, []
    for number in range(job.cameras):
        width, height = size = any_size(random)
        pose = any_pose(random)
        fx = fy = max(size) * random.uniform(0.5, 3)
        cx, cy = width / 2, height / 2
        told: dict[str, Any] = {"w": width, "h": height}
        if number % 3:
            cx, cy = np.array(size) * random.uniform(0.3, 0.7, 2)
            fy = fx * random.uniform(0.7, 1.4)
            told |= {"fl_x": fx, "fl_y": fy, "cx": cx, "cy": cy}
        else:
            told["camera_angle_x"] = 2 * math.atan(width / 2 / fx)
        frame = {"file_path": "./train/r_0", "transform_matrix": pose.tolist()}
        table = {**told, "frames": [frame]} if number % 2 else {"frames": [{**told, **frame}]}
        x, y = random.uniform(0, 1, (2, POINTS)) * [[width], [height]]
        ahead = np.column_stack([(x - cx) / fx, -(y - cy) / fy, -np.ones(POINTS)])
        points = random.uniform(0.5, 5, (POINTS, 1)) * ahead @ pose[:3, :3].T + pose[:3, 3]
        posed = only(read(json.dumps(table).encode(), "nerf"))
        errors.append(pixels(posed.camera, points, posed.size) - np.column_stack([x, y]))
    return measured("files in its three forms, read by us", errors)


def _lenses(job: Job) -> Measured:
    """Read a file for each camera, and see its points by nerfstudio's formulas."""
    errors = []
    for case in lens_cases(job, KINDS):
        text = transforms_json([case.posed])
        table, posed = json.loads(text), only(read(text.encode(), "nerf"))
        seen = _seen({**table, **table["frames"][0]}, case.points)
        errors.append(pixels(posed.camera, case.points, posed.size) - seen)
    return measured(f"lenses, {len(KINDS)} kinds, by nerfstudio's formulas", errors, beside=True)


def _bent(frame: dict[str, Any], x: Floats, y: Floats, z: Floats) -> tuple[Floats, Floats]:
    """Return where a lens sees directions: x right, y down, z forward."""
    across, a, b = np.hypot(x, y), x / z, y / z
    if frame["camera_model"] == "OPENCV_FISHEYE":
        a, b = (part / across * np.arctan2(across, z) for part in (x, y))
    k1, k2, k3, k4, p1, p2 = (frame.get(name, 0.0) for name in ["k1", "k2", "k3", "k4", "p1", "p2"])
    s = a * a + b * b
    radial = 1 + s * (k1 + s * (k2 + s * (k3 + s * k4)))
    return (
        a * radial + 2 * p1 * a * b + p2 * (s + 2 * a * a),
        b * radial + 2 * p2 * a * b + p1 * (s + 2 * b * b),
    )


def _seen(frame: dict[str, Any], points: Floats) -> Floats:
    """Return the pixels whose rays lead to these points: the inverse of get_rays()."""
    pose = np.array(frame["transform_matrix"])
    x, y, back = np.linalg.solve(pose[:3, :3], (points - pose[:3, 3]).T)
    a, b = _bent(frame, x, -y, -back)
    return np.column_stack([frame["cx"] + frame["fl_x"] * a, frame["cy"] + frame["fl_y"] * b])
