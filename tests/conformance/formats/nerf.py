"""NeRF: its own formula, written here, for there is no library that all share.

A pixel's ray, as run_nerf_helpers.py's get_rays() and nerfstudio have it, whole numbers at the
corners: direction ((x - cx) / fx, -(y - cy) / fy, -1), turned by transform_matrix, from its last
column.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from renderer.camera_checks import Floats
from renderer.camera_formats import PosedCamera, written
from tests.conformance.cameras import POINTS, any_size, cases, pixels, read, rotation
from tests.conformance.measured import Checked, Job, Measured, measured
from tests.support.format_cameras import straight_camera


def check(job: Job) -> Checked:
    return Checked("NeRF's `get_rays()`, written in the check", (_ours(job), _theirs(job)))


def _ours(job: Job) -> Measured:
    made = list(cases(job, straight_camera))
    table = json.loads(written([case.posed for case in made], "nerf")[""])
    errors = []
    for case, frame in zip(made, table["frames"], strict=True):
        found = {**table, **frame}
        if (found["w"], found["h"]) != case.size:
            raise AssertionError("another size")
        errors.append(_seen(found, case.points) - case.pixels)
        # Who takes the angles sees the same: the image's width and height in their tangents.
        for angle, side, focal in (
            ("camera_angle_x", "w", "fl_x"),
            ("camera_angle_y", "h", "fl_y"),
        ):
            by_angle = found[side] / 2 / math.tan(found[angle] / 2)
            errors[-1] = np.vstack([errors[-1], [[by_angle - found[focal], 0.0]]])
    return measured("our transforms.json", errors, cameras=job.cameras)


def _theirs(job: Job) -> Measured:
    """In the forms of the synthetic scenes, of instant-ngp and of nerfstudio."""
    random, errors = job.random, []
    for number in range(job.cameras):
        width, height = any_size(random)
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = rotation(random), 3 * random.normal(size=3)
        focal = max(width, height) * random.uniform(0.5, 3)
        full = {"w": width, "h": height, "fl_x": focal, "fl_y": focal}
        full |= {"cx": width / 2, "cy": height / 2}
        if number % 3:
            full |= {
                "cx": width * random.uniform(0.3, 0.7),
                "cy": height * random.uniform(0.3, 0.7),
            }
            full["fl_y"] = focal * random.uniform(0.7, 1.4)
            told = dict(full)
        else:
            told = {"camera_angle_x": 2 * math.atan(width / 2 / focal), "w": width, "h": height}
        frame = {"file_path": "./train/r_0", "transform_matrix": pose.tolist()}
        table = {**told, "frames": [frame]} if number % 2 else {"frames": [{**told, **frame}]}
        x, y = random.uniform(0, 1, (2, POINTS)) * [[width], [height]]
        ahead = np.column_stack(
            [(x - full["cx"]) / full["fl_x"], -(y - full["cy"]) / full["fl_y"], -np.ones(POINTS)]
        )
        points = random.uniform(0.5, 5, (POINTS, 1)) * ahead @ pose[:3, :3].T + pose[:3, 3]
        (posed,) = read(json.dumps(table).encode(), "nerf").cameras
        errors.append(_of(posed, points) - np.column_stack([x, y]))
    return measured("files in its three forms, read by us", errors, cameras=job.cameras)


def _of(posed: PosedCamera, points: Floats) -> Floats:
    assert posed.size is not None
    return pixels(posed.camera, points, posed.size)


def _seen(frame: dict[str, Any], points: Floats) -> Floats:
    """get_rays() turned round: the pixel whose ray leads to a point."""
    pose = np.array(frame["transform_matrix"])
    x, y, back = np.linalg.solve(pose[:3, :3], (points - pose[:3, 3]).T)
    return np.column_stack(
        [frame["cx"] + frame["fl_x"] * x / -back, frame["cy"] - frame["fl_y"] * y / -back]
    )
