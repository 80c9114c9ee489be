"""Blender: bpy runs our scripts and makes cameras of its own; world_to_camera_view() says where.

Blender's numbers are float32. world_to_camera_view() takes the picture's shape from the resolution
without resolution_percentage; what is rendered has whole pixels, fractions cut off. So a picture of
less than 100 % is held against the render's own projection, calc_matrix_camera() at the size that
it renders, and the sizes against pictures that were rendered.
"""

from __future__ import annotations

import contextlib
import json
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from renderer.camera_formats import PosedCamera, written
from renderer.errors import LucidaError
from tests.conformance.cameras import Case, cases, only, pixels, read
from tests.conformance.float32 import point_bounds
from tests.conformance.measured import Checked, Job, Measured, PeerMissing, asked, measured
from tests.peer_environment import apart
from tests.support.format_cameras import lens_camera, straight_camera

SCRIPT = Path(__file__).parents[1] / "blender_peer.py"
RENDERED = 20  # pictures
KINDS = ("equidistant", "equisolid", "equirectangular", "cylindrical")

# Roundings through world_to_camera_view(): bpy_extras, mathutils and camera.cc.
IN_SPACE = {
    "the point, and a matrix or a location, stored": 2,
    "a matrix out of angles: a sine, a cosine, three products and a sum": 6,
    "its columns' lengths: three squares, two sums, a root, a division": 7,
    "its inverse: cofactors and the determinant of products and sums, a division": 12,
    "times the point: four products and three sums": 7,
}
IN_PICTURE = {
    "lens, sensor, shift and the pixels' shape, stored": 5,
    "the frame: sensor by lens, by the picture's side, times its half, moved": 8,
    "the frame as far away as the point: two divisions": 2,
}


def check(job: Job) -> Checked:
    version = _ask(job, {"do": "version"})
    return Checked(
        f"bpy {version}: `world_to_camera_view`, `calc_matrix_camera`, rendered sizes",
        (_ours(job), *_theirs(job), _rendered(job), *_panoramas(job)),
    )


def _ours(job: Job) -> Measured:
    scripts: list[str] = []
    made: list[Case] = []
    for case in cases(replace(job, cameras=2 * job.cameras), straight_camera, True):
        # Our writer refuses pixels that are too far from square for Blender.
        with contextlib.suppress(LucidaError):
            scripts.append(case.file("blender").decode())
            made.append(case)
    made = made[: job.cameras]
    given = [
        {"script": script, "size": case.size, "points": case.points.tolist()}
        for script, case in zip(scripts, made, strict=False)
    ]
    seen = _ask(job, {"do": "read", "cameras": given})
    errors = [np.array(one) - case.pixels for one, case in zip(seen, made, strict=True)]
    return measured("our scripts, run by bpy", errors, [_bounds(case) for case in made])


def _bounds(case: Case) -> np.ndarray:
    return point_bounds(case.camera, case.size, case.points, IN_SPACE, IN_PICTURE)


def _theirs(job: Job) -> list[Measured]:
    """Pictures of 100 %, and smaller ones."""
    found: list[list[tuple[np.ndarray, np.ndarray]]] = [[], []]
    for made in _ask(job, {"do": "write", "count": 2 * job.cameras, "seed": job.seed}):
        posed = only(read(made["text"].encode(), "blender"))
        if posed.size != tuple(made["size"]):
            raise AssertionError(f"renders {made['size']}, and {posed.size} was read")
        points = np.array(made["points"])
        error = pixels(posed.camera, points, posed.size) - made["pixels"]
        bound = _bounds(Case(PosedCamera(posed.camera, posed.size), points, error))
        found[made["is_share"]].append((error, bound))
    names = ("its values, read by us", "its values with a resolution_percentage, read by us")
    return [measured(what, *zip(*of, strict=True)) for what, of in zip(names, found, strict=True)]


def _rendered(job: Job) -> Measured:
    """The sizes of pictures that it renders."""
    errors = []
    for made in _ask(job, {"do": "render", "count": RENDERED, "seed": job.seed}):
        posed = only(read(json.dumps(made["values"]).encode(), "blender"))
        errors.append(np.subtract(posed.size, made["size"]))
    return measured("size of a rendered picture", errors, 0.0, unit="pixels of a side")


def _panoramas(job: Job) -> list[Measured]:
    """Measure where our cameras see the directions in which Cycles looks at pixels' centres.

    It looks at random places within 0.005 pixels of them.
    """
    ours, random = [], job.random
    while len(ours) < RENDERED:
        camera = lens_camera(random, KINDS[len(ours) % len(KINDS)])
        ours.append(PosedCamera(camera, (48, 32)))
    scripts = [written([posed], "blender")[""].decode() for posed in ours]
    looked = _ask(job, {"do": "look", "scripts": scripts})
    made = _ask(job, {"do": "panoramas", "count": RENDERED, "seed": job.seed})
    theirs = [only(read(json.dumps(one["values"]).encode(), "blender")) for one in made]
    return [
        measured(f"rays of {what} panoramic cameras", _missed(cameras, rays), 0.01, beside=True)
        for what, cameras, rays in (
            ("our", ours, looked),
            ("its", theirs, [one["looked"] for one in made]),
        )
    ]


def _missed(cameras: list[PosedCamera], looked: list[Any]) -> list[float]:
    """Return the largest error in each picture."""
    errors = []
    for posed, rays in zip(cameras, looked, strict=True):
        assert posed.size is not None
        width, height = posed.size
        ways = np.reshape(rays, (height, width, 3))
        rows, columns = np.mgrid[:height, :width]
        seen = posed.camera.project(posed.camera.eye + ways, posed.size)
        missed = np.hypot(seen.row - rows, seen.column - columns)
        # Where it does not look, it is black, which are not the numbers of a direction.
        looks = np.abs(np.linalg.norm(ways, axis=2) - 1) < 1e-3
        if looks.mean() < 0.5:
            raise AssertionError(f"Blender looks at {looks.mean():.0%} of a picture")
        errors.append(float(missed[looks].max()))
    return errors


def _ask(job: Job, question: dict[str, Any]) -> Any:
    home = apart(job.home, "bpy")
    if not (home / "bpy").is_dir():
        raise PeerMissing("pip could not install bpy")
    # Its own NumPy, not Lucida's.
    environment = {**os.environ, "PYTHONPATH": str(home)}
    return asked(job, question, [sys.executable, "-P", str(SCRIPT)], env=environment)
