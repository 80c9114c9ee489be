"""The tasks that `lucida check` tries, from its arguments, a task file and the student's code."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import LucidaError, visible

if TYPE_CHECKING:
    from lucida.app.checking.running.program import ProgramStudent
    from lucida.app.checking.tasks import CheckTask, Limits

WITH_CAMERAS = ("viewing-ray", "render")  # kinds of tasks with cameras

SIZE = (64, 48)  # of --view's image at most; its aspect ratio is the camera's own


def all_tasks(source: str | None) -> tuple[list[CheckTask], Limits]:
    """Return the tasks and limits of a task file or a course; without one, the built-in tasks."""
    from lucida.app.checking.builtin import BUILTIN
    from lucida.app.checking.tasks import Limits

    if source is None:
        return list(BUILTIN), Limits()
    from lucida.app.checking.courses import task_path
    from lucida.app.checking.task_file import load_tasks

    found = load_tasks(task_path(source))
    for name in found.removed:
        print(f"lucida: {name} in {visible(source)} is ignored; see CHANGELOG.md", file=sys.stderr)
    return list(found.tasks), found.limits


def asked_for(arguments: argparse.Namespace) -> tuple[list[CheckTask], Limits]:
    """Return the tasks of the arguments, even if the code lacks their functions, and the limits."""
    tasks, limits = all_tasks(arguments.tasks)
    if arguments.task is not None:
        tasks = [named(tasks, arguments.task)]
    if arguments.time_limit is not None:
        limits = replace(limits, seconds=arguments.time_limit)
    if arguments.memory_limit is not None:
        limits = replace(limits, memory_mb=arguments.memory_limit)
    return _changed(arguments, tasks), limits


def named(tasks: list[CheckTask], name: str, field: str = "--task") -> CheckTask:
    """Return the task with a name, also with _ for -, or with a function's name. Raises
    LucidaError. field: the argument that has the name.
    """
    from lucida.renderer.files.reading import suggestion

    wanted = name.replace("_", "-")
    found = [task for task in tasks if task.name == name]
    found += [task for task in tasks if task.name.replace("_", "-") == wanted]
    found += [task for task in tasks if task.function == name]
    if not found:
        names = [task.name for task in tasks]
        raise LucidaError(field, f"{name[:40]!r} is unknown", suggestion(name, names))
    return found[0]


def _changed(arguments: argparse.Namespace, tasks: list[CheckTask]) -> list[CheckTask]:
    """Return the tasks with the arguments' camera, size, seed and indexing."""
    if arguments.seed is not None:
        tasks = [replace(task, seed=arguments.seed) for task in tasks]
    if arguments.indexing is not None:
        base = arguments.indexing.value
        tasks = [replace(task, conventions=replace(task.conventions, base=base)) for task in tasks]
    if arguments.view is not None:
        return _with_view(arguments, tasks)
    if arguments.size is not None:
        return [_sized(task, arguments.size) for task in tasks]
    return tasks


def _sized(task: CheckTask, size: tuple[int, int]) -> CheckTask:
    from lucida.app.checking.cases import check_size

    if task.kind not in WITH_CAMERAS:
        return task
    sized = replace(task, size=size)
    check_size(sized, "--size")
    return sized


def _with_view(arguments: argparse.Namespace, tasks: list[CheckTask]) -> list[CheckTask]:
    from lucida.app.checking.cases import check_size, check_views
    from lucida.app.commands.given_camera import say_changes, viewed
    from lucida.renderer.scene.model import View

    posed = viewed(arguments)
    assert posed is not None
    view = View(posed.camera, posed.fit)
    size = arguments.size or _small(posed.size)
    projection = view.camera.projection
    seen = [
        replace(task, views=(view,), count=0, size=size, projections=(projection,))
        for task in tasks
        if task.kind in WITH_CAMERAS and projection in task.projections
    ]
    if not seen:
        raise LucidaError("--view", f"no task is tried in {projection}", "give another camera")
    for task in seen:
        check_size(task, "--size")
        check_views(task)
    say_changes([posed], size)
    return seen


def _small(own: tuple[int, int] | None) -> tuple[int, int]:
    """Return a small size within SIZE, in the aspect ratio of the camera's own."""
    if own is None:
        return SIZE
    scale = min(SIZE[0] / own[0], SIZE[1] / own[1])
    width, height = (max(1, round(side * scale)) for side in own)
    return width, height


def possible(
    arguments: argparse.Namespace, student: ProgramStudent, tasks: list[CheckTask]
) -> list[CheckTask]:
    """Return the tasks to try: all that a lecturer or the user has named; of the built-in ones,
    those whose functions exist.
    """
    functions = student.functions()
    if functions is None or arguments.tasks is not None or arguments.task is not None:
        return tasks
    found = [task for task in tasks if task.function in functions]
    if not found:
        problem = "it has none of the functions that are asked for"
        raise LucidaError("", problem, _missing(tasks, functions), arguments.file)
    return found


def _missing(tasks: list[CheckTask], functions: frozenset[str]) -> str:
    """Return what to do if none of the tasks' functions exists."""
    from lucida.renderer.files.reading import close_matches

    names = list(dict.fromkeys(task.function for task in tasks))
    plain = {name.replace("_", ""): name for name in names}
    for function in sorted(functions):
        if close := close_matches(function.replace("_", ""), plain, 0.8):
            return f"is {function} to be {plain[close[0]]}?"
    return f"define one of {', '.join(names)}"
