"""Films on workers: frames a second, bytes a frame, the scene's way to the workers, and what the
scheduler costs a task. `python -m tests.benchmarks.films [--workers 100]`, for docs/animation.md.
"""

from __future__ import annotations

import argparse
import pickle
import time
from collections.abc import Iterator

from dask.distributed import Client, LocalCluster, as_completed

from app.cameras.focus import scene_focus
from app.films.frames import Look, Shot
from app.films.paths import around
from app.films.workers import AHEAD, drawn_by_workers, drawn_here
from renderer import load_scene
from renderer.scene.model import Mesh, Scene, SceneObject
from tests.benchmarks.meshes import knot

SIZE, FRAMES, TASKS = (1280, 720), 48, 4000
SCENES, RENDERERS = ("still-life", "columns"), ("raster", "ray")
FRAME = bytes(300_000)  # what a task of the simulation returns


def rate(pictures: Iterator[tuple[int, bytes]]) -> tuple[float, float]:
    """Return frames a second after the first two, and the mean of bytes a frame."""
    sizes, times = [], []
    for _, content in pictures:
        sizes.append(len(content))
        times.append(time.perf_counter())
    return (len(times) - 2) / (times[-1] - times[1]), sum(sizes) / len(sizes)


def frames() -> None:
    """Print the rates of both renderers for some numbers of workers."""
    for name in SCENES:
        scene = load_scene(name)
        cameras = around(scene.view, scene_focus(scene), SIZE, FRAMES)
        shots = {number: Shot(camera, SIZE) for number, camera in enumerate(cameras)}
        for renderer in RENDERERS:
            look = Look(renderer)
            rates = [rate(drawn_here(scene, look, shots))]
            rates += [rate(drawn_by_workers(scene, look, shots, count)) for count in (2, 4)]
            texts = ", ".join(f"{count:.1f}" for count, _ in rates)
            print(f"{name}, {renderer}: {texts} frames/s here, by 2 and 4 workers; ", end="")
            print(f"{rates[0][1] / 1e3:.0f} kB a frame", flush=True)


def empty(number: int, content: bytes) -> bytes:
    return content


def overhead(workers: int) -> None:
    """Print what a task costs that does nothing, and one that returns a frame's bytes."""
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        client.wait_for_workers(workers)
        for what, content in (("nothing", b""), ("300 kB", FRAME)):
            sent = client.scatter(content, broadcast=True)
            begin_s, given = time.perf_counter(), AHEAD * workers
            running = as_completed(
                [client.submit(empty, number, sent, pure=False) for number in range(given)],
                with_results=True,
            )
            for _ in running:
                if given < TASKS:
                    running.add(client.submit(empty, given, sent, pure=False))
                    given += 1
            task_ms = 1e3 * (time.perf_counter() - begin_s) / given
            print(f"{workers} workers, returning {what}: {task_ms:.2f} ms a task", flush=True)
        scene = Scene((SceneObject(Mesh(*knot(1_000_000))),))
        begin_s = time.perf_counter()
        client.scatter({"scene": scene}, broadcast=True)
        took_s, size = time.perf_counter() - begin_s, len(pickle.dumps(scene))
        what = f"a million triangles: {size / 1e6:.1f} MB"
        print(f"{what} to {workers} workers in {took_s:.2f} s", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers", type=int, default=2)
    asked = parser.parse_args()
    if asked.workers == 2:
        frames()
    overhead(asked.workers)
