"""OpenGL: pyrr's matrices. It multiplies row vectors from the left; so its arrays, flattened, are
OpenGL's columns one after another.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from renderer.camera_checks import Floats
from renderer.camera_formats import Options
from tests.conformance.cameras import POINTS, any_pose, any_size, cases, only, pixels, read
from tests.conformance.measured import Checked, Job, Measured, measured, needed
from tests.support.format_cameras import skewed_camera

NEAR, FAR = 0.1, 100.0
NAMES = ("camera_from_world", "clip_from_camera")


def check(job: Job) -> Checked:
    pyrr = needed("pyrr")
    return Checked(f"pyrr {pyrr.__version__}: `matrix44`", (_ours(pyrr, job), _theirs(pyrr, job)))


def _ours(pyrr: Any, job: Job) -> Measured:
    errors = []
    for case in cases(job, skewed_camera, parallel=True):
        found: dict[str, Any] = {}
        exec(case.file("opengl"), {}, found)
        view, clip = (np.reshape(found[name], (4, 4)) for name in NAMES)
        errors.append(_seen(pyrr, view, clip, case.points, case.size) - case.pixels)
    return measured("our matrices, multiplied by pyrr", errors)


def _theirs(pyrr: Any, job: Job) -> Measured:
    """Read its matrices column by column, row by row, and as JSON."""
    random, errors, m = job.random, [], pyrr.matrix44
    for number in range(job.cameras):
        size = any_size(random)
        eye, target = random.normal(size=(2, 3)) * 3
        view = m.create_look_at(eye, target, any_pose(random)[0, :3], dtype=float)
        edges = np.ravel(random.uniform(0.1, 1, (2, 2)) * (-1, 1))
        if number % 3 == 0:
            angle, aspect = random.uniform(10, 120), size[0] / size[1]
            clip = m.create_perspective_projection_matrix(angle, aspect, NEAR, FAR, dtype=float)
        elif number % 3 == 1:
            make = m.create_perspective_projection_from_bounds
            clip = make(*(NEAR * edges), NEAR, FAR, dtype=float)
        else:
            clip = m.create_orthogonal_projection_matrix(*(3 * edges), NEAR, FAR, dtype=float)
        posed = only(read(_text(view, clip, number), "opengl", Options(size=size)))
        # Points of the view volume, from the cube that is drawn.
        cube = np.column_stack([random.uniform(-0.98, 0.98, (POINTS, 3)), np.ones(POINTS)])
        world = cube @ np.linalg.inv(view @ clip)
        points = world[:, :3] / world[:, 3:]
        seen = _seen(pyrr, view, clip, points, size)
        errors.append(pixels(posed.camera, points, size) - seen)
    return measured("its matrices, read by us", errors)


def _text(view: Floats, clip: Floats, number: int) -> bytes:
    """Write matrices in one of the forms that people use."""
    if number % 5 == 4:
        return json.dumps({"view": view.tolist(), "projection": clip.tolist()}).encode()
    tables = [np.ravel(table.T if number % 2 else table).tolist() for table in (view, clip)]
    return f"view_matrix = {tables[0]}\nprojection_matrix = {tables[1]}".encode()


def _seen(pyrr: Any, view: Floats, clip: Floats, points: Floats, size: tuple[int, int]) -> Floats:
    both = pyrr.matrix44.multiply(view, clip)
    seen = [pyrr.matrix44.apply_to_vector(both, np.append(point, 1.0)) for point in points]
    x, y, _, w = np.transpose(seen)
    return np.column_stack([(x / w + 1) / 2 * size[0], (1 - y / w) / 2 * size[1]])
