"""The answers of a class, read from files and counted in one table by step.

The files are those of `lucida lecture --answers` and of `lucida check --json`. They may hold
anything: a part that cannot be read costs a line, and all text is escaped.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import msgspec

from lucida.app.lecture.answer_log import KeptAnswer
from lucida.app.web.lecture.text import plain, written
from lucida.renderer.files.reading import read_file
from lucida.renderer.system.errors import LucidaError, counted, shortened

LARGEST = 256 << 20  # bytes of a file
LONGEST = 400  # characters of a text from a file
MOST_LINES = 20  # that are reported of a file, which may be something else
HEAD = """\
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>What the class answered</title>
<style>
:root { color-scheme: light dark; }
body { margin: 0 auto; max-width: 64rem; padding: 1rem; font: 1rem/1.5 system-ui, sans-serif; }
table { border-collapse: collapse; width: 100%; } ul { margin: 0; padding-left: 1.2rem; }
li p { display: inline; margin-right: .3rem; } li p:first-of-type, .bold { font-weight: 600; }
th, td { border-bottom: 1px solid gray; padding: .4rem .6rem; text-align: left;
  vertical-align: top; }
td.count { text-align: right; font-variant-numeric: tabular-nums; }
</style></head><body>
<h1>What the class answered</h1>
"""
COLUMNS = ("step", "correct at once", "correct later", "not correct yet", "mistakes")


class NamedMistake(msgspec.Struct, frozen=True, rename={"name": "mistake"}):
    """name: unique. reply: its explanation, as a lecture's text. read: the step to read again."""

    name: str
    reply: str = ""
    read: str = ""


@dataclass(frozen=True)
class ClassAnswer:
    """An answer.

    student: a typed name, a sitting or a file of results; never shown.
    step: its title; for code, the task.
    time: in UTC, as text that sorts by time; empty if unknown.
    helped: given after the solution was shown.
    """

    student: str
    step: str
    right: bool
    time: str = ""
    mistakes: tuple[NamedMistake, ...] = ()
    helped: bool = False


def summary(answers: Sequence[ClassAnswer]) -> str:
    """Return the numbers of answers and students, in words."""
    students = len({answer.student for answer in answers})
    return f"{counted((len(answers), 'answer'))} by {counted((students, 'student'))}"


def page(answers: Sequence[ClassAnswer], titles: Sequence[str]) -> str:
    """Return one self-contained HTML page: a row for each step, in the order of the titles.

    titles: of the lecture's steps.
    """
    numbers = {title: number for number, title in reversed(list(enumerate(titles, 1)))}
    by_step: dict[str, list[ClassAnswer]] = defaultdict(list)
    for answer in sorted(answers, key=lambda one: one.time):
        by_step[answer.step].append(answer)
    steps = sorted(by_step, key=lambda title: numbers.get(title, len(titles) + 1))
    head = "".join(f"<th>{name}</th>" for name in COLUMNS)
    rows = "".join(_row(title, by_step[title], numbers) for title in steps)
    return (
        f"{HEAD}<p>{summary(answers)}</p>\n<table><tr>{head}</tr>\n{rows}</table>\n</body></html>\n"
    )


def counts(answers: Sequence[ClassAnswer]) -> tuple[int, int, int]:
    """Return the numbers of students who answered a step correctly at once, later, or not yet.

    answers: those to one step, in the order of time.
    """
    first: dict[str, ClassAnswer] = {}
    for answer in answers:
        first.setdefault(answer.student, answer)
    right = {answer.student for answer in answers if answer.right and not answer.helped}
    at_once = {who for who in right if first[who].right and not first[who].helped}
    return len(at_once), len(right - at_once), len(first.keys() - right)


