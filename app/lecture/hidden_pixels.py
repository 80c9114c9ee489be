"""The solutions of a lecture's hiding exercises, tried in images like a student's answers.

The tracer is imported on first use, because it loads the compiler.
"""

from __future__ import annotations

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError, errors_as

from .hiding import HideExercise, Ids
from .model import Lecture

SIZE = (960, 720)  # of the images in which answers are tried


def ids_seen(scene: Scene, camera: Camera, size: tuple[int, int]) -> Ids:
    """Return the ids (height, width) of a traced image. size: (width, height)."""
    from lucida.renderer.trace import Tracer

    with Tracer(scene) as tracer:
        ids: Ids = tracer.render(camera, size, channels=("id",)).channel("id")
    return ids


def first_wrong_answer(lecture: Lecture) -> LucidaError | None:
    """Return an error for the first exercise with a wrong answer, or one that is solved from the
    start; None if all are correct.
    """
    for build in lecture.builds:
        if isinstance(build.exercise, HideExercise):
            try:
                _check(build.exercise)
            except LucidaError as error:
                return error.within(f"steps[{build.number}].exercise")
    return None


def _check(task: HideExercise) -> None:
    camera = task.view.for_size(SIZE)
    alone = task.pixels(task.without, ids_seen(task.without, camera, SIZE))
    if not alone:
        problem = f"{task.hidden!r} is not in the picture"
        raise LucidaError("hidden", problem, "put it in front of the step's camera")
    if task.check(task.scene, ids_seen(task.scene, camera, SIZE), alone).right:
        problem = f"{task.hidden!r} is hidden before anything is moved"
        raise LucidaError("object", problem, "put the object elsewhere in the scene")
    with errors_as("answer"):
        there = task.solved(task.scene)
    judged = task.check(there, ids_seen(there, camera, SIZE), alone)
    if not judged.right:
        problem = f"is not correct: {judged.text}"
        raise LucidaError("answer", problem.rstrip("."), "move it in the window, and read it there")
