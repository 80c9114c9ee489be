"""Our own view files: nobody else's program reads them, so itself, to the bit."""

from __future__ import annotations

from dataclasses import astuple

from renderer.camera import Camera
from tests.conformance.cameras import cases, only, read
from tests.conformance.measured import Checked, Job, measured
from tests.support.format_cameras import skewed_camera


def check(job: Job) -> Checked:
    errors = []
    for case in cases(job, skewed_camera, parallel=True):
        again = only(read(case.file("view"), "view")).camera
        errors.append(_difference(case.camera, again))
    told = measured("written and read", errors, 0.0, cameras=job.cameras)
    return Checked("itself, to the bit", (told,))


def _difference(one: Camera, other: Camera) -> float:
    """0 where all fields are the same, to the bit."""
    return 0.0 if astuple(one) == astuple(other) else 1.0