def mistakes(answers: Sequence[ClassAnswer]) -> list[tuple[NamedMistake, int]]:
    """Return the mistakes in answers and the number of students who made each, most first."""
    known: dict[str, NamedMistake] = {}
    students: dict[str, set[str]] = defaultdict(set)
    for answer in answers:
        for mistake in answer.mistakes:
            known.setdefault(mistake.name, mistake)
            students[mistake.name].add(answer.student)
    found = [(mistake, len(students[name])) for name, mistake in known.items()]
    return sorted(found, key=lambda one: -one[1])


def _row(title: str, answers: Sequence[ClassAnswer], numbers: dict[str, int]) -> str:
    cells = "".join(f'<td class="count">{count}</td>' for count in counts(answers))
    items = "".join(
        f"<li>{counted((students, 'student'))}: {_mistake(mistake, numbers)}</li>"
        for mistake, students in mistakes(answers)
    )
    return f"<tr><td>{_step(title, numbers)}</td>{cells}<td><ul>{items}</ul></td></tr>\n"


def _mistake(mistake: NamedMistake, numbers: dict[str, int]) -> str:
    parts = [_lecture_text(text) for text in dict.fromkeys((mistake.name, mistake.reply)) if text]
    read = f"Explained by {_step(mistake.read, numbers)}." if mistake.read else ""
    return "".join(parts) + read


def _step(title: str, numbers: dict[str, int]) -> str:
    number = f"step {numbers[title]}, " if title in numbers else ""
    return number + plain(shortened(title, LONGEST))


def _lecture_text(text: str) -> str:
    """Return a lecture's text as HTML; as it is if it cannot be typeset."""
    text = shortened(text, LONGEST)
    try:
        return written(text)
    except LucidaError:
        return plain(text)


class _Extra(msgspec.Struct):
    mistakes: tuple[NamedMistake, ...] = ()
    time: datetime | None = None


class _Test(msgspec.Struct):
    name: str
    status: str
    extra_data: _Extra = msgspec.field(default_factory=_Extra)


class _Results(msgspec.Struct):
    """The file of a check, as Gradescope reads it."""

    tests: list[_Test]
    extra_data: _Extra = msgspec.field(default_factory=_Extra)


def read_answers(paths: Sequence[str | Path]) -> tuple[list[ClassAnswer], list[str]]:
    """Return all answers in the files, and a line for each part that could not be read."""
    answers: list[ClassAnswer] = []
    problems: list[str] = []
    for path in dict.fromkeys(map(Path, paths)):
        try:
            data = read_file(path, LARGEST)
        except LucidaError as error:
            problems.append(str(error))
            continue
        try:
            answers += _of_check(path, msgspec.json.decode(data, type=_Results))
        except (msgspec.DecodeError, UnicodeDecodeError):  # a lecture's, line by line
            found, lines = _of_lecture(path, data)
            answers += found
            problems += lines[:MOST_LINES]
    return answers, problems


def _of_check(path: Path, results: _Results) -> list[ClassAnswer]:
    time = results.extra_data.time
    return [
        ClassAnswer(
            str(path.absolute()),
            f"Your code: {test.name.partition(':')[0]}",
            test.status == "passed",
            time.isoformat() if time else "",
            test.extra_data.mistakes,
        )
        for test in results.tests
    ]


def _of_lecture(path: Path, data: bytes) -> tuple[list[ClassAnswer], list[str]]:
    answers, problems = [], []
    for number, line in enumerate(data.split(b"\n"), 1):
        if not line.strip():
            continue
        try:
            kept = msgspec.json.decode(line, type=KeptAnswer)
        except (msgspec.DecodeError, UnicodeDecodeError) as error:
            is_json = isinstance(error, msgspec.ValidationError)
            problem = f"is no answer: {error}" if is_json else "is no JSON"
            place = f"{path}:{number}"
            problems.append(str(LucidaError("", problem, "delete the line", place)))
            continue
        made = (NamedMistake(kept.mistake, kept.reply, kept.read),) if kept.mistake else ()
        student, time = kept.name or kept.sitting, kept.time.isoformat()
        answers.append(ClassAnswer(student, kept.step, kept.right, time, made, kept.after_solution))
    return answers, problems
