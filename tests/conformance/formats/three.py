"""three.js under node: ObjectLoader reads, toJSON() writes, Vector3.project says the pixels."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np

from renderer.camera_formats import Options
from tests.conformance.cameras import cases, only, pixels, read
from tests.conformance.measured import Checked, Job, Measured, PeerMissing, measured
from tests.support.format_cameras import straight_camera

SCRIPT = Path(__file__).parents[1] / "three_peer.mjs"


def check(job: Job) -> Checked:
    package = _installed(job) / "package.json"
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
    return measured("our JSON, read by three.js", errors, cameras=job.cameras)


def _theirs(job: Job) -> Measured:
    errors = []
    for made in _ask(job, {"do": "write", "count": job.cameras, "seed": job.seed}):
        data, size = json.dumps(made["file"]).encode(), tuple(made["size"])
        posed = only(read(data, "three", Options(size=size)))
        if made["has_size"] and posed.size != size:
            raise AssertionError(f"the view is {size}, and {posed.size} was read")
        # Without a view it is drawn by its own aspect ratio, stretched over the image.
        seen = pixels(posed.camera, np.array(made["points"]), size)
        errors.append(seen - made["pixels"])
    return measured("its JSON, nested and off-axis, read by us", errors, cameras=job.cameras)


def _installed(job: Job) -> Path:
    folder = job.home / "node_modules" / "three"
    if not folder.is_dir():
        raise PeerMissing("npm could not install three")
    return folder


def _ask(job: Job, question: dict[str, Any]) -> Any:
    node = shutil.which("node")
    if node is None:
        raise PeerMissing("node is not there")
    asked, answer = job.folder / "asked.json", job.folder / "answer.json"
    asked.write_text(json.dumps(question))
    command = [node, str(SCRIPT), str(job.home), str(asked), str(answer)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"node: {done.stderr.strip()}")
    return json.loads(answer.read_text())
