"""Rays that leave a closed mesh without a hit: there must be none."""

from __future__ import annotations

import numpy as np

from tests.benchmarks.cameras import random_inside, rays
from tests.benchmarks.peers import Trimesh
from tests.benchmarks.report import Table
from tests.benchmarks.run import Run
from tests.benchmarks.scenes import SUBJECTS

RAYS, FULL_RAYS, QUICK_RAYS = 5_000_000, 50_000_000, 500_000
SIZE = (800, 500)
SEED = 11


def measure(run: Run) -> list[Table]:
    """One table: pinholes by tracer, for camera images and for batches of single rays."""
    header = ("tracer", "rays from inside", "pinholes")
    table = Table("watertight", "Watertightness: rays from inside closed meshes", header)
    wanted = FULL_RAYS if run.full else QUICK_RAYS if run.quick else RAYS
    rng = np.random.default_rng(SEED)
    seen: dict[str, int] = {}
    missed: dict[str, int] = {}
    subjects = [SUBJECTS[name]() for name in ("ball 4k", "ball 70k")]
    for subject in subjects:
        with run.tracers(subject, Trimesh) as tracers:
            images = -(-wanted // (len(subjects) * SIZE[0] * SIZE[1]))
            for number in range(images):
                if number % 20 == 0:
                    run.say(f"watertight: {subject.name}, image {number + 1} of {images}")
                camera = random_inside(subject, SIZE, rng)
                for tracer in tracers:
                    tracer.image(camera, SIZE)
                    _count(seen, missed, tracer.name, tracer.hits().primitive)
                if number % 4 == 0:
                    ours = tracers[0]
                    ours.batch(*rays(camera, SIZE))
                    _count(seen, missed, f"{ours.name}, single rays", ours.hits().primitive)
    for name in seen:
        table.add(
            name, f"{seen[name]:,}", str(missed[name]), tracer=name, rays=seen[name],
            pinholes=missed[name],
        )  # fmt: skip
    own = sum(count for name, count in missed.items() if name.startswith("Lucida"))
    table.target("pinholes of Lucida's", own, 0, "", at_least=False)
    return [table]


def _count(seen: dict[str, int], missed: dict[str, int], name: str, primitive: np.ndarray) -> None:
    seen[name] = seen.get(name, 0) + len(primitive)
    missed[name] = missed.get(name, 0) + int(np.count_nonzero(primitive < 0))
