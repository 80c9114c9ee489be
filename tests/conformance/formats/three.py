"""three.js under node: ObjectLoader reads, toJSON() writes, Vector3.project computes the pixels."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np

from renderer.camera_formats import Options
from tests.conformance.cameras import cases, only, pixels, read
from tests.conformance.measured import Checked, Job, Measured, PeerMissing, asked, measured
from tests.support.format_cameras import straight_camera

SCRIPT = Path(__file__).parents[1] / "three_peer.mjs"


def check(job: Job) -> Checked:
    package = job.home / "node_modules" / "three" / "package.json"
    if not package.exists():
        raise PeerMissing("npm could not install three")
    version = json.loads(package.read_text())["version"]
    return Checked(
        f"three.js {version} under node: `ObjectLoader`, `toJSON`, `project`",
        (_ours(job), _theirs(job)),
    )


def _ours(job: Job) -> Measured:
    made = list(cases(job, straight_camera, parallel=True))
    given = [
        {
            "file": json.loads(case.file("three")),
            "size": case.size,
            "points": case.points.tolist(),
        }
        for case in made
    ]
    seen = _ask(job, {"do": "read", "cameras": given})
    errors = [np.array(one) - case.pixels for one, case in zip(seen, made, strict=True)]
    return measured("our JSON, read by three.js", errors)


def _theirs(job: Job) -> Measured:
    errors = []
    for made in _ask(job, {"do": "write", "count": job.cameras, "seed": job.seed}):
        data, size = json.dumps(made["file"]).encode(), tuple(made["size"])
        posed = only(read(data, "three", Options(size=size)))
        if made["has_size"] and posed.size != size:
            raise AssertionError(f"the view is {size}, and {posed.size} was read")
        # Without a view it is drawn by its own aspect ratio, stretched over the image.
        errors.append(pixels(posed.camera, np.array(made["points"]), size) - made["pixels"])
    return measured("its JSON, nested and off-axis, read by us", errors)


def _ask(job: Job, question: dict[str, Any]) -> Any:
    node = shutil.which("node")
    if node is None:
        raise PeerMissing("node is not there")
    return asked(job, question, [node, str(SCRIPT), str(job.home)])
