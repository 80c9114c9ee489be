"""Lucida's own view files, which no other program reads: they come back to the bit."""

from __future__ import annotations

from tests.support.format_cameras import skewed_camera
from tools.conformance.cameras import cases, only, read
from tools.conformance.measured import Checked, Job, measured


def check(job: Job) -> Checked:
    errors = [
        float(only(read(case.file("view"), "view")).camera != case.camera)
        for case in cases(job, skewed_camera, parallel=True)
    ]
    return Checked("itself, to the bit", (measured("written and read", errors, 0.0),))
