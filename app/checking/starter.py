"""A starter file for students: an empty function with a description of the task."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from app.checking.conventions import CAMERA, CAMERA_WORDS
from app.checking.kinds import KINDS
from app.checking.tasks import CheckTask
from app.explaining.symbols import arguments
from renderer.errors import visible

_WIDTH = 96


def starter(tasks: Sequence[CheckTask]) -> str:
    """Return the text of a Python file. Tasks with the same function share it."""
    parts = ['"""What is to be written; `lucida check` with this file\'s name tries it."""']
    for function in dict.fromkeys(task.function for task in tasks):
        parts.append(_function([task for task in tasks if task.function == function]))
    return "\n\n\n".join(parts) + "\n"


def signature(task: CheckTask) -> str:
    """Return the call with its arguments: `viewing_ray(i, j, width, height, camera)`."""
    names = (_shown(name, word, task) for name, word in task.conventions.arguments)
    return f"{task.function}({', '.join(names)})"


def returned(task: CheckTask) -> str:
    """Return the names of the returned parts, `origin, direction`; a description if there are no
    parts.
    """
    return ", ".join(task.conventions.returns) or KINDS[task.kind].answer


def _function(tasks: Sequence[CheckTask]) -> str:
    first = tasks[0]
    lines = [f"def {signature(first)}:", '    """' + _wrapped(first.text, 4)[0].lstrip()]
    lines += _wrapped(first.text, 4)[1:]
    for task in tasks[1:]:
        lines += ["", *_wrapped(task.text, 4)]
    lines += ["", *arguments_text(first), f"    Returns: {returned(first)}", '    """']
    return "\n".join([*lines, "    return None  # write it here"])


def arguments_text(task: CheckTask, indent: int = 4) -> list[str]:
    """Return lines that explain each argument, and each field of a camera."""
    words, said = KINDS[task.kind].words, task.conventions.explained
    lines = []
    for name, word in task.conventions.arguments:
        shown = _shown(name, word, task)
        lines += _wrapped(f"{shown}: {said(words[word])}", indent, indent + 4)
        if word == CAMERA:
            for field, meant in task.conventions.camera:
                its = _shown(field, meant, task)
                text = f"{shown}.{its}: {said(CAMERA_WORDS[meant])}"
                lines += _wrapped(text, indent + 4, indent + 8)
    return lines


def _shown(name: str, word: str, task: CheckTask) -> str:
    """Return an argument or a field in the task's notation, unless the course has named it."""
    return arguments(name, task.notation) if name == word else name


def _wrapped(text: str, indent: int, more: int | None = None) -> list[str]:
    return textwrap.wrap(
        visible(text).replace("\\", "\\\\").replace('"', "'"),
        _WIDTH,
        initial_indent=" " * indent,
        subsequent_indent=" " * (indent if more is None else more),
        break_long_words=False,
    )
