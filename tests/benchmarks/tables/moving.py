"""One object of many is moved: how long until the next ray sees it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from renderer.camera import Camera
from renderer.scene import Mesh, Scene, flatten
from renderer.trace import Tracer
from tests.benchmarks.lucida import VISIBILITY
from tests.benchmarks.measure import Timing, seconds
from tests.benchmarks.report import Table, ms
from tests.benchmarks.run import Run
from tests.benchmarks.scenes import many_objects

AT_MOST_MS = 5.0
TRIANGLES, OBJECTS = 70_000, 64


def measure(run: Run) -> list[Table]:
    """One table: moving one object, against preparing the scene anew."""
    run.say("moving")
    header = ("what", "objects", "triangles", "ms (quartiles)")
    table = Table("moving", "Moving one object of many, until the next ray", header)
    scene = many_objects(TRIANGLES, OBJECTS)
    triangles = len(flatten(scene).faces)
    camera = Camera.look_at((20.0, 14.0, 25.0), (6.0, 6.0, 6.0))
    count = 10 if run.quick else 40

    def first_ray(tracer: Tracer) -> None:
        tracer.render(camera, (1, 1), VISIBILITY)

    def prepare_anew(scene: Scene) -> None:
        with Tracer(scene) as tracer:
            first_ray(tracer)

    def move(tracer: Tracer, scene: Scene) -> None:
        tracer.set_scene(scene)
        first_ray(tracer)

    anew, moved = [], []
    for step in range(max(3, count // 8)):
        anew.append(seconds(partial(prepare_anew, moved_object(scene, step))))
    can_move = hasattr(Tracer, "set_scene")
    if can_move:
        with Tracer(scene) as tracer:
            first_ray(tracer)
            for step in range(count):
                scene = moved_object(scene, step)
                moved.append(seconds(partial(move, tracer, scene)))
    for name, samples in (("prepared anew", anew), ("one object moved", moved)):
        if samples:
            timing = Timing(tuple(samples[1:]))  # the first may compile
            cells = (name, str(OBJECTS), f"{triangles:,}", ms(timing))
            table.add(*cells, what=name, triangles=triangles, **timing.numbers())
    best = Timing(tuple((moved or anew)[1:]))
    if not can_move:
        table.notes.append("Lucida's Tracer cannot exchange its scene yet: it is prepared anew.")
    table.target("one object moved", 1e3 * best.median_s, AT_MOST_MS, "ms", at_least=False)
    return [table]


def moved_object(scene: Scene, step: int) -> Scene:
    """The scene with one of its meshes moved a little and turned; the others are the same."""
    number = step * 7 % len(scene.objects)
    entry = scene.objects[number]
    assert isinstance(entry.shape, Mesh)
    angle = 0.1 * (step + 1)
    turn = np.eye(4)
    turn[:3, :3] = [
        [np.cos(angle), 0, np.sin(angle)],
        [0, 1, 0],
        [-np.sin(angle), 0, np.cos(angle)],
    ]
    turn[:3, 3] = 0.05
    moved = replace(entry, shape=replace(entry.shape, transform=entry.shape.transform @ turn))
    objects = (*scene.objects[:number], moved, *scene.objects[number + 1 :])
    return replace(scene, objects=objects)
