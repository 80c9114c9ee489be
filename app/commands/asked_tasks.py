"""The tasks of a task file, of a course, or the built-in ones, as the commands name them."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import LucidaError, visible

if TYPE_CHECKING:
    from lucida.app.checking.tasks import CheckTask, Limits


def all_tasks(source: str | None) -> tuple[list[CheckTask], Limits]:
    """Return the tasks and limits of a task file or a course; without one, the built-in tasks."""
    from lucida.app.checking.task_file import BUILTIN
    from lucida.app.checking.tasks import Limits

    if source is None:
        return list(BUILTIN), Limits()
    from lucida.app.checking.courses import task_path
    from lucida.app.checking.task_file import load_tasks

    found = load_tasks(task_path(source))
    for note in found.notes:
        print(f"lucida: {visible(source)}: {note}", file=sys.stderr)
    return list(found.tasks), found.limits


def named(tasks: list[CheckTask], name: str, field: str = "--task") -> CheckTask:
    """Return the task with a name, also with _ for -, or with a function's name. Raises
    LucidaError. field: the argument that has the name.
    """
    from lucida.renderer.files.reading import suggestion

    for task in tasks:
        if name in (task.name, task.function) or name.replace("_", "-") == task.name:
            return task
    names = [task.name for task in tasks]
    raise LucidaError(field, f"{name[:40]!r} is unknown", suggestion(name, names))
