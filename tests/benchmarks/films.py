"""Films on workers: what a frame costs, how many bytes it has, the scene's way to the workers, and
what the scheduler costs a task. `python -m tests.benchmarks.films`, for docs/animation.md.

Times are of processors, so that other programs on the machine do not count.
"""

from __future__ import annotations

import pickle
import time

from dask.distributed import Client, LocalCluster, as_completed

from app.films.frames import Look, Shot
from app.films.paths import around
from app.films.workers import AHEAD, drawn_here
from renderer import load_scene
from renderer.focus import scene_focus
from renderer.scene.model import Mesh, Scene, SceneObject
from tests.benchmarks.meshes import knot

SIZE, FRAMES, TASKS = (1280, 720), 24, 2000
SCENES, RENDERERS = ("still-life", "columns"), ("raster", "ray")
FRAME = bytes(300_000)  # what a task of the simulation returns


def frames() -> None:
    """Print what a frame costs with both renderers, and its bytes."""
    for name in SCENES:
        scene = load_scene(name)
        cameras = around(scene.view, scene_focus(scene), SIZE, FRAMES)
        shots = {number: Shot(camera, SIZE) for number, camera in enumerate(cameras)}
        for renderer in RENDERERS:
            sizes, times = [], []
            for _, content in drawn_here(scene, Look(renderer), shots):
                sizes.append(len(content))
                times.append(time.process_time())
            cost_s = (times[-1] - times[1]) / (FRAMES - 2)  # the first ones prepare the scene
            print(f"{name}, {renderer}: {cost_s:.3f} s a frame, ", end="")
            print(f"{sum(sizes) / FRAMES / 1e3:.0f} kB", flush=True)


def empty(number: int, content: bytes) -> bytes:
    return content


def overhead(workers: int) -> None:
    """Print what a task costs that does nothing, and one that returns a frame's bytes.

    Scheduler, client and workers are all in this process: their costs are counted together.
    """
    with (
        LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            memory_limit=0,
            dashboard_address=None,
            processes=False,
        ) as cluster,
        Client(cluster) as client,
    ):
        for what, content in (("nothing", b""), ("300 kB", FRAME)):
            sent = client.scatter(content, broadcast=True)
            begin_s, given = time.process_time(), AHEAD * workers
            running = as_completed(
                [client.submit(empty, number, sent, pure=False) for number in range(given)],
                with_results=True,
            )
            for _ in running:
                if given < TASKS:
                    running.add(client.submit(empty, given, sent, pure=False))
                    given += 1
            task_ms = 1e3 * (time.process_time() - begin_s) / given
            print(f"{workers} workers, returning {what}: {task_ms:.2f} ms a task", flush=True)
    scene = Scene((SceneObject(Mesh(*knot(1_000_000))),))
    print(f"a million triangles: {len(pickle.dumps(scene)) / 1e6:.1f} MB", flush=True)


if __name__ == "__main__":
    frames()
    for count in (2, 100):
        overhead(count)
