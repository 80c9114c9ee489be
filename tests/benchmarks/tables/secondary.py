"""Single rays in batches: shadows, mirror reflections, and rays that go anywhere.

The rays start where the primary ones of a view hit. Each tracer gets them in the form that it
takes, made before the watch starts.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from renderer.trace import Tracer
from tests.benchmarks.cameras import Rays, easy_views
from tests.benchmarks.peers import Mitsuba, Open3D
from tests.benchmarks.report import Table, short
from tests.benchmarks.run import Run
from tests.benchmarks.scenes import Subject, scene_of

AT_LEAST = {Mitsuba.name: 1.5, Open3D.name: 2.0}
SIZE = (960, 540)
SEED = 3


def measure(run: Run) -> list[Table]:
    """One table: a row a scene and kind of rays."""
    own = ("scene", "rays", "thousands", "Lucida ms (quartiles)", "Mrays/s")
    title = "Single rays: shadows (any hit), reflections (closest hit)"
    table = Table("secondary", title, own + run.peer_columns())
    ratios: dict[tuple[str, str], list[float]] = defaultdict(list)
    for subject in run.subjects("small", "70k", "1M"):
        with run.tracers(subject) as tracers:
            for name, (origins, directions) in secondary_rays(subject).items():
                run.say(f"secondary: {subject.name}, {name}")
                for tracer in tracers:
                    tracer.batch(origins, directions, name == "shadow")
                count = len(origins)
                found = table.compare(
                    subject.name, name, short(count / 1e3), timings=run.time(tracers), rays=count
                )
                for peer, ratio in found.items():
                    ratios[name, peer].append(ratio)
    for (name, peer), own_ratios in ratios.items():
        if peer in AT_LEAST:
            table.target(
                f"{name} rays, against {peer}, worst", min(own_ratios), AT_LEAST[peer], "x"
            )
    return [table]


def secondary_rays(subject: Subject) -> dict[str, tuple[Rays, Rays]]:
    """Batches of rays, origins and directions float32 (n, 3), from the points that a view shows.

    shadow: towards a light far away. mirror: the viewing ray reflected. diffuse: a direction of
    the hemisphere about the normal, by its cosine, in no order.
    """
    camera = easy_views(subject, SIZE)[0].camera
    with Tracer(scene_of(subject)) as tracer:
        frame = tracer.render(camera, SIZE, ("depth", "normal"))
    depth, normal = frame.channel("depth").ravel(), frame.channel("normal").reshape(-1, 3)
    hit = np.isfinite(depth)
    viewing = camera.rays(SIZE)
    origin, direction = (part.reshape(-1, 3)[hit] for part in viewing)
    n = normal[hit].astype(float)
    start = origin + depth[hit, None] * direction + n * (1e-4 * subject.radius)
    unit = direction / np.linalg.norm(direction, axis=1, keepdims=True)
    mirrored = unit - 2 * np.einsum("ij,ij->i", unit, n)[:, None] * n
    light = np.broadcast_to(np.array([0.3, 0.9, -0.3]), n.shape)
    ball = np.random.default_rng(SEED).normal(size=n.shape)
    cosine = n + ball / np.linalg.norm(ball, axis=1, keepdims=True) * (1 - 1e-6)
    ways = {"shadow": light, "mirror": mirrored, "diffuse": cosine}
    return {
        name: (start.astype(np.float32), np.ascontiguousarray(way, np.float32))
        for name, way in ways.items()
    }
