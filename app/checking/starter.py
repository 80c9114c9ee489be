"""A starter file for students: an empty function with a description of the task."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

from lucida.app.checking.conventions import CAMERA, CAMERA_WORDS
from lucida.app.checking.kinds import KINDS
from lucida.app.checking.own_words import functions, shown_name
from lucida.app.checking.tasks import CheckTask
from lucida.renderer.system.errors import visible

_WIDTH = 96
_NUMPY = {"atan2": "arctan2 as atan2"}  # names that NumPy has only from version 2 on
# The functions of formulas that NumPy lacks, with those that they use.
_WRITTEN = {
    "normalized": ("array(a) / sqrt(dot(a, a))", "a", {"array", "dot", "sqrt"}),
    "vector": ("array((x, y, z), float)", "x, y, z", {"array"}),
    "inverse": ("linalg.inv(matrix)", "matrix", {"linalg"}),
    "times_point": ("(array(matrix) @ (*a, 1))[:3]", "matrix, a", {"array"}),
    "times_vector": ("(array(matrix) @ (*a, 0))[:3]", "matrix, a", {"array"}),
}


def starter(tasks: Sequence[CheckTask]) -> str:
    """Return the text of a Python file: the tasks' functions, and those that formulas of reports
    use. Tasks with the same function share it.
    """
    parts = ['"""What is to be written; `lucida check` with this file\'s name tries it."""']
    used = set().union(*map(functions, tasks))
    written = [name for name in _WRITTEN if name in used]
    used = used.union(*(_WRITTEN[name][2] for name in written)) - set(written)
    if used:
        parts[0] += (
            f"\n\nfrom numpy import {', '.join(_NUMPY.get(name, name) for name in sorted(used))}"
        )
    parts += [
        f"def {name}({_WRITTEN[name][1]}):\n    return {_WRITTEN[name][0]}" for name in written
    ]
    for function in dict.fromkeys(task.function for task in tasks):
        parts.append(_function([task for task in tasks if task.function == function]))
    return "\n\n\n".join(parts) + "\n"


def signature(task: CheckTask) -> str:
    """Return the call with its arguments: `viewing_ray(i, j, width, height, camera)`."""
    names = (shown_name(task, name, word) for name, word in task.conventions.arguments)
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
        shown = shown_name(task, name, word)
        lines += _wrapped(f"{shown}: {said(words[word])}", indent, indent + 4)
        if word == CAMERA:
            for field, meant in task.conventions.camera:
                its = shown_name(task, field, meant)
                text = f"{shown}.{its}: {said(CAMERA_WORDS[meant])}"
                lines += _wrapped(text, indent + 4, indent + 8)
    return lines


def _wrapped(text: str, indent: int, more: int | None = None) -> list[str]:
    return textwrap.wrap(
        visible(text).replace("\\", "\\\\").replace('"', "'"),
        _WIDTH,
        initial_indent=" " * indent,
        subsequent_indent=" " * (indent if more is None else more),
        break_long_words=False,
    )
