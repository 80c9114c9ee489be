"""OpenGL: pyrr's matrices. It multiplies row vectors from the left, so that its arrays, flattened,
are OpenGL's columns one after another."""

from __future__ import annotations

import ast
import json
import re
from typing import Any

import numpy as np

from renderer.camera_checks import Floats
from renderer.camera_formats import Options
from tests.conformance.cameras import POINTS, any_size, cases, only, pixels, read, rotation
from tests.conformance.measured import Checked, Job, Measured, measured, needed
from tests.support.format_cameras import skewed_camera

NEAR, FAR = 0.1, 100.0


def check(job: Job) -> Checked:
    pyrr = needed("pyrr")
    return Checked(f"pyrr {pyrr.__version__}: `matrix44`", (_ours(pyrr, job), _theirs(pyrr, job)))


def _ours(pyrr: Any, job: Job) -> Measured:
    errors = []
    for case in cases(job, skewed_camera, parallel=True):
        text = case.file("opengl").decode()
        found = re.findall(r"(\w+) = (\[.*?\n\])", text, re.DOTALL)
        view, clip = (
            np.reshape(ast.literal_eval(dict(found)[name]), (4, 4))
            for name in ("camera_from_world", "clip_from_camera")
        )
        errors.append(_seen(pyrr, view, clip, case.points, case.size) - case.pixels)
    return measured("our matrices, multiplied by pyrr", errors, cameras=job.cameras)


def _theirs(pyrr: Any, job: Job) -> Measured:
    """Its matrices column by column, row by row, and as JSON."""
    random, errors, m = job.random, [], pyrr.matrix44
    for number in range(job.cameras):
        size = any_size(random)
        eye, target = random.normal(size=(2, 3)) * 3
        view = m.create_look_at(eye, target, rotation(random)[0], dtype=float)
        left, bottom = -random.uniform(0.1, 1, 2)
        right, top = random.uniform(0.1, 1, 2)
        if number % 3 == 0:
            angle, aspect = random.uniform(10, 120), size[0] / size[1]
            clip = m.create_perspective_projection_matrix(angle, aspect, NEAR, FAR, dtype=float)
        elif number % 3 == 1:
            edges = NEAR * left, NEAR * right, NEAR * bottom, NEAR * top
            clip = m.create_perspective_projection_from_bounds(*edges, NEAR, FAR, dtype=float)
        else:
            edges = 3 * left, 3 * right, 3 * bottom, 3 * top
            clip = m.create_orthogonal_projection_matrix(*edges, NEAR, FAR, dtype=float)
        posed = only(read(_text(view, clip, number), "opengl", Options(size=size)))
        # Points of the view volume, from the cube that is drawn.
        cube = np.column_stack([random.uniform(-0.98, 0.98, (POINTS, 3)), np.ones(POINTS)])
        world = cube @ np.linalg.inv(view @ clip)
        points = world[:, :3] / world[:, 3:]
        seen = _seen(pyrr, view, clip, points, size)
        errors.append(pixels(posed.camera, points, size) - seen)
    return measured("its matrices, read by us", errors, cameras=job.cameras)


def _text(view: Floats, clip: Floats, number: int) -> bytes:
    """In one of the ways in which people write matrices down."""
    if number % 5 == 4:
        return json.dumps({"view": view.tolist(), "projection": clip.tolist()}).encode()
    order = "T" if number % 2 else "ravel"
    tables = [np.ascontiguousarray(table.T if order == "T" else table) for table in (view, clip)]
    names = ("view_matrix", "projection_matrix")
    lines = [
        f"{name} = [{', '.join(map(repr, table.ravel().tolist()))}]"
        for name, table in zip(names, tables, strict=True)
    ]
    return "\n".join(lines).encode()


def _seen(pyrr: Any, view: Floats, clip: Floats, points: Floats, size: tuple[int, int]) -> Floats:
    both = pyrr.matrix44.multiply(view, clip)
    seen = [pyrr.matrix44.apply_to_vector(both, np.append(point, 1.0)) for point in points]
    x, y, _, w = np.transpose(seen)
    return np.column_stack([(x / w + 1) / 2 * size[0], (1 - y / w) / 2 * size[1]])
