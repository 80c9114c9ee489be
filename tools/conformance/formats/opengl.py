"""OpenGL: GLM's matrices, and where it sees points through them. Lucida's are pyrr's.

GLM's matrices are lists of columns. Its projections are in float32, but their numbers are exact in
float64, in which all else is computed.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from lucida.renderer.camera.checks import Floats
from lucida.renderer.files.cameras import Options
from tests.support.format_cameras import skewed_camera
from tools.conformance.cameras import POINTS, any_pose, any_size, cases, only, pixels, read
from tools.conformance.measured import Checked, Job, Measured, measured, needed

NEAR, FAR = 0.1, 100.0
NAMES = ("camera_from_world", "clip_from_camera")


def check(job: Job) -> Checked:
    glm = needed("glm")
    ours, theirs = _ours(glm, job), _theirs(glm, job)
    return Checked(f"PyGLM {glm.__version__}: `lookAt`, `frustum`, `project`", (ours, theirs))


def _ours(glm: Any, job: Job) -> Measured:
    errors = []
    for case in cases(job, skewed_camera, parallel=True):
        found: dict[str, Any] = {}
        exec(case.file("opengl"), {}, found)
        view, clip = (glm.dmat4(*np.ravel(found[name]).tolist()) for name in NAMES)
        errors.append(_seen(glm, view, clip, case.points, case.size) - case.pixels)
    return measured("our matrices, by its project()", errors)


def _theirs(glm: Any, job: Job) -> Measured:
    """Read its matrices column by column, row by row, and as JSON."""
    random, errors = job.random, []
    for number in range(job.cameras):
        size = any_size(random)
        eye, target, up = (
            glm.dvec3(*vector)
            for vector in (*random.normal(size=(2, 3)) * 3, any_pose(random)[0, :3])
        )
        view = glm.lookAt(eye, target, up)
        edges = np.ravel(random.uniform(0.1, 1, (2, 2)) * (-1, 1)).tolist()
        if number % 3 == 0:
            angle, aspect = random.uniform(0.2, 2), size[0] / size[1]
            clip = glm.perspective(angle, aspect, NEAR, FAR)
        elif number % 3 == 1:
            clip = glm.frustum(*(NEAR * edge for edge in edges), NEAR, FAR)
        else:
            clip = glm.ortho(*(3 * edge for edge in edges), NEAR, FAR)
        clip = glm.dmat4(clip)
        posed = only(read(_text(_rows(view), _rows(clip), number), "opengl", Options(size=size)))
        # Points of the view volume, from the cube that is drawn.
        cube = np.column_stack([random.uniform(-0.98, 0.98, (POINTS, 3)), np.ones(POINTS)])
        world = cube @ np.linalg.inv(_rows(view) @ _rows(clip))
        points = world[:, :3] / world[:, 3:]
        seen = _seen(glm, view, clip, points, size)
        errors.append(pixels(posed.camera, points, size) - seen)
    return measured("its matrices, read by us", errors)


def _rows(matrix: Any) -> Floats:
    """Return the columns of a matrix of GLM as rows, for row vectors."""
    return np.array(matrix.to_list())


def _text(view: Floats, clip: Floats, number: int) -> bytes:
    """Write matrices in one of the forms that people use."""
    if number % 5 == 4:
        return json.dumps({"view": view.tolist(), "projection": clip.tolist()}).encode()
    tables = [np.ravel(table.T if number % 2 else table).tolist() for table in (view, clip)]
    return f"view_matrix = {tables[0]}\nprojection_matrix = {tables[1]}".encode()


def _seen(glm: Any, view: Any, clip: Any, points: Floats, size: tuple[int, int]) -> Floats:
    whole = glm.dvec4(0, 0, *size)
    seen = [glm.project(glm.dvec3(*point), view, clip, whole) for point in points]
    return np.array([(x, size[1] - y) for x, y, _ in seen])
