"""The starter file for students, and diagnoses in the task's words.

A starter file has an empty function with a description of the task.
"""

from __future__ import annotations

import ast
import builtins
import keyword
import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence

from lucida.app.ui.explaining.symbols import arguments, program, spoken
from lucida.renderer.system.errors import visible

from .conventions import CAMERA, CAMERA_WORDS
from .kinds import KINDS
from .mistakes.programs import program_of
from .mistakes.vectors import FUNCTIONS
from .tasks import CheckTask
from .words import PARTS

AS_IF = "Your code behaves like"
_NAME = re.compile(r"(?<![\w.'])[A-Za-z_]\w*")
_PIXEL = re.compile(r" ?\b([ij])\b")  # in the words of a hint
_PYTHON = {*dir(builtins), *keyword.kwlist}


def shown_name(task: CheckTask, name: str, word: str) -> str:
    """Return an argument or a field in the task's notation, or the course's own name for it."""
    return arguments(name, task.notation) if name == word else name


def own_names(task: CheckTask) -> dict[str, str]:
    """Return the student's name for each name of the programs: the task's for values that it
    passes, and the notation's for values that the lines compute.
    """
    computed = {
        node.id
        for node in ast.walk(ast.parse(program_of(task).source()))
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    computed |= {"i", "j"} if task.kind == "render" else set()
    given = {name: text for name, text in _given(task) if name not in computed}
    taken = {_NAME.findall(text)[0] for text in given.values()} | FUNCTIONS.keys()
    own: dict[str, str] = {}
    letters = {name: program(name, task.notation).removeprefix("cam.") for name in computed}
    for name in sorted(computed, key=lambda name: (letters[name] != name, name)):
        own[name] = next(text for text in (letters[name], name, f"{name}_") if text not in taken)
        taken.add(own[name])
    return given | own


def _given(task: CheckTask) -> Iterator[tuple[str, str]]:
    """Yield the names of the values that the task passes, and their texts."""
    for name, word in task.conventions.arguments:
        text = shown_name(task, name, word)
        yield from _parts(word, text)
        if word == CAMERA:
            for field, meant in task.conventions.camera:
                yield from _parts(meant, f"{text}.{shown_name(task, field, meant)}")


def _parts(word: str, text: str) -> Iterator[tuple[str, str]]:
    yield {"row": "i", "column": "j"}.get(word, word), text
    for part, at in PARTS.get(word, {}).items():
        yield part, text + at


def in_the_tasks_words(task: CheckTask, sentences: Sequence[str]) -> tuple[str, ...]:
    """Return sentences in the task's names and notation.

    A formula is included only if the task passes all of its values.
    """
    own = own_names(task)
    known = _PYTHON | FUNCTIONS.keys() | own.keys()
    told = []
    for sentence in sentences:
        if sentence.startswith(AS_IF):
            codes = sentence.split("`")[1::2]
            if not all(map(known.issuperset, map(_NAME.findall, codes))):
                continue
        told.append(_in_words(task, own, sentence))
    return tuple(told)


def _in_words(task: CheckTask, own: Mapping[str, str], sentence: str) -> str:
    """Replace the names in a sentence's code, and a pixel's i and j, by the task's names."""

    def named(found: re.Match[str]) -> str:
        return own.get(found[0]) or program(found[0], task.notation)

    def place(found: re.Match[str]) -> str:
        name = own.get(found[1], "")
        return found[0] if name == found[1] else found[0][:-1] + f"`{name}`" if name else ""

    parts = sentence.split("`")
    parts[::2] = [_PIXEL.sub(place, prose) for prose in parts[::2]]
    parts[1::2] = [_NAME.sub(named, code) for code in parts[1::2]]
    return "`".join(parts)


_WIDTH = 96


def starter(tasks: Sequence[CheckTask]) -> str:
    """Return the text of a Python file with the tasks' functions. Tasks with the same function
    share it.
    """
    parts = ['"""Functions to write. `lucida check` with this file\'s name tries them."""']
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
    return ", ".join(task.conventions.returns) or spoken(KINDS[task.kind].answer, task.notation)


def _function(tasks: Sequence[CheckTask]) -> str:
    first = tasks[0]
    text = "\n\n".join("\n".join(_wrapped(task.text, 4)) for task in tasks)
    lines = [f"def {signature(first)}:", f'    """{text.lstrip()}', "", *arguments_text(first)]
    lines += [f"    Returns: {returned(first)}", '    """', "    return None  # write it here"]
    return "\n".join(lines)


def arguments_text(task: CheckTask, indent: int = 4) -> list[str]:
    """Return lines that explain each argument, and each field of a camera."""
    words, said = KINDS[task.kind].words, task.conventions.explained
    lines = []
    for name, word in task.conventions.arguments:
        shown = shown_name(task, name, word)
        meaning = spoken(said(words[word]), task.notation)
        lines += _wrapped(f"{shown}: {meaning}", indent, indent + 4)
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
