"""The built-in tasks, one for each part of the lecture, from builtin.toml."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import msgspec

from lucida.app.checking.conventions import Conventions
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.task_schema import PROJECTIONS, TaskTable
from lucida.app.checking.tasks import CAMERA_KINDS, CheckTask
from lucida.app.state.options.shared import Notation
from lucida.app.ui.explaining.symbols import spoken


class _File(msgspec.Struct):
    tasks: list[TaskTable]


def _task(table: TaskTable, notation: Notation) -> CheckTask:
    kind = KINDS[table.kind]
    words = tuple((word, word) for word in kind.arguments)
    return CheckTask(
        table.name or kind.name,
        kind.name,
        kind.function,
        table.part,
        spoken(table.text, notation),
        table.points,
        Conventions(words, returns=kind.returns),
        cameras=tuple(table.cameras or CAMERA_KINDS),
        projections=PROJECTIONS[table.projection or "perspective"],
        count=table.cases or 10,
        notation=notation,
    )


@lru_cache
def builtin_tasks(notation: Notation) -> tuple[CheckTask, ...]:
    """Return the tasks in a notation."""
    text = Path(__file__).with_suffix(".toml").read_bytes()
    tables = msgspec.toml.decode(text, type=_File).tasks
    return tuple(_task(table, notation) for table in tables)


BUILTIN = builtin_tasks("book")
